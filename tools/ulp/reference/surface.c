#include "reference/parts.h"

#include <math.h>

static const real PI = 3.14159265358979323846264338327950288L;

static void tangents(Real3 n, Real3 *t1, Real3 *t2)
{
    const Real3 up = fabsl(n.y) > 0.9L ? real3(0, 0, -1) : real3(0, 1, 0);
    *t1 = real3_normalize(real3_cross(up, n));
    *t2 = real3_cross(n, *t1);
}

static real turn(real y, real x)
{
    const real a = atan2l(y, x) / (2 * PI);
    return a < 0 ? a + 1 : a;
}

int reference_pieces(const Shape *shape)
{
    switch (shape->kind) {
    case SHAPE_BOX:
        return 6;
    case SHAPE_TETRAHEDRON:
        return 4;
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return 3;
    default:
        return 1;
    }
}

static void barycentric(Real3 a, Real3 b, Real3 c, Real3 p, real uv[2])
{
    const Real3 n = real3_cross(real3_sub(b, a), real3_sub(c, a));
    const real nn = real3_dot(n, n);
    uv[0] = real3_dot(n, real3_cross(real3_sub(p, a), real3_sub(c, a))) / nn;
    uv[1] = real3_dot(n, real3_cross(real3_sub(b, a), real3_sub(p, a))) / nn;
}

static bool round_piece(const Shape *shape, int k, Real3 p, real *distance, Real3 *normal, real uv[2])
{
    const Round r = round_of(shape);
    const Real3 f = real3_sub(p, r.base);
    const real z = real3_dot(f, r.axis);
    const Real3 out = real3_sub(f, real3_scale(r.axis, z));
    const real rho = real3_length(out);
    Real3 t1, t2;
    if (k == 0) {
        const real cosine = 1 / sqrtl(1 + r.slope * r.slope);
        tangents(r.axis, &t1, &t2);
        *distance = (rho - r.base_radius - r.slope * z) * cosine;
        *normal = real3_sub(real3_scale(out, cosine / rho), real3_scale(r.axis, r.slope * cosine));
        uv[0] = turn(real3_dot(f, t2), real3_dot(f, t1));
        uv[1] = z / r.height;
        return true;
    }
    const real radius = k == 1 ? r.base_radius : r.top_radius;
    if (!r.caps || radius == 0)
        return false;
    *normal = k == 1 ? real3_scale(r.axis, -1) : r.axis;
    *distance = k == 1 ? -z : z - r.height;
    tangents(*normal, &t1, &t2);
    uv[0] = 0.5L + real3_dot(out, t1) / (2 * radius);
    uv[1] = 0.5L + real3_dot(out, t2) / (2 * radius);
    return true;
}

static void flat_piece(const Shape *shape, Real3 p, real *distance, Real3 *normal, real uv[2])
{
    Real3 point, t1, t2;
    flat_plane(shape, normal, &point);
    const Real3 q = real3_sub(p, point);
    *distance = real3_dot(q, *normal);
    tangents(*normal, &t1, &t2);
    uv[0] = real3_dot(q, t1);
    uv[1] = real3_dot(q, t2);
    if (shape->kind == SHAPE_DISK) {
        uv[0] = 0.5L + uv[0] / (2 * shape->as.disk.radius);
        uv[1] = 0.5L + uv[1] / (2 * shape->as.disk.radius);
    }
    if (shape->kind == SHAPE_TRIANGLE)
        barycentric(real3_from(shape->as.triangle.vertices[0]), real3_from(shape->as.triangle.vertices[1]),
                    real3_from(shape->as.triangle.vertices[2]), p, uv);
}

static void polyhedron_piece(const Shape *shape, int k, Real3 p, real *distance, Real3 *normal, real uv[2])
{
    real offset;
    Real3 t1, t2;
    if (shape->kind == SHAPE_BOX) {
        polyhedron_face(shape, k, normal, &offset);
        const Real3 min = real3_from(shape->as.box.min), size = real3_sub(real3_from(shape->as.box.max), min);
        const Real3 q = real3_sub(p, real3_add(min, real3_scale(size, 0.5L)));
        tangents(*normal, &t1, &t2);
        // The tangents are axes, so that their absolute product with the size is the extent.
        uv[0] = 0.5L + real3_dot(q, t1) / fabsl(real3_dot(size, t1));
        uv[1] = 0.5L + real3_dot(q, t2) / fabsl(real3_dot(size, t2));
    } else {
        const Vec3 *v = shape->as.tetrahedron.vertices;
        const int *f = tetrahedron_faces[k];
        polyhedron_face(shape, k, normal, &offset);
        barycentric(real3_from(v[f[0]]), real3_from(v[f[1]]), real3_from(v[f[2]]), p, uv);
    }
    *distance = real3_dot(p, *normal) - offset;
}

static void torus_piece(const Shape *shape, Real3 p, real *distance, Real3 *normal, real uv[2])
{
    const Real3 axis = real3_normalize(real3_from(shape->as.torus.axis));
    const Real3 f = real3_sub(p, real3_from(shape->as.torus.center));
    const real z = real3_dot(f, axis);
    const Real3 out = real3_sub(f, real3_scale(axis, z));
    const real rho = real3_length(out);
    const Real3 from_ring = real3_sub(f, real3_scale(out, shape->as.torus.major / rho));
    Real3 t1, t2;
    tangents(axis, &t1, &t2);
    *distance = real3_length(from_ring) - shape->as.torus.minor;
    *normal = real3_normalize(from_ring);
    uv[0] = turn(real3_dot(f, t2), real3_dot(f, t1));
    uv[1] = turn(z, rho - shape->as.torus.major);
}

bool reference_piece(const Shape *shape, int k, Real3 p, real *distance, Real3 *normal, real uv[2])
{
    switch (shape->kind) {
    case SHAPE_SPHERE: {
        const Real3 f = real3_sub(p, real3_from(shape->as.sphere.center));
        *distance = real3_length(f) - shape->as.sphere.radius;
        *normal = real3_normalize(f);
        uv[0] = 0.5L + atan2l(normal->x, normal->z) / (2 * PI);
        uv[1] = 1 - atan2l(hypotl(normal->x, normal->z), normal->y) / PI;
        return true;
    }
    case SHAPE_BOX:
    case SHAPE_TETRAHEDRON:
        polyhedron_piece(shape, k, p, distance, normal, uv);
        return true;
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return round_piece(shape, k, p, distance, normal, uv);
    case SHAPE_TORUS:
        torus_piece(shape, p, distance, normal, uv);
        return true;
    default:
        flat_piece(shape, p, distance, normal, uv);
        return true;
    }
}
