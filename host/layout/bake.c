#include "layout/bake.h"

#include <float.h>
#include <math.h>

// Half an ulp of 1 in float.
static const f64 ROUNDING = 1.0 / 16777216;
// A sphere whose surface passes the origin of the space by less than this share of its radius is giant.
// Above, rounding centre and radius moves the surface by less than 128 roundings of its distance.
static const f64 GIANT_SHARE = 1.0 / 64;
// How far from a similarity a transform of a sphere may be (relative, squared lengths) to count as one.
static const f64 SIMILARITY_TOLERANCE = 1e-10;

typedef struct Bake {
    Affine to_space;
    Primitive *out;
    BakedBounds *bounds;
} Bake;

static Vec3 vec_absolute(Vec3 a)
{
    return (Vec3){fabs(a.x), fabs(a.y), fabs(a.z)};
}

static Vec3 vec_largest(Vec3 a, Vec3 b)
{
    return (Vec3){fmax(a.x, b.x), fmax(a.y, b.y), fmax(a.z, b.z)};
}

static Vec3 vec_smallest(Vec3 a, Vec3 b)
{
    return (Vec3){fmin(a.x, b.x), fmin(a.y, b.y), fmin(a.z, b.z)};
}

// |m| a, every element taken absolute.
static Vec3 spread_by(Affine m, Vec3 a)
{
    return (Vec3){vec_dot(vec_absolute(m.row[0]), a), vec_dot(vec_absolute(m.row[1]), a),
                  vec_dot(vec_absolute(m.row[2]), a)};
}

static Vec3 transposed_direction(Affine m, Vec3 d)
{
    return vec_add(vec_scale(m.row[0], d.x), vec_add(vec_scale(m.row[1], d.y), vec_scale(m.row[2], d.z)));
}

static bool vec_axial(Vec3 a)
{
    return (a.x == 0) + (a.y == 0) + (a.z == 0) == 2;
}

// Length of a row's first two elements: half the extent of the image of the unit circle along an axis.
static f64 circle_extent(Vec3 row)
{
    return hypot(row.x, row.y);
}

// The tangents of the scene language's rule: right and up of somebody who faces the unit normal n.
static void tangents(Vec3 n, Vec3 *t1, Vec3 *t2)
{
    const Vec3 up = fabs(n.y) > 0.9 ? (Vec3){0, 0, -1} : (Vec3){0, 1, 0};
    *t1 = vec_normalize(vec_cross(up, n));
    *t2 = vec_cross(n, *t1);
}

// The map from a canonical space whose axes and origin are given in the shape's space.
static Affine frame(const Bake *bake, Vec3 x, Vec3 y, Vec3 z, Vec3 origin)
{
    const Affine local = {
        .row = {{x.x, y.x, z.x}, {x.y, y.y, z.y}, {x.z, y.z, z.z}},
        .translation = origin,
    };
    return affine_compose(bake->to_space, local);
}

static f32x4 row_of(Vec3 a, f64 w)
{
    return (f32x4){(f32)a.x, (f32)a.y, (f32)a.z, (f32)w};
}

static void set_rows(Primitive *out, const Vec3 row[3], Vec3 c)
{
    out->row0 = row_of(row[0], c.x);
    out->row1 = row_of(row[1], c.y);
    out->row2 = row_of(row[2], c.z);
}

static void set_bounds(BakedBounds *bounds, Vec3 center, Vec3 extent)
{
    bounds->min = vec_sub(center, extent);
    bounds->max = vec_add(center, extent);
}

// Widens the bounds by what rounding can move: coordinates by their size; and what a map of relative error
// ROUNDING an element, as rows or while it is applied, makes of points within `reach`.
static void pad_bounds(BakedBounds *bounds, Affine from_canonical, Affine to_canonical, Vec3 reach)
{
    const Vec3 far = vec_largest(vec_absolute(bounds->min), vec_absolute(bounds->max));
    const Vec3 moved = spread_by(from_canonical, spread_by(to_canonical, reach));
    const Vec3 pad = vec_scale(vec_add(far, moved), 8 * ROUNDING);
    bounds->min = vec_sub(bounds->min, pad);
    bounds->max = vec_add(bounds->max, pad);
}

static Vec3 half_extent(const BakedBounds *bounds)
{
    return vec_scale(vec_sub(bounds->max, bounds->min), 0.5);
}

static Vec3 farthest(const BakedBounds *bounds)
{
    return vec_largest(vec_absolute(bounds->min), vec_absolute(bounds->max));
}

// Common factor of a similarity's columns, 0 where m is none.
static f64 similarity_factor(Affine m)
{
    const Vec3 x = {m.row[0].x, m.row[1].x, m.row[2].x};
    const Vec3 y = {m.row[0].y, m.row[1].y, m.row[2].y};
    const Vec3 z = {m.row[0].z, m.row[1].z, m.row[2].z};
    const f64 s = vec_length(x);
    const Vec3 a = vec_scale(x, 1 / s), b = vec_scale(y, 1 / s), c = vec_scale(z, 1 / s);
    const f64 worst = fmax(fmax(fabs(vec_dot(a, b)), fmax(fabs(vec_dot(a, c)), fabs(vec_dot(b, c)))),
                           fmax(fabs(vec_dot(b, b) - 1), fabs(vec_dot(c, c) - 1)));
    return worst <= SIMILARITY_TOLERANCE ? s : 0;
}

static void bake_sphere(const Bake *bake, Vec3 center, f64 radius)
{
    const f64 r = radius;
    const Affine map = frame(bake, (Vec3){r, 0, 0}, (Vec3){0, r, 0}, (Vec3){0, 0, r}, center);
    const Affine inverse = affine_inverse(map);
    const f64 s = similarity_factor(map);
    Primitive *out = bake->out;
    const Vec3 c = map.translation;
    const Vec3 extent = {vec_length(map.row[0]), vec_length(map.row[1]), vec_length(map.row[2])};
    set_bounds(bake->bounds, c, extent);
    pad_bounds(bake->bounds, map, inverse, half_extent(bake->bounds));
    if (s == 0) {
        out->kind = PRIMITIVE_ELLIPSOID;
        set_rows(out, inverse.row, c);
        return;
    }
    const Vec3 axes[3] = {vec_scale(inverse.row[0], s), vec_scale(inverse.row[1], s),
                          vec_scale(inverse.row[2], s)};
    const f64 distance = vec_length(c);
    set_rows(out, axes, c);
    out->kind = PRIMITIVE_SPHERE;
    out->p0 = (f32)s;
    if (fabs(distance - s) < GIANT_SHARE * s) {
        out->kind = PRIMITIVE_GIANT_SPHERE;
        out->p1 = (f32)((distance - s) * (distance + s));
    }
}

static void bake_plane(const Bake *bake, Vec3 point, Vec3 normal)
{
    Vec3 t1, t2;
    tangents(vec_normalize(normal), &t1, &t2);
    const Affine inverse = affine_inverse(bake->to_space);
    const Vec3 n = affine_normal(bake->to_space, normal);
    // q.t of an object-space point is the gradient A^T t times p, and a constant.
    const Vec3 gradient1 = transposed_direction(inverse, t1), gradient2 = transposed_direction(inverse, t2);
    const Vec3 from_point = vec_sub(inverse.translation, point);
    f32 u_whole, u_rest, v_whole, v_rest;
    bake_split_whole(vec_dot(from_point, t1), &u_whole, &u_rest);
    bake_split_whole(vec_dot(from_point, t2), &v_whole, &v_rest);
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_PLANE;
    out->row0 = row_of(gradient1, u_whole);
    out->row1 = row_of(gradient2, u_rest);
    out->row2 = row_of(n, v_whole);
    out->p0 = (f32)vec_dot(n, affine_point(bake->to_space, point));
    out->p1 = v_rest;
    bake->bounds->min = (Vec3){-INFINITY, -INFINITY, -INFINITY};
    bake->bounds->max = (Vec3){INFINITY, INFINITY, INFINITY};
}

static void bake_box(const Bake *bake, Vec3 min, Vec3 max)
{
    const Affine to_space = bake->to_space;
    const Vec3 low = affine_point(to_space, min), high = affine_point(to_space, max);
    const Vec3 axes[3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    Vec3 n[3];
    f64 from[3], to[3];
    for (int i = 0; i < 3; ++i) {
        n[i] = affine_normal(to_space, axes[i]);
        from[i] = vec_dot(n[i], low);
        to[i] = fmax(from[i], vec_dot(n[i], high));
    }
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_BOX;
    set_rows(out, n, (Vec3){from[0], from[1], from[2]});
    out->p0 = (f32)to[0];
    out->p1 = (f32)to[1];
    out->p2 = (f32)to[2];
    const Vec3 half = vec_scale(vec_sub(max, min), 0.5);
    set_bounds(bake->bounds, affine_point(to_space, vec_add(min, half)), spread_by(to_space, half));
    pad_bounds(bake->bounds, to_space, affine_inverse(to_space), farthest(bake->bounds));
}

static void bake_tetrahedron(const Bake *bake, const Vec3 vertices[4])
{
    const Vec3 a = vertices[0];
    const Affine map =
        frame(bake, vec_sub(vertices[1], a), vec_sub(vertices[2], a), vec_sub(vertices[3], a), a);
    const Affine inverse = affine_inverse(map);
    const Vec3 k = inverse.translation;
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_TETRAHEDRON;
    set_rows(out, inverse.row, k);
    out->p0 = (f32)(1 - (k.x + k.y + k.z));
    BakedBounds *bounds = bake->bounds;
    bounds->min = bounds->max = map.translation;
    for (int i = 1; i < 4; ++i) {
        const Vec3 v = affine_point(bake->to_space, vertices[i]);
        bounds->min = vec_smallest(bounds->min, v);
        bounds->max = vec_largest(bounds->max, v);
    }
    pad_bounds(bounds, map, inverse, farthest(bounds));
}

static void bake_triangle(const Bake *bake, const Vec3 vertices[3])
{
    Vec3 v[3];
    for (int i = 0; i < 3; ++i)
        v[i] = affine_point(bake->to_space, vertices[i]);
    // From the edges in the shape's space: those of a small triangle far away have lost digits.
    const Vec3 normal = vec_cross(vec_normalize(vec_sub(vertices[1], vertices[0])),
                                  vec_normalize(vec_sub(vertices[2], vertices[0])));
    const Vec3 n = affine_normal(bake->to_space, normal);
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_TRIANGLE;
    set_rows(out, v, n);
    out->p1 = (f32)vec_dot(n, v[0]);
    // The plane of a triangle across an axis is exact; elsewhere a known plane is worth a little error, since
    // other shapes in it have the same.
    out->p0 = vec_axial(n) ? 0 : 0.25f;
    BakedBounds *bounds = bake->bounds;
    bounds->min = vec_smallest(v[0], vec_smallest(v[1], v[2]));
    bounds->max = vec_largest(v[0], vec_largest(v[1], v[2]));
    const Vec3 far = farthest(bounds);
    const Vec3 pad = vec_scale(vec_add(far, vec_scale(vec_absolute(n), vec_dot(vec_absolute(n), far))),
                               8 * ROUNDING);
    bounds->min = vec_sub(bounds->min, pad);
    bounds->max = vec_add(bounds->max, pad);
}

static void bake_disk(const Bake *bake, Vec3 center, Vec3 normal, f64 radius)
{
    Vec3 t1, t2;
    const Vec3 n = vec_normalize(normal);
    tangents(n, &t1, &t2);
    Affine map = frame(bake, vec_scale(t1, radius), vec_scale(t2, radius), n, center);
    const Vec3 unit = affine_normal(bake->to_space, n);
    const Vec3 c = map.translation;
    const Vec3 extent = {circle_extent(map.row[0]), circle_extent(map.row[1]), circle_extent(map.row[2])};
    // Off the disk the coordinates do not matter; along its normal they shall not change.
    map.row[0].z = unit.x;
    map.row[1].z = unit.y;
    map.row[2].z = unit.z;
    const Affine inverse = affine_inverse(map);
    const Vec3 rows[3] = {inverse.row[0], inverse.row[1], unit};
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_DISK;
    set_rows(out, rows, c);
    out->p0 = (f32)vec_dot(unit, c);
    set_bounds(bake->bounds, c, extent);
    pad_bounds(bake->bounds, map, inverse, half_extent(bake->bounds));
}

static void bake_cylinder(const Bake *bake, Vec3 base, Vec3 top, f64 radius, bool caps)
{
    Vec3 t1, t2;
    const Vec3 half = vec_scale(vec_sub(top, base), 0.5);
    tangents(vec_normalize(half), &t1, &t2);
    const Affine map = frame(bake, vec_scale(t1, radius), vec_scale(t2, radius), half, vec_add(base, half));
    const Affine inverse = affine_inverse(map);
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_CYLINDER;
    set_rows(out, inverse.row, map.translation);
    out->p0 = caps ? 1 : 0;
    Vec3 extent = {circle_extent(map.row[0]), circle_extent(map.row[1]), circle_extent(map.row[2])};
    extent = vec_add(extent, vec_absolute((Vec3){map.row[0].z, map.row[1].z, map.row[2].z}));
    set_bounds(bake->bounds, map.translation, extent);
    pad_bounds(bake->bounds, map, inverse, half_extent(bake->bounds));
}

static void bake_cone(const Bake *bake, Vec3 base, Vec3 top, f64 radius, f64 top_radius, bool caps)
{
    Vec3 t1, t2;
    const Vec3 half = vec_scale(vec_sub(top, base), 0.5);
    tangents(vec_normalize(half), &t1, &t2);
    const bool top_wider = top_radius > radius;
    const f64 wide = top_wider ? top_radius : radius, narrow = top_wider ? radius : top_radius;
    const Vec3 narrowing = vec_scale(half, top_wider ? -1 : 1);
    const Affine map = frame(bake, vec_scale(t1, wide), vec_scale(t2, wide), narrowing, vec_add(base, half));
    const Affine inverse = affine_inverse(map);
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_CONE;
    set_rows(out, inverse.row, map.translation);
    out->p0 = (caps ? 1.0f : 0.0f) + (top_wider ? 2.0f : 0.0f);
    out->p1 = (f32)((wide - narrow) / wide);
    const Vec3 z = {map.row[0].z, map.row[1].z, map.row[2].z};
    const Vec3 round = {circle_extent(map.row[0]), circle_extent(map.row[1]), circle_extent(map.row[2])};
    BakedBounds other;
    set_bounds(bake->bounds, vec_sub(map.translation, z), round);
    set_bounds(&other, vec_add(map.translation, z), vec_scale(round, narrow / wide));
    bake->bounds->min = vec_smallest(bake->bounds->min, other.min);
    bake->bounds->max = vec_largest(bake->bounds->max, other.max);
    pad_bounds(bake->bounds, map, inverse, vec_scale(half_extent(bake->bounds), 2));
}

static void bake_torus(const Bake *bake, Vec3 center, Vec3 axis, f64 major, f64 minor)
{
    Vec3 t1, t2;
    const Vec3 n = vec_normalize(axis);
    tangents(n, &t1, &t2);
    const Affine map =
        frame(bake, vec_scale(t1, major), vec_scale(t2, major), vec_scale(n, major), center);
    const Affine inverse = affine_inverse(map);
    const f64 tube = minor / major;
    Primitive *out = bake->out;
    out->kind = PRIMITIVE_TORUS;
    set_rows(out, inverse.row, map.translation);
    out->p0 = (f32)tube;
    // The tube is a ball swept along the circle, also under the map.
    const Vec3 ring = {circle_extent(map.row[0]), circle_extent(map.row[1]), circle_extent(map.row[2])};
    const Vec3 ball = {vec_length(map.row[0]), vec_length(map.row[1]), vec_length(map.row[2])};
    set_bounds(bake->bounds, map.translation, vec_add(ring, vec_scale(ball, tube)));
    pad_bounds(bake->bounds, map, inverse, half_extent(bake->bounds));
}

static bool row_in_range(f32x4 row)
{
    return isfinite(row.x) && isfinite(row.y) && isfinite(row.z) && isfinite(row.w);
}

// A row of zeros is what is left of a map whose numbers underflow.
static bool row_regular(f32x4 row)
{
    return row_in_range(row) && (row.x != 0 || row.y != 0 || row.z != 0);
}

// Whether a float holds a box's extent along an axis, or would if the box were here.
static bool extent_in_range(f32 from, f32 to)
{
    return fabsf(from) >= FLT_MIN || fabsf(to) >= FLT_MIN;
}

static bool primitive_in_range(const Primitive *p)
{
    if (!isfinite(p->p0) || !isfinite(p->p1) || !isfinite(p->p2))
        return false;
    const bool vanished = !extent_in_range(p->row0.w, p->p0) || !extent_in_range(p->row1.w, p->p1) ||
                          !extent_in_range(p->row2.w, p->p2);
    if (p->kind == PRIMITIVE_BOX && vanished)
        return false;
    if (p->kind == PRIMITIVE_TRIANGLE)
        return row_in_range(p->row0) && row_in_range(p->row1) && row_in_range(p->row2);
    if (p->kind == PRIMITIVE_SPHERE && !(p->p0 > 0))
        return false;
    return row_regular(p->row0) && row_regular(p->row1) && row_regular(p->row2);
}

bool bake_shape(const Shape *shape, const Affine *to_space, Primitive *out, BakedBounds *bounds,
                Error *error)
{
    const Bake bake = {.to_space = *to_space, .out = out, .bounds = bounds};
    *out = (Primitive){.kind = 0};
    switch (shape->kind) {
    case SHAPE_SPHERE:
        bake_sphere(&bake, shape->as.sphere.center, shape->as.sphere.radius);
        break;
    case SHAPE_PLANE:
        bake_plane(&bake, shape->as.plane.point, shape->as.plane.normal);
        break;
    case SHAPE_BOX:
        bake_box(&bake, shape->as.box.min, shape->as.box.max);
        break;
    case SHAPE_TETRAHEDRON:
        bake_tetrahedron(&bake, shape->as.tetrahedron.vertices);
        break;
    case SHAPE_TRIANGLE:
        bake_triangle(&bake, shape->as.triangle.vertices);
        break;
    case SHAPE_DISK:
        bake_disk(&bake, shape->as.disk.center, shape->as.disk.normal, shape->as.disk.radius);
        break;
    case SHAPE_CYLINDER:
        bake_cylinder(&bake, shape->as.cylinder.base, shape->as.cylinder.top, shape->as.cylinder.radius,
                      shape->as.cylinder.caps);
        break;
    case SHAPE_CONE:
        bake_cone(&bake, shape->as.cone.base, shape->as.cone.top, shape->as.cone.radius,
                  shape->as.cone.top_radius, shape->as.cone.caps);
        break;
    case SHAPE_TORUS:
        bake_torus(&bake, shape->as.torus.center, shape->as.torus.axis, shape->as.torus.major,
                   shape->as.torus.minor);
        break;
    case SHAPE_MESH:
        return error_set(error, ERROR_SCENE, "a mesh is no single primitive");
    }
    return primitive_in_range(out) || error_set(error, ERROR_SCENE, BAKE_OUT_OF_RANGE);
}
