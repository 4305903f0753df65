// Pictures: the two files to compare, made alike, and what of them is to be compared.
#ifndef CLRT_COMPARE_PICTURES_H
#define CLRT_COMPARE_PICTURES_H

#include "image/image.h"
#include "value.h"

typedef struct Region {
    u32 x, y, width, height;
} Region;

typedef enum Format { FORMAT_PNG8, FORMAT_PNG16, FORMAT_PFM } Format;

typedef struct Sources {
    const char *paths[2];
    const char *variances[2]; // NULL: none
    const char *mask;         // NULL: none
    const Region *crop;       // NULL: all
} Sources;

typedef struct Pictures {
    Image *images[2]; // of one size and the same channels, cut to `region`
    Format format;
    bool linear;         // PNG: levels are proportional to light, not sRGB
    u64 hashes[2];       // hash_image of the files' pixels: all, with their own channels
    Region region;       // within the files
    u8 *left_out;        // of each pixel of the region, 1: not compared; NULL: all are
    Image *variances[2]; // PFM: of the whole files, grey or with the pictures' colours; NULL: exact
} Pictures;

// The value of white: the last level, or 1 of a PFM.
f64 pictures_peak(const Pictures *pictures);

// What the values mean.
ValueScale pictures_scale(const Pictures *pictures);

// Of a value's noise, at least 0; x, y: within the region, channel: a colour. 0 where there is none.
f64 pictures_variance(const Pictures *pictures, int picture, u32 x, u32 y, u32 channel);

// The format is told by the content. A grey picture beside a coloured one is taken as coloured, one without
// alpha beside one with it as opaque; grey variances are those of each colour. On failure *pictures needs no
// pictures_destroy; ERROR_USAGE: they cannot be compared as asked.
bool pictures_read(const Sources *sources, Pictures *pictures, Error *error);

void pictures_destroy(Pictures *pictures);

#endif
