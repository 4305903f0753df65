#include "assets/fingerprint.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/hash.h"

enum { PIECE = 1 << 18 };

// Which of the scene's meshes and images have been added.
typedef struct Fingerprint {
    Hash hash;
    const Scene *scene;
    bool *meshes, *bitmaps;
    u8 *piece; // PIECE bytes
} Fingerprint;

static bool add_file(Fingerprint *fingerprint, const char *path, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    size_t length;
    while ((length = fread(fingerprint->piece, 1, PIECE, file)) > 0)
        hash_add(&fingerprint->hash, fingerprint->piece, length);
    const bool ok = !ferror(file);
    fclose(file);
    return ok || error_set(error, ERROR_IO, "%s: cannot be read again", path);
}

static bool add_mesh(Fingerprint *fingerprint, const Shape *shape, Error *error)
{
    const Scene *scene = fingerprint->scene;
    if (shape->kind != SHAPE_MESH || !shape->as.mesh.mesh)
        return true;
    bool *done = &fingerprint->meshes[shape->as.mesh.mesh - scene->meshes];
    const bool again = *done;
    *done = true;
    return again || add_file(fingerprint, shape->as.mesh.file, error);
}

static bool add_image(Fingerprint *fingerprint, const Bitmap *bitmap, const char *path, Error *error)
{
    if (!bitmap)
        return true;
    bool *done = &fingerprint->bitmaps[bitmap - fingerprint->scene->bitmaps];
    const bool again = *done;
    *done = true;
    return again || add_file(fingerprint, path, error);
}

static bool add_files(Fingerprint *fingerprint, Error *error)
{
    const Scene *scene = fingerprint->scene;
    bool ok = true;
    for (u32 i = 0; ok && i < scene->shape_count; i++)
        ok = add_mesh(fingerprint, &scene->shapes[i], error);
    for (u32 i = 0; ok && i < scene->texture_count; i++)
        ok = add_image(fingerprint, scene->textures[i].bitmap, scene->textures[i].file, error);
    return ok && add_image(fingerprint, scene->environment.bitmap, scene->environment.file, error);
}

static void add_numbers(Hash *hash, const f64 *numbers, size_t count)
{
    hash_add(hash, numbers, count * sizeof *numbers);
}

static void add_material(Hash *hash, const Material *m)
{
    const Vec3 colors[] = {m->ambient.color, m->diffuse.color, m->specular,      m->reflect,
                           m->transmit,      m->base_color.color, m->emission.color};
    const f64 numbers[] = {m->kind,           m->shininess,       m->ior,          m->fresnel,
                           m->metallic.value, m->roughness.value, m->occlusion.value, m->pbr_transmit};
    for (size_t i = 0; i < sizeof colors / sizeof colors[0]; i++)
        add_numbers(hash, (const f64[]){colors[i].x, colors[i].y, colors[i].z}, 3);
    add_numbers(hash, numbers, sizeof numbers / sizeof numbers[0]);
}

bool scene_fingerprint(const Scene *scene, u64 *value, Error *error)
{
    Fingerprint fingerprint = {.hash = hash_start(), .scene = scene};
    fingerprint.meshes = calloc((size_t)scene->mesh_count + 1, sizeof *fingerprint.meshes);
    fingerprint.bitmaps = calloc((size_t)scene->bitmap_count + 1, sizeof *fingerprint.bitmaps);
    fingerprint.piece = malloc(PIECE);
    bool ok = fingerprint.meshes && fingerprint.bitmaps && fingerprint.piece;
    if (!ok)
        error_set(error, ERROR_MEMORY, "no memory for the fingerprint of the scene");
    for (u32 i = 0; ok && i < scene->file_count; i++)
        hash_add(&fingerprint.hash, scene->file_texts[i], strlen(scene->file_texts[i]));
    ok = ok && add_files(&fingerprint, error);
    for (u32 i = 0; ok && scene->mesh_count > 0 && i < scene->material_count; i++)
        add_material(&fingerprint.hash, &scene->materials[i]);
    *value = hash_value(&fingerprint.hash);
    free(fingerprint.meshes);
    free(fingerprint.bitmaps);
    free(fingerprint.piece);
    return ok;
}
