// Records of image textures, and the array of texels: what is in it, once, where, and in which precision.
#include "layout_fixture.h"

#include "layout/textures.h"

static u8 rgb8[2 * 3 * 3];
static u16 grey16[5];
static f32 floats[3];

static Bitmap picture(u32 width, u32 height, u32 channels, BitmapType type, void *texels)
{
    return (Bitmap){.width = width, .height = height, .channels = channels, .type = type, .texels = texels};
}

static const char text[] =
    "texture a image { file \"a\" scale 0.1 -0.7 }\n"
    "texture b image { file \"b\" filter nearest }\n"
    "texture c image { file \"c\" color linear }\n"
    "texture d image { file \"a\" color linear }\n"
    "texture e image { file \"e\" }\n"
    "texture f checker { colors 1 0.5 scale 3 4 }\n"
    "material m phong { diffuse a }\nmaterial n phong { diffuse b normal_map d }\nmaterial o pbr { metallic c }\n"
    "material unused phong { diffuse e }\n"
    "sphere { center 0 0 -5 radius 1 material m }\nsphere { center 2 0 -5 radius 1 material n }\n"
    "sphere { center 4 0 -5 radius 1 material o }\nlight point { position 0 5 0 }\n";

// Pictures for a b c d e f; a and d share theirs.
static Layout *make(const Bitmap pictures[3])
{
    static const u32 of[] = {0, 1, 2, 0};
    Parsed parsed = parse_good(text);
    Error error = {0};
    for (u32 i = 0; i < 4; i++)
        parsed.scene->textures[i].bitmap = &pictures[of[i]];
    parsed.scene->textures[2].channel = 2;
    Layout *layout = layout_create(parsed.scene, &error); // that of e is NULL: it is not looked at
    if (!layout)
        fail_msg("%s", error.text);
    parsed_end(&parsed);
    return layout;
}

static void test_records(void **state)
{
    (void)state;
    for (u32 i = 0; i < sizeof rgb8; i++)
        rgb8[i] = (u8)(3 * i + 1);
    for (u32 i = 0; i < 5; i++)
        grey16[i] = (u16)(1000 * i);
    floats[0] = 1.5f;
    const Bitmap pictures[3] = {picture(2, 3, 3, BITMAP_U8, rgb8), picture(5, 1, 1, BITMAP_U16, grey16),
                                picture(1, 1, 3, BITMAP_FLOAT, floats)};
    Layout *l = make(pictures);
    const TextureRecord *t = l->textures;
    assert_int_equal(l->texture_count, 6);
    assert_int_equal(t[0].kind, TEXTURE_KIND_IMAGE);
    assert_true(t[0].width == 2 && t[0].height == 3);
    assert_int_equal(t[0].format, TEXEL_U8 | TEXEL_RGB | TEXEL_SRGB);
    assert_int_equal(t[1].format, TEXEL_U16 | TEXEL_SRGB | TEXEL_NEAREST);
    assert_int_equal(t[2].format, TEXEL_FLOAT | TEXEL_RGB | 2u << TEXEL_CHANNEL);
    assert_int_equal(t[3].format, TEXEL_U8 | TEXEL_RGB);
    // Scales to 48 bits.
    assert_true(fabs((f64)t[0].scale_u + (f64)t[0].scale_u_low - 0.1) < 1e-15);
    assert_true(fabs((f64)t[0].scale_v + (f64)t[0].scale_v_low + 0.7) < 1e-14);
    assert_true(t[0].scale_u_low < 0 && t[0].scale_v_low < 0);
    // Each picture once, in its own bytes, behind the tables.
    assert_int_equal(t[0].first, TEXELS_SRGB16_END / TEXEL_UNIT);
    assert_int_equal(t[3].first, t[0].first);
    assert_int_equal(t[1].first, t[0].first + 2);
    assert_int_equal(t[2].first, t[1].first + 1);
    assert_true(l->texel_bytes == TEXELS_SRGB16_END + 4 * TEXEL_UNIT);
    assert_memory_equal(l->texels + t[0].first * TEXEL_UNIT, rgb8, sizeof rgb8);
    assert_memory_equal(l->texels + t[1].first * TEXEL_UNIT, grey16, sizeof grey16);
    assert_memory_equal(l->texels + t[2].first * TEXEL_UNIT, floats, sizeof floats);
    // What is no image, or not in use, reads one texel that is there.
    assert_true(t[4].width == 1 && t[4].height == 1 && t[4].first == 0);
    assert_true(t[5].width == 1 && t[5].height == 1 && t[5].kind == TEXTURE_KIND_CHECKER);
    layout_destroy(l);
}

// The tables: ends, both branches, and that of 16 bits only where it is needed.
static void test_tables(void **state)
{
    (void)state;
    const Bitmap deep[3] = {picture(2, 3, 3, BITMAP_U8, rgb8), picture(5, 1, 1, BITMAP_U16, grey16),
                            picture(1, 1, 3, BITMAP_FLOAT, floats)};
    const Bitmap plain[3] = {deep[0], picture(3, 1, 1, BITMAP_U8, rgb8), deep[2]};
    Layout *a = make(deep), *b = make(plain);
    const f32 *levels = (const f32 *)(const void *)a->texels;
    const f32 *fine = (const f32 *)(const void *)(a->texels + TEXELS_SRGB16);
    for (u32 i = 0; i < 256; i++) {
        const f64 c = i / 255.0, linear = c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4);
        assert_true(levels[i] == (f32)linear);
        assert_true(fine[257 * i] == levels[i]);
    }
    for (u32 i = 1; i < 65536; i++)
        assert_true(fine[i] > fine[i - 1]);
    assert_true(levels[0] == 0 && levels[255] == 1 && fine[65535] == 1);
    assert_int_equal(b->textures[0].first, TEXELS_SRGB16 / TEXEL_UNIT);
    assert_memory_equal(b->texels, a->texels, TEXELS_SRGB16);
    assert_true(b->texel_bytes < 2 * TEXELS_SRGB16);
    layout_destroy(a);
    layout_destroy(b);
    Layout *none = layout_good("texture f checker { }\nmaterial m phong { diffuse f }\n"
                               "sphere { center 0 0 -5 radius 1 material m }\nlight point { position 0 5 0 }\n");
    assert_null(none->texels);
    assert_true(none->texel_bytes == 0);
    layout_destroy(none);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_records), cmocka_unit_test(test_tables)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
