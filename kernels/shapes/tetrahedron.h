// TETRAHEDRON: four half-spaces.
#ifndef CLRT_KERNELS_SHAPES_TETRAHEDRON_H
#define CLRT_KERNELS_SHAPES_TETRAHEDRON_H

#include "shapes/box.h"

// The function of the face opposite to vertex a, row.p + offset >= 0 inside.
static inline v3 tetrahedron_last_row(const PrimitiveLanes *p)
{
    return v3_neg(v3_add(v3_add(p->row0, p->row1), p->row2));
}

// The part of the ray in the half-space row.p + offset >= 0, whose boundary it meets at *t.
static inline Interval half_space(v3 row, vf offset, const RayLanes *ray, vf *t)
{
    const vf q = plane_height(row, -offset, ray->org);
    const vf rate = v3_dot(row, ray->dir);
    const vf meet = -q / rate;
    const vm parallel = rate == (vf)(0.0f);
    const vm rising = rate > (vf)(0.0f);
    *t = parallel ? (vf)(INFINITY) : meet;
    const Interval crossed = interval_make(rising ? meet : (vf)(-INFINITY), rising ? (vf)(INFINITY) : meet);
    const Interval along = interval_select(q >= (vf)(0.0f), interval_all(), interval_none());
    return interval_select(parallel, along, crossed);
}

static inline vf intersect_tetrahedron(const PrimitiveLanes *p, const RayLanes *ray)
{
    vf t;
    Interval solid = half_space(p->row0, p->c.x, ray, &t);
    solid = interval_common(half_space(p->row1, p->c.y, ray, &t), solid);
    solid = interval_common(half_space(p->row2, p->c.z, ray, &t), solid);
    solid = interval_common(half_space(tetrahedron_last_row(p), p->p0, ray, &t), solid);
    return solid_hit(ray, solid);
}

static inline void tetrahedron_offer(FaceChoice *best, const RayLanes *ray, vf t, v3 row, vf offset, int face)
{
    vf face_t;
    half_space(row, offset, ray, &face_t);
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
    tetrahedron_offer(&best, ray, t, p->row2, p->c.z, 0);
    tetrahedron_offer(&best, ray, t, p->row1, p->c.y, 1);
    tetrahedron_offer(&best, ray, t, p->row0, p->c.x, 2);
    tetrahedron_offer(&best, ray, t, tetrahedron_last_row(p), p->p0, 3);
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
