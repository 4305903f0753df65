// What the tests of the layout share: the layout of a scene text, and what the arrays say about it.
#ifndef CLRT_TESTS_LAYOUT_FIXTURE_H
#define CLRT_TESTS_LAYOUT_FIXTURE_H

#include "scene_parse_fixture.h"

#include <math.h>

#include "layout/layout.h"
#include "layout_meshes.h"

// Gives image textures and the environment a picture of one texel in place of that of their file.
static inline void bitmaps_attach(Scene *scene)
{
    static u8 texel[3] = {255, 128, 0};
    static const Bitmap bitmap = {.width = 1, .height = 1, .channels = 3, .type = BITMAP_U8, .texels = texel};
    for (u32 i = 0; i < scene->texture_count; i++)
        if (scene->textures[i].kind == TEXTURE_IMAGE)
            scene->textures[i].bitmap = &bitmap;
    scene->environment.bitmap = &bitmap;
}

static inline Layout *layout_good(const char *text)
{
    Parsed parsed = parse_good(text);
    Error error = {0};
    meshes_attach(parsed.scene);
    bitmaps_attach(parsed.scene);
    Layout *layout = layout_create(parsed.scene, &error);
    meshes_detach(parsed.scene);
    if (!layout)
        fail_msg("%s\n%s", error.text, text);
    parsed_end(&parsed);
    return layout;
}

// The error of a text that parses but cannot be laid out.
static inline Error layout_error(const char *text)
{
    Parsed parsed = parse_good(text);
    Error error = {0};
    meshes_attach(parsed.scene);
    bitmaps_attach(parsed.scene);
    assert_null(layout_create(parsed.scene, &error));
    meshes_detach(parsed.scene);
    parsed_end(&parsed);
    return error;
}

static inline FeatureSet features_of(const char *text)
{
    Layout *layout = layout_good(text);
    const FeatureSet set = layout->features;
    layout_destroy(layout);
    return set;
}

static inline u32 kind_of(const Primitive *primitive)
{
    return primitive->kind & PRIMITIVE_KIND_MASK;
}

static inline u32 count_kind(const Layout *layout, u32 kind)
{
    u32 count = 0;
    for (u32 i = 0; i < layout->primitive_count; i++)
        count += kind_of(&layout->primitives[i]) == kind;
    return count;
}

static inline u64 order_of(const Layout *layout, u32 i)
{
    return (u64)layout->infos[i].order_high << 32 | layout->infos[i].order_low;
}

#endif
