// Primitive: one analytic shape in its canonical form, as traversal reads it.
//
// Every kind but triangle has a local space of its own, q = A (p - c), with p in the space of the
// hierarchy that holds the primitive (render space, or the space of an object that is instanced), A in
// row0..row2.xyz and c in row0..row2.w. Its axes follow the texture rule of the scene language (t1, t2, n),
// so that texture coordinates are simple functions of q:
//
//   SPHERE       similarity: A = the rotation to object axes (rows orthonormal), c = centre, p0 = radius
//   ELLIPSOID    a sphere under any other transform: |q| = 1, q along object axes
//   PLANE        row2.xyz = unit normal n; p0 = n.p on the plane; row0.xyz, row1.xyz = gradients of u and v;
//                u = row0.p + (row0.w + row1.w), v = row1.p + (row2.w + p1): first term of each sum a whole
//                number, second one in [0, 1)
//   BOX          the cube |q_i| <= 1 (any affine image of it)
//   TETRAHEDRON  a -> 0, b -> x, c -> y, d -> z: q_i >= 0, q_x + q_y + q_z <= 1; c = vertex a
//   DISK         q_z = 0, q_x^2 + q_y^2 <= 1; x = t1, y = t2, z = n
//   CYLINDER     q_x^2 + q_y^2 = 1, |q_z| <= 1 from base (-1) to top (+1); x = t1, y = t2, z = n; p0 = 1: caps
//   CONE         q_x^2 + q_y^2 = (1 + p1 (q_z - 1) / 2)^2 or, where the base is the wider end,
//                (1 - p1 (q_z + 1) / 2)^2, p1 in [0, 1] the relative narrowing (1: an apex); p0 = 1: caps,
//                p0 bit 1 (value 2 added): the top is the wider end
//   TORUS        (rho - 1)^2 + q_z^2 = p0^2, rho = |(q_x, q_y)|, p0 = minor / major; x = t1, y = t2, z = axis
//   TRIANGLE     row0.xyz, row1.xyz, row2.xyz = vertices; p0 = 1, or -1 where a mirroring transform has been
//                baked in and the geometric normal is therefore -(b-a) x (c-a)
#ifndef CLRT_SHARED_PRIMITIVE_H
#define CLRT_SHARED_PRIMITIVE_H

#include "shared/types.h"

#define PRIMITIVE_SPHERE 0
#define PRIMITIVE_ELLIPSOID 1
#define PRIMITIVE_PLANE 2
#define PRIMITIVE_BOX 3
#define PRIMITIVE_TETRAHEDRON 4
#define PRIMITIVE_DISK 5
#define PRIMITIVE_CYLINDER 6
#define PRIMITIVE_CONE 7
#define PRIMITIVE_TORUS 8
#define PRIMITIVE_TRIANGLE 9
#define PRIMITIVE_KIND_COUNT 10

typedef struct Primitive {
    f32x4 row0; // see above; lengths in scene units
    f32x4 row1;
    f32x4 row2;
    f32 p0;
    f32 p1;
    u32 kind; // PRIMITIVE_X
    u32 id;   // place in the order of definition, unique in the scene's arrays of what shading needs
} Primitive;
LAYOUT_SIZE(Primitive, 64);
LAYOUT_OFFSET(Primitive, p0, 48);
LAYOUT_OFFSET(Primitive, kind, 56);

#endif
