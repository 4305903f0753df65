// Heat map: a picture of a number per pixel, with a legend below: what it is, and a colour bar with its
// scale. It knows nothing of what is compared.
#ifndef CLRT_COMPARE_HEATMAP_H
#define CLRT_COMPARE_HEATMAP_H

#include "base/error.h"
#include "base/types.h"

enum { HEATMAP_LABELS = 5 };

// What the ends of the bar stand for, and the numbers below it. Values beyond have the colours of the ends.
typedef struct HeatScale {
    f64 low, high;
    bool logarithmic;
    const char *labels[HEATMAP_LABELS]; // as font.h has them; NULL: no more
} HeatScale;

typedef struct HeatMap {
    u32 width, height;
    const f32 *values; // top row first; 0 is black, a NaN is cyan, a number below 0 is not there: grey
    HeatScale scale;
    const char *caption; // as font.h has it; what does not fit is cut
} HeatMap;

// A PNG of the map's size, or wider where the legend needs it. False with ERROR_IO, ERROR_USAGE (no .png) or
// ERROR_MEMORY.
bool heatmap_write(const HeatMap *map, const char *path, Error *error);

#endif
