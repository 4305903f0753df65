// Where rays that leave a surface start: off the surface by the error bound of the hit point, no more.
// Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8 "Managing Rounding Error".
#ifndef CLRT_KERNELS_BASE_OFFSET_H
#define CLRT_KERNELS_BASE_OFFSET_H

#include "base/exact.h"
#include "base/vec.h"

// Half an ulp of 1: the largest relative error of one rounding.
#define ROUNDING REAL(0x1p-24f, 0x1p-53)

// The number next to x, away from zero where `away` has the sign of x, towards zero else; x itself where
// away = 0. Zero goes to the smallest normal number, so that devices that flush denormals agree.
static inline vf next_towards(vf x, vf away)
{
    const vf smallest = (vf)(VF_SMALLEST_NORMAL);
    const vm outward = (x > 0.0f) == (away > 0.0f);
    const vf moved = vf_neighbour(x, outward);
    const vf stepped = fabs(x) < smallest ? (away > 0.0f ? smallest : -smallest) : moved;
    return away == 0.0f ? x : stepped;
}

// The point moved along the unit normal ng to the side that dir points to, by as much as covers the bounds
// `error` (>= 0) of its coordinates, and rounded away from the surface.
static inline v3 offset_origin(v3 point, v3 error, v3 ng, v3 dir)
{
    const vf distance = v3_dot(v3_abs(ng), error);
    const vf side = v3_dot(dir, ng) < (vf)(0.0f) ? -distance : distance;
    const v3 away = v3_scale(ng, side);
    const v3 moved = v3_add(point, away);
    return v3_make(next_towards(moved.x, away.x), next_towards(moved.y, away.y),
                   next_towards(moved.z, away.z));
}

#endif
