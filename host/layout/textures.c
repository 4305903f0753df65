#include "layout/textures.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"

u32 material_textures(const Material *material, bool lit, bool ambient, i32 textures[MATERIAL_TEXTURES_MAX])
{
    const bool pbr = material->kind == MATERIAL_PBR, seen = lit || ambient;
    const Vec3 emission = material->emission.color;
    const bool shines = emission.x > 0 || emission.y > 0 || emission.z > 0;
    const struct {
        i32 texture;
        bool seen;
    } inputs[] = {
        {material->normal_map, true},
        {material->emission.texture, shines},
        {material->diffuse.texture, !pbr && lit},
        {material->ambient.texture, !pbr && ambient},
        {material->base_color.texture, pbr && seen},
        {material->metallic.texture, pbr && seen},
        {material->roughness.texture, pbr && seen},
        {material->occlusion.texture, pbr && seen},
    };
    u32 count = 0;
    for (size_t i = 0; i < sizeof inputs / sizeof *inputs; i++)
        if (inputs[i].seen && inputs[i].texture >= 0)
            textures[count++] = inputs[i].texture;
    return count;
}

FeatureSet texture_features(const Texture *texture)
{
    switch (texture->kind) {
    case TEXTURE_CHECKER3D: return feature_bit(FEATURE_CHECKER3D);
    case TEXTURE_IMAGE: return feature_bit(FEATURE_IMAGE) | feature_bit(FEATURE_UV);
    default: return feature_bit(FEATURE_CHECKER) | feature_bit(FEATURE_UV);
    }
}

// ---- records --------------------------------------------------------------------------------

static void store3(f32 to[3], Vec3 v)
{
    to[0] = (f32)v.x;
    to[1] = (f32)v.y;
    to[2] = (f32)v.z;
}

// x less its float, for numbers kept in two. Volatile, because gcc 12 takes two of these side by side, which it
// vectorises, for 0.
static f32 low_part(f64 x)
{
    const volatile f32 high = (f32)x;
    return (f32)(x - (f64)high);
}

static TextureRecord checker_record(const Texture *texture)
{
    static const u32 kinds[] = {[TEXTURE_CHECKER] = TEXTURE_KIND_CHECKER,
                                [TEXTURE_CHECKER3D] = TEXTURE_KIND_CHECKER3D,
                                [TEXTURE_IMAGE] = TEXTURE_KIND_IMAGE};
    const f64 u = texture->scale[0], v = texture->kind == TEXTURE_CHECKER3D ? u : texture->scale[1];
    TextureRecord record = {
        .scale_u = (f32)u,
        .scale_v = (f32)v,
        .scale_u_low = low_part(u),
        .scale_v_low = low_part(v),
        .inset = (f32)(1e-4 / u),
        .kind = kinds[texture->kind],
        // Lanes that want no image read the first texel there is.
        .width = 1,
        .height = 1,
    };
    store3(record.color_a, texture->colors[0]);
    store3(record.color_b, texture->colors[1]);
    return record;
}

static bool is_level(const Bitmap *bitmap)
{
    return bitmap->type == BITMAP_U8 || bitmap->type == BITMAP_U16;
}

static u32 texel_format(const Texture *texture)
{
    static const u32 types[] = {[BITMAP_U8] = TEXEL_U8, [BITMAP_U16] = TEXEL_U16, [BITMAP_HALF] = TEXEL_HALF,
                                [BITMAP_FLOAT] = TEXEL_FLOAT};
    const Bitmap *bitmap = texture->bitmap;
    return types[bitmap->type] | (bitmap->channels == 3 ? TEXEL_RGB : 0) |
           (texture->encoding == ENCODING_SRGB && is_level(bitmap) ? TEXEL_SRGB : 0) |
           (texture->filter == TEXTURE_NEAREST ? TEXEL_NEAREST : 0) | texture->channel << TEXEL_CHANNEL;
}

// ---- texels ---------------------------------------------------------------------------------

static u64 aligned(u64 bytes)
{
    return (bytes + TEXEL_UNIT - 1) / TEXEL_UNIT * TEXEL_UNIT;
}

// The linear values of `count` levels.
static void add_levels(f32 *to, u32 count)
{
    for (u32 i = 0; i < count; i++) {
        const f64 c = (f64)i / (count - 1);
        to[i] = (f32)(c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4));
    }
}

static bool in_use(const Texture *texture, bool used)
{
    return used && texture->kind == TEXTURE_IMAGE;
}

// The first texture in use with this one's bitmap, which may be itself.
static u32 first_with_bitmap(const Scene *scene, const bool *used, u32 index)
{
    u32 i = 0;
    while (!in_use(&scene->textures[i], used[i]) || scene->textures[i].bitmap != scene->textures[index].bitmap)
        i++;
    return i;
}

// Bytes of the tables of levels that the images in use need; 0 where there is no image.
static u32 table_bytes(const Scene *scene, const bool *used)
{
    u32 bytes = 0;
    for (u32 i = 0; i < scene->texture_count; i++) {
        const Texture *texture = &scene->textures[i];
        if (!in_use(texture, used[i]))
            continue;
        if (texture->bitmap->type == BITMAP_U16 && texture->encoding == ENCODING_SRGB)
            return TEXELS_SRGB16_END;
        bytes = TEXELS_SRGB16;
    }
    return bytes;
}

// Gives each image in use its place, from `bytes` on; returns where they end.
static u64 place_images(Layout *layout, const Scene *scene, const bool *used, u64 bytes)
{
    for (u32 i = 0; i < scene->texture_count; i++) {
        const Texture *texture = &scene->textures[i];
        if (!in_use(texture, used[i]))
            continue;
        const u32 first = first_with_bitmap(scene, used, i);
        TextureRecord *record = &layout->textures[i];
        record->width = texture->bitmap->width;
        record->height = texture->bitmap->height;
        record->format = texel_format(texture);
        record->first = first < i ? layout->textures[first].first : (u32)(bytes / TEXEL_UNIT);
        if (first == i)
            bytes = aligned(bytes + bitmap_bytes(texture->bitmap));
    }
    return bytes;
}

bool textures_add(Layout *layout, const Scene *scene, const bool *used, Error *error)
{
    layout->texture_count = scene->texture_count;
    layout->textures = page_alloc(scene->texture_count * sizeof *layout->textures);
    if (!layout->textures && scene->texture_count > 0)
        return error_set(error, ERROR_MEMORY, "no memory for %u textures", scene->texture_count);
    for (u32 i = 0; i < scene->texture_count; i++)
        layout->textures[i] = checker_record(&scene->textures[i]);
    const u32 tables = table_bytes(scene, used);
    if (tables == 0)
        return true;
    const u64 bytes = place_images(layout, scene, used, tables);
    if (bytes / TEXEL_UNIT > UINT32_MAX || bytes > SIZE_MAX)
        return error_set(error, ERROR_MEMORY, "%llu bytes of textures are too many", (unsigned long long)bytes);
    layout->texels = page_alloc((size_t)bytes);
    if (!layout->texels)
        return error_set(error, ERROR_MEMORY, "no memory for %llu bytes of textures", (unsigned long long)bytes);
    layout->texel_bytes = bytes;
    add_levels((f32 *)(void *)(layout->texels + TEXELS_SRGB8), 256);
    if (tables == TEXELS_SRGB16_END)
        add_levels((f32 *)(void *)(layout->texels + TEXELS_SRGB16), 65536);
    for (u32 i = 0; i < scene->texture_count; i++)
        if (in_use(&scene->textures[i], used[i]) && first_with_bitmap(scene, used, i) == i)
            memcpy(layout->texels + (u64)layout->textures[i].first * TEXEL_UNIT, scene->textures[i].bitmap->texels,
                   (size_t)bitmap_bytes(scene->textures[i].bitmap));
    return true;
}
