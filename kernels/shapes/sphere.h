// SPHERE, and GIANT_SPHERE for those whose surface passes by the origin of the space much closer than the
// radius: there a rounded centre and radius would misplace the surface by more than the pixel sees.
#ifndef CLRT_KERNELS_SHAPES_SPHERE_H
#define CLRT_KERNELS_SHAPES_SPHERE_H

#include "shapes/roots.h"
#include "shapes/surface.h"

#if HAS_SPHERE || HAS_ELLIPSOID
// |f + t d| = r. From afar the constant term belongs to the closest point; close by it is factored, which
// keeps what |f|^2 - r^2 loses.
static inline Interval sphere_roots(v3 f, v3 d, vf r, vm self)
{
    const vf dd = v3_dot(d, d);
    const vf shift = closest_shift(&f, d, dd, FAR_FROM_CENTRE * r * r);
    const vf distance = sqrt(v3_dot(f, f));
    const vf c = self ? (vf)(0.0f) : (distance - r) * (distance + r);
    const Interval roots = quadratic_roots(dd, v3_dot(f, d), c);
    return interval_make(shift + roots.near, shift + roots.far);
}
#endif

#if HAS_SPHERE
static inline vf intersect_sphere(const PrimitiveLanes *p, const RayLanes *ray)
{
    return solid_hit(ray, sphere_roots(v3_sub(ray->org, p->c), ray->dir, p->p0, ray->self));
}
#endif

#if HAS_UV
// From the unit normal along object axes. The arc tangent keeps the polar angle accurate at the poles.
static inline void sphere_uv(SurfaceLanes *s, v3 n)
{
    const vf turn = vf_atan2(n.x, n.z) * TURNS_A_RADIAN + 0.5f;
    const vf rho = sqrt(fma(n.x, n.x, n.z * n.z));
    surface_uv(s, turn >= (vf)(1.0f) ? (vf)(0.0f) : turn,
               fma(vf_atan2(rho, n.y), (vf)(-2.0f * TURNS_A_RADIAN), (vf)(1.0f)));
}
#endif

#if HAS_NORMAL_MAP
// East and north; at the poles, those of u = 1/2.
static inline void sphere_tangents(const PrimitiveLanes *p, v3 n, SurfaceLanes *s)
{
    const vf rho = sqrt(fma(n.x, n.x, n.z * n.z));
    const vm pole = !(rho > (vf)(0.0f));
    const vf x = pole ? (vf)(0.0f) : n.x / rho, z = pole ? (vf)(1.0f) : n.z / rho;
    surface_tangents(p, v3_make(z, (vf)(0.0f), -x), v3_make(-x * n.y, rho, -z * n.y), s);
}
#endif

#if HAS_SPHERE
static inline void surface_sphere(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const v3 point = v3_fma(ray->dir, t, ray->org);
    const v3 f = v3_sub(point, p->c);
    const vf distance = sqrt(v3_dot(f, f));
    const v3 on = v3_scale(f, p->p0 / distance);
    s->ng = v3_scale(f, (vf)(1.0f) / distance);
    s->p = v3_add(p->c, on);
    // Length 2 roundings, quotient and product 1 each; the sum rounds to the size of p.
    s->error = v3_scale(v3_fma(v3_abs(on), (vf)(5.0f), v3_abs(s->p)), (vf)(ROUNDING));
#if HAS_UV
    sphere_uv(s, canonical_direction(p, s->ng));
#endif
#if HAS_NORMAL_MAP
    sphere_tangents(p, canonical_direction(p, s->ng), s);
#endif
}
#endif

#if HAS_GIANT_SPHERE
// |p|^2 - 2 c.p + p1 at p.
static inline vf giant_value(const PrimitiveLanes *p, v3 at)
{
    const v3 g = v3_make(fma(p->c.x, (vf)(-2.0f), at.x), fma(p->c.y, (vf)(-2.0f), at.y),
                         fma(p->c.z, (vf)(-2.0f), at.z));
    return fma(at.z, g.z, fma(at.y, g.y, fma(at.x, g.x, p->p1)));
}

static inline vf intersect_giant_sphere(const PrimitiveLanes *p, const RayLanes *ray)
{
    const vf dd = v3_dot(ray->dir, ray->dir);
    v3 f = v3_sub(ray->org, p->c);
    const vf shift = closest_shift(&f, ray->dir, dd, 4.0f * p->p0 * p->p0);
    const vf c = ray->self ? (vf)(0.0f) : giant_value(p, v3_fma(ray->dir, shift, ray->org));
    const Interval roots = quadratic_roots(dd, v3_dot(f, ray->dir), c);
    return solid_hit(ray, interval_make(shift + roots.near, shift + roots.far));
}

static inline void surface_giant_sphere(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    s->p = v3_fma(ray->dir, t, ray->org);
    s->ng = v3_normalize(v3_sub(s->p, p->c));
    const v3 a = v3_abs(s->p);
    const vf half_over_r = 0.5f / p->p0;
    const vf terms = v3_dot(a, v3_fma(v3_abs(p->c), (vf)(2.0f), a)) + fabs(p->p1);
    surface_settle(s, giant_value(p, s->p) * half_over_r, 4.0f * ROUNDING * terms * half_over_r);
#if HAS_UV
    sphere_uv(s, canonical_direction(p, s->ng));
#endif
#if HAS_NORMAL_MAP
    sphere_tangents(p, canonical_direction(p, s->ng), s);
#endif
}
#endif

#endif
