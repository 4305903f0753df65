#include "image/image.h"

#include <assert.h>
#include <stdlib.h>

Image *image_create(u32 width, u32 height, u32 channels, Error *error)
{
    assert(width > 0 && height > 0 && channels >= 1 && channels <= 4);
    Image *image = calloc(1, sizeof *image);
    size_t count;
    const bool overflow = __builtin_mul_overflow((size_t)width, height, &count) ||
                          __builtin_mul_overflow(count, channels, &count) ||
                          count > SIZE_MAX / 2 / sizeof(f32);
    if (image && !overflow)
        image->values = calloc(count, sizeof(f32));
    if (!image || !image->values) {
        image_destroy(image);
        error_set(error, ERROR_MEMORY, "no memory for an image of %u x %u with %u channels", width, height,
                  channels);
        return NULL;
    }
    image->width = width;
    image->height = height;
    image->channels = channels;
    return image;
}

void image_destroy(Image *image)
{
    if (!image)
        return;
    free(image->values);
    free(image);
}

f32 *image_row(const Image *image, u32 y)
{
    return image->values + (size_t)y * image->width * image->channels;
}
