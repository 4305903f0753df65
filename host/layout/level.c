#include "layout/level.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

static const u32 BOXES_MAX = 1u << 30;

bool error_locate(const Scene *scene, SourcePos at, Error *error)
{
    const Error reason = *error;
    if (reason.code == ERROR_MEMORY)
        return false;
    return error_set(error, reason.code, "%s:%u:%u: error: %s", scene->files[at.file], at.line, at.column,
                     reason.text);
}

bool level_complete(Level *level, const Scene *scene, Error *error)
{
    const u32 singles = level->list.count, faces = level->meshes.face_count;
    if (singles + faces == 0)
        return true;
    if (singles > BOXES_MAX - faces)
        return error_set(error, ERROR_MEMORY, "more than %u shapes and triangles in a hierarchy", BOXES_MAX);
    level->bounds = (Box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    if (singles > 0)
        level->bounds = primitive_list_bounds(&level->list);
    level->count = singles + faces;
    if (faces == 0) {
        level->boxes = level->list.boxes;
        level->list.boxes = NULL;
        return true;
    }
    level->boxes = page_alloc(level->count * sizeof *level->boxes);
    if (!level->boxes)
        return error_set(error, ERROR_MEMORY, "no memory for the boxes of %u triangles", faces);
    if (singles > 0)
        memcpy(level->boxes, level->list.boxes, singles * sizeof *level->boxes);
    if (!mesh_list_reserve_vertices(&level->meshes, error))
        return false;
    for (u32 i = 0; i < level->meshes.count; i++) {
        PlacedMesh *mesh = &level->meshes.meshes[i];
        Box *boxes = level->boxes + singles + mesh->first_face;
        if (!mesh_carry(mesh, &level->meshes, boxes, &level->bounds, error))
            return error_locate(scene, mesh->shape->at, error);
    }
    return true;
}

void level_drop_boxes(Level *level)
{
    if (level->meshes.face_count > 0)
        page_free(level->boxes, level->count * sizeof *level->boxes);
    else
        free(level->boxes);
    level->boxes = NULL;
}

void level_destroy(Level *level)
{
    level_drop_boxes(level);
    primitive_list_destroy(&level->list);
    mesh_list_destroy(&level->meshes);
    free(level->sources);
    memset(level, 0, sizeof *level);
}
