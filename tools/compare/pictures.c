#include "pictures.h"

#include "image/pfm.h"
#include "image/png.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

f64 pictures_peak(const Pictures *pictures)
{
    return pictures->format == FORMAT_PFM ? 1 : pictures->format == FORMAT_PNG8 ? 255 : 65535;
}

// The magic number says PFM; all else is libpng's to judge.
static bool is_pfm(const char *path, bool *pfm, Error *error)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    const int first = getc(file), second = getc(file);
    fclose(file);
    *pfm = first == 'P' && (second == 'F' || second == 'f');
    return true;
}

static Image *read_picture(const char *path, Format *format, bool *linear, Error *error)
{
    bool pfm = false;
    if (!is_pfm(path, &pfm, error))
        return NULL;
    *linear = pfm;
    *format = FORMAT_PFM;
    if (pfm)
        return pfm_image_read(path, error);
    PngInfo info;
    Image *image = png_image_read(path, &info, error);
    if (image) {
        *format = info.bits == 8 ? FORMAT_PNG8 : FORMAT_PNG16;
        *linear = info.linear;
    }
    return image;
}

static bool check_alike(const char *const paths[2], Image *const images[2], const Format formats[2],
                        const bool linear[2], Error *error)
{
    static const char *const NAMES[] = {"a PNG of 8 bits", "a PNG of 16 bits", "a PFM"};
    if (formats[0] != formats[1])
        return error_set(error, ERROR_USAGE, "cannot compare: %s is %s, %s is %s", paths[0],
                         NAMES[formats[0]], paths[1], NAMES[formats[1]]);
    if (linear[0] != linear[1])
        return error_set(error, ERROR_USAGE, "cannot compare: %s has %s levels, %s has %s ones", paths[0],
                         linear[0] ? "linear" : "sRGB", paths[1], linear[1] ? "linear" : "sRGB");
    if (images[0]->width != images[1]->width || images[0]->height != images[1]->height)
        return error_set(error, ERROR_USAGE, "cannot compare: %s is %u x %u, %s is %u x %u", paths[0],
                         images[0]->width, images[0]->height, paths[1], images[1]->width, images[1]->height);
    return true;
}

// Replaces *image by the region of it, with `channels`, of which alpha is `opaque` where there was none.
static bool recast(Image **image, Region region, u32 channels, f32 opaque, Error *error)
{
    const Image *from = *image;
    Image *to = image_create(region.width, region.height, channels, error);
    if (!to)
        return false;
    const u32 colors = channels >= 3 ? 3 : 1, from_colors = from->channels >= 3 ? 3 : 1;
    const bool alpha = channels % 2 == 0, from_alpha = from->channels % 2 == 0;
    for (u32 y = 0; y < region.height; y++) {
        const f32 *source = image_row(from, region.y + y) + (size_t)region.x * from->channels;
        f32 *target = image_row(to, y);
        for (u32 x = 0; x < region.width; x++, source += from->channels, target += channels) {
            for (u32 c = 0; c < colors; c++)
                target[c] = source[c < from_colors ? c : 0];
            if (alpha)
                target[colors] = from_alpha ? source[from_colors] : opaque;
        }
    }
    image_destroy(*image);
    *image = to;
    return true;
}

static bool make_alike(Pictures *pictures, Error *error)
{
    const u32 a = pictures->images[0]->channels, b = pictures->images[1]->channels;
    const bool color = a >= 3 || b >= 3, alpha = a % 2 == 0 || b % 2 == 0;
    const u32 channels = (color ? 3u : 1u) + (alpha ? 1u : 0u);
    for (int i = 0; i < 2; i++) {
        const Image *image = pictures->images[i];
        const bool whole =
            pictures->region.width == image->width && pictures->region.height == image->height;
        if ((!whole || image->channels != channels) &&
            !recast(&pictures->images[i], pictures->region, channels, (f32)pictures_peak(pictures), error))
            return false;
    }
    return true;
}

static bool set_region(Pictures *pictures, const Region *crop, Error *error)
{
    const u32 width = pictures->images[0]->width, height = pictures->images[0]->height;
    pictures->region = crop ? *crop : (Region){0, 0, width, height};
    const Region r = pictures->region;
    if (r.x >= width || r.width > width - r.x || r.y >= height || r.height > height - r.y)
        return error_set(error, ERROR_USAGE, "--crop %u,%u,%u,%u: not within the pictures' %u x %u", r.x, r.y,
                         r.width, r.height, width, height);
    return true;
}

static bool fill_left_out(Pictures *pictures, const char *path, const Image *mask, Error *error)
{
    const Region r = pictures->region;
    pictures->left_out = calloc((size_t)r.width * r.height, 1);
    if (!pictures->left_out)
        return error_set(error, ERROR_MEMORY, "%s: no memory for the mask", path);
    const u32 colors = mask->channels >= 3 ? 3 : 1;
    size_t left = 0;
    for (u32 y = 0; y < r.height; y++) {
        const f32 *values = image_row(mask, r.y + y) + (size_t)r.x * mask->channels;
        for (u32 x = 0; x < r.width; x++, values += mask->channels) {
            bool out = false;
            for (u32 c = 0; c < colors; c++)
                out = out || values[c] != 0;
            pictures->left_out[(size_t)y * r.width + x] = out;
            left += !out;
        }
    }
    if (left == 0)
        return error_set(error, ERROR_USAGE, "%s: the mask leaves nothing to compare", path);
    return true;
}

// width, height: of the files.
static bool read_mask(Pictures *pictures, const char *path, u32 width, u32 height, Error *error)
{
    PngInfo info;
    Image *mask = png_image_read(path, &info, error);
    if (!mask)
        return false;
    bool done = true;
    if (mask->width != width || mask->height != height)
        done = error_set(error, ERROR_USAGE, "%s: the mask is %u x %u, the pictures are %u x %u", path,
                         mask->width, mask->height, width, height);
    done = done && fill_left_out(pictures, path, mask, error);
    image_destroy(mask);
    return done;
}

static bool read_all(const char *const paths[2], const Region *crop, const char *mask, Pictures *pictures,
                     Error *error)
{
    Format formats[2];
    bool linear[2];
    for (int i = 0; i < 2; i++) {
        pictures->images[i] = read_picture(paths[i], &formats[i], &linear[i], error);
        if (!pictures->images[i])
            return false;
    }
    if (!check_alike(paths, pictures->images, formats, linear, error))
        return false;
    pictures->format = formats[0];
    pictures->linear = linear[0];
    const u32 width = pictures->images[0]->width, height = pictures->images[0]->height;
    return set_region(pictures, crop, error) && make_alike(pictures, error) &&
           (!mask || read_mask(pictures, mask, width, height, error));
}

bool pictures_read(const char *const paths[2], const Region *crop, const char *mask, Pictures *pictures,
                   Error *error)
{
    *pictures = (Pictures){.region = {0, 0, 0, 0}};
    if (read_all(paths, crop, mask, pictures, error))
        return true;
    pictures_destroy(pictures);
    return false;
}

void pictures_destroy(Pictures *pictures)
{
    image_destroy(pictures->images[0]);
    image_destroy(pictures->images[1]);
    free(pictures->left_out);
    *pictures = (Pictures){.region = {0, 0, 0, 0}};
}
