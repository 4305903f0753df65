// Errors that clrt-report finds between pictures, against values worked by hand.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "errors.h"

static Image *picture(u32 width, u32 height, u32 channels)
{
    Error error;
    Image *image = image_create(width, height, channels, &error);
    assert_non_null(image);
    return image;
}

static void expect_near(f64 value, f64 right, f64 relative)
{
    if (!(fabs(value - right) <= relative * fabs(right)))
        fail_msg("%.17g is not %.17g", value, right);
}

static void test_distances(void **state)
{
    (void)state;
    Error error;
    Distance d;
    Image *a = picture(2, 1, 3), *b = picture(2, 1, 3);
    const f32 right[] = {0, 0.5f, 1, 2, 0.25f, 0.125f}, test[] = {0, 0.75f, 1, 1.5f, 0.25f, 0.125f};
    memcpy(a->values, right, sizeof right);
    memcpy(b->values, test, sizeof test);
    assert_true(errors_compare(a, b, false, &d, &error));
    assert_int_equal(d.values, 6);
    assert_int_equal(d.different_values, 2);
    expect_near(d.max_abs, 0.5, 0);
    expect_near(d.p99_abs, 0.5, 0);
    expect_near(d.mse, (0.0625 + 0.25) / 6, 1e-15);
    expect_near(d.rmse, sqrt(0.3125 / 6), 1e-15);
    expect_near(d.relmse, (0.0625 / 0.26 + 0.25 / 4.01) / 6, 1e-14);
    expect_near(d.psnr_db, 10 * log10(6 / 0.3125), 1e-14);
    expect_near(d.mean, -0.25 / 6, 1e-15);
    assert_int_equal(d.max_ulp, 0x400000); // half of the floats from 0.5 to 1, or from 1 to 2
    assert_true(isnan(d.flip_mean));
    image_destroy(a);
    image_destroy(b);
}

// One value in two hundred is far off: beyond the 99th percentile.
static void test_percentile(void **state)
{
    (void)state;
    Error error;
    Distance d;
    Image *a = picture(200, 1, 1), *b = picture(200, 1, 1);
    for (u32 i = 0; i < 200; i++)
        b->values[i] = i == 77 ? 8 : (f32)(i % 4) / 16;
    assert_true(errors_compare(a, b, false, &d, &error));
    expect_near(d.max_abs, 8, 0);
    expect_near(d.p99_abs, 3.0 / 16, 0);
    image_destroy(a);
    image_destroy(b);
}

static void test_perceived(void **state)
{
    (void)state;
    Error error;
    Distance d;
    Image *black = picture(24, 24, 3), *white = picture(24, 24, 3);
    for (u32 i = 0; i < 24 * 24 * 3; i++)
        white->values[i] = 1;
    assert_true(errors_compare(black, white, true, &d, &error));
    expect_near(d.flip_mean, 0.96738, 1e-4); // of light, as the authors' program has it
    assert_true(errors_compare(white, white, true, &d, &error));
    assert_true(d.flip_mean == 0 && d.ssim_mean == 1 && d.mse == 0 && d.max_ulp == 0);
    image_destroy(black);
    image_destroy(white);
}

static void test_not_numbers(void **state)
{
    (void)state;
    Error error;
    Distance d;
    Image *a = picture(2, 2, 1), *b = picture(2, 2, 1), *other = picture(2, 1, 1);
    const f32 odd[] = {NAN, INFINITY, -1, 0};
    memcpy(b->values, odd, sizeof odd);
    assert_true(errors_compare(a, b, true, &d, &error));
    assert_true(isnan(d.mse) && isnan(d.max_abs) && isnan(d.p99_abs) && isnan(d.flip_mean) && isnan(d.mean));
    const Oddities found = errors_oddities(b);
    assert_true(found.nan == 1 && found.inf == 1 && found.negative == 1);
    assert_false(errors_compare(a, other, false, &d, &error));
    assert_int_equal(error.code, ERROR_IO);
    image_destroy(a);
    image_destroy(b);
    image_destroy(other);
}

static void test_other_objects(void **state)
{
    (void)state;
    Error error;
    u64 pixels;
    Image *a = picture(3, 1, 3), *b = picture(3, 1, 3);
    const f32 ids[] = {1, 0, 2, -1, -1, -1, 5, 0, 1};
    memcpy(a->values, ids, sizeof ids);
    memcpy(b->values, ids, sizeof ids);
    assert_true(errors_count_other(a, b, &pixels, &error));
    assert_int_equal(pixels, 0);
    b->values[5] = 3; // hit where there was a miss
    b->values[6] = 6;
    b->values[7] = 1; // the same pixel
    assert_true(errors_count_other(a, b, &pixels, &error));
    assert_int_equal(pixels, 2);
    image_destroy(a);
    image_destroy(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_distances),     cmocka_unit_test(test_percentile),
        cmocka_unit_test(test_perceived),     cmocka_unit_test(test_not_numbers),
        cmocka_unit_test(test_other_objects),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
