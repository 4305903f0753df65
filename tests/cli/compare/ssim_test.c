// SSIM: against numbers that were computed in another way, closed forms, and what must hold whatever the
// numbers.
//
// The numbers are those of NumPy in double, with the window as a sum over its 121 pixels and moments about
// the window's own mean; structural_similarity of scikit-image (gaussian_weights, sigma 1.5,
// use_sample_covariance off, data_range 1) gives the same nine digits for the means.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "ssim.h"
#include "synthetic.h"

enum { COUNT = SYNTHETIC_COUNT };

static const ValueScale LEVELS = {255, true};

static f64 compare_images(const Image *a, const Image *b, ValueScale scale, f32 *similarities)
{
    Error error;
    assert_true(ssim_compare(a, b, scale, similarities, &error));
    f64 sum = 0;
    u32 windows = 0;
    for (u32 i = 0; i < a->width * a->height; i++) {
        const u32 x = i % a->width, y = i / a->width;
        const bool fits = x >= SSIM_RADIUS && y >= SSIM_RADIUS && x + SSIM_RADIUS < a->width &&
                          y + SSIM_RADIUS < a->height;
        assert_true(isnan(similarities[i]) == !fits);
        if (fits) {
            sum += (f64)similarities[i];
            windows++;
        }
    }
    return sum / windows;
}

static f64 compare(Synthetic a, Synthetic b, f32 *similarities)
{
    Image *images[2] = {synthetic_image(a), synthetic_image(b)};
    const f64 mean = compare_images(images[0], images[1], LEVELS, similarities);
    image_destroy(images[0]);
    image_destroy(images[1]);
    return mean;
}

static void test_against_other_programs(void **state)
{
    (void)state;
    static f32 similarities[COUNT];
    const struct {
        Synthetic a, b;
        f64 mean;
    } cases[] = {
        {SYNTHETIC_RAMP, SYNTHETIC_FIREFLY, 0.993363777},
        {SYNTHETIC_RAMP, SYNTHETIC_SHIFTED, 0.999531195},
        {SYNTHETIC_NOISE, SYNTHETIC_OTHER_NOISE, 0.021615628},
        {SYNTHETIC_CHECKER, SYNTHETIC_MOVED_CHECKER, 0.575351449},
        {SYNTHETIC_RAMP, SYNTHETIC_CHECKER, 0.023974881},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const f64 mean = compare(cases[i].a, cases[i].b, similarities);
        if (!(fabs(mean - cases[i].mean) < 2e-9))
            fail_msg("case %zu: %.9f instead of %.9f", i, mean, cases[i].mean);
    }
    // Single windows of the last pair: the first, one inside, the last.
    assert_true(fabs((f64)similarities[5 * SYNTHETIC_WIDTH + 5] - 0.013446665) < 5e-9);
    assert_true(fabs((f64)similarities[60 * SYNTHETIC_WIDTH + 40] - 0.035611651) < 5e-9);
    assert_true(fabs((f64)similarities[124 * SYNTHETIC_WIDTH + 69] - 0.037257814) < 5e-9);
}

// Without contrast, SSIM is (2 a b + C1) / (a^2 + b^2 + C1) of the two lumas.
static void test_flat_pictures(void **state)
{
    (void)state;
    static f32 similarities[COUNT];
    assert_true(fabs(compare(SYNTHETIC_BLACK, SYNTHETIC_WHITE, similarities) - 1e-4 / (1 + 1e-4)) < 1e-11);
    const f64 green = 0.7152, blue = 0.0722;
    const f64 expected = (2 * green * blue + 1e-4) / (green * green + blue * blue + 1e-4);
    assert_true(fabs(compare(SYNTHETIC_GREEN, SYNTHETIC_BLUE, similarities) - expected) < 1e-7);
}

static void test_invariants(void **state)
{
    (void)state;
    static f32 ab[COUNT], ba[COUNT];
    for (int kind = SYNTHETIC_BLACK; kind <= SYNTHETIC_MOVED_CHECKER; kind++)
        assert_true(compare((Synthetic)kind, (Synthetic)kind, ab) == 1);
    compare(SYNTHETIC_NOISE, SYNTHETIC_CHECKER, ab);
    compare(SYNTHETIC_CHECKER, SYNTHETIC_NOISE, ba);
    for (int i = 0; i < COUNT; i++)
        assert_true(ab[i] == ba[i] || (isnan(ab[i]) && isnan(ba[i])));
    // A difference is seen where windows hold it, and nowhere else.
    compare(SYNTHETIC_RAMP, SYNTHETIC_FIREFLY, ab);
    for (int i = 0; i < COUNT; i++) {
        const int dx = abs(i % SYNTHETIC_WIDTH - 40), dy = abs(i / SYNTHETIC_WIDTH - 50);
        assert_true(isnan(ab[i]) || (ab[i] < 1) == (dx <= SSIM_RADIUS && dy <= SSIM_RADIUS));
    }
}

// Light as floats, some of it below black and beyond white, and grey levels with alpha.
static void test_other_forms(void **state)
{
    (void)state;
    static f32 similarities[COUNT];
    Image *images[2] = {synthetic_image(SYNTHETIC_NOISE), synthetic_image(SYNTHETIC_RAMP)};
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < COUNT * 3; i++)
            images[k]->values[i] = images[k]->values[i] / 64 - 0.5f;
    }
    const f64 light = compare_images(images[0], images[1], (ValueScale){1, false}, similarities);
    assert_true(fabs(light - 0.011472407) < 2e-9);
    image_destroy(images[0]);
    image_destroy(images[1]);
    Error error;
    for (u32 k = 0; k < 2; k++) {
        images[k] = image_create(SYNTHETIC_WIDTH, SYNTHETIC_HEIGHT, 2, &error);
        assert_non_null(images[k]);
        for (u32 i = 0; i < COUNT; i++) {
            const u32 x = i % SYNTHETIC_WIDTH, y = i / SYNTHETIC_WIDTH;
            images[k]->values[2 * i] = (f32)synthetic_noise(x, y, 0, k + 1);
            images[k]->values[2 * i + 1] = (f32)(k * 100);
        }
    }
    assert_true(fabs(compare_images(images[0], images[1], LEVELS, similarities) - 0.006543005) < 2e-9);
    image_destroy(images[0]);
    image_destroy(images[1]);
}

static void test_small_pictures(void **state)
{
    (void)state;
    const u32 sizes[][3] = {{10, 40, 0}, {40, 10, 0}, {1, 1, 0}, {11, 11, 1}, {12, 11, 2}, {11, 13, 3}};
    f32 similarities[400];
    Error error;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        Image *image = image_create(sizes[i][0], sizes[i][1], 3, &error);
        assert_non_null(image);
        assert_true(ssim_compare(image, image, LEVELS, similarities, &error));
        u32 windows = 0;
        for (u32 k = 0; k < sizes[i][0] * sizes[i][1]; k++)
            windows += similarities[k] == 1;
        assert_int_equal(windows, sizes[i][2]);
        image_destroy(image);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_against_other_programs),
        cmocka_unit_test(test_flat_pictures),
        cmocka_unit_test(test_invariants),
        cmocka_unit_test(test_other_forms),
        cmocka_unit_test(test_small_pictures),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
