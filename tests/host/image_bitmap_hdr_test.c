// Radiance HDR: bytes made by hand against m/256 2^(e-128).
#include "image_bitmap_fixture.h"

#include <dirent.h>
#include <math.h>

#include "image/bitmap_formats.h"

static Bytes hdr(const char *header, const void *data, size_t size)
{
    Bytes bytes = bytes_begin();
    bytes_add_text(&bytes, header);
    bytes_add(&bytes, data, size);
    return bytes;
}

static void assert_texel(const Bitmap *bitmap, u32 x, u32 y, int r, int g, int b, int e)
{
    const int mantissas[] = {r, g, b};
    for (u32 c = 0; c < 3; c++) {
        const f64 right = mantissas[c] / 256.0 * pow(2, e - 128);
        if (bitmap_value(bitmap, x, y, c) != right)
            fail_msg("texel %u %u has %g and not %g", x, y, bitmap_value(bitmap, x, y, c), right);
    }
}

static void test_values(void **state)
{
    (void)state;
    // The largest, the smallest, and e = 0, which is denormal.
    Bytes bytes = hdr("#?RGBE\n\n-Y 1 +X 4\n",
                      "\xff\x80\x01\xff" "\x01\x00\x02\x01" "\xff\x01\x00\x00" "\x00\x00\x00\x00", 16);
    Bitmap bitmap = expect_bitmap(&bytes, 4, 1, 3, BITMAP_FLOAT);
    assert_texel(&bitmap, 0, 0, 255, 128, 1, 255);
    assert_texel(&bitmap, 1, 0, 1, 0, 2, 1);
    assert_texel(&bitmap, 2, 0, 255, 1, 0, 0);
    assert_texel(&bitmap, 3, 0, 0, 0, 0, 0);
    assert_int_equal(bitmap_repair(&bitmap), 0);
    bitmap_destroy(&bitmap);
    bytes_end(&bytes);
}

// What else a header may hold changes nothing, and lines may end as on other systems.
static void test_headers(void **state)
{
    (void)state;
    static const char *const HEADERS[] = {
        "#?RADIANCE\n# made by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=8\nGAMMA=2\nVIEW=-vtv\n"
        "PRIMARIES=0.6 0.3 0.3 0.6 0.1 0.1 0.3 0.3\nCOLORCORR=1 2 3\n\n-Y 1 +X 1\n",
        "#?RADIANCE\r\nFORMAT=32-bit_rle_rgbe\r\n\r\n-Y 1 +X 1\r\n",
        "#?\n\n-Y  1  +X  1 \n",
    };
    for (size_t i = 0; i < sizeof HEADERS / sizeof *HEADERS; i++) {
        Bytes bytes = hdr(HEADERS[i], "\x80\x40\x20\x82" "what follows is not looked at", 20);
        Bitmap bitmap = expect_bitmap(&bytes, 1, 1, 3, BITMAP_FLOAT);
        assert_texel(&bitmap, 0, 0, 128, 64, 32, 130);
        bitmap_destroy(&bitmap);
        bytes_end(&bytes);
    }
}

// Six pixels, numbered as they are in the file, go where the axes say.
static void test_walks(void **state)
{
    (void)state;
    static const struct {
        const char *size;
        u32 width, height;
        int right[6]; // of the texels from the top left, row by row
    } CASES[] = {
        {"-Y 2 +X 3", 3, 2, {1, 2, 3, 4, 5, 6}}, {"-Y 2 -X 3", 3, 2, {3, 2, 1, 6, 5, 4}},
        {"+Y 2 +X 3", 3, 2, {4, 5, 6, 1, 2, 3}}, {"+Y 2 -X 3", 3, 2, {6, 5, 4, 3, 2, 1}},
        {"+X 2 -Y 3", 2, 3, {1, 4, 2, 5, 3, 6}}, {"+X 2 +Y 3", 2, 3, {3, 6, 2, 5, 1, 4}},
        {"-X 2 -Y 3", 2, 3, {4, 1, 5, 2, 6, 3}}, {"-X 2 +Y 3", 2, 3, {6, 3, 5, 2, 4, 1}},
    };
    u8 pixels[6][4];
    for (u8 i = 0; i < 6; i++)
        memcpy(pixels[i], (u8[]){(u8)(i + 1), 0, 0, 136}, 4);
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        char header[64];
        snprintf(header, sizeof header, "#?RADIANCE\n\n%s\n", CASES[i].size);
        Bytes bytes = hdr(header, pixels, sizeof pixels);
        Bitmap bitmap = expect_bitmap(&bytes, CASES[i].width, CASES[i].height, 3, BITMAP_FLOAT);
        for (u32 k = 0; k < 6; k++)
            assert_true(bitmap_value(&bitmap, k % bitmap.width, k / bitmap.width, 0) == CASES[i].right[k]);
        bitmap_destroy(&bitmap);
        bytes_end(&bytes);
    }
}

// Runs by component, with the code 128, which is no run; and a flat scanline that begins like none.
static void test_new_runs(void **state)
{
    (void)state;
    enum { WIDTH = 300 };
    Bytes bytes = hdr("#?RADIANCE\n\n-Y 2 +X 300\n", "\x02\x02\x01\x2c", 4);
    u8 ramp[128];
    for (int i = 0; i < 128; i++)
        ramp[i] = (u8)(i + 60);
    bytes_add(&bytes, "\xff\x11\xff\x22\xae\x33", 6);     // 127 of 0x11, 127 of 0x22, 46 of 0x33
    bytes_add(&bytes, "\x80", 1);                         // 128 as they are
    bytes_add(&bytes, ramp, 128);
    bytes_add(&bytes, "\xff\x05\xad\x06", 4);             // 127 and 45
    bytes_add(&bytes, "\xff\x07\xff\x07\x81\x08\xad\x07", 8); // 127, 127, 1, 45
    bytes_add(&bytes, "\xff\x80\xff\x81\xae\x82", 6);
    for (int x = 0; x < WIDTH; x++)
        bytes_add(&bytes, (u8[]){2, 2, 200, (u8)(100 + x % 50)}, 4);
    Bitmap bitmap = expect_bitmap(&bytes, WIDTH, 2, 3, BITMAP_FLOAT);
    for (int x = 0; x < WIDTH; x++) {
        assert_texel(&bitmap, (u32)x, 0, x < 127 ? 0x11 : x < 254 ? 0x22 : 0x33,
                     x < 128 ? x + 60 : x < 255 ? 5 : 6, x == 254 ? 8 : 7,
                     x < 127 ? 128 : x < 254 ? 129 : 130);
        assert_texel(&bitmap, (u32)x, 1, 2, 2, 200, 100 + x % 50);
    }
    bitmap_destroy(&bitmap);
    expect_sturdy(&bytes, 1);
    bytes_end(&bytes);
}

// Runs of whole pixels, one of 2 + 1 * 256.
static void test_old_runs(void **state)
{
    (void)state;
    Bytes bytes = hdr("#?RADIANCE\n\n-Y 1 +X 262\n",
                      "\x80\x40\x20\x80" "\x01\x01\x01\x02" "\x01\x01\x01\x01"
                      "\x10\x20\x40\x81" "\x01\x01\x01\x01" "\x50\x60\x70\x82", 24);
    Bitmap bitmap = expect_bitmap(&bytes, 262, 1, 3, BITMAP_FLOAT);
    for (u32 x = 0; x < 259; x++)
        assert_texel(&bitmap, x, 0, 128, 64, 32, 128);
    assert_texel(&bitmap, 259, 0, 16, 32, 64, 129);
    assert_texel(&bitmap, 260, 0, 16, 32, 64, 129);
    assert_texel(&bitmap, 261, 0, 80, 96, 112, 130);
    bitmap_destroy(&bitmap);
    expect_sturdy(&bytes, 1);
    bytes_end(&bytes);
}

static void test_refusals(void **state)
{
    (void)state;
    static const struct {
        const char *text, *reason;
    } CASES[] = {
        {"#?RADIANCE", "ends too early"},
        {"#?RADIANCE\n\n", "ends too early"},
        {"#?RADIANCE\n\n-Y 1 +X 1\n", "ends too early"},
        {"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n....", "32-bit_rle_rgbe"},
        {"#?RADIANCE\n\n-Y 0 +X 1\n", "size of 1 x 0"},
        {"#?RADIANCE\n\n-Y 1 +X 0\n", "size of 0 x 1"},
        {"#?RADIANCE\n\n-Y 1 +X 20000000\n", "a side may have"},
        {"#?RADIANCE\n\n-Y 16000000 +X 16000000\n", "no memory for 16000000 x 16000000"},
        {"#?RADIANCE\n\n-Y 1 +X 4294967296\n", "its size"},
        {"#?RADIANCE\n\n-Y 1 +Y 1\n", "its size"},
        {"#?RADIANCE\n\n-Y 1\n", "its size"},
        {"#?RADIANCE\n\n-Y -1 +X 1\n", "its size"},
        {"#?RADIANCE\n\n-Y 1 +X 1x\n", "its size"},
        {"#?RADIANCE\n\n-Y 1 +X 1 +X 1\n", "its size"},
        {"#?RADIANCE\n\nY 1 X 1\n", "its size"},
        {"#?RADIANCE\n\n-Y 1 +X 8\n\2\2\1\1", "another length"},
        {"#?RADIANCE\n\n-Y 1 +X 1\n\1\1\1\1", "does not fit"},
        {"#?RADIANCE\n\n-Y 1 +X 3\nabcd\1\1\1\3", "does not fit"},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++)
        expect_refusal(CASES[i].text, strlen(CASES[i].text), CASES[i].reason);
    static const char HEAD[] = "#?RADIANCE\n\n-Y 1 +X 8\n\2\2\0\10";
    static const char *const RUNS[] = {"\x89z", "\x09zzzzzzzzz", "\x85z\x84z"};
    for (size_t i = 0; i < sizeof RUNS / sizeof *RUNS; i++) {
        Bytes bytes = hdr("", HEAD, sizeof HEAD - 1);
        bytes_add_text(&bytes, RUNS[i]);
        expect_refusal(bytes.data, bytes.size, "does not fit");
        bytes_end(&bytes);
    }
    Bytes nothing = hdr("", HEAD, sizeof HEAD - 1);
    bytes_add(&nothing, "\0\0", 2);
    expect_refusal(nothing.data, nothing.size, "does not fit");
    bytes_end(&nothing);
}

// Widths at which the new way begins and ends, flat.
static void test_widths(void **state)
{
    (void)state;
    static const u32 WIDTHS[] = {7, 8, 32767, 32768, 40000};
    for (size_t i = 0; i < sizeof WIDTHS / sizeof *WIDTHS; i++) {
        const u32 width = WIDTHS[i];
        char header[64];
        snprintf(header, sizeof header, "#?RADIANCE\n\n-Y 1 +X %u\n", width);
        Bytes bytes = hdr(header, NULL, 0);
        const bool flat = width < 8 || width > 32767; // begins with 2 2 all the same
        for (u32 x = 0; x < width; x++)
            bytes_add(&bytes, (u8[]){flat ? 2 : 3, 2, 9, 136}, 4);
        Bitmap bitmap = expect_bitmap(&bytes, width, 1, 3, BITMAP_FLOAT);
        assert_texel(&bitmap, width - 1, 0, flat ? 2 : 3, 2, 9, 136);
        bitmap_destroy(&bitmap);
        bytes_end(&bytes);
    }
}

static void test_crashers(void **state)
{
    (void)state;
    DIR *directory = opendir(CLRT_TESTS "/crashers");
    assert_non_null(directory);
    u32 count = 0;
    for (const struct dirent *entry; (entry = readdir(directory));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".hdr") != 0)
            continue;
        char path[1000];
        snprintf(path, sizeof path, CLRT_TESTS "/crashers/%s", entry->d_name);
        Bitmap bitmap;
        Error error;
        if (bitmap_read(path, &bitmap, &error))
            fail_msg("%s gives a picture", path);
        assert_int_not_equal(error.code, ERROR_IO);
        count++;
    }
    closedir(directory);
    assert_true(count >= 9);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_values),   cmocka_unit_test(test_headers),  cmocka_unit_test(test_walks),
        cmocka_unit_test(test_new_runs), cmocka_unit_test(test_old_runs), cmocka_unit_test(test_refusals),
        cmocka_unit_test(test_widths),   cmocka_unit_test(test_crashers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
