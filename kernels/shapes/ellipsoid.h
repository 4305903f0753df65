// ELLIPSOID: the unit sphere in its canonical space.
#ifndef CLRT_KERNELS_SHAPES_ELLIPSOID_H
#define CLRT_KERNELS_SHAPES_ELLIPSOID_H

#include "shapes/sphere.h"

static inline vf intersect_ellipsoid(const PrimitiveLanes *p, const RayLanes *ray)
{
    const CanonicalRay q = canonical_ray(p, ray);
    const Interval roots = sphere_roots(q.o, q.d, (vf)(1.0f), ray->self);
    return solid_hit(ray, interval_make(q.shift + roots.near, q.shift + roots.far));
}

static inline void surface_ellipsoid(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    s->p = v3_fma(ray->dir, t, ray->org);
    const v3 q = canonical_point(p, s->p);
    const vf length = sqrt(v3_dot(q, q));
    const v3 unit = v3_scale(q, (vf)(1.0f) / length);
    surface_curved(p, unit, length - 1.0f, 2.0f, s);
#if HAS_UV
    sphere_uv(s, unit);
#endif
#if HAS_NORMAL_MAP
    sphere_tangents(p, unit, s);
#endif
}

#endif
