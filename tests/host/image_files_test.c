// Reading PNG and PFM: every kind of PNG gives the levels that its specification says, broken files give an
// error that names them.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>
#include <png.h>

#include "image/pfm.h"
#include "image/png.h"

typedef struct Folder {
    char path[64];
    char file[128]; // scratch file within
} Folder;

static int set_up(void **state)
{
    Folder *folder = calloc(1, sizeof *folder);
    strcpy(folder->path, "/tmp/clrt-image-XXXXXX");
    if (!mkdtemp(folder->path))
        return -1;
    snprintf(folder->file, sizeof folder->file, "%s/picture", folder->path);
    *state = folder;
    return 0;
}

static int tear_down(void **state)
{
    Folder *folder = *state;
    unlink(folder->file);
    const int result = rmdir(folder->path);
    free(folder);
    return result;
}

static void write_file(const char *path, const void *bytes, size_t length)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

typedef struct PngCase {
    int type, depth;
    bool interlaced, transparent;
    u32 channels, bits; // expected
} PngCase;

enum { WIDTH = 9, HEIGHT = 11 };

// Sample number `channel` of a pixel, of `depth` bits.
static u32 sample(const PngCase *c, u32 x, u32 y, u32 channel)
{
    return (x * 7919 + y * 104729 + channel * 3571 + 17) * 2654435761u >> (32 - c->depth);
}

static u32 stored_channels(int type)
{
    return type == PNG_COLOR_TYPE_RGB          ? 3
           : type == PNG_COLOR_TYPE_RGBA       ? 4
           : type == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                               : 1;
}

static void write_png(const char *path, const PngCase *c, bool linear)
{
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_init_io(png, file);
    png_set_IHDR(png, info, WIDTH, HEIGHT, c->depth, c->type,
                 c->interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (linear)
        png_set_gAMA_fixed(png, info, PNG_FP_1);
    png_color palette[256];
    png_byte alphas[256];
    for (int i = 0; i < 256; i++) {
        palette[i] = (png_color){(png_byte)i, (png_byte)(255 - i), (png_byte)(i * 3)};
        alphas[i] = (png_byte)(i * 5);
    }
    if (c->type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 1 << c->depth);
    if (c->transparent && c->type == PNG_COLOR_TYPE_PALETTE)
        png_set_tRNS(png, info, alphas, 1 << c->depth, NULL);
    png_color_16 key = {.gray = (png_uint_16)sample(c, 0, 0, 0)};
    if (c->transparent && c->type == PNG_COLOR_TYPE_GRAY)
        png_set_tRNS(png, info, NULL, 1, &key);
    png_write_info(png, info);
    if (c->depth < 8)
        png_set_packing(png);
    png_byte rows[HEIGHT][WIDTH * 8];
    png_bytep pointers[HEIGHT];
    const u32 channels = stored_channels(c->type);
    for (u32 y = 0; y < HEIGHT; y++) {
        pointers[y] = rows[y];
        for (u32 i = 0; i < WIDTH * channels; i++) {
            const u32 value = sample(c, i / channels, y, i % channels);
            if (c->depth == 16) {
                rows[y][2 * i] = (png_byte)(value >> 8);
                rows[y][2 * i + 1] = (png_byte)value;
            } else {
                rows[y][i] = (png_byte)value;
            }
        }
    }
    png_write_image(png, pointers);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    assert_int_equal(fclose(file), 0);
}

static u32 expected_value(const PngCase *c, u32 x, u32 y, u32 channel)
{
    const u32 stored = stored_channels(c->type);
    if (c->type == PNG_COLOR_TYPE_PALETTE) {
        const u32 i = sample(c, x, y, 0);
        const u32 entry[] = {i, 255 - i, i * 3 & 255, i * 5 & 255};
        return entry[channel];
    }
    if (channel == stored)
        return sample(c, x, y, 0) == sample(c, 0, 0, 0) ? 0 : c->depth == 16 ? 65535 : 255;
    const u32 value = sample(c, x, y, channel);
    return c->depth < 8 ? value * (255 / ((1u << c->depth) - 1)) : value;
}

static void test_every_kind_of_png(void **state)
{
    const Folder *folder = *state;
    const PngCase cases[] = {
        {PNG_COLOR_TYPE_GRAY, 1, false, false, 1, 8},       {PNG_COLOR_TYPE_GRAY, 2, true, false, 1, 8},
        {PNG_COLOR_TYPE_GRAY, 4, false, true, 2, 8},        {PNG_COLOR_TYPE_GRAY, 8, true, true, 2, 8},
        {PNG_COLOR_TYPE_GRAY, 16, false, false, 1, 16},     {PNG_COLOR_TYPE_GRAY, 16, true, true, 2, 16},
        {PNG_COLOR_TYPE_GRAY_ALPHA, 8, false, false, 2, 8},
        {PNG_COLOR_TYPE_GRAY_ALPHA, 16, true, false, 2, 16},
        {PNG_COLOR_TYPE_RGB, 8, false, false, 3, 8},        {PNG_COLOR_TYPE_RGB, 8, true, false, 3, 8},
        {PNG_COLOR_TYPE_RGB, 16, false, false, 3, 16},      {PNG_COLOR_TYPE_RGBA, 8, true, false, 4, 8},
        {PNG_COLOR_TYPE_RGBA, 16, false, false, 4, 16},     {PNG_COLOR_TYPE_PALETTE, 1, false, false, 3, 8},
        {PNG_COLOR_TYPE_PALETTE, 4, true, false, 3, 8},     {PNG_COLOR_TYPE_PALETTE, 8, false, true, 4, 8},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        const PngCase *c = &cases[i];
        write_png(folder->file, c, i % 2);
        Error error;
        PngInfo info;
        Image *image = png_image_read(folder->file, &info, &error);
        assert_non_null(image);
        assert_int_equal(image->width, WIDTH);
        assert_int_equal(image->height, HEIGHT);
        assert_int_equal(image->channels, c->channels);
        assert_int_equal(info.bits, c->bits);
        assert_int_equal(info.linear, i % 2);
        for (u32 y = 0; y < HEIGHT; y++) {
            for (u32 k = 0; k < WIDTH * c->channels; k++) {
                const u32 expected = expected_value(c, k / c->channels, y, k % c->channels);
                assert_true(image_row(image, y)[k] == (f32)expected);
            }
        }
        image_destroy(image);
    }
}

static void expect_error(const char *path, ErrorCode code, const char *part)
{
    Error error = {.code = ERROR_NONE};
    PngInfo info;
    assert_null(strstr(path, ".pfm") || strcmp(part, "PFM") == 0 ? pfm_image_read(path, &error)
                                                                 : png_image_read(path, &info, &error));
    assert_int_equal(error.code, code);
    assert_non_null(strstr(error.text, path));
    if (strcmp(part, "PFM") != 0)
        assert_non_null(strstr(error.text, part));
}

static void test_broken_png(void **state)
{
    const Folder *folder = *state;
    expect_error("/nonexistent/x.png", ERROR_IO, "No such file");
    expect_error("/tmp", ERROR_IO, "Is a directory");
    write_file(folder->file, "not a picture at all", 20);
    expect_error(folder->file, ERROR_IO, "Not a PNG");
    write_file(folder->file, "", 0);
    expect_error(folder->file, ERROR_IO, "ends too early");

    const PngCase c = {PNG_COLOR_TYPE_RGB, 8, false, false, 3, 8};
    write_png(folder->file, &c, false);
    u8 bytes[4096];
    FILE *file = fopen(folder->file, "rb");
    const size_t length = fread(bytes, 1, sizeof bytes, file);
    fclose(file);
    // Cut anywhere before the end of the pixels, or with a byte of the pixels' chunk changed, it is refused.
    for (size_t cut = 1; cut < length - 12; cut += 7) {
        Error error;
        PngInfo info;
        write_file(folder->file, bytes, cut);
        assert_null(png_image_read(folder->file, &info, &error));
        assert_int_equal(error.code, ERROR_IO);
    }
    for (size_t at = 45; at < length - 12; at += 5) {
        Error error;
        PngInfo info;
        bytes[at] ^= 0x55;
        write_file(folder->file, bytes, length);
        assert_null(png_image_read(folder->file, &info, &error));
        assert_int_equal(error.code, ERROR_IO);
        bytes[at] ^= 0x55;
    }
}

static void test_pfm(void **state)
{
    const Folder *folder = *state;
    Error error;
    // Two rows of one RGB pixel, the bottom one first: 1 2 3, then 4 5 NaN.
    u8 little[] = "PF\n1 2\n-1.0\n" "\0\0\x80\x3f\0\0\0\x40\0\0\x40\x40\0\0\x80\x40\0\0\xa0\x40\0\0\xc0\x7f";
    write_file(folder->file, little, sizeof little - 1);
    Image *image = pfm_image_read(folder->file, &error);
    assert_non_null(image);
    assert_int_equal(image->channels, 3);
    assert_true(image_row(image, 0)[0] == 4 && image_row(image, 0)[1] == 5 && isnan(image_row(image, 0)[2]));
    assert_true(image_row(image, 1)[0] == 1 && image_row(image, 1)[2] == 3);
    image_destroy(image);
    // Grey, the other byte order, other white space, a scale whose size says nothing.
    u8 big[] = "Pf 2\t1\n2.5\n" "\x3f\x80\0\0\xff\x80\0\0";
    write_file(folder->file, big, sizeof big - 1);
    image = pfm_image_read(folder->file, &error);
    assert_non_null(image);
    assert_int_equal(image->channels, 1);
    assert_int_equal(image->width, 2);
    assert_true(image->values[0] == 1 && isinf(image->values[1]) && image->values[1] < 0);
    image_destroy(image);

    write_file(folder->file, big, sizeof big - 2);
    assert_null(pfm_image_read(folder->file, &error));
    assert_non_null(strstr(error.text, "ends too early"));
    write_file(folder->file, big, sizeof big);
    assert_null(pfm_image_read(folder->file, &error));
    assert_non_null(strstr(error.text, "longer"));
}

static void test_broken_pfm(void **state)
{
    const Folder *folder = *state;
    const char *const headers[] = {
        "",           "P6\n1 1\n255\n", "PF\n",          "PF\n1\n",         "PF\n0 1\n-1\n",
        "PF\n-1 1\n-1\n", "PF\n1 x\n-1\n",  "PF\n1 1\n0\n",  "PF\n1 1\nnan\n",  "PF\n1 1\n-1.0",
        "PF\n1 1\n-1z\n", "PF\n4294967296 1\n-1\n", "PF\n1 00000000000000000000000000000000000001\n-1\n",
    };
    for (size_t i = 0; i < sizeof headers / sizeof headers[0]; i++) {
        write_file(folder->file, headers[i], strlen(headers[i]));
        expect_error(folder->file, ERROR_IO, "PFM");
    }
    // More than memory can hold, not more than a header can say.
    const char *huge = "PF\n4294967295 4294967295\n-1\n";
    write_file(folder->file, huge, strlen(huge));
    Error error;
    assert_null(pfm_image_read(folder->file, &error));
    assert_int_equal(error.code, ERROR_MEMORY);
    expect_error("/nonexistent/x.pfm", ERROR_IO, "No such file");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_every_kind_of_png, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_png, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_pfm, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_broken_pfm, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
