/* Plane, disk, triangle, box and tetrahedron. */
#include "shape.h"

/* Rounding of a barycentric weight in extended precision stays far below this. */
#define EDGE_WIDTH 1e-15L

static Surface flat_surface(Vec normal, real u, real v, Vec du, Vec dv)
{
    return (Surface){normal, normal, u, v, du, dv};
}

int plane_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    real toward = dot(line->d, shape->normal);
    if (toward == 0)
        return 0;
    out[0] = (Crossing){dot(sub(shape->center, line->o), shape->normal) / toward, 0, false};
    return 1;
}

Surface plane_surface(const Shape *shape, Vec p)
{
    Vec q = sub(p, shape->center);
    return flat_surface(shape->normal, dot(q, shape->t1), dot(q, shape->t2), shape->t1, shape->t2);
}

int disk_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    if (plane_crossings(shape, line, out) == 0)
        return 0;
    Vec q = sub(add(line->o, scaled(line->d, out[0].t)), shape->center);
    return dot(q, q) <= shape->radius * shape->radius ? 1 : 0;
}

Surface disk_surface(const Shape *shape, Vec p)
{
    Vec q = sub(p, shape->center);
    real width = 2 * shape->radius;
    return flat_surface(shape->normal, 0.5L + dot(q, shape->t1) / width, 0.5L + dot(q, shape->t2) / width,
                        scaled(shape->t1, width), scaled(shape->t2, width));
}

/* Weights of the second and third vertex at p in the plane of a, b, c. */
static void barycentric(Vec a, Vec b, Vec c, Vec p, real *second, real *third)
{
    Vec e1 = sub(b, a);
    Vec e2 = sub(c, a);
    Vec n = cross(e1, e2);
    Vec q = sub(p, a);
    *second = dot(cross(q, e2), n) / dot(n, n);
    *third = dot(cross(e1, q), n) / dot(n, n);
}

int triangle_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    const Vec *v = shape->vertices;
    Vec n = cross(sub(v[1], v[0]), sub(v[2], v[0]));
    real toward = dot(line->d, n);
    if (toward == 0)
        return 0;
    real t = dot(sub(v[0], line->o), n) / toward;
    real b, c;
    barycentric(v[0], v[1], v[2], add(line->o, scaled(line->d, t)), &b, &c);
    real least = fminl(fminl(b, c), 1 - b - c);
    if (!(least >= -EDGE_WIDTH))
        return 0;
    out[0] = (Crossing){t, 0, least <= EDGE_WIDTH};
    return 1;
}

Surface triangle_surface(const Shape *shape, Vec p)
{
    const Vec *v = shape->vertices;
    real b, c;
    barycentric(v[0], v[1], v[2], p, &b, &c);
    real a = 1 - b - c;
    Vec e1 = sub(v[1], v[0]);
    Vec e2 = sub(v[2], v[0]);
    Surface surface = flat_surface(normalized(cross(e1, e2)), b, c, e1, e2);
    if (shape->has_normals) {
        const Vec *n = shape->normals;
        surface.shading = add(add(scaled(n[0], a), scaled(n[1], b)), scaled(n[2], c));
    }
    if (shape->has_uvs) {
        surface.u = a * shape->uvs[0][0] + b * shape->uvs[1][0] + c * shape->uvs[2][0];
        surface.v = a * shape->uvs[0][1] + b * shape->uvs[1][1] + c * shape->uvs[2][1];
        /* e1 = u1 du + v1 dv, e2 = u2 du + v2 dv, by Cramer's rule; the determinant's sign is kept. */
        real u1 = shape->uvs[1][0] - shape->uvs[0][0];
        real v1 = shape->uvs[1][1] - shape->uvs[0][1];
        real u2 = shape->uvs[2][0] - shape->uvs[0][0];
        real v2 = shape->uvs[2][1] - shape->uvs[0][1];
        real determinant = u1 * v2 - u2 * v1;
        if (determinant != 0) {
            surface.du = scaled(sub(scaled(e1, v2), scaled(e2, v1)), 1 / determinant);
            surface.dv = scaled(sub(scaled(e2, u1), scaled(e1, u2)), 1 / determinant);
        }
    }
    return surface;
}

int parallelogram_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    const Vec *v = shape->vertices;
    Vec n = cross(sub(v[1], v[0]), sub(v[2], v[0]));
    real toward = dot(line->d, n);
    if (toward == 0)
        return 0;
    real t = dot(sub(v[0], line->o), n) / toward;
    real b, c;
    barycentric(v[0], v[1], v[2], add(line->o, scaled(line->d, t)), &b, &c);
    out[0] = (Crossing){t, 0, false};
    return b >= 0 && b <= 1 && c >= 0 && c <= 1 ? 1 : 0;
}

Surface parallelogram_surface(const Shape *shape, Vec p)
{
    const Vec *v = shape->vertices;
    Vec e1 = sub(v[1], v[0]);
    Vec e2 = sub(v[2], v[0]);
    real b, c;
    barycentric(v[0], v[1], v[2], p, &b, &c);
    return flat_surface(normalized(cross(e1, e2)), b, c, e1, e2);
}

/* A convex solid as the part of a line inside all of its half spaces: normal.p <= offset each. */
typedef struct Span {
    real enter, leave;
    int enter_patch, leave_patch;
    bool empty;
} Span;

/* distance: of the line's origin above the face; toward: how fast it grows with t. */
static void span_clip(Span *span, real distance, real toward, int patch)
{
    if (toward == 0) {
        span->empty = span->empty || distance > 0;
        return;
    }
    real t = -distance / toward;
    if (toward < 0 && t > span->enter) {
        span->enter = t;
        span->enter_patch = patch;
    } else if (toward > 0 && t < span->leave) {
        span->leave = t;
        span->leave_patch = patch;
    }
}

static int span_crossings(const Span *span, Crossing *out)
{
    if (span->empty || !(span->enter < span->leave))
        return 0;
    out[0] = (Crossing){span->enter, span->enter_patch, false};
    out[1] = (Crossing){span->leave, span->leave_patch, false};
    return 2;
}

int box_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    Span span = {-INFINITY, INFINITY, 0, 0, false};
    Vec q = sub(line->o, shape->center);
    for (int axis = 0; axis < 3; axis++) {
        real half = component(shape->half, axis);
        real from = component(q, axis);
        real toward = component(line->d, axis);
        span_clip(&span, -from - half, -toward, 2 * axis);
        span_clip(&span, from - half, toward, 2 * axis + 1);
    }
    return span_crossings(&span, out);
}

Surface box_surface(const Shape *shape, Vec p, int patch)
{
    int axis = patch / 2;
    real sign = patch % 2 == 0 ? -1 : 1;
    Vec n = scaled(vec(axis == 0, axis == 1, axis == 2), sign);
    Vec t1, t2;
    tangents_of(n, &t1, &t2);
    Vec q = sub(p, shape->center);
    /* The tangents are along axes, so the extent along one is a component of the size. */
    real extent1 = 2 * fabsl(dot(shape->half, t1));
    real extent2 = 2 * fabsl(dot(shape->half, t2));
    return flat_surface(n, 0.5L + dot(q, t1) / extent1, 0.5L + dot(q, t2) / extent2, scaled(t1, extent1),
                        scaled(t2, extent2));
}

/* Vertices of the faces abc abd acd bcd, and the vertex opposite each. */
static const int FACES[4][4] = {{0, 1, 2, 3}, {0, 1, 3, 2}, {0, 2, 3, 1}, {1, 2, 3, 0}};

static Vec face_normal(const Shape *shape, int face)
{
    const Vec *v = shape->vertices;
    const int *f = FACES[face];
    Vec n = normalized(cross(sub(v[f[1]], v[f[0]]), sub(v[f[2]], v[f[0]])));
    return dot(n, sub(v[f[3]], v[f[0]])) > 0 ? scaled(n, -1) : n;
}

int tetrahedron_crossings(const Shape *shape, const Line *line, Crossing *out)
{
    Span span = {-INFINITY, INFINITY, 0, 0, false};
    for (int face = 0; face < 4; face++) {
        Vec n = face_normal(shape, face);
        Vec corner = shape->vertices[FACES[face][0]];
        span_clip(&span, dot(sub(line->o, corner), n), dot(line->d, n), face);
    }
    return span_crossings(&span, out);
}

Surface tetrahedron_surface(const Shape *shape, Vec p, int patch)
{
    const Vec *v = shape->vertices;
    const int *f = FACES[patch];
    Vec e1 = sub(v[f[1]], v[f[0]]);
    Vec e2 = sub(v[f[2]], v[f[0]]);
    Surface surface = flat_surface(face_normal(shape, patch), 0, 0, e1, e2);
    barycentric(v[f[0]], v[f[1]], v[f[2]], p, &surface.u, &surface.v);
    return surface;
}
