// What the intersections of the shapes have in common: quadratics, intervals of solids, choice of the root.
//
// A solid is the interval [near, far] of t that the ray spends in it; (INFINITY, -INFINITY) where it never
// does. Roots do not depend on RayLanes.tmin, so that the roots of one ray are the same numbers whatever
// tmin they are asked with. Whatever is NaN is no hit.
#ifndef CLRT_KERNELS_SHAPES_ROOTS_H
#define CLRT_KERNELS_SHAPES_ROOTS_H

#include "base/exact.h"
#include "base/ray.h"
#include "shapes/surface.h"
#include "shapes/tangents.h"

typedef struct {
    vf near, far;
} Interval;

static inline Interval interval_select(vm m, Interval a, Interval b)
{
    Interval r;
    r.near = m ? a.near : b.near;
    r.far = m ? a.far : b.far;
    return r;
}

static inline Interval interval_make(vf near, vf far)
{
    Interval r;
    r.near = near;
    r.far = far;
    return r;
}

static inline Interval interval_none(void) { return interval_make((vf)(INFINITY), (vf)(-INFINITY)); }
static inline Interval interval_all(void) { return interval_make((vf)(-INFINITY), (vf)(INFINITY)); }

static inline Interval interval_common(Interval a, Interval b)
{
    return interval_make(vf_max(a.near, b.near), vf_min(a.far, b.far));
}

// Roots of a t^2 + 2 b t + c = 0 in order; none where they are not real. a must not be 0. The discriminant
// is a difference of products without cancellation error, and neither root is a difference of like numbers
// (Goldberg, "What every computer scientist should know about floating-point arithmetic", 1991).
static inline Interval quadratic_roots(vf a, vf b, vf c)
{
    const vf discriminant = difference_of_products(b, b, a, c);
    const vf q = -(b + copysign(sqrt(discriminant), b));
    const vf t0 = q == (vf)(0.0f) ? (vf)(0.0f) : c / q;
    const vf t1 = q / a;
    return interval_select(discriminant >= (vf)(0.0f), interval_make(vf_min(t0, t1), vf_max(t0, t1)),
                           interval_none());
}

// Rays that start far from a solid (|*o|^2 >= far2, o relative to its centre) are moved to the point closest
// to the centre, since there the squares of distances no longer cancel (Haines, Guenther, Akenine-Moeller,
// "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019). fma rounds the moved origin
// once, so that the ray stays the same ray. Returns the t of the new origin; dd = |d|^2.
//
// From one and a half radii on t is at least a third of the shift, so that the sum costs t little; from
// closer by, a grazing ray loses less to the squares than one ulp of what went in is worth.
#define FAR_FROM_CENTRE 2.25f // radii, squared
static inline vf closest_shift(v3 *o, v3 d, vf dd, vf far2)
{
    const vm far = v3_dot(*o, *o) >= far2;
    const vf t = far ? -v3_dot(*o, d) / dd : (vf)(0.0f);
    *o = v3_fma(d, t, *o);
    return t;
}

static inline vf ray_limit(const RayLanes *ray) { return vf_max(ray->tmin, (vf)(0.0f)); }

// The hit of a surface that a ray meets in one point and that is flat.
static inline vf flat_hit(const RayLanes *ray, vf t, vm on)
{
    const vm hit = on & (t > ray_limit(ray)) & !ray->self;
    return hit ? t : (vf)(INFINITY);
}

// The hit of a closed convex solid. A ray that starts on it and goes outward never comes back; one that
// goes inward leaves at the far end.
static inline vf solid_hit(const RayLanes *ray, Interval solid)
{
    const vf limit = ray_limit(ray);
    const vm first = !ray->self & (solid.near <= solid.far) & (solid.near > limit);
    const vm second = ((!ray->self & (solid.near <= solid.far)) | (ray->self & ray->inward)) &
                      (solid.far > limit);
    return first ? solid.near : second ? solid.far : (vf)(INFINITY);
}

static inline v3 canonical_direction(const PrimitiveLanes *p, v3 d)
{
    return v3_make(v3_dot(p->row0, d), v3_dot(p->row1, d), v3_dot(p->row2, d));
}

// q of a point, A (p - c).
static inline v3 canonical_point(const PrimitiveLanes *p, v3 point)
{
    return canonical_direction(p, v3_sub(point, p->c));
}

// A ray in the canonical space: q = o + (t - shift) d.
typedef struct {
    v3 o, d;
    vf shift;
} CanonicalRay;

// Rays that start far away (|q| >= 2) are moved to the point closest to c before A is applied, so that it is
// applied to small numbers: what its products round counts at the size of the shape and not at the distance.
static inline CanonicalRay canonical_ray(const PrimitiveLanes *p, const RayLanes *ray)
{
    CanonicalRay r;
    v3 f = v3_sub(ray->org, p->c);
    r.d = canonical_direction(p, ray->dir);
    r.o = canonical_direction(p, f);
    r.shift = (vf)(0.0f);
    const vm far = v3_dot(r.o, r.o) >= (vf)(4.0f);
    if (vm_any(far)) {
        const vf t = closest_shift(&f, ray->dir, v3_dot(ray->dir, ray->dir), (vf)(0.0f));
        r.shift = far ? t : r.shift;
        r.o = v3_select(far, canonical_direction(p, f), r.o);
    }
    return r;
}

// The gradient in the primitive's space of a function whose gradient in the canonical space is g.
static inline v3 canonical_gradient(const PrimitiveLanes *p, v3 g)
{
    return v3_fma(p->row2, g.z, v3_fma(p->row1, g.y, v3_scale(p->row0, g.x)));
}

// Settles s->p on a surface of the canonical space: `gradient` of the function there, outward, of any length;
// `value` of the function, whose own evaluation adds `roundings` to the error of q.
static inline void surface_curved(const PrimitiveLanes *p, v3 gradient, vf value, real roundings,
                                  SurfaceLanes *s)
{
    const v3 g = canonical_gradient(p, gradient);
    const vf inverse = (vf)(1.0f) / sqrt(v3_dot(g, g));
    const v3 f = v3_abs(v3_sub(s->p, p->c));
    const v3 spread = v3_make(v3_dot(v3_abs(p->row0), f), v3_dot(v3_abs(p->row1), f),
                              v3_dot(v3_abs(p->row2), f));
    const vf terms = fma(v3_dot(v3_abs(gradient), spread), (vf)(4.0f), (vf)(roundings));
    s->ng = v3_scale(g, inverse);
    surface_settle(s, value * inverse, ROUNDING * terms * inverse);
}

// plane.p - offset; one rounding where the plane is parallel to two axes.
static inline vf plane_distance(v3 plane, vf offset, v3 p)
{
    return fma(plane.z, p.z, fma(plane.y, p.y, fma(plane.x, p.x, -offset)));
}

// a b + c = sum + *rest, but for a few roundings of *rest: Knuth's sum of two numbers, one of them a product.
static inline vf fma_rest(vf a, vf b, vf c, vf *rest)
{
    const vf sum = fma(a, b, c);
    const vf added = sum - c;
    *rest = (c - (sum - added)) + fma(a, b, -added);
    return sum;
}

// plane.p = hi + lo, but for a few roundings of lo.
static inline vf2 plane_dot(v3 plane, v3 p)
{
    vf rest_y, rest_z;
    const vf x = plane.x * p.x;
    const vf y = fma_rest(plane.y, p.y, x, &rest_y);
    const vf z = fma_rest(plane.z, p.z, y, &rest_z);
    return vf2_make(z, fma(plane.x, p.x, -x) + (rest_y + rest_z));
}

// plane.p - offset to a rounding or two of what is left, however much cancels: t of shapes far from the
// origin of the space stands on that. All shapes with flat parts take it: those in one plane have the same t.
static inline vf plane_height(vf2 dot, vf offset) { return (dot.hi - offset) + dot.lo; }

#endif
