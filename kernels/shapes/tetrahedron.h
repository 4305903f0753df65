// TETRAHEDRON: four half-spaces.
#ifndef CLRT_KERNELS_SHAPES_TETRAHEDRON_H
#define CLRT_KERNELS_SHAPES_TETRAHEDRON_H

#include "shapes/box.h"

// The function of the face opposite to vertex a, row.p + offset >= 0 inside.
static inline v3 tetrahedron_last_row(const PrimitiveLanes *p)
{
    return v3_neg(v3_add(v3_add(p->row0, p->row1), p->row2));
}

// The barycentric weights of b, c, d and a at the origin of a ray, and how they grow along it. That of a is
// what the others leave, so that its row is never rounded.
typedef struct {
    vf at[4], rate[4];
} TetrahedronWeights;

static inline TetrahedronWeights tetrahedron_weights(const PrimitiveLanes *p, const RayLanes *ray)
{
    const vf2 b = plane_dot(p->row0, ray->org), c = plane_dot(p->row1, ray->org);
    const vf2 d = plane_dot(p->row2, ray->org);
    const vf2 first = two_sum(b.hi, c.hi), second = two_sum(first.hi, d.hi);
    const vf2 sum = vf2_make(second.hi, (first.lo + second.lo) + ((b.lo + c.lo) + d.lo));
    const v3 rate = canonical_direction(p, ray->dir);
    TetrahedronWeights w;
    w.at[0] = plane_height(b, -p->c.x);
    w.at[1] = plane_height(c, -p->c.y);
    w.at[2] = plane_height(d, -p->c.z);
    w.at[3] = -plane_height(sum, p->p0);
    w.rate[0] = rate.x;
    w.rate[1] = rate.y;
    w.rate[2] = rate.z;
    w.rate[3] = -((rate.x + rate.y) + rate.z);
    return w;
}

// The part of the ray where weight i is not negative, with the face at *t.
static inline Interval half_space(const TetrahedronWeights *w, int i, vf *t)
{
    const vf meet = -w->at[i] / w->rate[i];
    const vm parallel = w->rate[i] == (vf)(0.0f);
    const vm rising = w->rate[i] > (vf)(0.0f);
    *t = parallel ? (vf)(INFINITY) : meet;
    const Interval crossed = interval_make(rising ? meet : (vf)(-INFINITY), rising ? (vf)(INFINITY) : meet);
    const Interval along = interval_select(w->at[i] >= (vf)(0.0f), interval_all(), interval_none());
    return interval_select(parallel, along, crossed);
}

static inline vf intersect_tetrahedron(const PrimitiveLanes *p, const RayLanes *ray)
{
    const TetrahedronWeights w = tetrahedron_weights(p, ray);
    vf t;
    Interval solid = half_space(&w, 0, &t);
    solid = interval_common(half_space(&w, 1, &t), solid);
    solid = interval_common(half_space(&w, 2, &t), solid);
    solid = interval_common(half_space(&w, 3, &t), solid);
    return solid_hit(ray, solid);
}

static inline void tetrahedron_offer(FaceChoice *best, const TetrahedronWeights *w, int weight, vf t, v3 row,
                                     vf offset, int face)
{
    vf face_t;
    half_space(w, weight, &face_t);
    face_offer(best, t, face_t, v3_neg(row), offset, face);
}

// Settles s on the face.
static inline void surface_face(const FaceChoice *face, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const vf inverse = (vf)(1.0f) / sqrt(v3_dot(face->row, face->row));
    s->ng = v3_scale(face->row, inverse);
    s->p = v3_fma(ray->dir, t, ray->org);
    const vf terms = v3_dot(v3_abs(face->row), v3_abs(s->p)) + fabs(face->offset);
    surface_settle(s, plane_distance(face->row, face->offset, s->p) * inverse,
                   4.0f * ROUNDING * terms * inverse);
}

static inline void surface_tetrahedron(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    FaceChoice best;
    best.miss = (vf)(INFINITY);
    best.row = p->row2;
    best.offset = (vf)(0.0f);
    best.face = (vi)(0);
    // In the order abc, abd, acd, bcd: opposite to d, c, b, a.
    const TetrahedronWeights w = tetrahedron_weights(p, ray);
    tetrahedron_offer(&best, &w, 2, t, p->row2, p->c.z, 0);
    tetrahedron_offer(&best, &w, 1, t, p->row1, p->c.y, 1);
    tetrahedron_offer(&best, &w, 0, t, p->row0, p->c.x, 2);
    tetrahedron_offer(&best, &w, 3, t, tetrahedron_last_row(p), p->p0, 3);
    surface_face(&best, ray, t, s);
#if HAS_UV
    const vf b = plane_distance(p->row0, -p->c.x, s->p), c = plane_distance(p->row1, -p->c.y, s->p);
    const vf d = plane_distance(p->row2, -p->c.z, s->p);
    surface_uv(s, uv_clamp(best.face <= (vi)(1) ? b : c), uv_clamp(best.face == (vi)(0) ? c : d));
#endif
#if HAS_NORMAL_MAP
    // From the first vertex of the face, b on the last face and a on the others, to the second and the third.
    const v3 first = v3_select(best.face == (vi)(3), v3_axis(0), v3_splat(0.0f));
    const v3 second = v3_select(best.face <= (vi)(1), v3_axis(0), v3_axis(1));
    const v3 third = v3_select(best.face == (vi)(0), v3_axis(1), v3_axis(2));
    surface_tangents(p, v3_sub(second, first), v3_sub(third, first), s);
#endif
}

#endif
