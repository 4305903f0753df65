#include "picture.h"

#include <errno.h>
#include <png.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static real hable(real x)
{
    return (x * (0.15L * x + 0.05L) + 0.004L) / (x * (0.15L * x + 0.5L) + 0.06L) - 0.02L / 0.3L;
}

static real tone_mapped(const Scene *scene, real c)
{
    switch (scene->tone_map) {
    case TONE_NONE:
        return c;
    case TONE_REINHARD:
        return c / (1 + c);
    case TONE_REINHARD_EXTENDED:
        return c * (1 + c / (scene->white * scene->white)) / (1 + c);
    case TONE_ACES:
        return c * (2.51L * c + 0.03L) / (c * (2.43L * c + 0.59L) + 0.14L);
    case TONE_HABLE:
        return hable(2 * c) / hable(11.2L);
    }
    return c;
}

real output_value(const Scene *scene, real radiance)
{
    real c = tone_mapped(scene, radiance * exp2l(scene->exposure));
    c = fminl(1, fmaxl(0, c));
    if (!scene->srgb)
        return c;
    return c <= 0.0031308L ? 12.92L * c : 1.055L * powl(c, 1 / 2.4L) - 0.055L;
}

int output_level(const Scene *scene, real radiance, int bits)
{
    return (int)lroundl(output_value(scene, radiance) * (bits == 16 ? 65535 : 255));
}

static void write_png(const char *path, int width, int height, int bits, int type, const unsigned char *bytes,
                      size_t stride, bool srgb)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        die("%s: %s", path, strerror(errno));
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, NULL, NULL, NULL);
    png_infop info = png == NULL ? NULL : png_create_info_struct(png);
    if (info == NULL || setjmp(png_jmpbuf(png)))
        die("%s: libpng could not write it", path);
    png_init_io(png, file);
    png_set_IHDR(png, info, (png_uint_32)width, (png_uint_32)height, bits, type, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (srgb)
        png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA(png, info, 1.0);
    png_set_compression_level(png, 9);
    png_write_info(png, info);
    for (int y = 0; y < height; y++)
        png_write_row(png, bytes + (size_t)y * stride);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    if (fclose(file) != 0)
        die("%s: %s", path, strerror(errno));
}

void picture_write_png(const Picture *picture, const Scene *scene, int bits, const char *path)
{
    size_t stride = (size_t)picture->width * 3 * (size_t)(bits / 8);
    unsigned char *bytes = malloc(stride * (size_t)picture->height);
    if (bytes == NULL)
        die("out of memory");
    unsigned char *at = bytes;
    size_t count = (size_t)picture->width * (size_t)picture->height;
    for (size_t i = 0; i < count; i++) {
        for (int channel = 0; channel < 3; channel++) {
            int level = output_level(scene, component(picture->pixels[i], channel), bits);
            if (bits == 16)
                *at++ = (unsigned char)(level >> 8);
            *at++ = (unsigned char)(level & 255);
        }
    }
    write_png(path, picture->width, picture->height, bits, PNG_COLOR_TYPE_RGB, bytes, stride, scene->srgb);
    free(bytes);
}

void mask_write_png(const unsigned char *mask, int width, int height, const char *path)
{
    write_png(path, width, height, 8, PNG_COLOR_TYPE_GRAY, mask, (size_t)width, false);
}

void picture_write_pfm(const Picture *picture, const char *path)
{
    FILE *file = fopen(path, "wb");
    if (file == NULL)
        die("%s: %s", path, strerror(errno));
    fprintf(file, "PF\n%d %d\n-1.0\n", picture->width, picture->height);
    for (int y = picture->height - 1; y >= 0; y--) {
        for (int x = 0; x < picture->width; x++) {
            Vec c = picture->pixels[(size_t)y * (size_t)picture->width + (size_t)x];
            for (int channel = 0; channel < 3; channel++) {
                float value = (float)component(c, channel);
                unsigned int bits;
                memcpy(&bits, &value, sizeof bits);
                for (int byte = 0; byte < 4; byte++)
                    putc((int)(bits >> (8 * byte) & 255), file);
            }
        }
    }
    if (ferror(file) | (fclose(file) != 0))
        die("%s: could not be written", path);
}
