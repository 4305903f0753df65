// A limit of the brightness of samples: nothing is above it, what is below it keeps its bits, and what it took
// away is told to the last rounding; the same on every shape of the kernels, in any memory and any crop.
#include <float.h>
#include <math.h>

#include "render/aov.h"
#include "scenes.h"
#include "support.h"

static Device *device;

// A lamp in narrow highlights, so that a few samples of a pixel are far brighter than the others.
static const char sparkles[] =
    "image { size 70 53 seed 5 samples %u filter %s }\n"
    "camera { position 0 1 6 look_at 0 0.75 0 fov 40 }\n"
    "render { max_depth 3 integrator %s }\n"
    "background 0.125 0.25 0.5\n"
    "light point { position -2 4 4 intensity 30 20 10 }\n"
    "material shiny blinn_phong { diffuse 0.0078125 specular 0.875 shininess 2000 }\n"
    "material glossy phong { diffuse 0.0078125 0 0 specular 0.875 0.75 0.875 shininess 20 }\n"
    "material ground phong { diffuse 0.015625 0.0078125 0 reflect 0.25 }\n"
    "plane { point 0 0 0 normal 0 1 0 material ground }\n"
    "sphere { center -1 0.75 0 radius 0.75 material glossy }\n"
    "sphere { center 1 0.5 0.5 radius 0.5 material shiny }\n"
    "sphere { center 0.25 0.25 1.5 radius 0.25 material shiny }\n";

static Layout *layout_sparkles(const char *integrator, const char *filter, u32 samples)
{
    char *text = text_of(sparkles, samples, filter, integrator);
    Layout *layout = layout_of(text);
    free(text);
    return layout;
}

static f32 largest(const f32 *rgb)
{
    return rgb[0] > rgb[1] ? (rgb[0] > rgb[2] ? rgb[0] : rgb[2]) : rgb[1] > rgb[2] ? rgb[1] : rgb[2];
}

// Pixel by pixel, in floats.
static void test_one_sample(void **state)
{
    (void)state;
    static const f32 limits[] = {0.3f, 0.75f, 1.7f};
    Layout *layout = layout_sparkles("whitted", "box", 1);
    Picture plain = render_layout(device, layout, NULL);
    assert_false(features_have(plain.stats.features, FEATURE_CLAMP));
    for (size_t k = 0; k < sizeof limits / sizeof *limits; k++) {
        const f32 limit = limits[k];
        const RenderHow how = {.clamp = limit};
        Picture picture = render_layout(device, layout, &how);
        assert_true(features_have(picture.stats.features, FEATURE_CLAMP));
        u32 above = 0, colored = 0;
        for (size_t i = 0; i < (size_t)plain.width * plain.height; i++) {
            const f32 *before = plain.rgb + 3 * i, *after = picture.rgb + 3 * i, *lost = picture.clamped + 4 * i;
            const f32 most = largest(before);
            const bool clamped = most > limit;
            above += clamped;
            assert_true(lost[3] == (clamped ? 1.0f : 0.0f));
            for (u32 c = 0; c < 3; c++) {
                assert_true(after[c] <= limit);
                assert_true(lost[c] == before[c] - after[c]);
                const f64 expected = clamped ? (f64)before[c] * (f64)limit / (f64)most : (f64)before[c];
                assert_true(fabs((f64)after[c] - expected) <= 3 * (f64)FLT_EPSILON * expected);
                colored += clamped && after[c] < limit / 2;
            }
            if (!clamped)
                assert_memory_equal(before, after, 3 * sizeof(f32));
            else
                assert_true(largest(after) == limit);
        }
        print_message("limit %g: %u of %u pixels above it\n", (f64)limit, above, plain.width * plain.height);
        assert_true(above > 20 && colored > 20 && above < plain.width * plain.height);
        picture_destroy(&picture);
    }
    picture_destroy(&plain);
    layout_destroy(layout);
}

static void expect_sum(const Picture *plain, const Picture *clamped, u32 samples, f64 tolerance, const char *what)
{
    f64 mean = 0, removed = 0, count = 0;
    const size_t pixels = (size_t)plain->width * plain->height;
    for (size_t i = 0; i < 3 * pixels; i++) {
        const f64 lost = (f64)clamped->clamped[4 * (i / 3) + i % 3] / samples;
        const f64 off = fabs((f64)plain->rgb[i] - (f64)clamped->rgb[i] - lost);
        if (!(off <= tolerance * (fabs((f64)plain->rgb[i]) + fabs(lost) + 1)))
            fail_msg("%s, value %zu: %.9g is not %.9g and %.9g", what, i, (f64)plain->rgb[i], (f64)clamped->rgb[i],
                     lost);
        mean += (f64)plain->rgb[i] / (3 * (f64)pixels);
        removed += lost / (3 * (f64)pixels);
        count += i % 3 ? 0 : (f64)clamped->clamped[4 * (i / 3) + 3];
    }
    print_message("%-38s mean %.6f, of which %.6f above the limit, in %.0f samples\n", what, mean, removed, count);
    assert_true(removed > 0.05 * mean && count > 0 && count < 0.2 * (f64)samples * (f64)pixels);
}

// Pixel by pixel: the mean of samples that were clamped and what was taken from them are the mean of the
// others. Rounds of slots that are whole, and not; with weights of either sign; in doubles.
static void test_sum(void **state)
{
    (void)state;
    static const struct {
        const char *integrator, *filter;
        u32 samples;
        MathMode math;
    } cases[] = {{"whitted", "tent", 5, MATH_EXACT},
                 {"whitted", "mitchell", 37, MATH_EXACT},
                 {"whitted", "mitchell", 3, MATH_DOUBLE},
                 {"path", "mitchell", 5, MATH_EXACT}};
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        if (cases[k].math == MATH_DOUBLE && !device_info(device)->fp64)
            continue;
        Layout *layout = layout_sparkles(cases[k].integrator, cases[k].filter, cases[k].samples);
        const RenderHow plainly = {.math = cases[k].math}, limited = {.math = cases[k].math, .clamp = 0.75f};
        Picture plain = render_layout(device, layout, &plainly), clamped = render_layout(device, layout, &limited);
        char *what = text_of("%s, %s, %u samples%s", cases[k].integrator, cases[k].filter, cases[k].samples,
                             cases[k].math == MATH_DOUBLE ? ", double" : "");
        expect_sum(&plain, &clamped, cases[k].samples, 1e-6, what);
        free(what);
        picture_destroy(&plain);
        picture_destroy(&clamped);
        layout_destroy(layout);
    }
}

static void test_limit_above_all(void **state)
{
    (void)state;
    Layout *layout = layout_sparkles("whitted", "mitchell", 5);
    const RenderHow how = {.clamp = 1e6f};
    Picture plain = render_layout(device, layout, NULL), clamped = render_layout(device, layout, &how);
    assert_same_picture(&plain, &clamped, "a limit that nothing reaches");
    for (size_t i = 0; i < 4 * (size_t)plain.width * plain.height; i++)
        assert_true(clamped.clamped[i] == 0);
    picture_destroy(&plain);
    picture_destroy(&clamped);
    layout_destroy(layout);
}

static void assert_same_losses(const Picture *a, const Picture *b, const char *what)
{
    const size_t bytes = 4 * sizeof(f32) * a->width * a->height;
    if (memcmp(a->clamped, b->clamped, bytes) != 0)
        fail_msg("%s: what was taken away differs", what);
}

static void expect_same(const Picture *usual, const Layout *layout, const RenderHow *how, const char *what)
{
    Picture picture = render_layout(device, layout, how);
    assert_same_picture(usual, &picture, what);
    assert_same_losses(usual, &picture, what);
    if (how->memory) {
        assert_true(picture.stats.scene_bytes + picture.stats.state_bytes + picture.stats.film_bytes <=
                    how->memory);
        assert_true(picture.stats.band_rows < picture.height);
    }
    picture_destroy(&picture);
}

static void expect_part(const Picture *usual, const Layout *layout, f32 clamp)
{
    const RenderHow crop = {.clamp = clamp, .left = 17, .top = 9, .width = 50, .height = 40};
    Picture picture = render_layout(device, layout, &crop);
    for (u32 y = 0; y < crop.height; y++) {
        const size_t first = (size_t)usual->width * (crop.top + y) + crop.left;
        assert_memory_equal(picture.rgb + 3 * (size_t)crop.width * y, usual->rgb + 3 * first,
                            3 * sizeof(f32) * crop.width);
        assert_memory_equal(picture.clamped + 4 * (size_t)crop.width * y, usual->clamped + 4 * first,
                            4 * sizeof(f32) * crop.width);
    }
    picture_destroy(&picture);
}

// On shapes of the kernels, in memory for a band of few rows and of more, and a part of it.
static void expect_same_bytes(const Layout *layout, f32 clamp, const char *const *shapes, u32 shape_count)
{
    const RenderHow how = {.clamp = clamp};
    Picture usual = render_layout(device, layout, &how);
    f64 lost = 0;
    for (size_t i = 0; i < 4 * (size_t)usual.width * usual.height; i++)
        lost += fabs((f64)usual.clamped[i]);
    assert_true(lost > 0);
    for (u32 i = 0; i < shape_count; i++)
        expect_same(&usual, layout, &(RenderHow){.clamp = clamp, .shape = shapes[i]}, shapes[i]);
    const u64 strip = (u64)usual.width * TILE_SIDE * (12 + 12 + 4 + 16);
    const u64 least = usual.stats.scene_bytes + usual.stats.state_bytes / usual.stats.groups + strip;
    for (u32 more = 0; more < 2; more++)
        expect_same(&usual, layout, &(RenderHow){.clamp = clamp, .memory = least + 8192 + 2 * more * strip},
                    "another limit of memory");
    expect_part(&usual, layout, clamp);
    picture_destroy(&usual);
}

// The scene with the most features, transparency and a filter with negative lobes; and paths.
static void test_same_bytes(void **state)
{
    (void)state;
    static const char *const shapes[] = {"1,1,16", "4,32,1"};
    char *text = scene_under(scene_glass, NULL);
    Layout *glass = layout_of(text), *paths = layout_sparkles("path", "tent", 21);
    glass->params.samples = 21;
    expect_same_bytes(glass, 0.375f, shapes, 2);
    expect_same_bytes(paths, 0.75f, shapes + 1, 1);
    layout_destroy(glass);
    layout_destroy(paths);
    free(text);
}

// What is no number is not hidden by a limit; what is huge and finite is brought down.
static void test_not_finite(void **state)
{
    (void)state;
    Layout *layout = layout_of("image { size 2 1 }\nambient 0\ncamera { position 0 0 5 look_at 0 0 0 fov 90 }\n"
                               "material huge phong { diffuse 0 emission 3e38 1 0 }\n"
                               "material mirror phong { diffuse 0 emission 3e38 0 0 reflect 1 }\n"
                               "plane { point 0 0 9 normal 0 0 -1 material huge }\n"
                               "box { min -9 -9 -1 max 0 9 0 material mirror }\n"
                               "box { min 0 -9 -1 max 9 9 0 material huge }\n");
    const RenderHow how = {.clamp = 2};
    Picture picture = render_layout(device, layout, &how);
    assert_true(isinf(picture.rgb[0]) && picture.rgb[1] == 1 && picture.rgb[2] == 0);
    for (u32 c = 0; c < 4; c++)
        assert_true(picture.clamped[c] == 0);
    assert_true(picture.rgb[3] == 2 && picture.rgb[4] < 1e-37f && picture.rgb[5] == 0);
    assert_true(picture.clamped[4] == 3e38f && picture.clamped[7] == 1);
    picture_destroy(&picture);
    layout_destroy(layout);
}

// Properties of first hits are no radiance.
static void test_properties(void **state)
{
    (void)state;
    Layout *layout = layout_sparkles("whitted", "box", 1);
    Error error = {0};
    RenderRows rows = {0};
    const RenderJob job = {.layout = layout, .device = device, .width = 70, .height = 53, .aov = AOV_DEPTH, .clamp = 1};
    Render *render = render_create(&job, &error);
    if (!render)
        fail_msg("%s", error.text);
    while (!render_finished(render))
        assert_true(render_step(render, &rows, &error));
    assert_int_equal(rows.count, job.height);
    assert_null(rows.clamped);
    assert_false(features_have(render_stats(render)->features, FEATURE_CLAMP));
    assert_true(rows.rgb[3 * (70 * 26 + 35)] > 3);
    render_destroy(render);
    layout_destroy(layout);
}

int main(void)
{
    device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_one_sample), cmocka_unit_test(test_sum),        cmocka_unit_test(test_limit_above_all),
        cmocka_unit_test(test_same_bytes), cmocka_unit_test(test_not_finite), cmocka_unit_test(test_properties),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
