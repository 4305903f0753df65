// Environment: an equirectangular map of radiance around the scene, and tables for drawing directions from
// it.
//
// Texel (x, y) of width x height stands at u = (x + 1/2) / width, v = (y + 1/2) / height. The cells between
// the centres of four texels, width x (height + 1) of them with those at the poles, are what is drawn from:
// cell (x, y) has column x left and x + 1 right, row y - 1 above and y below. Within a cell the density is
// bilinear in u and in the cosine of the polar angle, in proportion to the strength (weighted radiance) of
// its corners.
#ifndef CLRT_SHARED_ENVIRONMENT_H
#define CLRT_SHARED_ENVIRONMENT_H

#include "shared/types.h"

// For paths, which look for many directions, the rows, and then the columns of each row, have guides: entry k of
// ENVIRONMENT_GUIDES + 1 is what k / ENVIRONMENT_GUIDES falls on, so that the search stays within a cache line or two.
#define ENVIRONMENT_GUIDES_LOG2 6
#define ENVIRONMENT_GUIDES (1 << ENVIRONMENT_GUIDES_LOG2)

// Prefiltered maps, whose first and last rows are at the poles: those of lobes whose width (roughness
// squared) is 2^(k + 1 - PREFILTER_LOBES), and one of irradiance over pi.
#define PREFILTER_LOBES 7
#define PREFILTER_MAPS (PREFILTER_LOBES + 1)
// Table of reflectances by N.V and roughness, both from 0 to 1 in steps of 1 / (PREFILTER_TABLE - 1): the
// factor of F0, the summand, and the share of diffuse reflection beside them.
#define PREFILTER_TABLE 32

typedef struct PrefilterMap {
    u32 offset; // in numbers, into the levels
    u32 width;  // twice the number of rows without the last
} PrefilterMap;
LAYOUT_SIZE(PrefilterMap, 8);

typedef struct EnvironmentRecord {
    u32 width, height;
    f32 turn;    // u = turn + atan2(dx, -dz) / 2 pi, and whole turns
    f32 scale;   // strength of a texel = scale (r + g + b), at most 1
    f32 density; // per steradian and strength
    u32 table;   // offset of the table of reflectances in the levels
    u32 padding[2];
    PrefilterMap maps[PREFILTER_MAPS];
} EnvironmentRecord;
LAYOUT_SIZE(EnvironmentRecord, 96);
LAYOUT_OFFSET(EnvironmentRecord, maps, 32);

#endif
