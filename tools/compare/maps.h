// Maps: what clrt-compare can draw of each pixel.
#ifndef CLRT_COMPARE_MAPS_H
#define CLRT_COMPARE_MAPS_H

#include "metrics.h"
#include "pictures.h"

// Largest difference over the channels, FLIP, 1 - SSIM, largest |z| over the colours.
typedef enum MapKind { MAP_DIFFERENCE, MAP_FLIP, MAP_SSIM, MAP_Z, MAP_COUNT } MapKind;

// Draws those whose path is not NULL, as PNGs; MAP_Z only where there are variances. The scale of a kind is
// the same for all pictures of a format, so that two maps can be held against each other. Where there is no
// FLIP and SSIM for a NaN somewhere, all of their map is NaN. False with ERROR_IO, ERROR_USAGE (no .png) or
// ERROR_MEMORY.
bool maps_write(const Pictures *pictures, const Metrics *metrics, const char *const paths[MAP_COUNT],
                Error *error);

#endif
