// Woop, Benthin, Wald, "Watertight ray/triangle intersection", 2013, with every edge function a difference of
// products of exact sign, so that neighbours agree on each side of their edge; an edge that a ray meets
// exactly belongs to one of the two triangles that share it, as in rasterisation.
#ifndef CLRT_KERNELS_SHAPES_WOOP_H
#define CLRT_KERNELS_SHAPES_WOOP_H

#include "base/ray.h"

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

// a: vertex relative to the origin, permuted. x and y: distances from the ray; z stays.
static inline v3 shear_flat(v3 a, vf shear_x, vf shear_y)
{
    return v3_make(fma(-shear_x, a.z, a.x), fma(-shear_y, a.z, a.y), a.z);
}

// x and y: distances from the ray; z: along the ray in multiples of dir.
static inline v3 shear_apply(const RayShear *s, v3 vertex, v3 org)
{
    const v3 a = shear_flat(shear_permute(s, v3_sub(vertex, org)), s->shear_x, s->shear_y);
    return v3_make(a.x, a.y, a.z * s->shear_z);
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

// Of vertices as shear_apply gives them.
static inline TriangleWeights woop_weights(v3 a, v3 b, v3 c)
{
    TriangleWeights w;
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

// The mean of the vertices' t: between the least and the largest of them but for 4 roundings.
static inline vf woop_distance(const TriangleWeights *w)
{
    return fma(w->b2, w->c_z, fma(w->b1, w->b_z, w->b0 * w->a_z)) / w->det;
}

// The same of a face of a mesh without the rule for edges, which is hardly ever asked: inside includes them,
// and where the least or the most of the weights is 0, woop_on_edge decides.
typedef struct {
    vf b0, b1, b2, det;
    vf least, most; // of the three
    vm inside;
} FaceWeights;

static inline FaceWeights face_weights(v3 a, v3 b, v3 c)
{
    FaceWeights w;
    w.b0 = edge_function(b, c);
    w.b1 = edge_function(c, a);
    w.b2 = edge_function(a, b);
    w.det = w.b0 + w.b1 + w.b2;
    w.least = vf_min(vf_min(w.b0, w.b1), w.b2);
    w.most = vf_max(vf_max(w.b0, w.b1), w.b2);
    w.inside = (w.least >= (vf)(0.0f)) | (w.most <= (vf)(0.0f));
    return w;
}

// Whether the ray passes within.
OUTLINE vm woop_on_edge(v3 a, v3 b, v3 c) { return woop_weights(a, b, c).within; }

// t of the hit; z of the vertices is not scaled. Between the least and the largest t of the vertices but for
// 5 roundings, since the weights are of one sign; NaN where the face has no area as the ray sees it.
static inline vf face_distance(const FaceWeights *w, v3 a, v3 b, v3 c, vf shear_z)
{
    const vf z = fma(w->b2, c.z, fma(w->b1, b.z, w->b0 * a.z));
    return z * shear_z / w->det;
}

#endif
