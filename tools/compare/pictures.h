// Pictures: the two files to compare, made alike, and what of them is to be compared.
#ifndef CLRT_COMPARE_PICTURES_H
#define CLRT_COMPARE_PICTURES_H

#include "image/image.h"

typedef struct Region {
    u32 x, y, width, height;
} Region;

typedef enum Format { FORMAT_PNG8, FORMAT_PNG16, FORMAT_PFM } Format;

typedef struct Pictures {
    Image *images[2]; // of one size and the same channels, cut to `region`
    Format format;
    bool linear;      // PNG: levels are proportional to light, not sRGB
    Region region;    // within the files
    u8 *left_out;     // of each pixel of the region, 1: not compared; NULL: all are
} Pictures;

// The value of white: the last level, or 1 of a PFM.
f64 pictures_peak(const Pictures *pictures);

// crop and mask may be NULL. The format is told by the content. A grey picture beside a coloured one is taken
// as coloured, one without alpha beside one with it as opaque. On failure *pictures needs no
// pictures_destroy; ERROR_USAGE: they cannot be compared as asked.
bool pictures_read(const char *const paths[2], const Region *crop, const char *mask, Pictures *pictures,
                   Error *error);

void pictures_destroy(Pictures *pictures);

#endif
