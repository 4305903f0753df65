// Backward judgement: whether a distance is right for a shape whose surface is moved by a little. That says the
// right thing at silhouettes, at edges and far away, where a small move of what went in changes t by much.
#ifndef CLRT_ULP_REFERENCE_ACCEPT_H
#define CLRT_ULP_REFERENCE_ACCEPT_H

#include "reference/shapes.h"

// A ray in the coordinates in which the shape is described.
typedef struct ShapeRay {
    const Shape *shape;
    Real3 o, d;
} ShapeRay;

// Whether t, INFINITY for no hit, is between the answers for the surface moved inward and outward by `grow`,
// but for `slack` in t; a ray that starts within `grow` of the surface may start on either side.
bool reference_accepts(const ShapeRay *ray, real t, real grow, real slack);

// Whether t is a point of the wall of an open cylinder or cone close to its rim, or on a ray that may miss.
bool reference_at_open_rim(const ShapeRay *ray, real t, real grow, bool may_miss);

#endif
