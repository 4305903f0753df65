// Irradiance by closed forms, at a point that faces +z.
#ifndef CLRT_TESTS_RENDER_IRRADIANCE_H
#define CLRT_TESTS_RENDER_IRRADIANCE_H

#include "base/types.h"
#include "base/vec.h"

enum { CORNERS_MAX = 12 };

typedef struct Polygon {
    Vec3 corner[CORNERS_MAX];
    int count;
} Polygon;

// The part of the polygon where p.normal >= limit.
Polygon polygon_clipped(const Polygon *in, Vec3 normal, f64 limit);

// Irradiance at p of a polygon of radiance 1 (Lambert, "Photometria", 1760).
f64 polygon_irradiance(Polygon polygon, Vec3 p);

// Irradiance of a sphere of radiance 1 that fills the half-angle `half` about a direction at `tilt` from the
// normal.
f64 sphere_irradiance(f64 half, f64 tilt);

#endif
