// SSIM: how similar the structure of two pictures is, per pixel, at most 1. After Wang, Bovik, Sheikh,
// Simoncelli, "Image Quality Assessment: From Error Visibility to Structural Similarity", IEEE Trans. Image
// Process. 13(4), 2004, with its constants (K1 0.01, K2 0.03) and its Gaussian window of 11 x 11 pixels and
// standard deviation 1.5, on the luma of what a display is sent. It knows nothing of files.
#ifndef CLRT_COMPARE_SSIM_H
#define CLRT_COMPARE_SSIM_H

#include "image/image.h"
#include "value.h"

// A window needs this many pixels on all sides of its centre.
enum { SSIM_RADIUS = 5 };

// Writes width x height similarities, top row first, NaN where a window does not fit: nearer to an edge than
// SSIM_RADIUS. Both images have one size and no NaN; grey is luma, alpha is not seen. False with
// ERROR_MEMORY.
bool ssim_compare(const Image *a, const Image *b, ValueScale scale, f32 *similarities, Error *error);

#endif
