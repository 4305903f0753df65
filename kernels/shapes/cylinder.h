// CYLINDER, closed or open.
#ifndef CLRT_KERNELS_SHAPES_CYLINDER_H
#define CLRT_KERNELS_SHAPES_CYLINDER_H

#include "shapes/roots.h"
#include "shapes/surface.h"

// A ray in the canonical space of a solid of revolution, moved near to it, with what it meets there: the
// wall (as the part of the ray within it) and the planes of the ends, in t from the moved origin.
typedef struct {
    v3 o, d;
    vf shift; // t of the moved origin
    Interval wall;
    vf end_low, end_high; // t of z = -1 and z = 1
    Interval slab;        // the part of the ray between them
} RoundSolid;

static inline RoundSolid round_solid(const PrimitiveLanes *p, const RayLanes *ray)
{
    RoundSolid s;
    const CanonicalRay q = canonical_ray(p, ray);
    s.o = q.o;
    s.d = q.d;
    s.shift = q.shift + closest_shift(&s.o, s.d, v3_dot(s.d, s.d), (vf)(FAR_FROM_CENTRE));
    const vf inverse = (vf)(1.0f) / s.d.z;
    const vm parallel = fabs(inverse) == (vf)(INFINITY);
    const vm between = fabs(s.o.z) <= (vf)(1.0f);
    s.end_low = parallel ? (vf)(INFINITY) : (-1.0f - s.o.z) * inverse;
    s.end_high = parallel ? (vf)(INFINITY) : (1.0f - s.o.z) * inverse;
    const Interval crossed = interval_make(vf_min(s.end_low, s.end_high), vf_max(s.end_low, s.end_high));
    s.slab = interval_select(parallel, interval_select(between, interval_all(), interval_none()), crossed);
    return s;
}

// Where a t^2 + 2 b t + c <= 0, for a >= 0.
static inline Interval quadratic_within(vf a, vf b, vf c)
{
    const vm level = (a == (vf)(0.0f)) & (b == (vf)(0.0f));
    const Interval everywhere = interval_select(c <= (vf)(0.0f), interval_all(), interval_none());
    return interval_select(level, everywhere, quadratic_roots(a, b, c));
}

// With ends the solid is met, so that there is no gap between wall and end; without them, each side of the
// wall that lies between the ends.
static inline vf round_hit(const RoundSolid *s, const RayLanes *ray, vm closed)
{
    const Interval common = interval_common(s->wall, s->slab);
    const vm near_on = (s->wall.near >= s->slab.near) & (s->wall.near <= s->slab.far);
    const vm far_on = (s->wall.far >= s->slab.near) & (s->wall.far <= s->slab.far);
    const vf limit = ray_limit(ray), near = s->shift + s->wall.near, far = s->shift + s->wall.far;
    const vm leaves = !ray->self | ray->inward;
    const vf second = (far_on & (far > limit) & leaves) ? far : (vf)(INFINITY);
    const vf open = (near_on & (near > limit) & !ray->self) ? near : second;
    return closed ? solid_hit(ray, interval_make(s->shift + common.near, s->shift + common.far)) : open;
}

#define ROUND_WALL 0
#define ROUND_LOW 1
#define ROUND_HIGH 2

// Which part the hit at t lies on: that whose own t is closest.
static inline vi round_part(const RoundSolid *s, vf t, vm closed)
{
    const vf wall = vf_min(fabs(s->shift + s->wall.near - t), fabs(s->shift + s->wall.far - t));
    const vf low = fabs(s->shift + s->end_low - t), high = fabs(s->shift + s->end_high - t);
    const vi end = high < low ? (vi)(ROUND_HIGH) : (vi)(ROUND_LOW);
    return (closed & (vf_min(low, high) < wall)) ? end : (vi)(ROUND_WALL);
}

static inline RoundSolid cylinder_solid(const PrimitiveLanes *p, const RayLanes *ray)
{
    RoundSolid s = round_solid(p, ray);
    const v3 o = s.o, d = s.d;
    const vf rho = sqrt(fma(o.x, o.x, o.y * o.y));
    s.wall = quadratic_within(fma(d.x, d.x, d.y * d.y), fma(o.x, d.x, o.y * d.y),
                              (rho - 1.0f) * (rho + 1.0f));
    return s;
}

static inline vf intersect_cylinder(const PrimitiveLanes *p, const RayLanes *ray)
{
    const RoundSolid s = cylinder_solid(p, ray);
    return round_hit(&s, ray, p->p0 > (vf)(0.0f));
}

static inline void surface_cylinder(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const RoundSolid solid = cylinder_solid(p, ray);
    const vi part = round_part(&solid, t, p->p0 > (vf)(0.0f));
    const vm on_wall = part == (vi)(ROUND_WALL);
    const vf end = part == (vi)(ROUND_HIGH) ? (vf)(1.0f) : (vf)(-1.0f);
    s->p = v3_fma(ray->dir, t, ray->org);
    const v3 q = canonical_point(p, s->p);
    const vf rho = sqrt(fma(q.x, q.x, q.y * q.y));
    const v3 out = v3_select(on_wall, v3_make(q.x / rho, q.y / rho, (vf)(0.0f)),
                             v3_make((vf)(0.0f), (vf)(0.0f), end));
    surface_curved(p, out, on_wall ? rho - 1.0f : q.z * end - 1.0f, 2.0f, s);
#if HAS_UV
    surface_uv(s, on_wall ? uv_turn(q.y, q.x) : uv_clamp(fma(q.x * end, (vf)(0.5f), (vf)(0.5f))),
               uv_clamp(fma(on_wall ? q.z : q.y, (vf)(0.5f), (vf)(0.5f))));
#endif
#if HAS_NORMAL_MAP
    surface_tangents(p, v3_select(on_wall, v3_make(-q.y, q.x, (vf)(0.0f)), v3_scale(v3_axis(0), end)),
                     v3_select(on_wall, v3_axis(2), v3_axis(1)), s);
#endif
}

#endif
