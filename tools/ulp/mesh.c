#include "mesh.h"

#include <string.h>

#include "scene/parse.h"

static const char SCENE[] = "mesh { file \"triangle.obj\" }";

static Layout *layout_of(const Placed *triangle, Arena *arena, Diagnostics *diagnostics, Error *error)
{
    Vec3 positions[3];
    u32 faces[1][3] = {{0, 1, 2}};
    MeshPart part = {.material = -1};
    memcpy(positions, triangle->shape.as.triangle.vertices, sizeof positions);
    Mesh mesh = {.positions = positions, .position_count = 3, .faces = faces, .face_count = 1, .parts = &part,
                 .part_count = 1};
    Scene *scene = scene_parse_text("clrt-ulp", SCENE, strlen(SCENE), arena, diagnostics, error);
    if (!scene)
        return NULL;
    scene->camera.position = (Vec3){0, 0, 0};
    scene->meshes = &mesh;
    scene->mesh_count = 1;
    scene->shapes[0].transform = triangle->map;
    scene->shapes[0].as.mesh.mesh = &mesh;
    return layout_create(scene, error);
}

Layout *mesh_layout(const Placed *triangle, Error *error)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Layout *layout = NULL;
    if (arena && diagnostics)
        layout = layout_of(triangle, arena, diagnostics, error);
    else
        error_set(error, ERROR_MEMORY, "no memory for a mesh");
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return layout;
}
