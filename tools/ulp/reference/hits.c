#include "reference/parts.h"

#include <math.h>

Real3 real3(double x, double y, double z) { return (Real3){x, y, z}; }
Real3 real3_add(Real3 a, Real3 b) { return (Real3){a.x + b.x, a.y + b.y, a.z + b.z}; }
Real3 real3_sub(Real3 a, Real3 b) { return (Real3){a.x - b.x, a.y - b.y, a.z - b.z}; }
Real3 real3_scale(Real3 a, real s) { return (Real3){a.x * s, a.y * s, a.z * s}; }
real real3_dot(Real3 a, Real3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
real real3_length(Real3 a) { return sqrtl(real3_dot(a, a)); }
Real3 real3_normalize(Real3 a) { return real3_scale(a, 1 / real3_length(a)); }

Real3 real3_cross(Real3 a, Real3 b)
{
    return (Real3){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

Real3 real3_from(Vec3 a) { return (Real3){a.x, a.y, a.z}; }

RealMap real_map_inverse(const Affine *m)
{
    const Real3 a = real3_from(m->row[0]), b = real3_from(m->row[1]), c = real3_from(m->row[2]);
    const Real3 bc = real3_cross(b, c), ca = real3_cross(c, a), ab = real3_cross(a, b);
    const real inverse = 1 / real3_dot(a, bc);
    return (RealMap){
        .row = {real3_scale((Real3){bc.x, ca.x, ab.x}, inverse),
                real3_scale((Real3){bc.y, ca.y, ab.y}, inverse),
                real3_scale((Real3){bc.z, ca.z, ab.z}, inverse)},
        .origin = real3_from(m->translation),
    };
}

Real3 real_map_direction(const RealMap *map, Real3 d)
{
    return (Real3){real3_dot(map->row[0], d), real3_dot(map->row[1], d), real3_dot(map->row[2], d)};
}

Real3 real_map_point(const RealMap *map, Real3 p)
{
    return real_map_direction(map, real3_sub(p, map->origin));
}

static real first_of(const real *roots, int count, real tmin)
{
    real best = INFINITY;
    for (int i = 0; i < count; ++i)
        if (roots[i] > tmin && roots[i] < best)
            best = roots[i];
    return best;
}

// Roots of a t^2 + 2 b t + c.
static int quadratic(real a, real b, real c, real roots[2])
{
    const real discriminant = b * b - a * c;
    if (a == 0 || discriminant < 0)
        return 0;
    const real q = -(b + copysignl(sqrtl(discriminant), b));
    roots[0] = q / a;
    roots[1] = q != 0 ? c / q : 0;
    return 2;
}

// A convex solid as the common part of what narrows [near, far].
typedef struct Range {
    real near, far;
} Range;

static void range_plane(Range *range, Real3 outward, real offset, Real3 o, Real3 d)
{
    const real height = real3_dot(outward, o) - offset, rate = real3_dot(outward, d);
    if (rate == 0) {
        if (height > 0)
            *range = (Range){INFINITY, -INFINITY};
    } else if (rate < 0) {
        range->near = fmaxl(range->near, -height / rate);
    } else {
        range->far = fminl(range->far, -height / rate);
    }
}

static real range_first(Range range, real tmin)
{
    if (!(range.near <= range.far))
        return INFINITY;
    return range.near > tmin ? range.near : range.far > tmin ? range.far : INFINITY;
}

// ---- polyhedra --------------------------------------------------------------------------------

// Face k of a box: outward normal and offset.
static void box_face(const Shape *shape, int k, Real3 *normal, real *offset)
{
    const Real3 min = real3_from(shape->as.box.min), max = real3_from(shape->as.box.max);
    const real side = k & 1 ? 1 : -1;
    const Real3 corner = k & 1 ? max : min;
    *normal = k / 2 == 0 ? (Real3){side, 0, 0} : k / 2 == 1 ? (Real3){0, side, 0} : (Real3){0, 0, side};
    *offset = real3_dot(*normal, corner);
}

// Vertices of the faces abc, abd, acd, bcd, and the vertex opposite.
const int tetrahedron_faces[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};

static void tetrahedron_face(const Shape *shape, int k, Real3 *normal, real *offset)
{
    const Vec3 *v = shape->as.tetrahedron.vertices;
    const int *f = tetrahedron_faces[k];
    const Real3 a = real3_from(v[f[0]]), b = real3_from(v[f[1]]), c = real3_from(v[f[2]]),
                other = real3_from(v[f[3]]);
    *normal = real3_normalize(real3_cross(real3_sub(b, a), real3_sub(c, a)));
    if (real3_dot(*normal, real3_sub(other, a)) > 0)
        *normal = real3_scale(*normal, -1);
    *offset = real3_dot(*normal, a);
}

void polyhedron_face(const Shape *shape, int k, Real3 *normal, real *offset)
{
    (shape->kind == SHAPE_BOX ? box_face : tetrahedron_face)(shape, k, normal, offset);
}

static real polyhedron_hit(const Shape *shape, Real3 o, Real3 d, real grow, real tmin)
{
    Range range = {-INFINITY, INFINITY};
    for (int k = 0; k < reference_pieces(shape); ++k) {
        Real3 normal;
        real offset;
        polyhedron_face(shape, k, &normal, &offset);
        range_plane(&range, normal, offset + grow, o, d);
    }
    return range_first(range, tmin);
}

// ---- flat shapes ------------------------------------------------------------------------------

static Real3 triangle_normal(const Shape *shape)
{
    const Vec3 *v = shape->as.triangle.vertices;
    const Real3 a = real3_from(v[0]);
    return real3_normalize(real3_cross(real3_sub(real3_from(v[1]), a), real3_sub(real3_from(v[2]), a)));
}

static bool triangle_contains(const Shape *shape, Real3 p, real grow)
{
    const Real3 n = triangle_normal(shape);
    for (int i = 0; i < 3; ++i) {
        const Real3 a = real3_from(shape->as.triangle.vertices[i]);
        const Real3 b = real3_from(shape->as.triangle.vertices[(i + 1) % 3]);
        const Real3 inward = real3_normalize(real3_cross(n, real3_sub(b, a)));
        if (real3_dot(inward, real3_sub(p, a)) < -grow)
            return false;
    }
    return true;
}

void flat_plane(const Shape *shape, Real3 *normal, Real3 *point)
{
    if (shape->kind == SHAPE_PLANE) {
        *normal = real3_normalize(real3_from(shape->as.plane.normal));
        *point = real3_from(shape->as.plane.point);
    } else if (shape->kind == SHAPE_DISK) {
        *normal = real3_normalize(real3_from(shape->as.disk.normal));
        *point = real3_from(shape->as.disk.center);
    } else {
        *normal = triangle_normal(shape);
        *point = real3_from(shape->as.triangle.vertices[0]);
    }
}

static real flat_first(const Shape *shape, Real3 o, Real3 d, real grow, real tmin)
{
    Real3 normal, point;
    flat_plane(shape, &normal, &point);
    const real t = real3_dot(normal, real3_sub(point, o)) / real3_dot(normal, d);
    const Real3 p = real3_add(o, real3_scale(d, t));
    if (!(t > tmin && t < INFINITY))
        return INFINITY;
    if (shape->kind == SHAPE_DISK && real3_length(real3_sub(p, point)) > shape->as.disk.radius + grow)
        return INFINITY;
    if (shape->kind == SHAPE_TRIANGLE && !triangle_contains(shape, p, grow))
        return INFINITY;
    return t;
}

// ---- solids of revolution ---------------------------------------------------------------------

Round round_of(const Shape *shape)
{
    const bool cone = shape->kind == SHAPE_CONE;
    const Real3 base = real3_from(cone ? shape->as.cone.base : shape->as.cylinder.base);
    const Real3 top = real3_from(cone ? shape->as.cone.top : shape->as.cylinder.top);
    Round r = {.base = base, .caps = cone ? shape->as.cone.caps : shape->as.cylinder.caps};
    r.height = real3_length(real3_sub(top, base));
    r.axis = real3_scale(real3_sub(top, base), 1 / r.height);
    r.base_radius = cone ? shape->as.cone.radius : shape->as.cylinder.radius;
    r.top_radius = cone ? shape->as.cone.top_radius : shape->as.cylinder.radius;
    r.slope = (r.top_radius - r.base_radius) / r.height;
    return r;
}

static real round_hit(const Shape *shape, Real3 o, Real3 d, real grow, real longer, real tmin)
{
    const Round r = round_of(shape);
    const Real3 f = real3_sub(o, r.base);
    const real oz = real3_dot(f, r.axis), dz = real3_dot(d, r.axis);
    const Real3 ox = real3_sub(f, real3_scale(r.axis, oz)), dx = real3_sub(d, real3_scale(r.axis, dz));
    const real radius = r.base_radius + r.slope * oz + grow * sqrtl(1 + r.slope * r.slope),
               rate = r.slope * dz;
    real roots[4];
    int count = quadratic(real3_dot(dx, dx) - rate * rate, real3_dot(ox, dx) - radius * rate,
                          real3_dot(ox, ox) - radius * radius, roots);
    int kept = 0;
    for (int i = 0; i < count; ++i) {
        const real z = oz + dz * roots[i];
        if (z >= -longer && z <= r.height + longer && radius + rate * roots[i] >= 0)
            roots[kept++] = roots[i];
    }
    for (int end = 0; r.caps && dz != 0 && end < 2; ++end) {
        const real z = end ? r.height + longer : -longer, t = (z - oz) / dz;
        if (real3_length(real3_add(ox, real3_scale(dx, t))) <= fmaxl(radius + rate * t, 0))
            roots[kept++] = t;
    }
    return first_of(roots, kept, tmin);
}

static real polynomial(const real *c, int degree, real x)
{
    real value = c[degree];
    for (int i = degree - 1; i >= 0; --i)
        value = value * x + c[i];
    return value;
}

// Real roots in [low, high], between those of the derivative.
static int polynomial_roots(const real *c, int degree, real low, real high, real *roots)
{
    if (degree == 0)
        return 0;
    real slope[5], places[6] = {low};
    for (int i = 0; i < degree; ++i)
        slope[i] = c[i + 1] * (real)(i + 1);
    const int inner = polynomial_roots(slope, degree - 1, low, high, places + 1);
    places[inner + 1] = high;
    int count = 0;
    for (int i = 0; i <= inner; ++i) {
        real a = places[i], b = places[i + 1];
        const bool rising = polynomial(c, degree, a) < 0;
        if ((polynomial(c, degree, b) < 0) == rising)
            continue;
        for (int k = 0; k < 68; ++k) {
            const real middle = (a + b) / 2;
            *((polynomial(c, degree, middle) < 0) == rising ? &a : &b) = middle;
        }
        roots[count++] = (a + b) / 2;
    }
    return count;
}

static real torus_hit(const Shape *shape, Real3 o, Real3 d, real grow, real tmin)
{
    const Real3 axis = real3_normalize(real3_from(shape->as.torus.axis));
    const real major = shape->as.torus.major, minor = shape->as.torus.minor + grow;
    const real length = real3_length(d), reach = (major + minor) * 1.001L;
    const Real3 u = real3_scale(d, 1 / length);
    Real3 f = real3_sub(o, real3_from(shape->as.torus.center));
    const real shift = -real3_dot(f, u);
    f = real3_add(f, real3_scale(u, shift));
    const real ff = real3_dot(f, f), fu = real3_dot(f, u), chord = reach * reach - ff;
    if (chord <= 0 || minor < 0)
        return INFINITY;
    // (s^2 + 2 fu s + k)^2 - 4 major^2 rho^2
    const real k = ff + major * major - minor * minor, fz = real3_dot(f, axis), uz = real3_dot(u, axis);
    const real m = 4 * major * major;
    const real c[5] = {k * k - m * (ff - fz * fz), 4 * fu * k - 2 * m * (fu - fz * uz),
                       4 * fu * fu + 2 * k - m * (1 - uz * uz), 4 * fu, 1};
    real roots[4];
    const int count = polynomial_roots(c, 4, -sqrtl(chord), sqrtl(chord), roots);
    for (int i = 0; i < count; ++i)
        roots[i] = (roots[i] + shift) / length;
    return first_of(roots, count, tmin);
}

real reference_hit(const Shape *shape, Real3 o, Real3 d, real grow, real longer, real tmin)
{
    switch (shape->kind) {
    case SHAPE_SPHERE: {
        const Real3 f = real3_sub(o, real3_from(shape->as.sphere.center));
        const real r = shape->as.sphere.radius + grow;
        real roots[2];
        const int count = quadratic(real3_dot(d, d), real3_dot(f, d), real3_dot(f, f) - r * r, roots);
        return r < 0 ? (real)INFINITY : first_of(roots, count, tmin);
    }
    case SHAPE_BOX:
    case SHAPE_TETRAHEDRON:
        return polyhedron_hit(shape, o, d, grow, tmin);
    case SHAPE_PLANE:
    case SHAPE_DISK:
    case SHAPE_TRIANGLE:
        return flat_first(shape, o, d, grow, tmin);
    case SHAPE_CYLINDER:
    case SHAPE_CONE:
        return round_hit(shape, o, d, grow, longer, tmin);
    case SHAPE_TORUS:
        return torus_hit(shape, o, d, grow, tmin);
    case SHAPE_MESH:
        break;
    }
    return INFINITY;
}
