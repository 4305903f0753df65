// Z-test: known p-values and thresholds, and whether it errs as often as it says.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "ztest.h"

enum { WIDTH = 20, HEIGHT = 10, PIXELS = WIDTH * HEIGHT };

static const ZLimits LIMITS = {.significance = 0.01, .pass_percent = 99.75};

static Image *make_image(u32 channels, f32 value)
{
    Error error;
    Image *image = image_create(WIDTH, HEIGHT, channels, &error);
    assert_non_null(image);
    for (u32 i = 0; i < PIXELS * channels; i++)
        image->values[i] = value;
    return image;
}

// Both 100, each with a variance.
static Pictures make(u32 channels, f32 variance_a, f32 variance_b)
{
    return (Pictures){.images = {make_image(channels, 100), make_image(channels, 100)},
                      .format = FORMAT_PFM,
                      .linear = true,
                      .region = {0, 0, WIDTH, HEIGHT},
                      .variances = {make_image(channels, variance_a), make_image(1, variance_b)}};
}

static void assert_near(f64 value, f64 expected, f64 relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.17g instead of %.17g", value, expected);
}

// erfc(z / sqrt 2) by mpmath with 30 digits; variances of 3 and 1 make 2 one standard deviation.
static void test_p_values(void **state)
{
    (void)state;
    const struct {
        f32 z;
        f64 p;
    } cases[] = {
        {0, 1},
        {1, 0.3173105078629141},
        {2, 0.045500263896358414},
        {3, 0.0026997960632601891},
        {5, 5.7330314375838782e-7},
        {6, 1.9731752900753963e-9},
        {8, 1.2441921148543568e-15},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            Pictures pictures = make(3, 3, 1);
            f32 z[PIXELS];
            pictures.images[1]->values[(2 * WIDTH + 7) * 3 + 1] += (f32)sign * 2 * cases[i].z;
            const ZTest test = ztest_compute(&pictures, &LIMITS, z);
            assert_near(test.p_min, cases[i].p, 1e-13);
            assert_true(z[2 * WIDTH + 7] == cases[i].z && z[0] == 0);
            assert_true(i == 0 || (test.x == 7 && test.y == 2 && test.channel == 1));
            assert_near(test.z_rms, (f64)cases[i].z / sqrt(600), 1e-14);
            assert_near(test.bias, sign * 2 * (f64)cases[i].z / 600, 1e-14);
            assert_near(test.bias_error, 2 / sqrt(600), 1e-14);
            pictures_destroy(&pictures);
        }
    }
}

// 1 - (1 - s)^(1/n) by mpmath with 30 digits; n is the number of values that are tested.
static void test_thresholds(void **state)
{
    (void)state;
    Pictures pictures = make(3, 1, 0);
    ZLimits limits = LIMITS;
    assert_near(ztest_compute(&pictures, &limits, NULL).threshold, 1.6750419465992981e-5, 1e-14);
    limits.significance = 0.2;
    assert_near(ztest_compute(&pictures, &limits, NULL).threshold, 0.00037183677042327875, 1e-14);
    pictures.left_out = calloc(PIXELS, 1);
    assert_non_null(pictures.left_out);
    for (int i = 0; i < PIXELS - 1; i++)
        pictures.left_out[i] = 1;
    limits.significance = 0.05;
    const ZTest test = ztest_compute(&pictures, &limits, NULL);
    assert_near(test.threshold, 0.016952427508441499, 1e-14);
    assert_int_equal(test.pixels, 1);
    pictures_destroy(&pictures);
    pictures = make(1, 1, 0);
    assert_near(ztest_compute(&pictures, &LIMITS, NULL).threshold, 5.0250416673021857e-5, 1e-14);
    pictures_destroy(&pictures);
}

static void test_what_passes(void **state)
{
    (void)state;
    Pictures pictures = make(3, 4, 0);
    ZLimits limits = LIMITS;
    // p is 1.67504e-5 at z = 4.305: just below it, just above it in two channels of one pixel.
    pictures.images[1]->values[30] = 100 + 2 * 4.30f;
    assert_int_equal(ztest_compute(&pictures, &limits, NULL).passed_pixels, PIXELS);
    pictures.images[1]->values[30] = 100 + 2 * 4.31f;
    pictures.images[1]->values[31] = 100 - 2 * 4.31f;
    ZTest test = ztest_compute(&pictures, &limits, NULL);
    assert_int_equal(test.passed_pixels, PIXELS - 1);
    assert_int_equal(test.pixels, PIXELS);
    assert_false(test.passed); // 99.5 %
    limits.pass_percent = 99.5;
    assert_true(ztest_compute(&pictures, &limits, NULL).passed);
    limits = LIMITS;
    limits.variance_floor = 5;
    assert_true(ztest_compute(&pictures, &limits, NULL).passed_pixels == PIXELS);
    // Each colour has its own variance.
    pictures.variances[0]->values[30] = 100;
    test = ztest_compute(&pictures, &LIMITS, NULL);
    assert_true(test.passed_pixels == PIXELS - 1 && test.channel == 1);
    pictures.variances[0]->values[31] = 100;
    assert_true(ztest_compute(&pictures, &LIMITS, NULL).passed_pixels == PIXELS);
    pictures_destroy(&pictures);
}

// Neither variance nor difference; a difference without variance; infinities; NaN.
static void test_edges(void **state)
{
    (void)state;
    Pictures pictures = make(3, 0, 0);
    f32 z[PIXELS];
    ZTest test = ztest_compute(&pictures, &LIMITS, z);
    assert_true(test.passed && test.p_min == 1 && test.z_rms == 0 && test.bias_error == 0);
    f32 *b = pictures.images[1]->values;
    b[0] = nextafterf(100, 0);
    test = ztest_compute(&pictures, &LIMITS, z);
    assert_true(test.passed_pixels == PIXELS - 1 && test.p_min == 0 && isinf(z[0]) && isinf(test.z_rms));
    pictures.images[0]->values[0] = b[0] = -INFINITY;
    test = ztest_compute(&pictures, &LIMITS, z);
    assert_true(test.passed && test.p_min == 1 && test.bias == 0);
    pictures.variances[0]->values[3] = 1e30f;
    b[3] = INFINITY;
    test = ztest_compute(&pictures, &LIMITS, z);
    assert_true(test.passed_pixels == PIXELS - 1 && test.p_min == 0 && isinf(z[1]));
    b[7] = NAN;
    pictures.variances[0]->values[8] = 1;
    b[8] = 101;
    test = ztest_compute(&pictures, &LIMITS, z);
    assert_true(test.passed_pixels == PIXELS - 2 && isnan(z[2]) && isnan(test.z_rms));
    pictures_destroy(&pictures);
}

// xorshift64* (Vigna 2016), and Box and Muller's normal numbers from it.
static f64 uniform(u64 *seed)
{
    *seed ^= *seed >> 12;
    *seed ^= *seed << 25;
    *seed ^= *seed >> 27;
    return ((f64)(*seed * 0x2545F4914F6CDD1Du >> 11) + 0.5) / 9007199254740992.0;
}

static f64 normal(u64 *seed)
{
    const f64 radius = sqrt(-2 * log(uniform(seed)));
    return radius * cos(6.283185307179586 * uniform(seed));
}

// 2000 pairs that differ by nothing but normal noise of their variances, at a significance of 0.2 and with
// all pixels needed: 400 should be rejected, with a standard deviation of 17.9. One value in 600 that is
// wrong by six standard deviations is found in nearly all.
static void test_calibration(void **state)
{
    (void)state;
    const ZLimits limits = {.significance = 0.2, .pass_percent = 100};
    u64 seed = 1;
    int rejected = 0, found = 0;
    f64 z_squares = 0, bias_squares = 0;
    for (int trial = 0; trial < 2000; trial++) {
        Pictures pictures = make(3, 0.5f, 0.25f);
        for (int i = 0; i < PIXELS * 3; i++) {
            pictures.images[0]->values[i] += (f32)(sqrt(0.5) * normal(&seed));
            pictures.images[1]->values[i] += (f32)(sqrt(0.25) * normal(&seed));
        }
        const ZTest test = ztest_compute(&pictures, &limits, NULL);
        rejected += !test.passed;
        z_squares += test.z_rms * test.z_rms;
        bias_squares += test.bias * test.bias / (test.bias_error * test.bias_error);
        pictures.images[1]->values[300] += (f32)(6 * sqrt(0.75));
        found += !ztest_compute(&pictures, &limits, NULL).passed;
        pictures_destroy(&pictures);
    }
    assert_in_range(rejected, 400 - 72, 400 + 72);
    assert_true(fabs(z_squares / 2000 - 1) < 4 * sqrt(2.0 / (600 * 2000)));
    assert_true(fabs(bias_squares / 2000 - 1) < 4 * sqrt(2.0 / 2000));
    assert_true(found > 1980);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_p_values), cmocka_unit_test(test_thresholds),
        cmocka_unit_test(test_what_passes), cmocka_unit_test(test_edges),
        cmocka_unit_test(test_calibration),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
