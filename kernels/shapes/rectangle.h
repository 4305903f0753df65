// RECTANGLE, a parallelogram.
#ifndef CLRT_KERNELS_SHAPES_RECTANGLE_H
#define CLRT_KERNELS_SHAPES_RECTANGLE_H

#include "shapes/plane.h"

static inline vf intersect_rectangle(const PrimitiveLanes *p, const RayLanes *ray)
{
    const vf t = -plane_height(plane_dot(p->row2, ray->org), p->p0) / v3_dot(p->row2, ray->dir);
    const v3 f = v3_fma(ray->dir, t, v3_sub(ray->org, p->c));
    const vf x = v3_dot(p->row0, f), y = v3_dot(p->row1, f);
    return flat_hit(ray, t, (t < (vf)(INFINITY)) & (fabs(x) <= (vf)(1.0f)) & (fabs(y) <= (vf)(1.0f)));
}

static inline void surface_rectangle(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    s->p = v3_fma(ray->dir, t, ray->org);
    s->ng = p->row2;
    surface_flat(s, p->p0);
#if HAS_UV
    const v3 f = v3_sub(s->p, p->c);
    surface_uv(s, uv_clamp(fma(v3_dot(p->row0, f), (vf)(0.5f), (vf)(0.5f))),
               uv_clamp(fma(v3_dot(p->row1, f), (vf)(0.5f), (vf)(0.5f))));
#endif
}

#endif
