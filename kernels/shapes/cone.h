// CONE, pointed or cut off, closed or open. Its radius at height z is 1 - p1 (z + 1) / 2 >= 0, so that the
// other nappe lies beyond the narrow end.
#ifndef CLRT_KERNELS_SHAPES_CONE_H
#define CLRT_KERNELS_SHAPES_CONE_H

#include "shapes/cylinder.h"

static inline vm cone_closed(const PrimitiveLanes *p) { return (VI_FROM_VF(p->p0) & 1) != (vi)(0); }
static inline vm cone_top_wider(const PrimitiveLanes *p) { return (VI_FROM_VF(p->p0) & 2) != (vi)(0); }

static inline vf cone_radius(const PrimitiveLanes *p, vf z)
{
    return fma(p->p1 * -0.5f, z, fma(p->p1, (vf)(-0.5f), (vf)(1.0f)));
}

// A ray steeper than the wall lies within this nappe from its only crossing on, or up to there.
static inline Interval cone_steep_part(vf a, vf b, vf c, vf radius_rate)
{
    const vf discriminant = vf_max(difference_of_products(b, b, a, c), (vf)(0.0f));
    const vf q = -(b + copysign(sqrt(discriminant), b));
    const vf t0 = q == (vf)(0.0f) ? (vf)(0.0f) : c / q;
    const vf t1 = q / a;
    const vm widening = radius_rate > (vf)(0.0f);
    return interval_make(widening ? vf_max(t0, t1) : (vf)(-INFINITY),
                         widening ? (vf)(INFINITY) : vf_min(t0, t1));
}

// Where the wall is looked at from: from the apex where the cone is pointed enough for rays to pass close by
// it, so that what is small there is computed from small numbers; else from the middle of the axis.
typedef struct {
    vf height, radius;
} ConeReference;

static inline ConeReference cone_reference(const PrimitiveLanes *p)
{
    ConeReference r;
    const vm pointed = p->p1 > (vf)(0.5f);
    r.height = pointed ? 2.0f / p->p1 - 1.0f : (vf)(0.0f);
    r.radius = pointed ? (vf)(0.0f) : cone_radius(p, (vf)(0.0f));
    return r;
}

static inline vf cone_terms(v3 o, vf radius) { return fma(o.x, o.x, fma(o.y, o.y, radius * radius)); }

static inline RoundSolid cone_solid(const PrimitiveLanes *p, const RayLanes *ray)
{
    RoundSolid s = round_solid(p, ray);
    const ConeReference reference = cone_reference(p);
    const v3 d = s.d, from = v3_make(s.o.x, s.o.y, s.o.z - reference.height);
    v3 o = from;
    const vf slope = -0.5f * p->p1;
    vf shift = closest_shift(&o, d, v3_dot(d, d), (vf)(0.0f));
    // What the quadratic is made of, there and here; near the wall the origin is the better place.
    const vf radius_o = fma(slope, o.z, reference.radius), radius_from = fma(slope, from.z, reference.radius);
    const vm near = cone_terms(from, radius_from) < FAR_FROM_CENTRE * cone_terms(o, radius_o);
    shift = near ? (vf)(0.0f) : shift;
    o = v3_select(near, from, o);
    const vf radius = near ? radius_from : radius_o, rate = slope * d.z;
    const vf rho = sqrt(fma(o.x, o.x, o.y * o.y));
    const vf a = difference_of_products(d.x, d.x, rate, rate) + d.y * d.y;
    const vf b = difference_of_products(o.x, d.x, radius, rate) + o.y * d.y;
    const vf c = (rho - radius) * (rho + radius);
    const Interval steep = cone_steep_part(a, b, c, rate);
    const Interval wall = interval_select(a < (vf)(0.0f), steep, quadratic_within(a, b, c));
    s.wall = interval_make(shift + wall.near, shift + wall.far);
    return s;
}

static inline vf intersect_cone(const PrimitiveLanes *p, const RayLanes *ray)
{
    const RoundSolid s = cone_solid(p, ray);
    return round_hit(&s, ray, cone_closed(p));
}

static inline void surface_cone(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const RoundSolid solid = cone_solid(p, ray);
    const vi part = round_part(&solid, t, cone_closed(p));
    const vm on_wall = part == (vi)(ROUND_WALL);
    const vf end = part == (vi)(ROUND_HIGH) ? (vf)(1.0f) : (vf)(-1.0f);
    s->p = v3_fma(ray->dir, t, ray->org);
    const v3 q = canonical_point(p, s->p);
    const vf rho = sqrt(fma(q.x, q.x, q.y * q.y));
    // At the apex itself the normal is the axis.
    const vm round = rho > (vf)(0.0f);
    const v3 wall = v3_make(round ? q.x / rho : (vf)(0.0f), round ? q.y / rho : (vf)(0.0f),
                            round ? 0.5f * p->p1 : (vf)(1.0f));
    const v3 out = v3_select(on_wall, wall, v3_make((vf)(0.0f), (vf)(0.0f), end));
    surface_curved(p, out, on_wall ? rho - cone_radius(p, q.z) : q.z * end - 1.0f, 3.0f, s);
#if HAS_UV
    const vm flipped = cone_top_wider(p);
    const vf height = flipped ? -q.z : q.z;
    // Somebody who faces the top sees x to the right, at the base to the left.
    const vm on_top = (end > (vf)(0.0f)) != flipped;
    const vf across = q.x / cone_radius(p, end), up = q.y / cone_radius(p, end);
    const vf end_u = uv_clamp(fma(on_top ? across : -across, (vf)(0.5f), (vf)(0.5f)));
    surface_uv(s, on_wall ? uv_turn(q.y, q.x) : end_u,
               uv_clamp(fma(on_wall ? height : up, (vf)(0.5f), (vf)(0.5f))));
#endif
#if HAS_NORMAL_MAP
    // At the apex, those of u = 0.
    const vf x = round ? q.x / rho : (vf)(1.0f), y = round ? q.y / rho : (vf)(0.0f);
    const v3 slant = v3_make(x * p->p1 * -0.5f, y * p->p1 * -0.5f, (vf)(1.0f));
    const v3 right = v3_select(on_top, v3_axis(0), v3_neg(v3_axis(0)));
    surface_tangents(p, v3_select(on_wall, v3_make(-y, x, (vf)(0.0f)), right),
                     v3_select(on_wall, v3_select(flipped, v3_neg(slant), slant), v3_axis(1)), s);
#endif
}

#endif
