#include <png.h>
#include <setjmp.h>
#include <string.h>

#include "image/bitmap_formats.h"

// Everything that lives across libpng's longjmp stands here and not in locals.
typedef struct Reader {
    const u8 *bytes;
    size_t left;
    png_structp png;
    png_infop info;
    Bitmap *bitmap;
    Error *error;
} Reader;

static void on_error(png_structp png, png_const_charp message)
{
    Reader *reader = png_get_error_ptr(png);
    error_set(reader->error, ERROR_SCENE, "%s", message);
    png_longjmp(png, 1);
}

// A warning is about something that libpng repaired or left out; pixels are whole all the same.
static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_read(png_structp png, png_bytep bytes, size_t length)
{
    Reader *reader = png_get_io_ptr(png);
    if (length > reader->left)
        png_error(png, "the file ends too early");
    memcpy(bytes, reader->bytes, length);
    reader->bytes += length;
    reader->left -= length;
}

// Asks for levels of 8 or 16 bits, as they are stored, grey or RGB.
static void set_transforms(png_structp png, bool palette)
{
    if (palette)
        png_set_palette_to_rgb(png);
    png_set_expand_gray_1_2_4_to_8(png);
    png_set_strip_alpha(png); // also what a palette's transparency has become
    const u16 one = 1;
    u8 first;
    memcpy(&first, &one, 1);
    if (first)
        png_set_swap(png);
}

static bool read_image(Reader *reader)
{
    png_structp png = reader->png;
    png_infop info = reader->info;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, reader, on_read);
    png_set_user_limits(png, BITMAP_SIDE_MAX, BITMAP_SIDE_MAX);
    png_read_info(png, info);
    set_transforms(png, png_get_color_type(png, info) == PNG_COLOR_TYPE_PALETTE);
    const int passes = png_set_interlace_handling(png);
    png_read_update_info(png, info);
    const BitmapType type = png_get_bit_depth(png, info) == 16 ? BITMAP_U16 : BITMAP_U8;
    if (!bitmap_create(reader->bitmap, png_get_image_width(png, info), png_get_image_height(png, info),
                       png_get_channels(png, info), type, reader->error))
        return false;
    for (int pass = 0; pass < passes; pass++) {
        for (u32 y = 0; y < reader->bitmap->height; y++)
            png_read_row(png, bitmap_row(reader->bitmap, y), NULL);
    }
    png_read_end(png, NULL);
    return true;
}

bool bitmap_decode_png(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    Reader reader = {.bytes = bytes, .left = size, .bitmap = bitmap, .error = error};
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    reader.info = reader.png ? png_create_info_struct(reader.png) : NULL;
    const bool done =
        reader.info ? read_image(&reader) : error_set(error, ERROR_MEMORY, "no memory to read a PNG");
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    return done;
}
