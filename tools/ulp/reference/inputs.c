#include "reference/inputs.h"

#include <math.h>

#include "reference/parts.h"

// The distance from |x| to the next larger float; 0 is exact.
static real ulp(real x)
{
    const float f = (float)fabsl(x);
    return f > 0 ? (real)nextafterf(f, INFINITY) - (real)f : 0;
}

static real largest(Vec3 a) { return fmaxl(fmaxl(fabs(a.x), fabs(a.y)), fabs(a.z)); }
static real float_largest(const float a[3]) { return fmaxf(fmaxf(fabsf(a[0]), fabsf(a[1])), fabsf(a[2])); }

// Elements of maps that are 0 or 1 stand for "as it is".
static real element_ulp(real x) { return fabsl(x) == 1 ? 0 : ulp(x); }

static real sum_of(Real3 a) { return fabsl(a.x) + fabsl(a.y) + fabsl(a.z); }

// One ulp of a normal or an axis tilts what it carries at `arm` from the point that stays.
static real tilt(Vec3 axis, Real3 arm) { return ulp(largest(axis)) / (real)vec_length(axis) * sum_of(arm); }

// What one ulp of the points and lengths that describe the shape moves it at q along its normal.
static real own_move(const Shape *s, Real3 q, Real3 normal)
{
    const real n = sum_of(normal);
    real most = 0;
    switch (s->kind) {
    case SHAPE_SPHERE:
        return n * ulp(largest(s->as.sphere.center)) + ulp(s->as.sphere.radius);
    case SHAPE_PLANE:
        return n * ulp(largest(s->as.plane.point)) +
               tilt(s->as.plane.normal, real3_sub(q, real3_from(s->as.plane.point)));
    case SHAPE_DISK:
        return n * ulp(largest(s->as.disk.center)) + ulp(s->as.disk.radius) +
               tilt(s->as.disk.normal, real3_sub(q, real3_from(s->as.disk.center)));
    case SHAPE_BOX:
        return ulp(fmaxl(largest(s->as.box.min), largest(s->as.box.max)));
    case SHAPE_TETRAHEDRON:
        for (int k = 0; k < 4; ++k)
            most = fmaxl(most, largest(s->as.tetrahedron.vertices[k]));
        return n * ulp(most);
    case SHAPE_TRIANGLE:
        for (int k = 0; k < 3; ++k)
            most = fmaxl(most, largest(s->as.triangle.vertices[k]));
        return n * ulp(most);
    case SHAPE_CYLINDER:
        most = fmaxl(largest(s->as.cylinder.base), largest(s->as.cylinder.top));
        return n * ulp(most) + ulp(s->as.cylinder.radius);
    case SHAPE_CONE:
        most = fmaxl(largest(s->as.cone.base), largest(s->as.cone.top));
        return n * ulp(most) + ulp(fmax(s->as.cone.radius, s->as.cone.top_radius));
    case SHAPE_TORUS:
        return n * ulp(largest(s->as.torus.center)) + ulp(s->as.torus.major) + ulp(s->as.torus.minor) +
               tilt(s->as.torus.axis, real3_sub(q, real3_from(s->as.torus.center)));
    case SHAPE_MESH:
        break;
    }
    return 0;
}

// The normal of the piece of the surface that q is closest to.
static Real3 nearest_normal(const Shape *shape, Real3 q)
{
    Real3 best = {0, 0, 1};
    real least = INFINITY;
    for (int k = 0; k < reference_pieces(shape); ++k) {
        real distance, uv[2];
        Real3 normal;
        if (reference_piece(shape, k, q, &distance, &normal, uv) && fabsl(distance) < least) {
            least = fabsl(distance);
            best = normal;
        }
    }
    return best;
}

static real weighted(Real3 a, const real by[3])
{
    return fabsl(a.x) * by[0] + fabsl(a.y) * by[1] + fabsl(a.z) * by[2];
}

InputMove reference_input_move(const Placed *p, const float origin[3], const float direction[3], real t)
{
    const Real3 o = real_map_point(&p->inverse, real3(origin[0], origin[1], origin[2]));
    const Real3 d = real_map_direction(&p->inverse, real3(direction[0], direction[1], direction[2]));
    const Real3 q = real3_add(o, real3_scale(d, t)), normal = nearest_normal(&p->shape, q);
    const Vec3 *row = p->map.row;
    const real same = ulp(float_largest(origin)) + fabsl(t) * ulp(float_largest(direction)) +
                      ulp(largest(p->map.translation));
    real moved[3];
    for (int i = 0; i < 3; ++i)
        moved[i] = same + element_ulp(row[i].x) * fabsl(q.x) + element_ulp(row[i].y) * fabsl(q.y) +
                   element_ulp(row[i].z) * fabsl(q.z);
    const Real3 *inverse = p->inverse.row;
    const Real3 gradient =
        real3_add(real3_scale(inverse[0], normal.x),
                  real3_add(real3_scale(inverse[1], normal.y), real3_scale(inverse[2], normal.z)));
    const real own = own_move(&p->shape, q, normal);
    const real rows = fmaxl(weighted(inverse[0], moved),
                            fmaxl(weighted(inverse[1], moved), weighted(inverse[2], moved)));
    const real along = weighted(gradient, moved) + own;
    return (InputMove){.along = along, .across = fmaxl(along, rows + own),
                       .rate = fabsl(real3_dot(normal, d))};
}
