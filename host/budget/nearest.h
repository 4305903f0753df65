// How far the surfaces of a layout are from a point: what bounds the light of a lamp that grows without limit
// towards its position.
#ifndef CLRT_BUDGET_NEAREST_H
#define CLRT_BUDGET_NEAREST_H

#include "base/vec.h"
#include "layout/layout.h"

// No surface is nearer to the point, in render space, than this; INFINITY without surfaces. Exact for planes,
// spheres and boxes, up to rounding, that of the plane or of the box about it for others, whichever is
// farther: 0 where a point is within the box of, say, a torus.
f64 nearest_surface(const Layout *layout, Vec3 point);

#endif
