// PNG as bitmaps: every colour type and depth, plain and interlaced, with and without transparency, against
// the levels that its specification says.
#include "image_bitmap_fixture.h"

#include <png.h>

enum { WIDTH = 19, HEIGHT = 11 };

typedef struct Case {
    int type, depth;
    bool interlaced, transparent;
    u32 channels;
} Case;

static u32 sample(const Case *c, u32 x, u32 y, u32 channel)
{
    return (x * 7919 + y * 104729 + channel * 3571 + 17) * 2654435761u >> (32 - c->depth);
}

static const png_byte SHADES[3][4] = {{11, 17, 250, 0}, {90, 255, 3, 7}, {1, 200, 100, 50}};

// A palette of 2^depth entries, told by their index.
static png_color palette_color(u32 i)
{
    return (png_color){(png_byte)(SHADES[0][i % 4] ^ i), (png_byte)(SHADES[1][i % 4] ^ i),
                       (png_byte)(SHADES[2][i % 4] ^ i)};
}

static u32 stored_channels(int type)
{
    return type == PNG_COLOR_TYPE_RGB          ? 3
           : type == PNG_COLOR_TYPE_RGBA       ? 4
           : type == PNG_COLOR_TYPE_GRAY_ALPHA ? 2
                                               : 1;
}

static void on_write(png_structp png, png_bytep data, size_t size)
{
    bytes_add(png_get_io_ptr(png), data, size);
}

static void set_transparency(png_structp png, png_infop info, const Case *c)
{
    png_byte alphas[256];
    for (u32 i = 0; i < 256; i++)
        alphas[i] = (png_byte)(i * 5);
    png_color_16 key = {.gray = (png_uint_16)sample(c, 0, 0, 0), .red = (png_uint_16)sample(c, 0, 0, 0),
                        .green = (png_uint_16)sample(c, 0, 0, 1), .blue = (png_uint_16)sample(c, 0, 0, 2)};
    if (c->type == PNG_COLOR_TYPE_PALETTE)
        png_set_tRNS(png, info, alphas, 1 << c->depth, NULL);
    else
        png_set_tRNS(png, info, NULL, 1, &key);
}

static void write_rows(png_structp png, const Case *c)
{
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
}

// gamma: a gAMA chunk that would change levels if it were obeyed.
static Bytes make_png(const Case *c, bool gamma)
{
    Bytes bytes = bytes_begin();
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, on_write, NULL);
    png_set_IHDR(png, info, WIDTH, HEIGHT, c->depth, c->type,
                 c->interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (gamma)
        png_set_gAMA_fixed(png, info, PNG_FP_1);
    png_color palette[256];
    for (u32 i = 0; i < 256; i++)
        palette[i] = palette_color(i);
    if (c->type == PNG_COLOR_TYPE_PALETTE)
        png_set_PLTE(png, info, palette, 1 << c->depth);
    if (c->transparent)
        set_transparency(png, info, c);
    png_write_info(png, info);
    if (c->depth < 8)
        png_set_packing(png);
    write_rows(png, c);
    png_write_end(png, info);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

static u32 expected(const Case *c, u32 x, u32 y, u32 channel)
{
    const u32 value = sample(c, x, y, c->type == PNG_COLOR_TYPE_PALETTE ? 0 : channel);
    if (c->type == PNG_COLOR_TYPE_PALETTE) {
        const png_color color = palette_color(value);
        return channel == 0 ? color.red : channel == 1 ? color.green : color.blue;
    }
    return c->depth < 8 ? value * 255 / ((1u << c->depth) - 1) : value;
}

static void check(const Case *c, bool gamma)
{
    Bytes bytes = make_png(c, gamma);
    const BitmapType type = c->depth == 16 ? BITMAP_U16 : BITMAP_U8;
    Bitmap bitmap = expect_bitmap(&bytes, WIDTH, HEIGHT, c->channels, type);
    for (u32 y = 0; y < HEIGHT; y++) {
        for (u32 x = 0; x < WIDTH; x++) {
            for (u32 k = 0; k < c->channels; k++) {
                const size_t i = (size_t)x * c->channels + k;
                const void *row = bitmap_row(&bitmap, y);
                const u32 level = c->depth == 16 ? ((const u16 *)row)[i] : ((const u8 *)row)[i];
                if (level != expected(c, x, y, k))
                    fail_msg("type %d depth %d: %u %u %u is %u", c->type, c->depth, x, y, k, level);
            }
        }
    }
    bitmap_destroy(&bitmap);
    bytes_end(&bytes);
}

static void test_kinds(void **state)
{
    (void)state;
    static const struct {
        int type, depths[6];
        bool may_be_transparent;
        u32 channels;
    } KINDS[] = {
        {PNG_COLOR_TYPE_GRAY, {1, 2, 4, 8, 16, 0}, true, 1},
        {PNG_COLOR_TYPE_GRAY_ALPHA, {8, 16, 0}, false, 1},
        {PNG_COLOR_TYPE_PALETTE, {1, 2, 4, 8, 0}, true, 3},
        {PNG_COLOR_TYPE_RGB, {8, 16, 0}, true, 3},
        {PNG_COLOR_TYPE_RGBA, {8, 16, 0}, false, 3},
    };
    u32 count = 0;
    for (size_t k = 0; k < sizeof KINDS / sizeof *KINDS; k++) {
        for (u32 bits = 0; bits < 8; bits++) {
            for (const int *depth = KINDS[k].depths; *depth; depth++) {
                const Case c = {KINDS[k].type, *depth, bits & 1, bits & 2, KINDS[k].channels};
                if (c.transparent && !KINDS[k].may_be_transparent)
                    continue;
                check(&c, bits & 4);
                count++;
            }
        }
    }
    assert_int_equal(count, 4 * 4 + 8 * 11);
}

static void test_broken(void **state)
{
    (void)state;
    for (u32 i = 0; i < 4; i++) {
        const Case c = {i & 1 ? PNG_COLOR_TYPE_PALETTE : PNG_COLOR_TYPE_RGB, 8, i & 2, i & 1, 3};
        Bytes bytes = make_png(&c, false);
        expect_sturdy(&bytes, 1);
        expect_refusal(bytes.data, bytes.size / 2, "the file ends too early");
        bytes.data[bytes.size / 2] ^= 0xff;
        expect_refusal(bytes.data, bytes.size, "");
        bytes_end(&bytes);
    }
}

// Sizes in the header of a file that is otherwise whole.
static void test_sizes(void **state)
{
    (void)state;
    static const struct {
        u32 width, height;
    } SIZES[] = {{0, 1}, {1, 0}, {1u << 31, 1}, {UINT32_MAX, UINT32_MAX}, {16000000, 16000000},
                 {20000000, 1}};
    const Case c = {PNG_COLOR_TYPE_RGBA, 16, false, false, 3};
    for (size_t i = 0; i < sizeof SIZES / sizeof *SIZES; i++) {
        Bytes bytes = make_png(&c, false);
        png_save_uint_32(bytes.data + 16, SIZES[i].width);
        png_save_uint_32(bytes.data + 20, SIZES[i].height);
        u32 crc = UINT32_MAX; // of the chunk's name and data, ISO 3309
        for (size_t k = 12; k < 29; k++) {
            crc ^= bytes.data[k];
            for (int bit = 0; bit < 8; bit++)
                crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
        }
        png_save_uint_32(bytes.data + 29, ~crc);
        expect_refusal(bytes.data, bytes.size, "");
        bytes_end(&bytes);
    }
}

static void add_chunk(Bytes *bytes, const char *name, const u8 *data, u32 size)
{
    u8 word[4];
    png_save_uint_32(word, size);
    bytes_add(bytes, word, 4);
    const size_t start = bytes->size;
    bytes_add(bytes, name, 4);
    bytes_add(bytes, data, size);
    u32 crc = UINT32_MAX;
    for (size_t k = start; k < bytes->size; k++) {
        crc ^= bytes->data[k];
        for (int bit = 0; bit < 8; bit++)
            crc = crc & 1 ? crc >> 1 ^ 0xedb88320 : crc >> 1;
    }
    png_save_uint_32(word, ~crc);
    bytes_add(bytes, word, 4);
}

// APNG: acTL before the picture, a second frame's fcTL and fdAT after it.
static void test_animated(void **state)
{
    (void)state;
    const Case c = {PNG_COLOR_TYPE_RGB, 8, false, false, 3};
    Bytes plain = make_png(&c, false), animated = bytes_begin();
    bytes_add(&animated, plain.data, 33); // signature and IHDR
    add_chunk(&animated, "acTL", (const u8[]){0, 0, 0, 2, 0, 0, 0, 0}, 8);
    bytes_add(&animated, plain.data + 33, plain.size - 33 - 12);
    const u8 control[26] = {[3] = 1, [7] = WIDTH, [11] = HEIGHT};
    add_chunk(&animated, "fcTL", control, sizeof control);
    add_chunk(&animated, "fdAT", (const u8[]){0, 0, 0, 2, 1, 2, 3}, 7);
    bytes_add(&animated, plain.data + plain.size - 12, 12);
    Bitmap first = expect_bitmap(&plain, WIDTH, HEIGHT, 3, BITMAP_U8);
    Bitmap second = expect_bitmap(&animated, WIDTH, HEIGHT, 3, BITMAP_U8);
    assert_memory_equal(first.texels, second.texels, bitmap_bytes(&first));
    bitmap_destroy(&first);
    bitmap_destroy(&second);
    bytes_end(&plain);
    bytes_end(&animated);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_kinds),
        cmocka_unit_test(test_broken),
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_animated),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
