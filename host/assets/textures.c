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

// Those of textures that files name, or that the scene does.
static bool list_textures(NamedFiles *named, const Scene *scene, bool by_files)
{
    for (u32 i = 0; i < scene->texture_count; ++i) {
        const Texture *texture = &scene->textures[i];
        if (is_image(texture) && (texture->named_by != NULL) == by_files &&
            !named_files_add(named, texture->file, texture->file_at, texture->named_by))
            return false;
    }
    return true;
}

// What the scene names comes first, so that it cannot be missing without an error.
static bool list_files(NamedFiles *named, const Scene *scene)
{
    const Environment *environment = &scene->environment;
    if (!list_textures(named, scene, false))
        return false;
    if (environment->present && !named_files_add(named, environment->file, environment->file_at, NULL))
        return false;
    return list_textures(named, scene, true);
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
    scene_report(scene, named->diagnostics, SEVERITY_WARNING, texture->file_at,
                 "cannot read an image in '%s': %s; it is left out", texture->file, error.text);
}

// ---- faded ----------------------------------------------------------------------------------

static bool is_faded(const Texture *texture)
{
    return texture->kind == TEXTURE_IMAGE && (texture->fade < 0 || texture->fade > 0);
}

// In floats, because values may leave 0 .. 1, and are linear like those that are faded.
static bool make_faded(const Texture *texture, const Bitmap *from, Bitmap *to)
{
    Error error; // memory is the only reason
    if (!bitmap_create(to, from->width, from->height, from->channels, BITMAP_FLOAT, &error))
        return false;
    for (u32 y = 0; y < from->height; ++y) {
        f32 *row = bitmap_row(to, y);
        for (u32 x = 0; x < from->width; ++x)
            for (u32 c = 0; c < from->channels; ++c) {
                const f64 value = bitmap_value(from, x, y, c);
                *row++ = (f32)(c < 2 ? value + texture->fade * (texture->fade_to - value) : value);
            }
    }
    return true;
}

// Gives the textures that are faded bitmaps of their own, one for all that are alike.
static bool fade(const NamedFiles *named, Scene *scene)
{
    const Bitmap **sources = arena_alloc(named->arena, scene->texture_count, sizeof *sources);
    if (!sources)
        return false;
    for (u32 i = 0; i < scene->texture_count; ++i) {
        Texture *texture = &scene->textures[i];
        sources[i] = texture->bitmap;
        if (!is_faded(texture) || !texture->bitmap)
            continue;
        u32 like = 0;
        while (like < i && (sources[like] != sources[i] || scene->textures[like].fade != texture->fade ||
                            scene->textures[like].fade_to != texture->fade_to))
            ++like;
        if (like < i) {
            texture->bitmap = scene->textures[like].bitmap;
            continue;
        }
        Bitmap *bitmap = &scene->bitmaps[scene->bitmap_count++];
        if (!make_faded(texture, sources[i], bitmap))
            return false;
        texture->bitmap = bitmap;
    }
    return true;
}

// ---- left out -------------------------------------------------------------------------------

static void forget(const Scene *scene, i32 *texture)
{
    if (*texture >= 0 && scene->textures[*texture].named_by && !scene->textures[*texture].bitmap)
        *texture = -1;
}

// A material of a file goes without the images that cannot be read.
static void forget_missing(Scene *scene)
{
    for (u32 i = 0; i < scene->material_count; ++i) {
        Material *material = &scene->materials[i];
        i32 *const inputs[] = {&material->ambient.texture,   &material->diffuse.texture,
                               &material->base_color.texture, &material->metallic.texture,
                               &material->roughness.texture, &material->occlusion.texture,
                               &material->emission.texture,  &material->normal_map};
        for (size_t k = 0; k < sizeof inputs / sizeof *inputs; ++k)
            forget(scene, inputs[k]);
    }
}

static bool load(NamedFiles *named, Scene *scene, Arena *arena)
{
    u32 more = 0;
    scene->bitmap_count = 0;
    if (!named->arena || !list_files(named, scene))
        return false;
    for (u32 i = 0; i < scene->texture_count; ++i)
        more += (u32)is_within(&scene->textures[i]) + (u32)is_faded(&scene->textures[i]);
    scene->bitmaps = arena_alloc(arena, (size_t)named->count + more, sizeof *scene->bitmaps);
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
    forget_missing(scene);
    return fade(named, scene);
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
