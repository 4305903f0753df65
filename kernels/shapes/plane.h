// PLANE: the only infinite shape.
#ifndef CLRT_KERNELS_SHAPES_PLANE_H
#define CLRT_KERNELS_SHAPES_PLANE_H

#include "shapes/roots.h"
#include "shapes/surface.h"

static inline vf intersect_plane(const PrimitiveLanes *p, const RayLanes *ray)
{
    const vf t = -plane_height(plane_dot(p->row2, ray->org), p->p0) / v3_dot(p->row2, ray->dir);
    return flat_hit(ray, t, t < (vf)(INFINITY));
}

// Puts s->p on the plane: exactly so where that is parallel to two axes, since the distance is then exact.
static inline void surface_flat(SurfaceLanes *s, vf offset)
{
    const vf terms = v3_dot(v3_abs(s->ng), v3_abs(s->p)) + fabs(offset);
    surface_settle(s, plane_distance(s->ng, offset, s->p), 3.0f * ROUNDING * terms);
}

static inline void surface_plane(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    s->p = v3_fma(ray->dir, t, ray->org);
    s->ng = p->row2;
    surface_flat(s, p->p0);
#if HAS_UV
    s->u = v3_dot(p->row0, s->p) + p->c.y;
    s->v = v3_dot(p->row1, s->p) + p->p1;
    s->u_whole = p->c.x;
    s->v_whole = p->c.z;
#endif
#if HAS_NORMAL_MAP
    surface_tangents(p, v3_axis(0), v3_axis(1), s);
#endif
}

#endif
