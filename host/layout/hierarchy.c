#include "layout/hierarchy.h"

#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "layout/faces.h"

// Kernels count the numbers of a record from the first one of its array on in 31 bits.
static const u32 PRIMITIVES_MAX = 0x80000000u / (sizeof(ObjectFrame) / sizeof(f32)); // they are beside
static const u32 BLOCKS_MAX = 0x80000000u / (sizeof(TriangleBlock) / sizeof(f32));

typedef struct Hierarchies {
    Level **levels; // that hold anything, the world's first
    Bvh *built;     // beside them
    u32 count;
} Hierarchies;

static bool collect(Hierarchies *all, Placer *placer, Error *error)
{
    const u32 objects = placer->scene->object_count;
    all->levels = calloc(objects + (size_t)1, sizeof *all->levels);
    all->built = calloc(objects + (size_t)1, sizeof *all->built);
    if (!all->levels || !all->built)
        return error_set(error, ERROR_MEMORY, "no memory for %u objects", objects);
    if (placer->top.count > 0)
        all->levels[all->count++] = &placer->top;
    for (u32 i = 0; i < objects; i++)
        if (placer->objects[i].listed)
            all->levels[all->count++] = &placer->objects[i].level;
    return true;
}

// Builds one hierarchy behind those that are there.
static bool build(Layout *layout, Level *level, Bvh *bvh, Error *error)
{
    const BvhInput input = { .boxes = level->boxes, .count = level->count, .singles = level->list.count,
                             .first_node = layout->node_count, .first_single = layout->primitive_count,
                             .first_block = layout->block_count };
    if (level->list.count > PRIMITIVES_MAX - layout->primitive_count)
        return error_set(error, ERROR_MEMORY, "more than %u shapes", PRIMITIVES_MAX);
    const f64 start = clock_seconds();
    if (!bvh_build(&input, bvh, error))
        return false;
    if (bvh->block_count > BLOCKS_MAX - layout->block_count)
        return error_set(error, ERROR_MEMORY, "more triangles than %u blocks of them hold", BLOCKS_MAX);
    layout->build_seconds += clock_seconds() - start;
    level->root = layout->node_count;
    level->first_single = layout->primitive_count;
    level_drop_boxes(level);
    layout->node_count += bvh->node_count;
    layout->primitive_count += bvh->single_count;
    layout->block_count += bvh->block_count;
    return true;
}

// Gives INSTANCE primitives the root node of their object in place of its index.
static void link_instances(Placer *placer)
{
    PrimitiveList *list = &placer->top.list;
    for (u32 i = 0; i < list->count; i++) {
        if (list->primitives[i].kind == PRIMITIVE_INSTANCE) {
            u32 object;
            memcpy(&object, &list->primitives[i].p0, sizeof object);
            memcpy(&list->primitives[i].p0, &placer->objects[object].level.root, sizeof object);
        }
    }
}

static bool reserve(Layout *layout, const Hierarchies *all, bool with_frames, Error *error)
{
    u64 frames = layout->primitive_count;
    for (u32 i = 0; i < all->count; i++)
        frames += all->levels[i]->meshes.count;
    if (frames > PRIMITIVES_MAX)
        return error_set(error, ERROR_MEMORY, "more than %u shapes", PRIMITIVES_MAX);
    layout->frame_count = with_frames ? (u32)frames : 0;
    layout->primitives = page_alloc(layout->primitive_count * sizeof *layout->primitives);
    layout->infos = page_alloc(layout->primitive_count * sizeof *layout->infos);
    layout->frames = page_alloc(layout->frame_count * sizeof *layout->frames);
    layout->nodes = page_alloc(layout->node_count * sizeof *layout->nodes);
    layout->blocks = page_alloc(layout->block_count * sizeof *layout->blocks);
    if (layout->primitive_count > 0 && (!layout->primitives || !layout->infos))
        return error_set(error, ERROR_MEMORY, "no memory for %u primitives", layout->primitive_count);
    if (layout->frame_count > 0 && !layout->frames)
        return error_set(error, ERROR_MEMORY, "no memory for %u object spaces", layout->frame_count);
    if (layout->node_count > 0 && !layout->nodes)
        return error_set(error, ERROR_MEMORY, "no memory for %u nodes of the hierarchy", layout->node_count);
    return layout->block_count == 0 || layout->blocks ||
           error_set(error, ERROR_MEMORY, "no memory for %u blocks of triangles", layout->block_count);
}

static void store(const PrimitiveList *list, const u32 *order, u32 count, u32 first, Layout *layout)
{
    primitive_list_store(list, order, count, layout->primitives + first, layout->infos + first,
                         layout->frames ? layout->frames + first : NULL);
}

// Moves what was built to its place in the layout.
static void fill(Layout *layout, Hierarchies *all)
{
    u32 block = 0;
    for (u32 i = 0; i < all->count; i++) {
        Level *level = all->levels[i];
        Bvh *bvh = &all->built[i];
        memcpy(layout->nodes + level->root, bvh->nodes, bvh->node_count * sizeof *bvh->nodes);
        if (bvh->single_count > 0)
            store(&level->list, bvh->singles, bvh->single_count, level->first_single, layout);
        if (bvh->block_count > 0)
            faces_fill_blocks(layout, level, bvh->blocks, bvh->block_count, layout->blocks + block);
        block += bvh->block_count;
        bvh_destroy(bvh);
        level_destroy(level);
    }
}

bool hierarchies_add(Layout *layout, Placer *placer, Error *error)
{
    Hierarchies all = { NULL, NULL, 0 };
    layout->plane_count = layout->primitive_count = placer->planes.count;
    bool ok = collect(&all, placer, error);
    for (u32 i = 0; ok && i < all.count; i++)
        ok = build(layout, all.levels[i], &all.built[i], error);
    if (ok && placer->top.count > 0)
        layout->root = placer->top.root;
    ok = ok && reserve(layout, &all, placer->solid, error) &&
         faces_add(layout, placer->scene, all.levels, all.count, error);
    if (ok) {
        link_instances(placer);
        if (layout->plane_count > 0)
            store(&placer->planes, NULL, layout->plane_count, 0, layout);
        fill(layout, &all);
    }
    for (u32 i = 0; all.built && i < all.count; i++)
        bvh_destroy(&all.built[i]);
    free(all.built);
    free(all.levels);
    return ok;
}
