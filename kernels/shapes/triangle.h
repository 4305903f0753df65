// TRIANGLE: one of its own, as the scene language writes it; its edges are those of shapes/woop.h.
#ifndef CLRT_KERNELS_SHAPES_TRIANGLE_H
#define CLRT_KERNELS_SHAPES_TRIANGLE_H

#include "shapes/plane.h"
#include "shapes/woop.h"

static inline TriangleWeights triangle_weights(const PrimitiveLanes *p, const RayLanes *ray)
{
    const RayShear shear = shear_make(ray->dir);
    return woop_weights(shear_apply(&shear, p->row0, ray->org), shear_apply(&shear, p->row1, ray->org),
                        shear_apply(&shear, p->row2, ray->org));
}

// t is that of the plane, by the formula of intersect_plane, so that shapes in one plane have the same t, or
// the mean of the vertices' t where the plane's error bound is several times larger (by p0): the mean is
// exact to the size of the triangle, the plane to the distances from the origin of the space. Either way the
// error along the normal stays below what rays are moved off a surface, so that triangles in one plane never
// shadow each other.
static inline vf intersect_triangle(const PrimitiveLanes *p, const RayLanes *ray)
{
    const TriangleWeights w = triangle_weights(p, ray);
    const vf mean = woop_distance(&w);
    const vf facing = v3_dot(p->c, ray->dir);
    const vf plane = -plane_height(plane_dot(p->c, ray->org), p->p1) / facing;
    const v3 n = v3_abs(p->c);
    const vf reach = vf_max(fabs(w.a_z), vf_max(fabs(w.b_z), fabs(w.c_z)));
    const vf spread = v3_dot(n, v3_fma(v3_abs(ray->dir), fabs(mean), v3_abs(ray->org))) + fabs(p->p1);
    const vf t = reach * fabs(facing) >= spread * p->p0 ? plane : mean;
    return flat_hit(ray, t, w.within & (t < (vf)(INFINITY)));
}

static inline void surface_triangle(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const TriangleWeights w = triangle_weights(p, ray);
    s->p = v3_fma(ray->dir, t, ray->org);
    s->ng = p->c;
    surface_flat(s, p->p1);
    const vf inverse = (vf)(1.0f) / w.det;
    s->b1 = w.b1 * inverse;
    s->b2 = w.b2 * inverse;
#if HAS_NORMAL_MAP
    s->tangent_u = v3_sub(p->row1, p->row0);
    s->tangent_v = v3_sub(p->row2, p->row0);
#endif
#if HAS_UV
    surface_uv(s, s->b1, s->b2);
#endif
}

#endif
