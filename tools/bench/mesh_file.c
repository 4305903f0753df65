#include "mesh_file.h"

#include <stdlib.h>

#include "assets/assets.h"
#include "scene/parse.h"

static void drop_shading(Mesh *mesh)
{
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->face_normals);
    free(mesh->face_uvs);
    mesh->normals = NULL;
    mesh->uvs = NULL;
    mesh->face_normals = NULL;
    mesh->face_uvs = NULL;
    mesh->normal_count = mesh->uv_count = 0;
}

// Loads what the scene, which is empty, names: one mesh.
static bool load(const char *path, Scene *scene, Arena *arena, Diagnostics *diagnostics, Error *error)
{
    Shape shape = {.kind = SHAPE_MESH, .material = -1, .transform = affine_identity()};
    shape.as.mesh.file = path;
    shape.as.mesh.smooth = 0;
    scene->shapes = &shape;
    scene->shape_count = 1;
    const bool ok = assets_load(scene, arena, diagnostics, error);
    scene->shapes = NULL;
    scene->shape_count = 0;
    if (ok && diagnostics_error_count(diagnostics) > 0) {
        diagnostics_print(diagnostics, stderr);
        return error_set(error, ERROR_SCENE, "%s: the mesh has errors", path);
    }
    return ok;
}

bool mesh_file_read(const char *path, Mesh *mesh, Error *error)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Scene *scene = NULL;
    bool ok = false;
    if (!arena || !diagnostics)
        error_set(error, ERROR_MEMORY, "%s: no memory", path);
    else if ((scene = scene_parse_text(path, "", 0, arena, diagnostics, error)) != NULL)
        ok = load(path, scene, arena, diagnostics, error);
    if (ok) {
        *mesh = scene->meshes[0];
        scene->meshes[0] = (Mesh){.positions = NULL};
        drop_shading(mesh);
    }
    assets_release(scene);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return ok;
}
