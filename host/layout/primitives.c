#include "layout/primitives.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { STORE_PARALLEL = 4096 }; // fewer are not worth waking threads

// Makes room for `capacity` primitives; on failure the list keeps what it has.
static bool reserve(PrimitiveList *list, u32 capacity)
{
    Primitive *primitives = realloc(list->primitives, capacity * sizeof *primitives);
    list->primitives = primitives ? primitives : list->primitives;
    PrimitiveInfo *infos = realloc(list->infos, capacity * sizeof *infos);
    list->infos = infos ? infos : list->infos;
    Box *boxes = realloc(list->boxes, capacity * sizeof *boxes);
    list->boxes = boxes ? boxes : list->boxes;
    ObjectFrame *frames = list->with_frames ? realloc(list->frames, capacity * sizeof *frames) : NULL;
    list->frames = frames ? frames : list->frames;
    if (!primitives || !infos || !boxes || (list->with_frames && !frames))
        return false;
    list->capacity = capacity;
    return true;
}

bool primitive_list_add(PrimitiveList *list, const Primitive *primitive, PrimitiveInfo info,
                        const ObjectFrame *frame, Box box, Error *error)
{
    if (list->count == list->capacity) {
        const u32 capacity = list->capacity ? 2 * list->capacity : 16;
        if (!reserve(list, capacity))
            return error_set(error, ERROR_MEMORY, "no memory for %u primitives", capacity);
    }
    list->primitives[list->count] = *primitive;
    list->infos[list->count] = info;
    list->boxes[list->count] = box;
    if (list->with_frames) {
        if (frame)
            list->frames[list->count] = *frame;
        else
            memset(&list->frames[list->count], 0, sizeof *list->frames);
    }
    list->count++;
    return true;
}

void primitive_list_store(const PrimitiveList *list, const u32 *order, u32 count, Primitive *primitives,
                          PrimitiveInfo *infos, ObjectFrame *frames)
{
#pragma omp parallel for if (count >= STORE_PARALLEL)
    for (u32 i = 0; i < count; i++) {
        const u32 from = order ? order[i] : i;
        primitives[i] = list->primitives[from];
        infos[i] = list->infos[from];
        if (frames)
            frames[i] = list->frames[from];
    }
}

void primitive_list_destroy(PrimitiveList *list)
{
    free(list->primitives);
    free(list->infos);
    free(list->frames);
    free(list->boxes);
    memset(list, 0, sizeof *list);
}

Box primitive_list_bounds(const PrimitiveList *list)
{
    Box bounds = list->boxes[0];
    for (u32 i = 1; i < list->count; i++) {
        for (int k = 0; k < 3; k++) {
            bounds.min[k] = fminf(bounds.min[k], list->boxes[i].min[k]);
            bounds.max[k] = fmaxf(bounds.max[k], list->boxes[i].max[k]);
        }
    }
    return bounds;
}

static f32 rounded_down(f64 x)
{
    const f64 finite = fmax(fmin(x, FLT_MAX), -FLT_MAX);
    return (f32)finite > finite ? nextafterf((f32)finite, -FLT_MAX) : (f32)finite;
}

Box box_from_bounds(Vec3 min, Vec3 max)
{
    return (Box){ { rounded_down(min.x), rounded_down(min.y), rounded_down(min.z) },
                  { -rounded_down(-max.x), -rounded_down(-max.y), -rounded_down(-max.z) } };
}
