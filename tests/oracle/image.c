#include "image.h"

#include <errno.h>
#include <png.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static Image *new_image(Store *store, int width, int height)
{
    Image *image = store_alloc(store, sizeof *image);
    size_t size = (size_t)width * (size_t)height * sizeof *image->values;
    *image = (Image){.width = width, .height = height};
    image->values = store_alloc(store, size);
    image->decoded = image->values;
    return image;
}

real srgb_decode(real encoded)
{
    return encoded <= 0.04045L ? encoded / 12.92L : powl((encoded + 0.055L) / 1.055L, 2.4L);
}

/* The row's samples, 1 or 3 channels of 8 or 16 bits, as values. */
static void take_row(Vec *values, const png_byte *row, int width, int channels, int depth)
{
    for (int x = 0; x < width; x++) {
        real v[3];
        for (int c = 0; c < channels; c++) {
            const png_byte *at = row + (size_t)(x * channels + c) * (size_t)(depth / 8);
            v[c] = depth == 16 ? (real)(at[0] * 256 + at[1]) / 65535 : (real)at[0] / 255;
        }
        values[x] = channels == 1 ? grey(v[0]) : vec(v[0], v[1], v[2]);
    }
}

static Image *read_png(Store *store, const char *path, FILE *file)
{
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    if (info == NULL || setjmp(png_jmpbuf(png)))
        die("%s: libpng could not read it", path);
    png_init_io(png, file);
    png_read_info(png, info);
    /* Palettes to their colors, fewer than 8 bits to 8 by repeating them, which keeps the share of the
     * largest. */
    png_set_expand(png);
    png_set_strip_alpha(png);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    int width = (int)png_get_image_width(png, info);
    int height = (int)png_get_image_height(png, info);
    size_t stride = png_get_rowbytes(png, info);
    png_bytep *rows = store_alloc(store, (size_t)height * sizeof *rows);
    for (int y = 0; y < height; y++)
        rows[y] = store_alloc(store, stride);
    png_read_image(png, rows);
    Image *image = new_image(store, width, height);
    for (int y = 0; y < height; y++)
        take_row(&image->values[(size_t)y * (size_t)width], rows[y], width, png_get_channels(png, info),
                 png_get_bit_depth(png, info));
    png_destroy_read_struct(&png, &info, NULL);
    size_t count = (size_t)width * (size_t)height;
    image->decoded = store_alloc(store, count * sizeof *image->decoded);
    for (size_t i = 0; i < count; i++) {
        Vec v = image->values[i];
        image->decoded[i] = vec(srgb_decode(v.x), srgb_decode(v.y), srgb_decode(v.z));
    }
    return image;
}

static unsigned char take_byte(FILE *file, const char *path)
{
    int byte = getc(file);
    if (byte == EOF)
        die("%s: ends too early", path);
    return (unsigned char)byte;
}

/* A run-length coded scan line of Radiance: the four components one after the other. */
static void take_runs(unsigned char *line, int width, FILE *file, const char *path)
{
    for (int component = 0; component < 4; component++) {
        for (int x = 0; x < width;) {
            int count = take_byte(file, path);
            bool run = count > 128;
            count = run ? count - 128 : count;
            unsigned char value = run ? take_byte(file, path) : 0;
            for (; count > 0 && x < width; count--, x++)
                line[4 * x + component] = run ? value : take_byte(file, path);
        }
    }
}

static Image *read_hdr(Store *store, const char *path, FILE *file)
{
    char text[256];
    int width, height;
    do {
        if (fgets(text, sizeof text, file) == NULL)
            die("%s: no size", path);
    } while (sscanf(text, "-Y %d +X %d", &height, &width) != 2);
    Image *image = new_image(store, width, height);
    image->is_float = true;
    unsigned char *line = store_alloc(store, 4 * (size_t)width);
    for (int y = 0; y < height; y++) {
        for (int i = 0; i < 4; i++)
            line[i] = take_byte(file, path);
        if (width >= 8 && width < 32768 && line[0] == 2 && line[1] == 2 && line[2] < 128)
            take_runs(line, width, file, path);
        else
            for (int i = 4; i < 4 * width; i++)
                line[i] = take_byte(file, path);
        for (int x = 0; x < width; x++) {
            const unsigned char *at = &line[4 * x];
            real unit = at[3] == 0 ? 0 : ldexpl(1, at[3] - 128) / 256;
            image->values[(size_t)y * (size_t)width + (size_t)x] = scaled(vec(at[0], at[1], at[2]), unit);
        }
    }
    return image;
}

const Image *image_read(Store *store, const char *path)
{
    FILE *file = fopen(path, "rb");
    if (file == NULL)
        die("%s: %s", path, strerror(errno));
    int first = getc(file);
    rewind(file);
    const Image *image;
    if (first == 0x89)
        image = read_png(store, path, file);
    else if (first == '#')
        image = read_hdr(store, path, file);
    else
        die("%s: not in the oracle's part of the language", path);
    fclose(file);
    return image;
}

/* The texel in column `x` and row `y`, any whole numbers. */
static Vec texel(const Image *image, const Vec *values, real x, real y, bool wrap_y)
{
    x -= image->width * floorl(x / image->width);
    if (wrap_y)
        y -= image->height * floorl(y / image->height);
    int column = (int)x % image->width;
    int row = (int)fminl(image->height - 1, fmaxl(0, y));
    return values[(size_t)row * (size_t)image->width + (size_t)column];
}

Vec image_bilinear(const Image *image, const Vec *values, real x, real y, bool wrap_y)
{
    real left = floorl(x - 0.5L);
    real top = floorl(y - 0.5L);
    real s = x - 0.5L - left;
    real t = y - 0.5L - top;
    Vec upper = add(scaled(texel(image, values, left, top, wrap_y), 1 - s),
                    scaled(texel(image, values, left + 1, top, wrap_y), s));
    Vec lower = add(scaled(texel(image, values, left, top + 1, wrap_y), 1 - s),
                    scaled(texel(image, values, left + 1, top + 1, wrap_y), s));
    return add(scaled(upper, 1 - t), scaled(lower, t));
}

Vec image_nearest(const Image *image, const Vec *values, real x, real y)
{
    return texel(image, values, floorl(x), floorl(y), true);
}
