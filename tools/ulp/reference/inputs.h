// How far one ulp of the inputs moves a surface past a ray. The inputs are vectors and lengths: origin and
// direction of the ray, the elements of the shape's map and its place, points and radii of the shape; each
// moves by one unit in the last place that a float of its largest coordinate has, and the moves add up.
#ifndef CLRT_ULP_REFERENCE_INPUTS_H
#define CLRT_ULP_REFERENCE_INPUTS_H

#include "reference/placed.h"

typedef struct InputMove {
    real along;  // the normal at the point where the ray meets the shape; object units
    real across; // any direction; at least `along`
    real rate;   // of the distance from the surface along the ray: one ulp changes t by along / rate
} InputMove;

// At t of the ray (origin, direction) of space.
InputMove reference_input_move(const Placed *p, const float origin[3], const float direction[3], real t);

#endif
