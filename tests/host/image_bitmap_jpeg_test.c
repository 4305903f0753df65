// JPEG as bitmaps: what libjpeg wrote is near what it was given; broken and unwanted files are refused.
#include "image_bitmap_fixture.h"

#ifdef CLRT_JPEG

#include <jpeglib.h>

enum { WIDTH = 45, HEIGHT = 37 };

typedef struct Case {
    J_COLOR_SPACE given, stored;
    int components;
    bool progressive;
} Case;

// Smooth, so that little is lost.
static int sample(u32 x, u32 y, u32 channel)
{
    return channel == 0 ? (int)(20 + x * 4) : channel == 1 ? (int)(30 + y * 5) : (int)(220 - x * 2 - y);
}

static Bytes make_jpeg(const Case *c, int restart)
{
    struct jpeg_compress_struct jpeg;
    struct jpeg_error_mgr errors;
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char *data = NULL;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = WIDTH;
    jpeg.image_height = HEIGHT;
    jpeg.input_components = c->components;
    jpeg.in_color_space = c->given;
    jpeg_set_defaults(&jpeg);
    jpeg_set_colorspace(&jpeg, c->stored);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg.restart_in_rows = restart;
    if (c->progressive)
        jpeg_simple_progression(&jpeg);
    jpeg_start_compress(&jpeg, TRUE);
    for (u32 y = 0; y < HEIGHT; y++) {
        JSAMPLE row[WIDTH * 4];
        for (u32 i = 0; i < WIDTH * (u32)c->components; i++)
            row[i] = (JSAMPLE)sample(i / (u32)c->components, y, i % (u32)c->components);
        JSAMPROW rows[] = {row};
        jpeg_write_scanlines(&jpeg, rows, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    Bytes bytes = bytes_begin();
    bytes_add(&bytes, data, size);
    free(data);
    return bytes;
}

static const Case GREY = {JCS_GRAYSCALE, JCS_GRAYSCALE, 1, false};
static const Case YCC = {JCS_RGB, JCS_YCbCr, 3, false};
static const Case PROGRESSIVE = {JCS_RGB, JCS_YCbCr, 3, true};

static void test_kinds(void **state)
{
    (void)state;
    static const Case RGB = {JCS_RGB, JCS_RGB, 3, false};
    static const Case GREY_PROGRESSIVE = {JCS_GRAYSCALE, JCS_GRAYSCALE, 1, true};
    const Case *cases[] = {&GREY, &YCC, &PROGRESSIVE, &RGB, &GREY_PROGRESSIVE};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Case *c = cases[i];
        Bytes bytes = make_jpeg(c, i % 2);
        Bitmap bitmap = expect_bitmap(&bytes, WIDTH, HEIGHT, (u32)c->components, BITMAP_U8);
        // Chroma at half the resolution may be some levels off where it changes; the others round.
        const int most = c->stored == JCS_YCbCr ? 8 : 1;
        for (u32 y = 0; y < HEIGHT; y++) {
            const u8 *row = bitmap_row(&bitmap, y);
            for (u32 x = 0; x < WIDTH * bitmap.channels; x++) {
                const int off = row[x] - sample(x / bitmap.channels, y, x % bitmap.channels);
                if (abs(off) > most)
                    fail_msg("case %zu: %u %u is %d off", i, x, y, off);
            }
        }
        bitmap_destroy(&bitmap);
        bytes_end(&bytes);
    }
}

static void test_cmyk(void **state)
{
    (void)state;
    static const Case CASES[] = {{JCS_CMYK, JCS_CMYK, 4, false}, {JCS_CMYK, JCS_YCCK, 4, false}};
    for (size_t i = 0; i < 2; i++) {
        Bytes bytes = make_jpeg(&CASES[i], 0);
        expect_refusal(bytes.data, bytes.size, "CMYK");
        bytes_end(&bytes);
    }
}

static void test_broken(void **state)
{
    (void)state;
    const Case *cases[] = {&GREY, &YCC, &PROGRESSIVE};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        Bytes bytes = make_jpeg(cases[i], 1);
        expect_sturdy(&bytes, 3);
        expect_refusal(bytes.data, bytes.size / 2, "the file ends too early");
        bytes_end(&bytes);
    }
}

// The size stands in the frame header: marker, length, precision, height, width.
static void test_sizes(void **state)
{
    (void)state;
    static const struct {
        u8 height[2], width[2];
        const char *reason;
    } SIZES[] = {{{0, 37}, {0, 0}, "mpty"}, {{0, 0}, {0, 45}, ""}, {{0xff, 0xff}, {0xff, 0xff}, ""},
                 {{0xf0, 0}, {0xf0, 0}, "ends too early"}};
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) {
        Bytes bytes = make_jpeg(&GREY, 0);
        size_t at = 2;
        while (bytes.data[at + 1] != 0xc0)
            at += 2 + (size_t)(bytes.data[at + 2] << 8 | bytes.data[at + 3]);
        memcpy(bytes.data + at + 5, SIZES[i].height, 2);
        memcpy(bytes.data + at + 7, SIZES[i].width, 2);
        bytes.size -= 2; // the end of the image
        expect_refusal(bytes.data, bytes.size, SIZES[i].reason);
        bytes_end(&bytes);
    }
}

// Bytes between segments and behind the end are common and harm nothing.
static void test_harmless(void **state)
{
    (void)state;
    Bytes plain = make_jpeg(&YCC, 0), odd = bytes_begin();
    const size_t head = 2 + 2 + (size_t)(plain.data[4] << 8 | plain.data[5]); // start of image, APP0
    bytes_add(&odd, plain.data, head);
    bytes_add_text(&odd, "extraneous");
    bytes_add(&odd, plain.data + head, plain.size - head);
    bytes_add_text(&odd, "behind the end");
    Bitmap first = expect_bitmap(&plain, WIDTH, HEIGHT, 3, BITMAP_U8);
    Bitmap second = expect_bitmap(&odd, WIDTH, HEIGHT, 3, BITMAP_U8);
    assert_memory_equal(first.texels, second.texels, bitmap_bytes(&first));
    bitmap_destroy(&first);
    bitmap_destroy(&second);
    bytes_end(&plain);
    bytes_end(&odd);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds), cmocka_unit_test(test_cmyk),     cmocka_unit_test(test_broken),
        cmocka_unit_test(test_sizes), cmocka_unit_test(test_harmless),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#else

static void test_refused(void **state)
{
    (void)state;
    expect_refusal("\xff\xd8\xff\xe0", 4, "this build reads no JPEG");
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_refused)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

#endif
