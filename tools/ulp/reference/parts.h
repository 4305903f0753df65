// What both halves of the reference share: the parts that shapes are made of.
#ifndef CLRT_ULP_REFERENCE_PARTS_H
#define CLRT_ULP_REFERENCE_PARTS_H

#include "reference/shapes.h"

// A cylinder or cone: the radius at distance z along the axis from the base is base_radius + slope z.
typedef struct Round {
    Real3 base, axis; // unit, from base to top
    real height, base_radius, top_radius, slope;
    bool caps;
} Round;

Round round_of(const Shape *shape);
// Face k of a box or tetrahedron: outward normal and offset.
void polyhedron_face(const Shape *shape, int k, Real3 *normal, real *offset);
// Vertices of the faces abc, abd, acd, bcd, and the vertex opposite.
extern const int tetrahedron_faces[4][4];
void flat_plane(const Shape *shape, Real3 *normal, Real3 *point);
Real3 real3_from(Vec3 a);

#endif
