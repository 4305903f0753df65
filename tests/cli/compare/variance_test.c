// clrt-compare as it is used: the Z-test with variances.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <string.h>

#include <cmocka.h>
#include <png.h>

#include "program.h"

#define TEST "a.pfm b.pfm --variance-a va.pfm --variance-b vb.pfm "

// Variances of 0.75 and 0.25, so that the difference has a standard deviation of 1. Every value of b is one
// up, but blue of pixel 7, 3 five down.
static void write_pair(Fixture *f)
{
    f32 floats[VALUES];
    write_pfm("a.pfm", f->floats);
    for (int i = 0; i < VALUES; i++)
        floats[i] = f->floats[i] + 1;
    floats[(3 * WIDTH + 7) * 3 + 2] = f->floats[(3 * WIDTH + 7) * 3 + 2] - 5;
    write_pfm("b.pfm", floats);
    for (int i = 0; i < VALUES; i++)
        floats[i] = 0.75f;
    write_pfm("va.pfm", floats);
    for (int i = 0; i < VALUES; i++)
        floats[i] = 0.25f;
    write_pfm("vb.pfm", floats);
}

static void test_verdict(void **state)
{
    Fixture *f = *state;
    write_pair(f);
    expect_different(f, "a.pfm b.pfm");
    assert_null(strstr(f->out, "Z-test"));
    // 199 of 200 pixels are 99.5 %.
    expect_different(f, TEST);
    assert_non_null(strstr(f->out, "Z-test: 199 of 200 pixels pass, 99.5 %; needed 99.75 %"));
    assert_non_null(strstr(f->out, "at pixel 7, 3 blue"));
    assert_null(strstr(f->out, "beyond"));
    expect_same(f, TEST "--pass-percent 99.5");
    assert_non_null(strstr(f->out, "the same within the limits"));
    expect_same(f, TEST "--crop 8,0,12,10");
    expect_same(f, TEST "--significance 1e-9");
    expect_same(f, TEST "--variance-floor 2.5");
    // Without its variance, b is exact and 1 / sqrt 0.75 is not far; with 0.25 alone, 2 is not, either.
    expect_same(f, "a.pfm b.pfm --variance-a va.pfm --pass-percent 99.5");
    expect_same(f, "a.pfm b.pfm --variance-b vb.pfm --pass-percent 99.5");
    // Limits that are asked for still hold.
    expect_different(f, TEST "--pass-percent 99.5 --fail 0");
    expect_different(f, TEST "--pass-percent 99.5 --hard-fail 4.9");
    expect_same(f, TEST "--pass-percent 99.5 --hard-fail 5.1 --fail 1.1 --fail-percent 0.2");
}

static void test_json(void **state)
{
    Fixture *f = *state;
    write_pair(f);
    json_t *root = run_json(f, TEST "--variance-floor 0.125", 1);
    assert_true(json_is_null(json_object_get(json_object_get(root, "limits"), "fail")));
    const json_t *test = json_object_get(root, "ztest");
    assert_true(json_is_false(json_object_get(test, "passed")));
    assert_string_equal(json_string_value(json_object_get(test, "variance_a")), "va.pfm");
    assert_string_equal(json_string_value(json_object_get(test, "variance_b")), "vb.pfm");
    assert_true(number(test, "variance_floor") == 0.125);
    assert_true(number(test, "significance") == 0.01);
    assert_true(number(test, "pass_percent") == 99.75);
    assert_true(number(test, "pixels") == 200 && number(test, "passed_pixels") == 199);
    // 1 - 0.99^(1/600) and erfc(5 / sqrt 2).
    assert_true(fabs(number(test, "threshold") - 1.6750419465992981e-5) < 1e-18);
    assert_true(fabs(number(test, "p_min") - 5.7330314375838782e-7) < 1e-11);
    const json_t *at = json_object_get(test, "p_min_at");
    assert_true(number(at, "x") == 7 && number(at, "y") == 3);
    assert_string_equal(json_string_value(json_object_get(at, "channel")), "blue");
    // 599 of 1 and one of -5.
    assert_true(fabs(number(test, "z_rms") - sqrt((599 + 25) / 600.0)) < 1e-6);
    assert_true(fabs(number(test, "bias") - 594 / 600.0) < 1e-6);
    assert_true(fabs(number(test, "bias_standard_error") - 1 / sqrt(600)) < 1e-12);
    json_decref(root);
    root = run_json(f, "a.pfm b.pfm --variance-b vb.pfm --pass-percent 1", 0);
    assert_true(json_is_null(json_object_get(json_object_get(root, "ztest"), "variance_a")));
    json_decref(root);
    root = run_json(f, "a.pfm b.pfm", 1);
    assert_true(json_is_null(json_object_get(root, "ztest")));
    json_decref(root);
}

// A NaN differs, whatever the test says.
static void test_nan(void **state)
{
    Fixture *f = *state;
    write_pair(f);
    f->floats[0] = NAN;
    write_pfm("b.pfm", f->floats);
    expect_different(f, TEST "--pass-percent 50");
    assert_non_null(strstr(f->out, "NaN: 1 values; allowed none"));
    json_t *root = run_json(f, TEST, 1);
    assert_true(number(json_object_get(root, "ztest"), "p_min") == 0);
    assert_true(json_is_null(json_object_get(json_object_get(root, "ztest"), "z_rms")));
    json_decref(root);
}

static void test_cannot_test(void **state)
{
    Fixture *f = *state;
    write_pair(f);
    expect_trouble(f, "a.pfm b.pfm --significance 0.1", "--significance needs --variance-a or --variance-b");
    expect_trouble(f, "a.pfm b.pfm --pass-percent 1", "--pass-percent needs --variance-a");
    expect_trouble(f, "a.pfm b.pfm --variance-floor 1", "--variance-floor needs --variance-a");
    expect_trouble(f, "a.pfm b.pfm --z-map z.png", "--z-map needs --variance-a");
    expect_trouble(f, TEST "--significance 0", "\"0\" is not between 0 and 1");
    expect_trouble(f, TEST "--significance 1", "\"1\" is not between 0 and 1");
    expect_trouble(f, TEST "--significance nan", "\"nan\" is not a number");
    expect_trouble(f, TEST "--pass-percent -1", "is not a number");
    expect_trouble(f, TEST "--variance-floor x", "is not a number");
    expect_trouble(f, "a.pfm b.pfm --variance-a missing.pfm", "missing.pfm: No such file");
    write_rgb("a.png", f->levels);
    expect_trouble(f, "a.png a.png --variance-a va.pfm", "only PFMs are compared with their variances");
    expect_trouble(f, "a.pfm b.pfm --variance-a a.png", "a.png: variances are a PFM");
    FILE *file = fopen("small.pfm", "wb");
    fputs("Pf\n1 1\n-1\n", file);
    fwrite(&(f32){1}, 4, 1, file);
    fclose(file);
    expect_trouble(f, "a.pfm b.pfm --variance-b small.pfm",
                   "the variances are 1 x 1, the pictures are 20 x 10");
    const f32 bad[3] = {-1, INFINITY, NAN};
    for (int i = 0; i < 3; i++) {
        f->floats[(4 * WIDTH + 2) * 3] = bad[i];
        write_pfm("bad.pfm", f->floats);
        expect_trouble(f, "a.pfm b.pfm --variance-b bad.pfm", "bad.pfm: pixel 2, 4: ");
        // It is not looked at where nothing is compared.
        expect_same(f, "a.pfm b.pfm --variance-b bad.pfm --variance-floor 100 --crop 3,0,17,10");
    }
}

// One variance for all colours of a pixel; and none of colours for a grey picture.
static void test_grey_variances(void **state)
{
    Fixture *f = *state;
    write_pair(f);
    FILE *file = fopen("grey.pfm", "wb");
    fputs("Pf\n20 10\n-1\n", file);
    for (int i = 0; i < WIDTH * HEIGHT; i++)
        fwrite(&(f32){0.75f}, 4, 1, file);
    fclose(file);
    json_t *color = run_json(f, TEST, 1);
    json_t *grey = run_json(f, "a.pfm b.pfm --variance-a grey.pfm --variance-b vb.pfm", 1);
    assert_true(number(json_object_get(color, "ztest"), "z_rms") ==
                number(json_object_get(grey, "ztest"), "z_rms"));
    json_decref(color);
    json_decref(grey);
    expect_same(f, "grey.pfm grey.pfm --variance-a grey.pfm");
    expect_trouble(f, "grey.pfm grey.pfm --variance-a va.pfm", "the variances are of colours");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_verdict, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_json, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_nan, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_cannot_test, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_grey_variances, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
