// clrt-compare as it is used: files in, report, exit status and map out.
#define _XOPEN_SOURCE 700

#include <dirent.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>
#include <png.h>

#include "output/output.h"

enum { WIDTH = 20, HEIGHT = 10, VALUES = WIDTH * HEIGHT * 3, TEXT_BYTES = 8192 };

typedef struct Fixture {
    char folder[64];
    u8 levels[VALUES];
    f32 floats[VALUES];
    char out[TEXT_BYTES], err[TEXT_BYTES]; // of the last run
} Fixture;

static int set_up(void **state)
{
    Fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/clrt-compare-XXXXXX");
    if (!mkdtemp(f->folder) || chdir(f->folder) != 0)
        return -1;
    for (int i = 0; i < VALUES; i++) {
        f->levels[i] = (u8)(i % 200 + 20);
        f->floats[i] = (f32)(i + 1) / 100;
    }
    *state = f;
    return 0;
}

static int tear_down(void **state)
{
    Fixture *f = *state;
    DIR *folder = opendir(f->folder);
    for (const struct dirent *entry = readdir(folder); entry; entry = readdir(folder)) {
        if (entry->d_name[0] != '.')
            unlink(entry->d_name);
    }
    closedir(folder);
    const int result = chdir("/") || rmdir(f->folder);
    free(f);
    return result;
}

static void write_levels(const char *name, const void *levels, u32 format, u32 width, u32 height)
{
    png_image image = {.version = PNG_IMAGE_VERSION, .width = width, .height = height, .format = format};
    assert_true(png_image_write_to_file(&image, name, 0, levels, 0, NULL));
}

static void write_rgb(const char *name, const u8 *levels)
{
    write_levels(name, levels, PNG_FORMAT_RGB, WIDTH, HEIGHT);
}

static void write_output(const char *name, const f32 *rows, const OutputOptions *options)
{
    Error error;
    Output *output = output_open(name, options, WIDTH, HEIGHT, &error);
    assert_non_null(output);
    assert_true(output_write_rows(output, rows, HEIGHT, &error));
    assert_true(output_commit(output, &error));
}

static void write_pfm(const char *name, const f32 *rows)
{
    write_output(name, rows, &(OutputOptions){.bits = 8});
}

static void read_text(const char *name, char text[TEXT_BYTES])
{
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    const size_t length = fread(text, 1, TEXT_BYTES - 1, file);
    text[length] = 0;
    fclose(file);
}

// Runs the program with these arguments as a shell reads them; gives its exit status.
static int run(Fixture *f, const char *arguments)
{
    char command[1024];
    snprintf(command, sizeof command, "\"%s\" %s >out.txt 2>err.txt", CLRT_COMPARE, arguments);
    const int status = system(command);
    assert_true(WIFEXITED(status));
    read_text("out.txt", f->out);
    read_text("err.txt", f->err);
    return WEXITSTATUS(status);
}

static void expect_same(Fixture *f, const char *arguments)
{
    if (run(f, arguments) != 0)
        fail_msg("clrt-compare %s: not the same\n%s%s", arguments, f->out, f->err);
    assert_string_equal(f->err, "");
}

static void expect_different(Fixture *f, const char *arguments)
{
    if (run(f, arguments) != 1)
        fail_msg("clrt-compare %s: not different\n%s%s", arguments, f->out, f->err);
    assert_string_equal(f->err, "");
}

static void expect_trouble(Fixture *f, const char *arguments, const char *says)
{
    if (run(f, arguments) != 2 || !strstr(f->err, says))
        fail_msg("clrt-compare %s: expected \"%s\"\n%s%s", arguments, says, f->out, f->err);
    assert_string_equal(f->out, "");
}

static json_t *run_json(Fixture *f, const char *arguments, int status)
{
    char all[512];
    snprintf(all, sizeof all, "--json %s", arguments);
    assert_int_equal(run(f, all), status);
    json_error_t error;
    json_t *root = json_loads(f->out, JSON_REJECT_DUPLICATES, &error);
    assert_non_null(root);
    assert_string_equal(json_string_value(json_object_get(root, "schema")), "clrt-compare/1");
    return root;
}

static f64 number(const json_t *root, const char *key)
{
    const json_t *value = json_object_get(root, key);
    if (!json_is_number(value))
        fail_msg("%s is not a number", key);
    return json_number_value(value);
}

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
    assert_true(fabs(number(root, "psnr_db") - 20 * log10(255 / rmse)) < 1e-12);
    assert_true(number(root, "flip_mean") > 0 && number(root, "flip_mean") < 0.2);
    assert_true(json_is_null(json_object_get(root, "max_ulp")));
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
    assert_string_equal(json_string_value(json_object_get(json_object_get(root, "worst"), "b")), "nan");
    json_decref(root);
}

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

static void read_map(u8 **pixels, u32 *width, u32 *height)
{
    png_image image = {.version = PNG_IMAGE_VERSION};
    assert_true(png_image_begin_read_from_file(&image, "map.png"));
    image.format = PNG_FORMAT_RGB;
    *pixels = malloc(PNG_IMAGE_SIZE(image));
    assert_non_null(*pixels);
    assert_true(png_image_finish_read(&image, NULL, *pixels, 0, NULL));
    *width = image.width;
    *height = image.height;
}

static u32 brightness(const u8 *rgb)
{
    return (u32)rgb[0] + rgb[1] + rgb[2];
}

static void test_map(void **state)
{
    Fixture *f = *state;
    write_pfm("a.pfm", f->floats);
    f->floats[0] += 0.001f;
    f->floats[3] += 1;
    f->floats[6] = NAN;
    write_pfm("b.pfm", f->floats);
    u8 mask[WIDTH * HEIGHT] = {0};
    mask[3] = 255;
    write_levels("mask.png", mask, PNG_FORMAT_GRAY, WIDTH, HEIGHT);
    expect_different(f, "a.pfm b.pfm --map map.png --mask mask.png");
    u8 *pixels;
    u32 width, height;
    read_map(&pixels, &width, &height);
    assert_true(width > WIDTH && height > HEIGHT); // room for the legend
    const u8 cyan[3] = {0, 255, 255};
    assert_true(brightness(pixels) > 0 && brightness(pixels) < brightness(pixels + 3));
    assert_memory_equal(pixels + 6, cyan, 3);
    assert_true(brightness(pixels + 9) > 0 && pixels[9] == pixels[10] && pixels[10] == pixels[11]);
    assert_int_equal(brightness(pixels + 12), 0);
    // The legend: its bar gets brighter from end to end.
    u32 steps = 0, before = 0;
    const u8 *bar = pixels + ((size_t)(HEIGHT + 10) * width) * 3;
    for (u32 x = 40; x < 250; x++) {
        steps += brightness(bar + (size_t)x * 3) >= before;
        before = brightness(bar + (size_t)x * 3);
    }
    assert_true(steps > 200);
    free(pixels);
    // A map is drawn for the same pictures, too; a failed one leaves the old.
    expect_same(f, "a.pfm a.pfm --map map.png");
    read_map(&pixels, &width, &height);
    for (u32 x = 0; x < WIDTH; x++)
        assert_int_equal(brightness(pixels + (size_t)x * 3), 0);
    free(pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_limits, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_figures, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_crop_and_mask, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_floats, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_nan_is_never_the_same, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_kinds_of_png, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_cannot_compare, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_help_and_version, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_map, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
