// Weld: points that are the same point.
#ifndef CLRT_ASSETS_WELD_H
#define CLRT_ASSETS_WELD_H

#include "base/vec.h"

// Moves the first of each set of equal points (0 is -0) to the front, in order; map[i] becomes the new index
// of point i. Returns how many are left, or MESH_NO_INDEX (2^32 - 1) when memory is exhausted. Points are
// finite, count is below 2^31.
u32 weld_points(Vec3 *points, u32 count, u32 *map);

#endif
