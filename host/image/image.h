// Image: a picture in memory as floats. It knows nothing of files; what its values mean (linear
// radiance, or the levels of a PNG) is for whoever makes one to say.
#ifndef CLRT_IMAGE_IMAGE_H
#define CLRT_IMAGE_IMAGE_H

#include "base/error.h"
#include "base/types.h"

typedef struct Image {
    u32 width, height; // at least 1
    u32 channels;      // 1 grey, 2 grey and alpha, 3 RGB, 4 RGB and alpha
    f32 *values;       // top row first, channels of a pixel side by side
} Image;

// An image of zeros, the caller's to destroy. NULL with ERROR_MEMORY where width x height x channels
// is more than memory can hold. Sizes must be at least 1, channels 1 to 4.
Image *image_create(u32 width, u32 height, u32 channels, Error *error);

// Takes NULL.
void image_destroy(Image *image);

// The values of row y, counted from the top.
f32 *image_row(const Image *image, u32 y);

#endif
