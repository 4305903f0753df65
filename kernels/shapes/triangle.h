// TRIANGLE: Woop, Benthin, Wald, "Watertight ray/triangle intersection", 2013, with every edge function a
// difference of products of exact sign, so that neighbours agree on each side of their edge; an edge that a
// ray meets exactly belongs to one of the two triangles that share it, as in rasterisation.
#ifndef CLRT_KERNELS_SHAPES_TRIANGLE_H
#define CLRT_KERNELS_SHAPES_TRIANGLE_H

#include "shapes/plane.h"

// Axes permuted so that the ray runs mainly along z, and the shear that makes it the z axis of unit length.
typedef struct {
    vm z_is_x, z_is_y;
    vf shear_x, shear_y, shear_z;
} RayShear;

static inline v3 shear_permute(const RayShear *s, v3 a)
{
    return v3_make(s->z_is_x ? a.y : s->z_is_y ? a.z : a.x, s->z_is_x ? a.z : s->z_is_y ? a.x : a.y,
                   s->z_is_x ? a.x : s->z_is_y ? a.y : a.z);
}

static inline RayShear shear_make(v3 dir)
{
    RayShear s;
    const v3 a = v3_abs(dir);
    s.z_is_x = (a.x >= a.y) & (a.x >= a.z);
    s.z_is_y = !s.z_is_x & (a.y >= a.z);
    const v3 d = shear_permute(&s, dir);
    s.shear_z = (vf)(1.0f) / d.z;
    s.shear_x = d.x / d.z;
    s.shear_y = d.y / d.z;
    return s;
}

// x and y: distances from the ray; z: along the ray in multiples of dir.
static inline v3 shear_apply(const RayShear *s, v3 vertex, v3 org)
{
    const v3 a = shear_permute(s, v3_sub(vertex, org));
    return v3_make(fma(-s->shear_x, a.z, a.x), fma(-s->shear_y, a.z, a.y), a.z * s->shear_z);
}

// Twice the signed area between the ray's point and the edge from a to b.
static inline vf edge_function(v3 a, v3 b) { return difference_of_products(a.x, b.y, a.y, b.x); }

// Whether the ray is on the inner side of the edge, given the function and the winding (1 or -1). The
// function's sign is exact; where it is 0, the edge counts if it runs upwards, or level to the right, along
// the boundary, which it does for one of two triangles that lie on either side of it.
static inline vm edge_inside(vf function, v3 a, v3 b, vm positive)
{
    const vm up = (a.y < b.y) | ((a.y == b.y) & (a.x < b.x));
    const vm down = (a.y > b.y) | ((a.y == b.y) & (a.x > b.x));
    const vm on = (function == (vf)(0.0f)) & (positive ? up : down);
    return (positive ? function > (vf)(0.0f) : function < (vf)(0.0f)) | on;
}

// Barycentric weights times det, and whether the ray passes within.
typedef struct {
    vf b0, b1, b2, det;
    vf a_z, b_z, c_z; // t of the vertices
    vm within;
} TriangleWeights;

static inline TriangleWeights triangle_weights(const PrimitiveLanes *p, const RayLanes *ray)
{
    TriangleWeights w;
    const RayShear shear = shear_make(ray->dir);
    const v3 a = shear_apply(&shear, p->row0, ray->org);
    const v3 b = shear_apply(&shear, p->row1, ray->org);
    const v3 c = shear_apply(&shear, p->row2, ray->org);
    w.b0 = edge_function(b, c);
    w.b1 = edge_function(c, a);
    w.b2 = edge_function(a, b);
    w.det = w.b0 + w.b1 + w.b2;
    w.a_z = a.z;
    w.b_z = b.z;
    w.c_z = c.z;
    const vm positive = w.det > (vf)(0.0f);
    w.within = edge_inside(w.b0, b, c, positive) & edge_inside(w.b1, c, a, positive) &
               edge_inside(w.b2, a, b, positive) & (w.det != (vf)(0.0f));
    return w;
}

// t is that of the plane, by the formula of intersect_plane, so that shapes in one plane have the same t, or
// the mean of the vertices' t where the plane's error bound is several times larger (by p0): the mean is
// exact to the size of the triangle, the plane to the distances from the origin of the space. Either way the
// error along the normal stays below what rays are moved off a surface, so that triangles in one plane never
// shadow each other.
static inline vf intersect_triangle(const PrimitiveLanes *p, const RayLanes *ray)
{
    const TriangleWeights w = triangle_weights(p, ray);
    const vf mean = fma(w.b2, w.c_z, fma(w.b1, w.b_z, w.b0 * w.a_z)) / w.det;
    const vf facing = v3_dot(p->c, ray->dir);
    const vf plane = -plane_distance(p->c, p->p1, ray->org) / facing;
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
#if HAS_UV
    surface_uv(s, s->b1, s->b2);
#endif
}

#endif
