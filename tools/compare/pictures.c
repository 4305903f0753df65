#include "pictures.h"

#include "hash.h"
#include "image/pfm.h"
#include "image/png.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

f64 pictures_peak(const Pictures *pictures)
{
    return pictures->format == FORMAT_PFM ? 1 : pictures->format == FORMAT_PNG8 ? 255 : 65535;
}

ValueScale pictures_scale(const Pictures *pictures)
{
    return (ValueScale){(f32)pictures_peak(pictures), !pictures->linear};
}

static u32 colors_of(const Image *image)
{
    return image->channels >= 3 ? 3 : 1;
}

f64 pictures_variance(const Pictures *pictures, int picture, u32 x, u32 y, u32 channel)
{
    const Image *image = pictures->variances[picture];
    if (!image)
        return 0;
    const f32 *values =
        image_row(image, pictures->region.y + y) + (size_t)(pictures->region.x + x) * image->channels;
    return (f64)values[channel < image->channels ? channel : 0];
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
    const u32 colors = channels >= 3 ? 3 : 1, from_colors = colors_of(from);
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
    const u32 colors = colors_of(mask);
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

// Of the pixels that are compared.
static bool check_variances(const Pictures *pictures, int picture, const char *path, Error *error)
{
    const Region r = pictures->region;
    const u32 colors = colors_of(pictures->images[0]);
    for (u32 y = 0; y < r.height; y++) {
        for (u32 x = 0; x < r.width; x++) {
            if (pictures->left_out && pictures->left_out[(size_t)y * r.width + x])
                continue;
            for (u32 c = 0; c < colors; c++) {
                const f64 variance = pictures_variance(pictures, picture, x, y, c);
                if (!(variance >= 0 && isfinite(variance)))
                    return error_set(error, ERROR_USAGE, "%s: pixel %u, %u: %g is not a variance", path,
                                     r.x + x, r.y + y, variance);
            }
        }
    }
    return true;
}

// width, height: of the files.
static bool read_variances(Pictures *pictures, int picture, const char *path, u32 width, u32 height,
                           Error *error)
{
    if (pictures->format != FORMAT_PFM)
        return error_set(error, ERROR_USAGE, "%s: only PFMs are compared with their variances", path);
    bool pfm = false;
    if (!is_pfm(path, &pfm, error))
        return false;
    if (!pfm)
        return error_set(error, ERROR_USAGE, "%s: variances are a PFM", path);
    Image *image = pictures->variances[picture] = pfm_image_read(path, error);
    if (!image)
        return false;
    if (image->width != width || image->height != height)
        return error_set(error, ERROR_USAGE, "%s: the variances are %u x %u, the pictures are %u x %u", path,
                         image->width, image->height, width, height);
    if (image->channels > pictures->images[0]->channels)
        return error_set(error, ERROR_USAGE, "%s: the variances are of colours, the pictures are grey", path);
    return check_variances(pictures, picture, path, error);
}

static bool read_all(const Sources *sources, Pictures *pictures, Error *error)
{
    static const u32 BYTES[] = {[FORMAT_PNG8] = 1, [FORMAT_PNG16] = 2, [FORMAT_PFM] = 4};
    Format formats[2];
    bool linear[2];
    for (int i = 0; i < 2; i++) {
        pictures->images[i] = read_picture(sources->paths[i], &formats[i], &linear[i], error);
        if (!pictures->images[i])
            return false;
    }
    if (!check_alike(sources->paths, pictures->images, formats, linear, error))
        return false;
    for (int i = 0; i < 2; i++)
        pictures->hashes[i] = hash_image(pictures->images[i], BYTES[formats[i]]);
    pictures->format = formats[0];
    pictures->linear = linear[0];
    const u32 width = pictures->images[0]->width, height = pictures->images[0]->height;
    bool done = set_region(pictures, sources->crop, error) && make_alike(pictures, error) &&
                (!sources->mask || read_mask(pictures, sources->mask, width, height, error));
    for (int i = 0; i < 2 && done; i++)
        done = !sources->variances[i] ||
               read_variances(pictures, i, sources->variances[i], width, height, error);
    return done;
}

bool pictures_read(const Sources *sources, Pictures *pictures, Error *error)
{
    *pictures = (Pictures){.region = {0, 0, 0, 0}};
    if (read_all(sources, pictures, error))
        return true;
    pictures_destroy(pictures);
    return false;
}

void pictures_destroy(Pictures *pictures)
{
    for (int i = 0; i < 2; i++) {
        image_destroy(pictures->images[i]);
        image_destroy(pictures->variances[i]);
    }
    free(pictures->left_out);
    *pictures = (Pictures){.region = {0, 0, 0, 0}};
}
