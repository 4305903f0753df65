// Where to cut a range in two: the binned surface-area heuristic.
#ifndef CLRT_ACCEL_SPLIT_H
#define CLRT_ACCEL_SPLIT_H

#include <float.h>

#include "accel/range.h"

// Half of the surface of the box, in units in which the largest edge of the hierarchy is about 1, so that it
// neither overflows nor vanishes: scale is that of area_scale. 0 for an empty box.
static inline f32 bounds_area(Quad low, Quad high, f32 scale)
{
    // Edges are kept finite; fourth lanes may be anything and are left out.
    const Quad edge = quad_min(quad_sub(high, low), quad_all(FLT_MAX));
    const Quad scaled = quad_mul(quad_max(edge, quad_all(0)), quad_all(scale));
    f32 sides[4];
    quad_store(sides, quad_mul(scaled, quad_yzx(scaled)));
    return sides[0] + sides[1] + sides[2];
}

// A power of two for bounds_area.
f32 area_scale(const Bounds *bounds);

// The best cut of a range of two items or more; false where no plane between bins separates them. In parallel
// where the range is large; to be called in a task.
bool split_find(const Item *items, const Range *range, f32 area_scale, Cut *cut);

#endif
