// clrt-compare as it is used: which files and options it takes.
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

static void test_kinds_of_png(void **state)
{
    Fixture *f = *state;
    u8 grey[WIDTH * HEIGHT], repeated[VALUES], opaque[WIDTH * HEIGHT * 4];
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        grey[i] = (u8)i;
        for (int c = 0; c < 3; c++)
            repeated[3 * i + c] = opaque[4 * i + c] = (u8)i;
        opaque[4 * i + 3] = 255;
    }
    write_levels("grey.png", grey, PNG_FORMAT_GRAY, WIDTH, HEIGHT);
    write_rgb("rgb.png", repeated);
    write_levels("rgba.png", opaque, PNG_FORMAT_RGBA, WIDTH, HEIGHT);
    expect_same(f, "grey.png rgb.png");
    expect_same(f, "grey.png rgba.png");
    expect_same(f, "rgba.png rgb.png");
    opaque[4 * 25 + 3] = 254;
    write_levels("clear.png", opaque, PNG_FORMAT_RGBA, WIDTH, HEIGHT);
    expect_different(f, "rgb.png clear.png");
    assert_non_null(strstr(f->out, "worst: pixel 5, 1 alpha: 255 and 254"));

    write_output("deep.png", f->floats, &(OutputOptions){.bits = 16});
    write_output("linear.png", f->floats, &(OutputOptions){.bits = 8, .settings.encoding = ENCODING_LINEAR});
    expect_same(f, "deep.png deep.png");
    expect_same(f, "linear.png linear.png");
    expect_trouble(f, "deep.png rgb.png", "is a PNG of 16 bits, rgb.png is a PNG of 8 bits");
    expect_trouble(f, "rgb.png linear.png", "rgb.png has sRGB levels, linear.png has linear ones");
    // One of 65535 levels.
    f->floats[0] = 0.5f;
    write_output("deep.png", f->floats, &(OutputOptions){.bits = 16});
    f->floats[0] = 0.500023f;
    write_output("deeper.png", f->floats, &(OutputOptions){.bits = 16});
    expect_different(f, "deep.png deeper.png");
    expect_same(f, "deep.png deeper.png --fail 1");
}

static void test_cannot_compare(void **state)
{
    Fixture *f = *state;
    write_rgb("a.png", f->levels);
    write_pfm("a.pfm", f->floats);
    write_levels("small.png", f->levels, PNG_FORMAT_RGB, WIDTH - 1, HEIGHT);
    FILE *file = fopen("broken.png", "wb");
    fputs("no picture", file);
    fclose(file);
    expect_trouble(f, "a.png missing.png", "missing.png: No such file or directory");
    expect_trouble(f, "missing.png a.png", "missing.png: No such file or directory");
    expect_trouble(f, "a.png broken.png", "broken.png: Not a PNG file");
    expect_trouble(f, "a.png a.pfm", "a.pfm is a PFM");
    expect_trouble(f, "a.png small.png", "a.png is 20 x 10, small.png is 19 x 10");
    expect_trouble(f, "a.png .", "Is a directory");
    expect_trouble(f, "", "two pictures are needed, not 0");
    expect_trouble(f, "a.png", "two pictures are needed, not 1");
    expect_trouble(f, "a.png a.png a.png", "two pictures are needed, not 3");
    expect_trouble(f, "--fial 1 a.png a.png", "--fial: not an option");
    expect_trouble(f, "a.png a.png --fail", "--fail: an argument is missing");
    expect_trouble(f, "a.png a.png --fail x", "\"x\" is not a number");
    expect_trouble(f, "a.png a.png --fail 1x", "\"1x\" is not a number");
    expect_trouble(f, "a.png a.png --fail ''", "\"\" is not a number");
    expect_trouble(f, "a.png a.png --fail -1", "\"-1\" is not a number");
    expect_trouble(f, "a.png a.png --fail nan", "\"nan\" is not a number");
    expect_trouble(f, "a.png a.png --hard-fail -0.1", "is not a number");
    expect_trouble(f, "a.png a.png --fail-percent %", "is not a number");
    expect_trouble(f, "a.png a.png --fail-ulp 1.5", "is not a whole number");
    expect_trouble(f, "a.png a.png --fail-ulp 4294967296", "is not a whole number");
    expect_trouble(f, "a.png a.png --crop 1,2,3", "is not X,Y,W,H");
    expect_trouble(f, "a.png a.png --crop 1,2,3,4,5", "is not X,Y,W,H");
    expect_trouble(f, "a.png a.png --crop 1,2,0,4", "is not X,Y,W,H");
    expect_trouble(f, "a.png a.png --crop -1,2,3,4", "is not X,Y,W,H");
    expect_trouble(f, "a.png a.png --map missing/map.png", "missing/map.png: No such file");
    expect_trouble(f, "a.png a.png --map map.pfm", "the map is a PNG");
    expect_trouble(f, "a.png a.png --map map.jpg", ".png");
}

static void test_help_and_version(void **state)
{
    Fixture *f = *state;
    expect_same(f, "--help");
    assert_memory_equal(f->out, "usage: clrt-compare [options] A B\n", 33);
    expect_same(f, "-h ignored");
    expect_same(f, "--version");
    assert_string_equal(f->out, "clrt-compare " CLRT_VERSION "\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_kinds_of_png, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_cannot_compare, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_help_and_version, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
