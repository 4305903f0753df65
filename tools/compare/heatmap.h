// Heat map: a picture of where two pictures differ and by how much, with a legend below.
#ifndef CLRT_COMPARE_HEATMAP_H
#define CLRT_COMPARE_HEATMAP_H

#include "pictures.h"

// A PNG of the compared region, or wider where the legend needs it. The colour is the pixel's largest
// difference over its channels on a logarithmic scale that is the same for all pictures of a format, so that
// two maps can be held against each other. False with ERROR_IO, ERROR_USAGE (no .png) or ERROR_MEMORY.
bool heatmap_write(const Pictures *pictures, const char *path, Error *error);

#endif
