// Canonical forms: kinds, bounds that hold the shape and little else, numbers that describe it.
#include "layout/bake.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <cmocka.h>

enum { SHAPE_COUNT = SHAPE_MESH, ROUNDS = 60, POINTS = 4000 };

static const Vec3 origin = {0, 0, 0};

static double random_in(uint64_t *state, double low, double high)
{
    *state += 0x9e3779b97f4a7c15u;
    uint64_t x = *state;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return low + (high - low) * (double)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

static Vec3 random_vec(uint64_t *state, double extent)
{
    const double x = random_in(state, -extent, extent), y = random_in(state, -extent, extent);
    return (Vec3){x, y, random_in(state, -extent, extent)};
}

static Shape random_shape(ShapeKind kind, uint64_t *state)
{
    Shape s = {.kind = kind};
    const Vec3 c = random_vec(state, 2), other = vec_add(c, random_vec(state, 1));
    const double r = random_in(state, 0.1, 1);
    switch (kind) {
    case SHAPE_SPHERE:
        s.as.sphere.center = c;
        s.as.sphere.radius = r;
        break;
    case SHAPE_PLANE:
        s.as.plane.point = c;
        s.as.plane.normal = random_vec(state, 1);
        break;
    case SHAPE_BOX:
        s.as.box.min = c;
        s.as.box.max = vec_add(c, (Vec3){r, random_in(state, 0.1, 1), 0.5});
        break;
    case SHAPE_TETRAHEDRON:
    case SHAPE_TRIANGLE:
        for (int i = 0; i < (kind == SHAPE_TRIANGLE ? 3 : 4); ++i) {
            Vec3 *v = kind == SHAPE_TRIANGLE ? s.as.triangle.vertices : s.as.tetrahedron.vertices;
            v[i] = vec_add(c, random_vec(state, 1));
        }
        break;
    case SHAPE_DISK:
        s.as.disk.center = c;
        s.as.disk.normal = random_vec(state, 1);
        s.as.disk.radius = r;
        break;
    case SHAPE_CYLINDER:
        s.as.cylinder.base = c;
        s.as.cylinder.top = other;
        s.as.cylinder.radius = r;
        s.as.cylinder.caps = true;
        break;
    case SHAPE_CONE:
        s.as.cone.base = c;
        s.as.cone.top = other;
        s.as.cone.radius = r;
        s.as.cone.top_radius = random_in(state, -0.5, 1);
        s.as.cone.top_radius = fmax(s.as.cone.top_radius, 0);
        s.as.cone.caps = true;
        break;
    case SHAPE_TORUS:
        s.as.torus.center = c;
        s.as.torus.axis = random_vec(state, 1);
        s.as.torus.major = r;
        s.as.torus.minor = r * random_in(state, 0.05, 1);
        break;
    case SHAPE_MESH:
        break;
    }
    return s;
}

static void any_tangents(Vec3 n, Vec3 *a, Vec3 *b)
{
    *a = vec_normalize(vec_cross(fabs(n.x) > 0.5 ? (Vec3){0, 1, 0} : (Vec3){1, 0, 0}, n));
    *b = vec_cross(n, *a);
}

// A point of the surface in the shape's own coordinates, from its description.
static Vec3 surface_point(const Shape *s, uint64_t *state)
{
    const double angle = random_in(state, 0, 6.283185307179586), share = random_in(state, 0, 1);
    Vec3 x, y;
    switch (s->kind) {
    case SHAPE_SPHERE: {
        const double z = random_in(state, -1, 1), w = sqrt(1 - z * z);
        return vec_add(s->as.sphere.center,
                       vec_scale((Vec3){w * cos(angle), w * sin(angle), z}, s->as.sphere.radius));
    }
    case SHAPE_PLANE: {
        any_tangents(vec_normalize(s->as.plane.normal), &x, &y);
        return vec_add(s->as.plane.point, vec_add(vec_scale(x, 10 * share), vec_scale(y, 10 * cos(angle))));
    }
    case SHAPE_BOX: {
        const Vec3 size = vec_sub(s->as.box.max, s->as.box.min);
        return vec_add(s->as.box.min,
                       (Vec3){size.x * share, size.y * random_in(state, 0, 1), size.z * (angle > 3 ? 1 : 0)});
    }
    case SHAPE_TETRAHEDRON:
    case SHAPE_TRIANGLE: {
        const Vec3 *v = s->kind == SHAPE_TRIANGLE ? s->as.triangle.vertices : s->as.tetrahedron.vertices;
        const int skip = s->kind == SHAPE_TRIANGLE ? 3 : (int)(angle / 1.58);
        Vec3 corner[4];
        for (int i = 0, k = 0; k < 3; ++i)
            if (i != skip)
                corner[k++] = v[i];
        const double a = random_in(state, 0, 1) * (1 - share);
        return vec_add(vec_scale(corner[0], share),
                       vec_add(vec_scale(corner[1], a), vec_scale(corner[2], 1 - share - a)));
    }
    case SHAPE_DISK:
        any_tangents(vec_normalize(s->as.disk.normal), &x, &y);
        return vec_add(s->as.disk.center,
                       vec_scale(vec_add(vec_scale(x, cos(angle)), vec_scale(y, sin(angle))),
                                 s->as.disk.radius * sqrt(share)));
    case SHAPE_CYLINDER:
    case SHAPE_CONE: {
        const bool cone = s->kind == SHAPE_CONE;
        const Vec3 base = cone ? s->as.cone.base : s->as.cylinder.base,
                   top = cone ? s->as.cone.top : s->as.cylinder.top;
        const double r0 = cone ? s->as.cone.radius : s->as.cylinder.radius,
                     r1 = cone ? s->as.cone.top_radius : r0;
        any_tangents(vec_normalize(vec_sub(top, base)), &x, &y);
        return vec_add(
            vec_add(base, vec_scale(vec_sub(top, base), share)),
            vec_scale(vec_add(vec_scale(x, cos(angle)), vec_scale(y, sin(angle))), r0 + (r1 - r0) * share));
    }
    case SHAPE_TORUS: {
        const Vec3 n = vec_normalize(s->as.torus.axis);
        any_tangents(n, &x, &y);
        const Vec3 out = vec_add(vec_scale(x, cos(angle)), vec_scale(y, sin(angle)));
        const double turn = share * 6.283185307179586;
        return vec_add(s->as.torus.center,
                       vec_add(vec_scale(out, s->as.torus.major + s->as.torus.minor * cos(turn)),
                               vec_scale(n, s->as.torus.minor * sin(turn))));
    }
    case SHAPE_MESH:
        break;
    }
    return origin;
}

static Affine random_map(uint64_t *state)
{
    const double s = pow(10, random_in(state, -4, 4));
    const Vec3 factors = {s * random_in(state, 0.2, 2), -s * random_in(state, 0.2, 2), s};
    return affine_compose(
        affine_translate(vec_scale(random_vec(state, 10), s)),
        affine_compose(affine_rotate(random_vec(state, 1), random_in(state, 0, 360)),
                       affine_compose(affine_scale(factors), affine_rotate(random_vec(state, 1), 30))));
}

static f64 row_dot(f32x4 row, Vec3 p) { return (f64)row.x * p.x + (f64)row.y * p.y + (f64)row.z * p.z; }

static Vec3 local_point(const Primitive *b, Vec3 p)
{
    const Vec3 f = {p.x - (f64)b->row0.w, p.y - (f64)b->row1.w, p.z - (f64)b->row2.w};
    return (Vec3){row_dot(b->row0, f), row_dot(b->row1, f), row_dot(b->row2, f)};
}

// How far p is off the surface that the numbers of the primitive describe, in units of the canonical space.
static f64 canonical_miss(const Primitive *b, Vec3 p)
{
    const Vec3 q = local_point(b, p);
    const Vec3 plain = {row_dot(b->row0, p) + (f64)b->row0.w, row_dot(b->row1, p) + (f64)b->row1.w,
                        row_dot(b->row2, p) + (f64)b->row2.w};
    const f64 p0 = b->p0, p1 = b->p1, rho = hypot(q.x, q.y);
    switch (b->kind) {
    case PRIMITIVE_SPHERE:
        return vec_length(q) / p0 - 1;
    case PRIMITIVE_ELLIPSOID:
        return vec_length(q) - 1;
    case PRIMITIVE_PLANE:
    case PRIMITIVE_DISK:
        return (row_dot(b->row2, p) - p0) / (fabs(p0) + vec_length(p));
    case PRIMITIVE_BOX:
        return fmax(fmax(fabs(2 * row_dot(b->row0, p) - (f64)b->row0.w - p0) + (f64)b->row0.w - p0,
                         fabs(2 * row_dot(b->row1, p) - (f64)b->row1.w - p1) + (f64)b->row1.w - p1),
                    fabs(2 * row_dot(b->row2, p) - (f64)b->row2.w - (f64)b->p2) + (f64)b->row2.w -
                        (f64)b->p2) /
               2;
    case PRIMITIVE_TETRAHEDRON: {
        const f64 a = p0 - row_dot(b->row0, p) - row_dot(b->row1, p) - row_dot(b->row2, p);
        return fmin(fmin(plain.x, plain.y), fmin(plain.z, a));
    }
    case PRIMITIVE_CYLINDER:
        return fabs(rho - 1) + fmax(fabs(q.z) - 1, 0);
    case PRIMITIVE_CONE:
        return fabs(rho - (1 - p1 * (q.z + 1) / 2)) + fmax(fabs(q.z) - 1, 0);
    case PRIMITIVE_TORUS:
        return hypot(rho - 1, q.z) - p0;
    case PRIMITIVE_TRIANGLE:
        return ((f64)b->row0.w * p.x + (f64)b->row1.w * p.y + (f64)b->row2.w * p.z - p1) / vec_length(p);
    default:
        return INFINITY;
    }
}

// What rounding the primitive's numbers may change of that: a thin shape far from the origin is known up to
// the rounding of its place.
static f64 canonical_rounding(const Primitive *b, Vec3 p)
{
    const Vec3 r0 = {b->row0.x, b->row0.y, b->row0.z}, r1 = {b->row1.x, b->row1.y, b->row1.z};
    const Vec3 r2 = {b->row2.x, b->row2.y, b->row2.z};
    const bool plane =
        b->kind == PRIMITIVE_PLANE || b->kind == PRIMITIVE_DISK || b->kind == PRIMITIVE_TRIANGLE;
    const f64 rows = vec_length(r0) + vec_length(r1) + vec_length(r2);
    const f64 unit = b->kind == PRIMITIVE_SPHERE ? (f64)b->p0 : 1;
    return plane ? 0x1p-22 : 0x1p-23 * rows * vec_length(p) / unit;
}

static Primitive bake(const Shape *shape, Affine map, BakedBounds *bounds)
{
    Primitive p = {.kind = 77};
    Error error;
    assert_true(bake_shape(shape, &map, &p, bounds, &error));
    return p;
}

static void bounds_hold_the_shape_tightly(void **state)
{
    (void)state;
    uint64_t random = 1;
    for (int kind = 0; kind < SHAPE_COUNT; ++kind)
        for (int round = 0; round < ROUNDS; ++round) {
            const Shape shape = random_shape((ShapeKind)kind, &random);
            const Affine map = random_map(&random);
            BakedBounds bounds;
            const Primitive p = bake(&shape, map, &bounds);
            Vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
            for (int i = 0; i < POINTS; ++i) {
                const Vec3 at = affine_point(map, surface_point(&shape, &random));
                low = (Vec3){fmin(low.x, at.x), fmin(low.y, at.y), fmin(low.z, at.z)};
                high = (Vec3){fmax(high.x, at.x), fmax(high.y, at.y), fmax(high.z, at.z)};
                assert_true(fabs(canonical_miss(&p, at)) <= 1e-6 + canonical_rounding(&p, at));
            }
            assert_true(low.x >= bounds.min.x && low.y >= bounds.min.y && low.z >= bounds.min.z);
            assert_true(high.x <= bounds.max.x && high.y <= bounds.max.y && high.z <= bounds.max.z);
            if (kind == SHAPE_PLANE) {
                assert_true(isinf(bounds.min.x) && isinf(bounds.max.z));
                continue;
            }
            const Vec3 slack = vec_scale(vec_sub(high, low), 0.12);
            assert_true(low.x - bounds.min.x <= slack.x && bounds.max.x - high.x <= slack.x);
            assert_true(low.y - bounds.min.y <= slack.y && bounds.max.y - high.y <= slack.y);
            assert_true(low.z - bounds.min.z <= slack.z && bounds.max.z - high.z <= slack.z);
        }
}

static void spheres_stay_spheres_under_similarities(void **state)
{
    (void)state;
    const Shape s = {.kind = SHAPE_SPHERE, .as.sphere = {{1, 2, 3}, 2}};
    BakedBounds bounds;
    const Affine turned = affine_compose(affine_rotate((Vec3){1, 2, 3}, 77), affine_scale((Vec3){-3, 3, 3}));
    Primitive p = bake(&s, affine_compose(affine_translate((Vec3){50, 0, 0}), turned), &bounds);
    assert_int_equal(p.kind, PRIMITIVE_SPHERE);
    assert_true(p.p0 == 6);
    p = bake(&s, affine_scale((Vec3){3, 3, 3.001}), &bounds);
    assert_int_equal(p.kind, PRIMITIVE_ELLIPSOID);
    // The ground of a planet below a camera: |c|^2 - r^2 without cancellation.
    const Shape planet = {.kind = SHAPE_SPHERE, .as.sphere = {{0, -6.4e6, 0}, 6.4e6}};
    p = bake(&planet, affine_translate((Vec3){0, -1.7, 0}), &bounds);
    assert_int_equal(p.kind, PRIMITIVE_GIANT_SPHERE);
    assert_true(fabs((f64)p.p1 / (1.7 * (12.8e6 + 1.7)) - 1) < 1e-7);
    p = bake(&planet, affine_translate((Vec3){0, 3e6, 0}), &bounds);
    assert_int_equal(p.kind, PRIMITIVE_SPHERE);
}

static void normals_and_windings_keep_their_side(void **state)
{
    (void)state;
    const Shape s = {.kind = SHAPE_TRIANGLE, .as.triangle.vertices = {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}}};
    BakedBounds bounds;
    Primitive p = bake(&s, affine_identity(), &bounds);
    assert_true(p.row0.w == 0 && p.row1.w == 0 && p.row2.w == 1 && p.p1 == -1);
    // Mirrored along z, the side that looked to +z looks to -z.
    p = bake(&s, affine_scale((Vec3){1, 1, -1}), &bounds);
    assert_true(p.row2.w == -1 && p.p1 == -1);
    // Mirrored along x, it still looks to +z, against the winding of the vertices.
    p = bake(&s, affine_scale((Vec3){-1, 1, 1}), &bounds);
    assert_true(p.row2.w == 1 && p.p1 == -1);
    const Shape plane = {.kind = SHAPE_PLANE, .as.plane = {{0, 2, 0}, {0, 3, 0}}};
    p = bake(&plane, affine_scale((Vec3){1, -2, 1}), &bounds);
    assert_true(p.row2.x == 0 && p.row2.y == -1 && p.row2.z == 0 && p.p0 == 4);
}

static void near_faces_of_boxes_are_exact(void **state)
{
    (void)state;
    const Shape s = {.kind = SHAPE_BOX, .as.box = {{-1e6, -1000, -1e6}, {1e6, -1.7, 1e6}}};
    BakedBounds bounds;
    const Primitive p = bake(&s, affine_identity(), &bounds);
    // The top is as good as a float can tell, and the same number as a plane's there.
    assert_true(p.row1.x == 0 && p.row1.y == 1 && p.row1.z == 0 && p.p1 == -1.7f && p.row1.w == -1000);
    const Shape plane = {.kind = SHAPE_PLANE, .as.plane = {{0, -1.7, 0}, {0, 1, 0}}};
    BakedBounds none;
    assert_true(bake(&plane, affine_identity(), &none).p0 == p.p1);
    assert_true(bounds.max.y >= -1.7 && bounds.max.y < -1.69);
}

static void coordinates_of_planes_are_whole_and_rest(void **state)
{
    (void)state;
    static const f64 places[] = {0, 0.25, -0.25, 1e6 + 0.5, 8388608.5, 16777217, -16777217.25, 3e9, -1e-9};
    for (size_t i = 0; i < sizeof places / sizeof *places; ++i) {
        f32 whole, rest;
        bake_split_whole(places[i], &whole, &rest);
        assert_true(floor((f64)whole) == (f64)whole);
        // Small numbers on either side of 0 keep all their digits.
        const f64 x = fabs(places[i]), slack = x < 0.5 ? x * 0x1p-24 : x * 0x1p-40 + 0x1p-26;
        assert_true(fabs((f64)whole + (f64)rest - places[i]) <= slack);
    }
    const Shape plane = {.kind = SHAPE_PLANE, .as.plane = {{1, 2, 3}, {0, 1, 0}}};
    BakedBounds bounds;
    const Primitive p = bake(&plane, affine_translate((Vec3){-0.5, 0, 10}), &bounds);
    // u = x - 1 and v = 3 - z of the object; space is half a unit left and ten back.
    assert_true(p.row0.x == 1 && p.row0.w + p.row1.w == -0.5f && fabsf(p.row1.w) == 0.5f);
    assert_true(p.row1.z == -1 && p.row2.w == 13 && p.p1 == 0);
}

static void frames_lead_back_to_the_object(void **state)
{
    (void)state;
    uint64_t random = 3;
    for (int i = 0; i < 200; ++i) {
        const Affine map = random_map(&random);
        ObjectFrame f;
        Error error;
        assert_true(bake_object_frame(&map, &f, &error));
        const Vec3 p = random_vec(&random, 5), n = vec_normalize(random_vec(&random, 1)),
                   at = affine_point(map, p);
        const Vec3 back = {row_dot(f.row0, at) + (f64)f.row0.w + (f64)f.normal0.w,
                           row_dot(f.row1, at) + (f64)f.row1.w + (f64)f.normal1.w,
                           row_dot(f.row2, at) + (f64)f.row2.w + (f64)f.normal2.w};
        assert_true(vec_length(vec_sub(back, p)) < 1e-4);
        const Vec3 carried = affine_normal(map, n);
        const Vec3 normal = {row_dot(f.normal0, carried), row_dot(f.normal1, carried),
                             row_dot(f.normal2, carried)};
        assert_true(vec_length(vec_sub(vec_normalize(normal), n)) < 1e-5);
        assert_true(floor((f64)f.row0.w) == (f64)f.row0.w);
    }
}

static void numbers_out_of_range_are_errors(void **state)
{
    (void)state;
    const Shape s = {.kind = SHAPE_SPHERE, .as.sphere = {{1, 2, 3}, 2}};
    const Shape box = {.kind = SHAPE_BOX, .as.box = {{0, 0, 0}, {1e-10, 1, 1}}};
    Primitive p = {0};
    BakedBounds bounds;
    Error error;
    const Affine huge = affine_scale((Vec3){2e38, 2e38, 2e38}),
                 tiny = affine_scale((Vec3){1e-35, 1e-35, 1e-35});
    const Affine moved = affine_translate((Vec3){1e39, 0, 0});
    assert_false(bake_shape(&s, &huge, &p, &bounds, &error));
    assert_int_equal(error.code, ERROR_SCENE);
    assert_false(bake_shape(&s, &moved, &p, &bounds, &error));
    assert_false(bake_shape(&box, &tiny, &p, &bounds, &error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bounds_hold_the_shape_tightly),
        cmocka_unit_test(spheres_stay_spheres_under_similarities),
        cmocka_unit_test(normals_and_windings_keep_their_side),
        cmocka_unit_test(near_faces_of_boxes_are_exact),
        cmocka_unit_test(coordinates_of_planes_are_whole_and_rest),
        cmocka_unit_test(frames_lead_back_to_the_object),
        cmocka_unit_test(numbers_out_of_range_are_errors),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
