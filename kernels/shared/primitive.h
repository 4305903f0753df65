// Primitive: one analytic shape in its canonical form, as traversal reads it.
//
// p is a point in the space of the hierarchy that holds the primitive (render space, whose origin is the
// camera, or the space of an object that is instanced); A is row0..row2.xyz, c is row0..row2.w. Axes follow
// the texture rule of the scene language (t1, t2, n), so that texture coordinates are simple functions of q.
// Planes are kept as offsets from the origin of the space, computed in double: their error is then relative
// to their distance from the camera, however large the shape.
//
//   SPHERE       similarity: A = the rotation to object axes (rows orthonormal), c = centre, p0 = radius
//   GIANT_SPHERE the same where the surface passes close by the origin of the space: p1 = |c|^2 - r^2, from
//                double; the surface is |p|^2 - 2 c.p + p1 = 0, so that rounding c moves it little there
//   ELLIPSOID    a sphere under any other transform: q = A (p - c), |q| = 1, q along object axes
//   PLANE        row2.xyz = unit normal n; p0 = n.p on the plane; row0.xyz, row1.xyz = gradients of u and v;
//                u = row0.p + (row0.w + row1.w), v = row1.p + (row2.w + p1): first term of each sum a whole
//                number, second one what is missing (at most 1/2 up to 2^24)
//   BOX          row_i.xyz = unit normals of the three pairs of faces, along the object's axes;
//                row_i.w <= row_i.p <= p_i: both faces of a pair as offsets, as a plane has its own
//   TETRAHEDRON  q = A p + c >= 0: the barycentric weights of b, c, d; that of a is
//                p0 - (row0 + row1 + row2).p >= 0
//   DISK         row2.xyz = unit normal, p0 = row2.p on the disk; x = row0.(p - c), y = row1.(p - c) along
//                t1 and t2, x^2 + y^2 <= 1
//   RECTANGLE    a parallelogram: row2.xyz, p0 as of DISK; |row0.(p - c)| <= 1, |row1.(p - c)| <= 1 with c its
//                centre, along its first and second edge
//   CYLINDER     q = A (p - c), q_x^2 + q_y^2 = 1, |q_z| <= 1 from base (-1) to top (+1); x = t1, y = t2,
//                z = n; p0 = 1: caps
//   CONE         q = A (p - c), q_x^2 + q_y^2 = (1 - p1 (q_z + 1) / 2)^2, |q_z| <= 1, from the wider end (-1)
//                to the narrower one (+1); p1 in [0, 1]: the relative narrowing (1: an apex); x = t1, y = t2
//                of the axis from base to top; p0 = 1: caps; 2 added: the wider end is the top
//   TORUS        q = A (p - c), (rho - 1)^2 + q_z^2 = p0^2, rho = |(q_x, q_y)|, p0 = minor / major; x = t1,
//                y = t2, z = axis
//   TRIANGLE     row0.xyz, row1.xyz, row2.xyz = vertices; c = the unit geometric normal n (against
//                (b-a) x (c-a) where a mirroring transform has been baked in), p1 = n.a; p0 = share of the
//                error bound of the plane's t that counts against it: 0 where n is an axis
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
#define PRIMITIVE_GIANT_SPHERE 10
#define PRIMITIVE_RECTANGLE 11
#define PRIMITIVE_KIND_COUNT 12

typedef struct Primitive {
    f32x4 row0; // see above; lengths in scene units
    f32x4 row1;
    f32x4 row2;
    f32 p0;
    f32 p1;
    u32 kind; // PRIMITIVE_X
    f32 p2;
} Primitive;
LAYOUT_SIZE(Primitive, 64);
LAYOUT_OFFSET(Primitive, p0, 48);
LAYOUT_OFFSET(Primitive, kind, 56);
LAYOUT_OFFSET(Primitive, p2, 60);

#endif
