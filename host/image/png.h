// Reading PNG files through libpng. Levels are kept exactly; nothing is decoded to linear here.
#ifndef CLRT_IMAGE_PNG_H
#define CLRT_IMAGE_PNG_H

#include "image/image.h"

typedef struct PngInfo {
    u32 bits;    // 8 or 16: values are whole numbers from 0 to 2^bits - 1
    bool linear; // the file says that its levels are proportional to light (gAMA 1.0 without sRGB)
} PngInfo;

// Any PNG: interlaced ones, palettes (as RGB), 1 to 4 bits of grey (scaled to 8 bits), transparency of
// any kind (as an alpha channel). The caller destroys the image. NULL with ERROR_IO (missing, broken)
// or ERROR_MEMORY; the text names the path.
Image *png_image_read(const char *path, PngInfo *info, Error *error);

#endif
