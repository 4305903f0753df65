#include "assets/textures.h"

#include "assets/named_files.h"
#include "scene/report.h"

// Of a file of its own.
static bool is_image(const Texture *texture)
{
    return texture->kind == TEXTURE_IMAGE && !texture->content;
}

static bool is_within(const Texture *texture)
{
    return texture->kind == TEXTURE_IMAGE && texture->content;
}

static bool list_files(NamedFiles *named, const Scene *scene)
{
    for (u32 i = 0; i < scene->texture_count; ++i) {
        const Texture *texture = &scene->textures[i];
        if (is_image(texture) && !named_files_add(named, texture->file, texture->file_at))
            return false;
    }
    const Environment *environment = &scene->environment;
    return !environment->present || named_files_add(named, environment->file, environment->file_at);
}

static void repair(const NamedFiles *named, const char *path, SourcePos at, Bitmap *bitmap)
{
    const u64 bad = bitmap_repair(bitmap);
    if (bad > 0)
        scene_report(named->scene, named->diagnostics, SEVERITY_WARNING, at,
                     "'%s' has %llu value%s below 0, infinite or not a number; these are taken as 0, or as the "
                     "largest there is",
                     path, (unsigned long long)bad, bad > 1 ? "s" : "");
}

// Leaves *bitmap zeroed where the file cannot be used.
static void read_file(const NamedFiles *named, const NamedFile *file, Bitmap *bitmap)
{
    Error error;
    if (!file->readable)
        return;
    if (!bitmap_read(file->path, bitmap, &error)) {
        named_file_refuse(named, file, "read", error.text);
        return;
    }
    repair(named, file->path, file->at, bitmap);
}

static const Bitmap *find_bitmap(const NamedFiles *named, const char *path)
{
    const Bitmap *bitmap = &named->scene->bitmaps[named_files_find(named, path)];
    return bitmap->texels ? bitmap : NULL;
}

static void point_environment(const NamedFiles *named, Environment *environment)
{
    environment->bitmap = find_bitmap(named, environment->file);
    if (!environment->bitmap || environment->bitmap->type >= BITMAP_HALF)
        return;
    environment->bitmap = NULL;
    scene_report(named->scene, named->diagnostics, SEVERITY_ERROR, environment->file_at,
                 "'%s' has levels, no radiance; an environment is Radiance HDR or OpenEXR",
                 environment->file);
}

// The picture that a texture finds within another file, decoded once for all that share it.
static void read_within(const NamedFiles *named, Scene *scene, u32 index)
{
    Texture *texture = &scene->textures[index];
    Error error;
    for (u32 i = 0; i < index; ++i) {
        if (scene->textures[i].content == texture->content) {
            texture->bitmap = scene->textures[i].bitmap;
            return;
        }
    }
    Bitmap *bitmap = &scene->bitmaps[scene->bitmap_count++];
    if (bitmap_decode(texture->content, texture->content_size, bitmap, &error)) {
        repair(named, texture->file, texture->file_at, bitmap);
        texture->bitmap = bitmap;
        return;
    }
    scene_report(scene, named->diagnostics, SEVERITY_ERROR, texture->file_at, "cannot read an image in '%s': %s",
                 texture->file, error.text);
}

static bool load(NamedFiles *named, Scene *scene, Arena *arena)
{
    u32 within = 0;
    scene->bitmap_count = 0;
    if (!named->arena || !list_files(named, scene))
        return false;
    for (u32 i = 0; i < scene->texture_count; ++i)
        within += is_within(&scene->textures[i]);
    scene->bitmaps = arena_alloc(arena, (size_t)named->count + within, sizeof *scene->bitmaps);
    if (!scene->bitmaps)
        return false;
    scene->bitmap_count = named->count;
    for (u32 i = 0; i < named->count; ++i)
        read_file(named, &named->files[i], &scene->bitmaps[i]);
    for (u32 i = 0; i < scene->texture_count; ++i) {
        if (is_image(&scene->textures[i]))
            scene->textures[i].bitmap = find_bitmap(named, scene->textures[i].file);
        else if (is_within(&scene->textures[i]))
            read_within(named, scene, i);
    }
    if (scene->environment.present)
        point_environment(named, &scene->environment);
    return true;
}

bool textures_load(Scene *scene, Arena *arena, Diagnostics *diagnostics, Error *error)
{
    NamedFiles named = {.scene = scene, .arena = arena_create(), .diagnostics = diagnostics};
    const bool ok = load(&named, scene, arena);
    arena_destroy(named.arena);
    return ok || error_set(error, ERROR_MEMORY, "no memory for the textures");
}

void textures_release(Scene *scene)
{
    for (u32 i = 0; i < scene->bitmap_count; ++i)
        bitmap_destroy(&scene->bitmaps[i]);
    scene->bitmaps = NULL;
    scene->bitmap_count = 0;
    for (u32 i = 0; i < scene->texture_count; ++i)
        scene->textures[i].bitmap = NULL;
    scene->environment.bitmap = NULL;
}
