// Slow reference for single shapes in long double, straight from the scene language; shares no formula with
// the kernels. Works in the coordinates in which the shape is described.
#ifndef CLRT_ULP_REFERENCE_SHAPES_H
#define CLRT_ULP_REFERENCE_SHAPES_H

#include "scene/scene.h"

typedef long double real;

typedef struct Real3 {
    real x, y, z;
} Real3;

Real3 real3(double x, double y, double z);
Real3 real3_add(Real3 a, Real3 b);
Real3 real3_sub(Real3 a, Real3 b);
Real3 real3_scale(Real3 a, real s);
real real3_dot(Real3 a, Real3 b);
Real3 real3_cross(Real3 a, Real3 b);
real real3_length(Real3 a);
Real3 real3_normalize(Real3 a);

// Rows of the inverse of m's linear part, and points and directions led back through m.
typedef struct RealMap {
    Real3 row[3];
    Real3 origin; // of m: its translation
} RealMap;

RealMap real_map_inverse(const Affine *m);
Real3 real_map_point(const RealMap *map, Real3 p);
Real3 real_map_direction(const RealMap *map, Real3 d);

// The smallest root t > tmin of the ray with the shape, all of whose surfaces are moved outward by `grow`
// (edges of flat shapes likewise; ends of cylinders and cones by `longer`); INFINITY where there is none.
real reference_hit(const Shape *shape, Real3 o, Real3 d, real grow, real longer, real tmin);

// Number of pieces with normals of their own (faces, walls, caps).
int reference_pieces(const Shape *shape);

// At a point near piece k: signed distance from it (outward), unit outward normal, texture coordinates.
// False where the shape has no such piece (a cap of an open cylinder).
bool reference_piece(const Shape *shape, int k, Real3 p, real *distance, Real3 *normal, real uv[2]);

#endif
