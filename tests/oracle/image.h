/* Image files that scenes name, as values: PNG of every kind through libpng, Radiance HDR by its definition.
 * What a value means (sRGB or linear) is the texture's business. */
#ifndef ORACLE_IMAGE_H
#define ORACLE_IMAGE_H

#include "store.h"
#include "vec.h"

typedef struct Image {
    int width, height;
    bool is_float; /* values are radiance as they stand */
    Vec *values;   /* as the file has them, integers over their largest; top row first; alpha left out */
    Vec *decoded;  /* the same through the sRGB curve; `values` itself where is_float */
} Image;

/* By the file's first bytes. Ends the program where it cannot be read. */
const Image *image_read(Store *store, const char *path);
/* Linear value of an sRGB-encoded one in [0, 1]. */
real srgb_decode(real encoded);

/* Value at x, y in texels, (0, 0) the top-left corner and texel centres at half-integers: bilinear, or the
 * texel that holds the point. Wraps in x, and in y too where wrap_y is set, else clamps. */
Vec image_bilinear(const Image *image, const Vec *values, real x, real y, bool wrap_y);
Vec image_nearest(const Image *image, const Vec *values, real x, real y);

#endif
