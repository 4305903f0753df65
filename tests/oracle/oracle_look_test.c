/* Textures, normal maps and pbr against closed forms. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <png.h>

#include "look.h"
#include "oracle_test.h"
#include "texture.h"

/* 2 x 2 texels: 0 and 1 above, 0.2 and 0.4 below (levels of 255). */
static const Vec TEXELS[4] = {{0, 0, 0}, {1, 1, 1}, {0.2L, 0.2L, 0.2L}, {0.4L, 0.4L, 0.4L}};

static void test_lookup(void **state)
{
    (void)state;
    Vec texels[4];
    memcpy(texels, TEXELS, sizeof texels);
    Image image = {2, 2, false, texels, texels};
    /* Centres, half way between two and between four, and around the border. */
    assert_near(image_bilinear(&image, texels, 0.5L, 0.5L, true).x, 0, 0);
    assert_near(image_bilinear(&image, texels, 1.5L, 0.5L, true).x, 1, 0);
    assert_near(image_bilinear(&image, texels, 1, 1.5L, true).x, 0.3L, 1e-18L);
    assert_near(image_bilinear(&image, texels, 1, 1, true).x, 0.4L, 1e-18L);
    assert_near(image_bilinear(&image, texels, 0, 0.5L, true).x, 0.5L, 1e-18L);
    assert_near(image_bilinear(&image, texels, -6.5L, 100.5L, true).x, 1, 0);
    assert_near(image_bilinear(&image, texels, 0.75L, 0.5L, true).x, 0.25L, 1e-18L);
    /* Clamped above and below, wrapped aside. */
    assert_near(image_bilinear(&image, texels, 0.5L, 0, false).x, 0, 0);
    assert_near(image_bilinear(&image, texels, 0.5L, 2, false).x, 0.2L, 0);
    assert_near(image_bilinear(&image, texels, 2, 1.75L, false).x, 0.3L, 1e-18L);
    assert_near(image_nearest(&image, texels, 0.999L, 1).x, 0.2L, 0);
    assert_near(image_nearest(&image, texels, 1, 0.999L).x, 1, 0);
    assert_near(image_nearest(&image, texels, -0.001L, -0.001L).x, 0.4L, 0);
}

static void test_orientation(void **state)
{
    (void)state;
    Vec texels[4];
    memcpy(texels, TEXELS, sizeof texels);
    Image image = {2, 2, false, texels, texels};
    Texture texture = {.kind = TEXTURE_IMAGE, .scale = {1, 1}, .image = &image, .nearest = true};
    Scene scene = {.textures = &texture, .texture_count = 1};
    Paint paint = {grey(1), 0};
    /* v = 0 is the bottom edge. */
    Surface surface = {.u = 0.25L, .v = 0.25L};
    assert_near(paint_color(&scene, &paint, grey(0), &surface).x, 0.2L, 0);
    surface.u = surface.v = 0.75L;
    assert_near(paint_color(&scene, &paint, grey(0), &surface).x, 1, 0);
    texture.scale[0] = 3;
    surface.u = 0.25L;
    assert_near(paint_color(&scene, &paint, grey(0), &surface).x, 1, 0);
    surface.u = 0.4L;
    assert_near(paint_color(&scene, &paint, grey(0), &surface).x, 0, 0);
}

static void write_png(const char *path, int type, int depth, const unsigned char *bytes, png_colorp palette)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, 2, 1, depth, type, PNG_INTERLACE_ADAM7, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (palette != NULL)
        png_set_PLTE(png, info, palette, 2);
    png_write_info(png, info);
    int passes = png_set_interlace_handling(png);
    for (int i = 0; i < passes; i++)
        png_write_row(png, bytes);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
}

static void test_files(void **state)
{
    (void)state;
    char path[] = "/tmp/oracle_look_XXXXXX";
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    Store store = {NULL};
    write_png(path, PNG_COLOR_TYPE_GRAY, 2, (const unsigned char[]){0x60}, NULL);
    const Image *image = image_read(&store, path);
    assert_vec_near(image->values[0], grey(1.0L / 3), 0);
    assert_vec_near(image->values[1], grey(2.0L / 3), 0);
    write_png(path, PNG_COLOR_TYPE_RGB_ALPHA, 16,
              (const unsigned char[]){0x12, 0x34, 0, 1, 0xff, 0xff, 0, 0, 0, 0, 0x80, 0, 0, 2, 0, 9}, NULL);
    image = image_read(&store, path);
    assert_vec_near(image->values[0], vec(0x1234 / 65535.0L, 1 / 65535.0L, 1), 1e-18L);
    assert_near(image->decoded[1].y, srgb_decode(0x8000 / 65535.0L), 1e-18L);
    png_color palette[2] = {{255, 51, 0}, {0, 102, 255}};
    write_png(path, PNG_COLOR_TYPE_PALETTE, 1, (const unsigned char[]){0x40}, palette);
    image = image_read(&store, path);
    assert_vec_near(image->values[0], vec(1, 0.2L, 0), 1e-18L);
    assert_vec_near(image->values[1], vec(0, 0.4L, 1), 1e-18L);

    /* Flat and coded lines: m / 256 2^(e - 128); no power of two without a mantissa. */
    static const char FLAT[] =
        "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n\x80\x40\x00\x81\xff\x01\x02\x7f";
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(FLAT, 1, sizeof FLAT - 1, file);
    fclose(file);
    image = image_read(&store, path);
    assert_true(image->is_float);
    assert_vec_near(image->values[0], vec(1, 0.5L, 0), 0);
    assert_vec_near(image->values[1], vec(255 / 512.0L, 1 / 512.0L, 2 / 512.0L), 0);
    static const char CODED[] =
        "#?RADIANCE\n\n-Y 1 +X 8\n\x02\x02\x00\x08\x88\x80\x04\x01\x02\x03\x04\x84\x05"
                                "\x08\x08\x07\x06\x05\x04\x03\x02\x01\x88\x80";
    file = fopen(path, "wb");
    assert_non_null(file);
    fwrite(CODED, 1, sizeof CODED - 1, file);
    fclose(file);
    image = image_read(&store, path);
    assert_vec_near(image->values[2], scaled(vec(128, 3, 6), 1 / 256.0L), 0);
    assert_vec_near(image->values[7], scaled(vec(128, 5, 1), 1 / 256.0L), 0);
    unlink(path);
    store_free(&store);
}

/* du and dv of every shape against differences of the points that they lead to: uv of p + du h is u + h. */
static void test_tangents(void **state)
{
    (void)state;
    static const char *const SHAPES[] = {
        "sphere { center 1 2 3 radius 1.5 }",
        "plane { point 1 2 3 normal 0.2 1 0.3 }",
        "box { min -1 -2 -1.5 max 1 1 2 }",
        "tetrahedron { center 0 0 0 size 2 }",
        "triangle { vertices -2 -2 0 3 -2 0.5 0 3 1 uvs 0.1 0.2 1.3 -0.4 0.6 2 }",
        "disk { center 0 0 0 normal 0.1 0.2 1 radius 3 }",
        "cone { base 0 -2 0 top 0.3 2 0.2 radius 1.5 top_radius 0.5 }",
        "cylinder { base 0 -2 0 top 0.3 2 0.2 radius 1.5 }",
        "torus { center 0 0 0 axis 0.3 0.4 1 major 1.5 minor 0.7 }",
    };
    static const Vec STARTS[] = {{3, 4, 9}, {0.5L, 0.7L, 9}, {1.6L, -9, 2}, {0.1L, 8, 0.3L}};
    for (size_t i = 0; i < CASES(SHAPES); i++) {
        Scene scene;
        scene_init(&scene);
        scene_read_text(&scene, SHAPES[i]);
        const Shape *shape = scene.primitives[0].shape;
        int hits = 0;
        for (size_t k = 0; k < CASES(STARTS); k++) {
            Vec goal = grey(0.2L);
            if (shape->kind == SHAPE_SPHERE || shape->kind == SHAPE_PLANE)
                goal = vec(1.2L, 2.4L, 3.1L);
            if (shape->kind == SHAPE_TORUS)
                goal = vec(1.5L, 0.1L, 0);
            Ray ray = {STARTS[k], normalized(sub(goal, STARTS[k])), NULL, 0};
            Hit hit;
            if (!hit_closest(&scene, &ray, &hit))
                continue;
            hits++;
            real h = 1e-8L;
            const Surface *at = &hit.surface;
            assert_near(dot(at->du, at->normal), 0, 1e-15L);
            assert_near(dot(at->dv, at->normal), 0, 1e-15L);
            Surface right = shape_surface(shape, add(hit.local, scaled(at->du, h)), hit.patch);
            Surface up = shape_surface(shape, add(hit.local, scaled(at->dv, h)), hit.patch);
            assert_near((right.u - at->u) / h, 1, 1e-5L);
            assert_near((right.v - at->v) / h, 0, 1e-5L);
            assert_near((up.u - at->u) / h, 0, 1e-5L);
            assert_near((up.v - at->v) / h, 1, 1e-5L);
        }
        assert_true(hits >= 2);
        scene_free(&scene);
    }
}

static Vec mapped_on_plane(const char *transform, Vec color)
{
    char text[300];
    snprintf(text, sizeof text,
             "texture t checker { colors 0 0 } material m phong { normal_map t } "
             "plane { point 0 0 0 normal 0 1 0 material m %s }", transform);
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene, text);
    scene.textures[0].colors[0] = scene.textures[0].colors[1] = color;
    Ray ray = {vec(0.1L, 5, 0.2L), vec(0, -1, 0), NULL, 0};
    Hit hit;
    assert_true(hit_closest(&scene, &ray, &hit));
    scene_free(&scene);
    return hit.shading;
}

static void test_normal_map(void **state)
{
    (void)state;
    /* Normal y: u along x, v along -z. */
    Vec red = vec(0.5L + 0.5L * 0.6L, 0.5L, 0.5L + 0.5L * 0.8L);
    Vec green = vec(0.5L, 0.5L + 0.5L * 0.6L, 0.5L + 0.5L * 0.8L);
    assert_vec_near(mapped_on_plane("", vec(0.5L, 0.5L, 1)), vec(0, 1, 0), 1e-18L);
    assert_vec_near(mapped_on_plane("", red), vec(0.6L, 0.8L, 0), 1e-18L);
    assert_vec_near(mapped_on_plane("", green), vec(0, 0.8L, -0.6L), 1e-18L);
    /* Mirrored: right becomes left, up stays; stretching does not tilt. */
    assert_vec_near(mapped_on_plane("scale -1 1 1", red), vec(-0.6L, 0.8L, 0), 1e-18L);
    assert_vec_near(mapped_on_plane("scale -1 1 1", green), vec(0, 0.8L, -0.6L), 1e-18L);
    assert_vec_near(mapped_on_plane("scale 5 1 0.2", red), vec(0.6L, 0.8L, 0), 1e-18L);
    assert_vec_near(mapped_on_plane("scale 1 1 -1", green), vec(0, 0.8L, 0.6L), 1e-18L);
}

static void test_ggx(void **state)
{
    (void)state;
    static const real ROUGHNESS[] = {0.02L, 0.1L, 0.5L, 1};
    for (size_t i = 0; i < CASES(ROUGHNESS); i++) {
        real a = ROUGHNESS[i] * ROUGHNESS[i];
        assert_near(ggx_density(a, 1) * PI * a * a, 1, 1e-12L);
        /* The projected area of all facets is 1: the integral of D cos over the hemisphere, in tan^2 = a^2 x
         * / (1-x). */
        real sum = 0;
        int steps = 1000;
        for (int k = 0; k < steps; k++) {
            real x = (k + 0.5L) / steps;
            real c = sqrtl((1 - x) / (1 - x + a * a * x));
            /* dw cos = pi d(sin^2), and d(sin^2)/dx = a^2 / (1 - x + a^2 x)^2. */
            sum += ggx_density(a, c) * PI * a * a / ((1 - x + a * a * x) * (1 - x + a * a * x)) / steps;
        }
        assert_near(sum, 1, 1e-10L);
    }
    /* Without roughness no masking: 1 / (4 N.L N.V). */
    assert_near(ggx_visibility(0, 0.5L, 0.8L), 1 / (4 * 0.5L * 0.8L), 1e-18L);
    assert_near(ggx_visibility(1, 0.5L, 0.8L), 0.5L / 1.3L, 1e-18L);
    assert_near(ggx_visibility(1, 0.5L, -0.3L), 0.5L / 0.5001L, 1e-18L);
}

#define PLANE_DOWN "camera { position 0 5 0 look_at 0 0 0 up 0 0 -1 orthographic 1 } " \
    "plane { point 0 0 0 normal 0 1 0 material m } "
#define PBR_DOWN "ambient 0 " PLANE_DOWN

static void test_pbr_values(void **state)
{
    (void)state;
    /* Straight on: F = 0.04, D = 1 / (pi a^2), Vis = 1/4. */
    real a = 0.25L;
    real lobe = 0.04L / (4 * PI * a * a);
    assert_near(pixel_of("light directional { direction 0 -1 0 intensity 2 } "
                         "material m pbr { base_color 0.5 } " PBR_DOWN).x,
                2 * (0.96L * 0.5L / PI + lobe), 1e-15L);
    assert_near(pixel_of("light directional { direction 0 -1 0 } "
                         "material m pbr { base_color 0.5 metallic 1 roughness 1 } " PBR_DOWN).x,
                0.5L / (4 * PI), 1e-15L);
    /* A mirror: the diffuse part and one ray. */
    assert_near(pixel_of("background 1 light directional { direction 0 -1 0 } "
                         "material m pbr { base_color 0.5 roughness 0.01 } " PBR_DOWN).x,
                0.96L * 0.5L / PI + 0.04L, 1e-15L);
    assert_near(pixel_of("background 1 material m pbr { base_color 0.5 metallic 1 roughness 0 } " PBR_DOWN).x,
                0.5L, 1e-15L);
    /* Rough: no ray. Ambient by base color and occlusion, in the first channel. */
    assert_near(pixel_of("background 1 material m pbr { metallic 1 } " PBR_DOWN).x, 0, 0);
    assert_near(pixel_of("ambient 0.5 material m pbr { base_color 0.5 occlusion 0.25 } " PLANE_DOWN).x,
                0.0625L, 1e-18L);
}

static void test_pbr_transmit(void **state)
{
    (void)state;
    /* m = 0.8 0.75 = 0.6: the rest of the weight is neither seen nor reflected by the rough lobe here. */
    assert_near(pixel_of("background 1 material m pbr { base_color 0.5 transmit 0.8 metallic 0.25 } "
                         PBR_DOWN).x,
                0.6L * 0.96L * 0.5L + 0.6L * 0.04L, 1e-15L);
    /* Smooth: (1 - m) F0 more, F0 = 0.04 0.75 + 0.5 0.25. */
    assert_near(pixel_of("background 1 material m pbr { "
                         "base_color 0.5 transmit 0.8 metallic 0.25 roughness 0 } "
                         PBR_DOWN).x,
                0.6L * 0.96L * 0.5L + 0.6L * 0.04L + 0.4L * (0.03L + 0.125L), 1e-15L);
    /* From inside at 45 degrees: total reflection. */
    assert_near(pixel_of("ambient 0 background 1 camera { position 0 -1 0 look_at 1 0 0 } "
                         "material m pbr { transmit 0.8 } plane { point 0 0 0 normal 0 1 0 material m }").x,
                0.8L, 1e-15L);
    /* A shadow ray takes m base_color of each surface, by the base color there. */
    real lit = 0.8L;
    assert_vec_near(pixel_of("ambient 0 light directional { direction 0 -1 0 } "
                             "texture t checker { colors 1 0.5 0.25  0 0 0 } "
                             "material floor phong { diffuse 0.8 } "
                             "material m pbr { base_color t transmit 0.5 metallic 0.5 } "
                             "camera { position 0 0.5 5 look_at 0 0 0 } "
                             "plane { point 0 0 0 normal 0 1 0 material floor } "
                             "plane { point -0.25 1 0.25 normal 0 1 0 material m }"),
                    scaled(vec(lit, lit / 2, lit / 4), 0.25L), 1e-15L);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lookup),     cmocka_unit_test(test_orientation), cmocka_unit_test(test_files),
        cmocka_unit_test(test_tangents),   cmocka_unit_test(test_normal_map),  cmocka_unit_test(test_ggx),
        cmocka_unit_test(test_pbr_values), cmocka_unit_test(test_pbr_transmit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
