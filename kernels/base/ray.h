// RayLanes: LANES rays as the intersection functions see them.
#ifndef CLRT_KERNELS_BASE_RAY_H
#define CLRT_KERNELS_BASE_RAY_H

#include "base/vec.h"

// In place of the index of a primitive or an instance.
#define NO_HIT (-1)

typedef struct {
    v3 org;    // in the space of the primitive
    v3 dir;    // unit in render space, of any length within an instance; t counts in multiples of it
    vf tmin;   // roots must be > tmin; 0 or the t of an earlier hit
    vm self;   // the ray starts on the surface of the very primitive that is tested (its root at 0 is no hit)
    vm inward; // where self: it starts towards the inner side, against the geometric normal
} RayLanes;

// One primitive's numbers for each lane: all the same in traversal, gathered in shading.
typedef struct {
    v3 row0, row1, row2; // rows of A, or vertices of a triangle
    v3 c;                // (row0.w, row1.w, row2.w)
    vf p0, p1, p2;
} PrimitiveLanes;

#endif
