// clrt-compare as it is used: what its limits and figures are.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#include "program.h"

static void test_limits(void **state)
{
    Fixture *f = *state;
    write_rgb("a.png", f->levels);
    write_rgb("same.png", f->levels);
    // 6 of 600 values, 1 %, by 3 levels.
    for (int i = 0; i < 6; i++)
        f->levels[i * 97] = (u8)(f->levels[i * 97] + 3);
    write_rgb("b.png", f->levels);
    expect_same(f, "a.png same.png");
    assert_non_null(strstr(f->out, "a.png, same.png: the same\n"));
    expect_different(f, "a.png b.png");
    assert_non_null(strstr(f->out, "a.png, b.png: different\n"));
    assert_non_null(strstr(f->out, "6 values, 1 %"));
    expect_different(f, "a.png b.png --fail 2.9");
    expect_same(f, "a.png b.png --fail 3");
    assert_non_null(strstr(f->out, "the same within the limits"));
    expect_same(f, "--fail-percent 1 a.png b.png");
    expect_different(f, "--fail-percent 0.999 a.png b.png");
    expect_same(f, "--fail-percent=1 a.png b.png --hard-fail=3");
    expect_different(f, "--fail-percent 1 a.png b.png --hard-fail 2");
    expect_different(f, "--fail-percent 100 --hard-fail 0 a.png b.png");
    expect_different(f, "--quiet a.png b.png");
    assert_string_equal(f->out, "");
    expect_same(f, "--quiet a.png same.png");
    assert_string_equal(f->out, "");
}

static void test_figures(void **state)
{
    Fixture *f = *state;
    write_rgb("a.png", f->levels);
    f->levels[(3 * WIDTH + 7) * 3 + 1] = (u8)(f->levels[(3 * WIDTH + 7) * 3 + 1] + 10);
    f->levels[(3 * WIDTH + 7) * 3 + 2] = (u8)(f->levels[(3 * WIDTH + 7) * 3 + 2] - 2);
    f->levels[(8 * WIDTH + 2) * 3] = (u8)(f->levels[(8 * WIDTH + 2) * 3] - 10);
    write_rgb("b.png", f->levels);
    json_t *root = run_json(f, "a.png b.png --fail 1", 1);
    assert_true(number(root, "pixels") == WIDTH * HEIGHT);
    assert_true(number(root, "values") == VALUES);
    assert_true(number(root, "left_out_pixels") == 0);
    assert_true(number(root, "different_pixels") == 2);
    assert_true(number(root, "different_values") == 3);
    assert_true(number(root, "failed_values") == 3);
    assert_true(number(root, "nan_values") == 0);
    assert_true(number(root, "max_abs") == 10);
    assert_true(fabs(number(root, "mean_abs") - 22.0 / VALUES) < 1e-15);
    const f64 rmse = sqrt(204.0 / VALUES);
    assert_true(fabs(number(root, "rmse") - rmse) < 1e-15);
    assert_true(fabs(number(root, "mse") - 204.0 / VALUES) < 1e-15);
    assert_true(fabs(number(root, "psnr_db") - 20 * log10(255 / rmse)) < 1e-12);
    assert_true(number(root, "flip_mean") > 0 && number(root, "flip_mean") < 0.2);
    assert_true(json_is_null(json_object_get(root, "max_ulp")));
    assert_true(json_is_null(json_object_get(root, "ssim_mean"))); // less than 11 pixels high
    assert_true(number(root, "relmse") > 0 && number(root, "relmse_epsilon") == 0.01);
    const json_t *hash = json_object_get(root, "pixel_hash");
    assert_string_equal(json_string_value(json_object_get(hash, "algorithm")), "fnv1a-64");
    assert_string_equal(json_string_value(json_object_get(hash, "a")), "ba125b2380e80601");
    assert_string_not_equal(json_string_value(json_object_get(hash, "b")), "ba125b2380e80601");
    assert_true(json_is_false(json_object_get(root, "same")));
    const json_t *worst = json_object_get(root, "worst");
    assert_true(number(worst, "x") == 7 && number(worst, "y") == 3);
    assert_string_equal(json_string_value(json_object_get(worst, "channel")), "green");
    assert_true(number(worst, "b") - number(worst, "a") == 10);
    json_decref(root);

    root = run_json(f, "a.png a.png", 0);
    assert_true(json_is_null(json_object_get(root, "worst")));
    assert_true(json_is_null(json_object_get(root, "psnr_db")));
    assert_true(number(root, "flip_mean") == 0);
    assert_true(json_is_true(json_object_get(root, "same")));
    json_decref(root);
}

// The hash is of the file's pixels: a crop and another compression do not change it.
static void test_hash(void **state)
{
    Fixture *f = *state;
    write_pfm("a.pfm", f->floats);
    f->floats[0] = nextafterf(f->floats[0], 9);
    write_pfm("b.pfm", f->floats);
    expect_same(f, "a.pfm a.pfm");
    assert_non_null(strstr(f->out, "pixels: FNV-1a e822c9166d7c9382 and e822c9166d7c9382\n"));
    expect_same(f, "a.pfm b.pfm --crop 1,0,19,10");
    assert_non_null(strstr(f->out, "e822c9166d7c9382 and "));
    assert_null(strstr(f->out, "and e822c9166d7c9382"));
}

static void test_crop_and_mask(void **state)
{
    Fixture *f = *state;
    write_rgb("a.png", f->levels);
    f->levels[(3 * WIDTH + 7) * 3] = 0;
    write_rgb("b.png", f->levels);
    expect_different(f, "a.png b.png");
    expect_different(f, "a.png b.png --crop 7,3,1,1");
    assert_non_null(strstr(f->out, "worst: pixel 7, 3 red"));
    expect_same(f, "a.png b.png --crop 8,0,12,10");
    expect_same(f, "a.png b.png --crop 0,4,20,6");
    expect_trouble(f, "a.png b.png --crop 8,0,13,10", "not within");
    expect_trouble(f, "a.png b.png --crop 20,0,1,1", "not within");
    expect_trouble(f, "a.png b.png --crop 4294967295,4294967295,4294967295,4294967295", "not within");

    u8 mask[WIDTH * HEIGHT * 2] = {0};
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        mask[2 * i + 1] = 255; // alpha alone leaves nothing out
    write_levels("mask.png", mask, PNG_FORMAT_GA, WIDTH, HEIGHT);
    expect_different(f, "a.png b.png --mask mask.png");
    mask[2 * (3 * WIDTH + 7)] = 1;
    write_levels("mask.png", mask, PNG_FORMAT_GA, WIDTH, HEIGHT);
    expect_same(f, "a.png b.png --mask mask.png");
    assert_non_null(strstr(f->out, "1 pixels left out"));
    expect_same(f, "a.png b.png --mask mask.png --crop 6,2,3,3");
    expect_trouble(f, "a.png b.png --mask mask.png --crop 7,3,1,1", "nothing to compare");
    expect_trouble(f, "a.png b.png --mask missing.png", "missing.png: No such file");
    write_levels("small.png", mask, PNG_FORMAT_GRAY, WIDTH, HEIGHT - 1);
    expect_trouble(f, "a.png b.png --mask small.png", "the mask is 20 x 9");
}

static void test_floats(void **state)
{
    Fixture *f = *state;
    f->floats[100] = INFINITY;
    f->floats[101] = 0;
    write_pfm("a.pfm", f->floats);
    f->floats[99] = nextafterf(nextafterf(f->floats[99], 9), 9);
    f->floats[101] = -0.0f;
    write_pfm("b.pfm", f->floats);
    expect_different(f, "a.pfm b.pfm");
    assert_non_null(strstr(f->out, "at most 2 ulp"));
    assert_non_null(strstr(f->out, "differing: 1 pixels"));
    expect_different(f, "a.pfm b.pfm --fail-ulp 1");
    expect_same(f, "a.pfm b.pfm --fail-ulp 2");
    expect_same(f, "a.pfm b.pfm --fail 1e-6");
    // Either nearness is enough; a hard limit asks for the distance alone.
    f->floats[99] += 0.5f;
    f->floats[3] = nextafterf(f->floats[3], 9);
    write_pfm("c.pfm", f->floats);
    expect_different(f, "a.pfm c.pfm --fail-ulp 1");
    expect_same(f, "a.pfm c.pfm --fail-ulp 1 --fail-percent 0.2");
    expect_different(f, "a.pfm c.pfm --fail-ulp 1 --fail-percent 0.2 --hard-fail 0.4");
    json_t *root = run_json(f, "a.pfm c.pfm", 1);
    assert_true(number(root, "max_ulp") > 1e6);
    assert_true(fabs(number(root, "max_abs") - 0.5) < 1e-6);
    json_decref(root);
    // An infinity is as far from every number as can be.
    f->floats[100] = 1e38f;
    write_pfm("d.pfm", f->floats);
    root = run_json(f, "a.pfm d.pfm --fail 1e300", 1);
    assert_true(number(root, "failed_values") == 1);
    assert_true(json_is_null(json_object_get(root, "max_abs")));
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "worst"), "a")), "inf");
    json_decref(root);
}

static void test_nan_is_never_the_same(void **state)
{
    Fixture *f = *state;
    f->floats[300] = NAN;
    write_pfm("a.pfm", f->floats);
    expect_different(f, "a.pfm a.pfm");
    expect_different(f, "a.pfm a.pfm --fail 1e30 --fail-percent 100 --fail-ulp 4294967295");
    assert_non_null(strstr(f->out, "NaN: 1 values; allowed none"));
    assert_non_null(strstr(f->out, "worst: pixel 0, 5 red: nan and nan"));
    expect_same(f, "a.pfm a.pfm --crop 1,0,19,10");
    json_t *root = run_json(f, "a.pfm a.pfm", 1);
    assert_true(number(root, "nan_values") == 1);
    assert_true(json_is_null(json_object_get(root, "rmse")));
    assert_true(json_is_null(json_object_get(root, "flip_mean")));
    assert_true(json_is_null(json_object_get(root, "relmse")));
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "worst"), "b")), "nan");
    json_decref(root);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_limits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_figures, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_hash, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_crop_and_mask, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_floats, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_nan_is_never_the_same, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
