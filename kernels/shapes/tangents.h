// Tangents of surfaces, for normal maps: the directions of dP/du and dP/dv, of any length.
#ifndef CLRT_KERNELS_SHAPES_TANGENTS_H
#define CLRT_KERNELS_SHAPES_TANGENTS_H

#include "shapes/surface.h"

#if HAS_NORMAL_MAP || HAS_MESH
// a of any length but 0, scaled so that its products neither overflow nor vanish.
static inline v3 scaled_to_one(v3 a)
{
    const v3 m = v3_abs(a);
    const vf largest = vf_max(m.x, vf_max(m.y, m.z));
    return v3_scale(a, (vf)(1.0f) / largest);
}
#endif

#if HAS_NORMAL_MAP
static inline v3 v3_cross(v3 a, v3 b)
{
    return v3_make(difference_of_products(a.y, b.z, a.z, b.y), difference_of_products(a.z, b.x, a.x, b.z),
                   difference_of_products(a.x, b.y, a.y, b.x));
}

static inline v3 v3_axis(int k)
{
    return v3_make((vf)(k == 0 ? 1.0f : 0.0f), (vf)(k == 1 ? 1.0f : 0.0f), (vf)(k == 2 ? 1.0f : 0.0f));
}

// The tangents that are u and v in a space q = A (p - c), given as `map`. They are carried by the inverse of A, whose
// columns are the cross products of its rows over its determinant.
static inline void surface_tangents(const PrimitiveLanes *map, v3 u, v3 v, SurfaceLanes *s)
{
    const v3 a = v3_abs(map->row0), b = v3_abs(map->row1), c = v3_abs(map->row2);
    const vf largest = vf_max(vf_max(vf_max(a.x, vf_max(a.y, a.z)), vf_max(b.x, vf_max(b.y, b.z))),
                              vf_max(c.x, vf_max(c.y, c.z)));
    const vf scale = (vf)(1.0f) / largest;
    const v3 row0 = v3_scale(map->row0, scale), row1 = v3_scale(map->row1, scale);
    const v3 row2 = v3_scale(map->row2, scale);
    const v3 x = v3_cross(row1, row2), y = v3_cross(row2, row0), z = v3_cross(row0, row1);
    const v3 along_u = v3_fma(z, u.z, v3_fma(y, u.y, v3_scale(x, u.x)));
    const v3 along_v = v3_fma(z, v.z, v3_fma(y, v.y, v3_scale(x, v.x)));
    const vm mirrored = v3_dot(row0, x) < (vf)(0.0f);
    s->tangent_u = v3_select(mirrored, v3_neg(along_u), along_u);
    s->tangent_v = v3_select(mirrored, v3_neg(along_v), along_v);
}

// On a triangle whose tangents are its edges from the first vertex, in the lanes of m: those of the texture
// coordinates us, vs at its vertices. Where these lie on a line, the edges stay.
static inline void surface_uv_tangents(SurfaceLanes *s, const vf us[3], const vf vs[3], vm m)
{
    const v3 edge1 = s->tangent_u, edge2 = s->tangent_v;
    const vf u1 = us[1] - us[0], u2 = us[2] - us[0], v1 = vs[1] - vs[0], v2 = vs[2] - vs[0];
    const vf area = difference_of_products(u1, v2, u2, v1);
    const vf sign = area < (vf)(0.0f) ? (vf)(-1.0f) : (vf)(1.0f);
    const v3 along_u = v3_sub(v3_scale(edge1, v2 * sign), v3_scale(edge2, v1 * sign));
    const v3 along_v = v3_sub(v3_scale(edge2, u1 * sign), v3_scale(edge1, u2 * sign));
    const vm spread = m & (area != (vf)(0.0f));
    s->tangent_u = v3_select(spread, along_u, edge1);
    s->tangent_v = v3_select(spread, along_v, edge2);
}

// The unit vector along what v has beside n; where that is next to nothing, the one to the right of somebody who
// faces n.
static inline v3 unit_beside(v3 n, v3 v)
{
    const v3 scaled = scaled_to_one(v);
    const v3 beside = v3_fma(n, -v3_dot(n, scaled), scaled);
    const vm steep = fabs(n.y) > (vf)(0.9f);
    const v3 right = v3_make(steep ? n.y : n.z, steep ? -n.x : (vf)(0.0f), steep ? (vf)(0.0f) : -n.x);
    return v3_normalize(v3_select(v3_dot(beside, beside) > (vf)(1e-10f), beside, right));
}

// The unit normal n, as the color of a normal map at a place with these tangents tilts it; a color without a
// direction leaves it.
static inline v3 tilted_normal(v3 n, v3 tangent_u, v3 tangent_v, v3 color)
{
    const v3 t = unit_beside(n, tangent_u);
    const v3 across = v3_cross(n, t);
    const v3 b = v3_select(v3_dot(across, tangent_v) < (vf)(0.0f), v3_neg(across), across);
    const vf x = fma(color.x, (vf)(2.0f), (vf)(-1.0f)), y = fma(color.y, (vf)(2.0f), (vf)(-1.0f));
    const vf z = fma(color.z, (vf)(2.0f), (vf)(-1.0f));
    const v3 tilted = v3_fma(n, z, v3_fma(b, y, v3_scale(t, x)));
    const vf size = v3_dot(tilted, tilted);
    const vm directed = (size > (vf)(1e-10f)) & (size < (vf)(INFINITY));
    return v3_normalize(v3_select(directed, tilted, n));
}
#endif

#endif
