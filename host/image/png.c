#include "image/png.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Everything that lives across libpng's longjmp stands here and not in locals.
typedef struct Reader {
    const char *path;
    FILE *file;
    png_structp png;
    png_infop info;
    Image *image;
    png_bytep bytes;
    png_bytepp rows;
    PngInfo *result;
    Error *error;
} Reader;

static void on_error(png_structp png, png_const_charp message)
{
    Reader *reader = png_get_error_ptr(png);
    error_set(reader->error, ERROR_IO, "%s: %s", reader->path, message);
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
    if (fread(bytes, 1, length, reader->file) == length)
        return;
    png_error(png, ferror(reader->file) ? strerror(errno) : "the file ends too early");
}

static void convert_rows(const Reader *reader)
{
    const Image *image = reader->image;
    const size_t count = (size_t)image->width * image->channels;
    for (u32 y = 0; y < image->height; y++) {
        const u8 *bytes = reader->rows[y];
        f32 *values = image_row(image, y);
        if (reader->result->bits == 8) {
            for (size_t i = 0; i < count; i++)
                values[i] = (f32)bytes[i];
        } else {
            for (size_t i = 0; i < count; i++)
                values[i] = (f32)(bytes[2 * i] * 256 + bytes[2 * i + 1]);
        }
    }
}

static bool is_linear(const Reader *reader)
{
    png_fixed_point gamma = 0;
    int intent = 0;
    return !png_get_sRGB(reader->png, reader->info, &intent) &&
           png_get_gAMA_fixed(reader->png, reader->info, &gamma) && gamma == PNG_FP_1;
}

static bool read_image(Reader *reader)
{
    png_structp png = reader->png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_read_fn(png, reader, on_read);
    png_read_info(png, reader->info);
    png_set_expand(png);
    png_set_interlace_handling(png);
    reader->result->linear = is_linear(reader);
    png_read_update_info(png, reader->info);

    const u32 height = png_get_image_height(png, reader->info);
    reader->result->bits = png_get_bit_depth(png, reader->info);
    reader->image = image_create(png_get_image_width(png, reader->info), height,
                                 png_get_channels(png, reader->info), reader->error);
    if (!reader->image)
        return false;
    const size_t stride = png_get_rowbytes(png, reader->info);
    // Smaller than the floats of the image, so the product cannot overflow.
    reader->bytes = malloc(stride * height);
    reader->rows = calloc(height, sizeof *reader->rows);
    if (!reader->bytes || !reader->rows)
        return error_set(reader->error, ERROR_MEMORY, "%s: no memory to read the image", reader->path);
    for (u32 y = 0; y < height; y++)
        reader->rows[y] = reader->bytes + y * stride;
    png_read_image(png, reader->rows);
    png_read_end(png, NULL);
    convert_rows(reader);
    return true;
}

Image *png_image_read(const char *path, PngInfo *info, Error *error)
{
    Reader reader = {.path = path, .result = info, .error = error};
    reader.file = fopen(path, "rb");
    if (!reader.file) {
        error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
        return NULL;
    }
    reader.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &reader, on_error, on_warning);
    reader.info = reader.png ? png_create_info_struct(reader.png) : NULL;
    bool done = false;
    if (reader.info)
        done = read_image(&reader);
    else
        error_set(error, ERROR_MEMORY, "%s: no memory to read the image", path);
    png_destroy_read_struct(&reader.png, &reader.info, NULL);
    fclose(reader.file);
    free(reader.rows);
    free(reader.bytes);
    if (!done) {
        image_destroy(reader.image);
        return NULL;
    }
    return reader.image;
}
