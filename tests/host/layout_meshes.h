// Meshes for tests that have no files: a shape whose file is called "gridN ..." gets a bent sheet of 2 N N
// triangles, as if it had been read. Words behind it: normals (all faces but the first have them), uvs (the
// same), parts (materials 1, none, 2), far (a vertex of no face out of the range of float).
#ifndef CLRT_TESTS_LAYOUT_MESHES_H
#define CLRT_TESTS_LAYOUT_MESHES_H

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scene/scene.h"

static inline void grid_faces(Mesh *mesh, u32 n)
{
    mesh->face_count = 2 * n * n;
    mesh->faces = malloc(mesh->face_count * sizeof *mesh->faces);
    for (u32 y = 0; y < n; y++) {
        for (u32 x = 0; x < n; x++) {
            const u32 a = y * (n + 1) + x, f = 2 * (y * n + x);
            memcpy(mesh->faces[f], (u32[3]){a, a + 1, a + n + 2}, sizeof *mesh->faces);
            memcpy(mesh->faces[f + 1], (u32[3]){a, a + n + 2, a + n + 1}, sizeof *mesh->faces);
        }
    }
}

// The corners of the faces by `shift` vertices further, so that indices differ from those of positions.
static inline u32 (*grid_corners(const Mesh *mesh, u32 count, u32 shift))[3]
{
    u32(*corners)[3] = malloc(mesh->face_count * sizeof *corners);
    for (u32 f = 0; f < mesh->face_count; f++)
        for (u32 k = 0; k < 3; k++)
            corners[f][k] = f == 0 ? MESH_NO_INDEX : (mesh->faces[f][k] + shift) % count;
    return corners;
}

static inline void grid_make(Mesh *mesh, const char *words, u32 material_count)
{
    u32 n = 1;
    sscanf(words, "grid%u", &n);
    const u32 count = (n + 1) * (n + 1), far = strstr(words, "far") != NULL;
    *mesh = (Mesh){.position_count = count + far};
    mesh->positions = malloc((count + far) * sizeof *mesh->positions);
    grid_faces(mesh, n);
    for (u32 i = 0; i < count; i++) {
        const f64 x = 2.0 * (i % (n + 1)) / n - 1, y = 2.0 * (i / (n + 1)) / n - 1;
        mesh->positions[i] = (Vec3){x, y, 0.2 * sin(3 * x) * cos(2 * y + 0.3)};
    }
    if (far)
        mesh->positions[count] = (Vec3){1e300, 0, 0};
    if (strstr(words, "normals")) {
        mesh->normal_count = count;
        mesh->normals = malloc(count * sizeof *mesh->normals);
        for (u32 i = 0; i < count; i++) {
            const Vec3 v = vec_normalize((Vec3){sin(i), cos(1.7 * i), 2});
            memcpy(mesh->normals[i], (f32[3]){(f32)v.x, (f32)v.y, (f32)v.z}, sizeof *mesh->normals);
        }
        mesh->face_normals = grid_corners(mesh, count, 1);
    }
    if (strstr(words, "uvs")) {
        mesh->uv_count = count;
        mesh->uvs = malloc(count * sizeof *mesh->uvs);
        for (u32 i = 0; i < count; i++)
            memcpy(mesh->uvs[i], (f32[2]){(f32)i, -(f32)i}, sizeof *mesh->uvs);
        mesh->face_uvs = grid_corners(mesh, count, 2);
    }
    const bool parts = strstr(words, "parts") && material_count > 2;
    mesh->part_count = parts ? 3 : 1;
    mesh->parts = malloc(mesh->part_count * sizeof *mesh->parts);
    mesh->parts[0] = (MeshPart){0, parts ? 1 : -1};
    for (u32 i = 1; i < mesh->part_count; i++)
        mesh->parts[i] = (MeshPart){mesh->face_count * i / 4, i == 1 ? -1 : 2};
}

// Gives the shapes of the scene their meshes, those of the same file the same one.
static inline void meshes_attach(Scene *scene)
{
    scene->meshes = calloc(scene->shape_count + (size_t)1, sizeof *scene->meshes);
    for (u32 i = 0; i < scene->shape_count; i++) {
        Shape *shape = &scene->shapes[i];
        if (shape->kind != SHAPE_MESH)
            continue;
        for (u32 k = 0; k < i && !shape->as.mesh.mesh; k++)
            if (scene->shapes[k].kind == SHAPE_MESH &&
                strcmp(scene->shapes[k].as.mesh.file, shape->as.mesh.file) == 0)
                shape->as.mesh.mesh = scene->shapes[k].as.mesh.mesh;
        if (shape->as.mesh.mesh)
            continue;
        const char *slash = strrchr(shape->as.mesh.file, '/');
        Mesh *mesh = &scene->meshes[scene->mesh_count++];
        grid_make(mesh, slash ? slash + 1 : shape->as.mesh.file, scene->material_count);
        shape->as.mesh.mesh = mesh;
    }
}

static inline void meshes_detach(Scene *scene)
{
    for (u32 i = 0; i < scene->mesh_count; i++)
        mesh_destroy(&scene->meshes[i]);
    free(scene->meshes);
    scene->meshes = NULL;
    scene->mesh_count = 0;
}

#endif
