// Float pictures: what is written as EXR is read back the same, as HDR within the format's precision; texts
// stand in the headers; a picture that is given up leaves nothing.
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "image/bitmap.h"
#include "output/hdr_stream.h"
#include "output/output.h"

static const OutputText TEXTS[] = {
    {"Software", "clrt 1.2"},
    {"a key of more than thirty-one letters", "caf\xc3\xa9\nline 2"},
    {"Empty", ""},
};

typedef struct Picture {
    u32 width, height;
    f32 *rows;
} Picture;

// Radiance over many magnitudes with equal pixels here and there.
static Picture make_picture(u32 width, u32 height)
{
    const size_t count = (size_t)width * height * 3;
    Picture picture = {width, height, calloc(count, sizeof(f32))};
    assert_non_null(picture.rows);
    for (size_t i = 0; i < count; i++) {
        const u32 hash = (u32)(i / 3 % 16 < 9 ? i / 48 : i) * 2654435761u;
        picture.rows[i] = hash >> 24 == 0 ? 0 : ldexpf((f32)(hash >> 16), (int)(hash >> 7 & 63) - 40);
    }
    return picture;
}

static bool write_picture(const Picture *picture, const char *path, bool whole, Error *error)
{
    const OutputOptions options = {.bits = 8, .texts = TEXTS, .text_count = 3};
    Output *output = output_open(path, &options, picture->width, picture->height, error);
    if (!output)
        return false;
    const size_t row = (size_t)picture->width * 3;
    for (u32 y = 0, count = 1; y < picture->height; y += count, count = count % 7 + 1) {
        count = count < picture->height - y ? count : picture->height - y;
        if (!output_write_rows(output, picture->rows + y * row, count, error) || (!whole && y > 0)) {
            output_abort(output);
            return false;
        }
    }
    return output_commit(output, error);
}

static Bitmap read_back(const Picture *picture, const char *path)
{
    Error error;
    Bitmap bitmap;
    if (!write_picture(picture, path, true, &error) || !bitmap_read(path, &bitmap, &error))
        fail_msg("%s", error.text);
    assert_int_equal(bitmap.width, picture->width);
    assert_int_equal(bitmap.height, picture->height);
    assert_int_equal(bitmap.channels, 3);
    assert_int_equal(bitmap.type, BITMAP_FLOAT);
    return bitmap;
}

static bool file_has(const char *path, const char *bytes, size_t length)
{
    static u8 content[1 << 16];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(content, 1, sizeof content, file);
    fclose(file);
    for (size_t i = 0; i + length <= size; i++) {
        if (memcmp(content + i, bytes, length) == 0)
            return true;
    }
    return false;
}

static const u32 SIZES[][2] = {{1, 1}, {7, 3}, {8, 16}, {45, 53}, {300, 17}, {32767, 2}, {32768, 2}};

static void test_exr(void **state)
{
    (void)state;
#ifdef CLRT_EXR
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) {
        Picture picture = make_picture(SIZES[i][0], SIZES[i][1]);
        picture.rows[0] = NAN;
        picture.rows[1] = -INFINITY;
        Bitmap bitmap = read_back(&picture, "a.exr");
        assert_memory_equal(bitmap.texels, picture.rows, bitmap_bytes(&bitmap));
        bitmap_destroy(&bitmap);
        free(picture.rows);
    }
    assert_true(file_has("a.exr", "Software\0string\0\x08\0\0\0clrt 1.2", 28));
    static const char LONG[] = "a key of more than thirty-one letters\0string\0"
                               "\x0c\0\0\0caf\xc3\xa9\nline 2";
    assert_true(file_has("a.exr", LONG, sizeof LONG - 1));
    unlink("a.exr");
#else
    Error error;
    const Picture picture = make_picture(1, 1);
    assert_false(write_picture(&picture, "a.exr", true, &error));
    assert_int_equal(error.code, ERROR_USAGE);
    assert_non_null(strstr(error.text, "this build writes no OpenEXR"));
    assert_int_not_equal(access("a.exr", F_OK), 0);
    free(picture.rows);
#endif
}

static void test_hdr(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) {
        Picture picture = make_picture(SIZES[i][0], SIZES[i][1]);
        Bitmap bitmap = read_back(&picture, "a.hdr");
        const f32 *values = bitmap.texels;
        for (size_t k = 0; k < (size_t)picture.width * picture.height * 3; k++) {
            const f32 *pixel = picture.rows + k / 3 * 3;
            const f32 largest = fmaxf(pixel[0], fmaxf(pixel[1], pixel[2]));
            if (!(fabsf(values[k] - picture.rows[k]) <= largest / 256))
                fail_msg("%zu: %g is %g", k, (f64)picture.rows[k], (f64)values[k]);
        }
        bitmap_destroy(&bitmap);
        free(picture.rows);
    }
    static const char HEADER[] = "#?RADIANCE\nSoftware=clrt 1.2\n"
                                 "a key of more than thirty-one letters=caf\xc3\xa9 line 2\nEmpty=\n"
                                 "FORMAT=32-bit_rle_rgbe\n\n-Y 2 +X 32768\n";
    assert_true(file_has("a.hdr", HEADER, sizeof HEADER - 1));
    unlink("a.hdr");
}

// Runs in what is even: much smaller than flat.
static void test_hdr_runs(void **state)
{
    (void)state;
    Picture picture = make_picture(1000, 100);
    for (size_t i = 0; i < 300000; i++)
        picture.rows[i] = (f32)(i % 3 + 1);
    Bitmap bitmap = read_back(&picture, "a.hdr");
    assert_memory_equal(bitmap.texels, picture.rows, bitmap_bytes(&bitmap));
    bitmap_destroy(&bitmap);
    FILE *file = fopen("a.hdr", "rb");
    assert_non_null(file);
    fseek(file, 0, SEEK_END);
    assert_in_range(ftell(file), 100, 100 * (4 + 4 * 16) + 200);
    fclose(file);
    free(picture.rows);
    unlink("a.hdr");
}

static void expect_rgbe(f32 r, f32 g, f32 b, int mr, int mg, int mb, int e)
{
    u8 rgbe[4];
    hdr_encode((const f32[]){r, g, b}, rgbe);
    assert_int_equal(rgbe[0], mr);
    assert_int_equal(rgbe[1], mg);
    assert_int_equal(rgbe[2], mb);
    assert_int_equal(rgbe[3], e);
}

static void test_hdr_pixels(void **state)
{
    (void)state;
    expect_rgbe(1, 0.5f, 0.25f, 128, 64, 32, 129);
    expect_rgbe(0, 0, 0, 0, 0, 0, 0);
    expect_rgbe(NAN, -1, 2, 0, 0, 128, 130);
    expect_rgbe(NAN, -INFINITY, -0.0f, 0, 0, 0, 0);
    expect_rgbe(0.999f, 0, 0, 128, 0, 0, 129);            // 255.7 of 256
    expect_rgbe(255.49f / 256, 0.5f, 0, 255, 128, 0, 128);
    expect_rgbe(INFINITY, FLT_MAX, 0x1p126f, 255, 255, 128, 255);
    expect_rgbe(0x1p-128f, 0x1p-129f, 0, 128, 64, 0, 1);
    expect_rgbe(0x0.fcp-128f, 0, 0, 0, 0, 0, 0);
    expect_rgbe(0x0.ffep-128f, 0, 0, 128, 0, 0, 1); // rounds up to what there is
}

static void test_abort(void **state)
{
    (void)state;
    const Picture picture = make_picture(45, 53);
    static const char *const NAMES[] = {"b.hdr", "b.exr"};
    for (int i = 0; i < 2; i++) {
        Error error;
        assert_false(write_picture(&picture, NAMES[i], false, &error));
        assert_int_not_equal(access(NAMES[i], F_OK), 0);
    }
    free(picture.rows);
}

#ifdef CLRT_EXR
// A full disk at any point.
static void test_full(void **state)
{
    (void)state;
    if (access("/dev/full", W_OK) != 0)
        skip();
    const Picture picture = make_picture(300, 400);
    assert_int_equal(symlink("/dev/full", "full.hdr"), 0);
    Error error;
    assert_false(write_picture(&picture, "full.hdr", true, &error));
    assert_int_equal(error.code, ERROR_IO);
    unlink("full.hdr");
    assert_int_equal(symlink("/dev/full", "full.exr"), 0);
    assert_false(write_picture(&picture, "full.exr", true, &error));
    assert_int_equal(error.code, ERROR_IO);
    unlink("full.exr");
    free(picture.rows);
}

// A key that the format has for something else.
static void test_key(void **state)
{
    (void)state;
    const OutputText text = {"channels", "a"};
    const OutputOptions options = {.bits = 8, .texts = &text, .text_count = 1};
    Error error;
    assert_null(output_open("c.exr", &options, 4, 4, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_int_not_equal(access("c.exr", F_OK), 0);
}
#endif

static char folder[] = "/tmp/clrt-float-XXXXXX";

static int enter(void **state)
{
    (void)state;
    return mkdtemp(folder) && chdir(folder) == 0 ? 0 : -1;
}

static int leave(void **state)
{
    (void)state;
    return rmdir(folder);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exr),        cmocka_unit_test(test_hdr),   cmocka_unit_test(test_hdr_runs),
        cmocka_unit_test(test_hdr_pixels), cmocka_unit_test(test_abort),
#ifdef CLRT_EXR
        cmocka_unit_test(test_full),       cmocka_unit_test(test_key),
#endif
    };
    return cmocka_run_group_tests(tests, enter, leave);
}
