// BOX: three pairs of parallel planes.
#ifndef CLRT_KERNELS_SHAPES_BOX_H
#define CLRT_KERNELS_SHAPES_BOX_H

#include "shapes/plane.h"

// t of the faces q = 0 and q = 1 of a pair; unordered.
typedef struct {
    vf t0, t1;
} SlabTimes;

static inline SlabTimes slab_times(v3 row, vf c, const RayLanes *ray)
{
    SlabTimes s;
    const vf q = plane_distance(row, -c, ray->org);
    const vf inverse = (vf)(1.0f) / v3_dot(row, ray->dir);
    const vm parallel = fabs(inverse) == (vf)(INFINITY);
    const vm inside = (q >= (vf)(0.0f)) & (q <= (vf)(1.0f));
    s.t0 = parallel ? (inside ? (vf)(-INFINITY) : (vf)(INFINITY)) : -q * inverse;
    s.t1 = parallel ? (vf)(INFINITY) : (1.0f - q) * inverse;
    return s;
}

static inline Interval slab_interval(SlabTimes s)
{
    return interval_make(vf_min(s.t0, s.t1), vf_max(s.t0, s.t1));
}

static inline vf intersect_box(const PrimitiveLanes *p, const RayLanes *ray)
{
    const Interval x = slab_interval(slab_times(p->row0, p->c.x, ray));
    const Interval y = slab_interval(slab_times(p->row1, p->c.y, ray));
    const Interval z = slab_interval(slab_times(p->row2, p->c.z, ray));
    return solid_hit(ray, interval_common(interval_common(x, y), z));
}

// The face of a polyhedron whose t is closest to the hit's; the first one among equals.
typedef struct {
    vf miss; // |t of the face - t of the hit|
    v3 row;  // gradient of the face's function, outward
    vf offset;
    vi face;
} FaceChoice;

static inline void face_offer(FaceChoice *best, vf t, vf face_t, v3 row, vf offset, int face)
{
    const vf miss = fabs(face_t - t);
    const vm better = miss < best->miss;
    best->miss = better ? miss : best->miss;
    best->row = v3_select(better, row, best->row);
    best->offset = better ? offset : best->offset;
    best->face = better ? (vi)(face) : best->face;
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

#if HAS_UV
// q, turned to the object's axes.
static inline v3 box_object_point(const PrimitiveLanes *p, v3 at)
{
    const v3 q = v3_make(plane_distance(p->row0, -p->c.x, at), plane_distance(p->row1, -p->c.y, at),
                         plane_distance(p->row2, -p->c.z, at));
    const vi flips = VI_FROM_VF(p->p0);
    return v3_make((flips & 1) != (vi)(0) ? 1.0f - q.x : q.x, (flips & 2) != (vi)(0) ? 1.0f - q.y : q.y,
                   (flips & 4) != (vi)(0) ? 1.0f - q.z : q.z);
}

// Right and up of somebody who faces the side; face = 2 axis + (1 on the side of q = 1).
static inline void box_uv(const PrimitiveLanes *p, vi face, SurfaceLanes *s)
{
    const v3 q = box_object_point(p, s->p);
    const vi axis = face >> 1;
    const vm positive = (((VI_FROM_VF(p->p0) >> axis) ^ face) & 1) != (vi)(0);
    const vm on_x = axis == (vi)(0), on_y = axis == (vi)(1);
    // The sides of x see z run to the left, the others x to the right; both turned round on negative sides.
    const vf along = on_x ? q.z : q.x;
    const vm left = (on_x & positive) | (!on_x & !positive);
    surface_uv(s, uv_clamp(left ? 1.0f - along : along), uv_clamp(on_y ? 1.0f - q.z : q.y));
}
#endif

static inline void surface_box(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    const SlabTimes x = slab_times(p->row0, p->c.x, ray);
    const SlabTimes y = slab_times(p->row1, p->c.y, ray);
    const SlabTimes z = slab_times(p->row2, p->c.z, ray);
    FaceChoice best;
    best.miss = (vf)(INFINITY);
    best.row = p->row0;
    best.offset = (vf)(0.0f);
    best.face = (vi)(0);
    face_offer(&best, t, x.t0, v3_neg(p->row0), p->c.x, 0);
    face_offer(&best, t, x.t1, p->row0, 1.0f - p->c.x, 1);
    face_offer(&best, t, y.t0, v3_neg(p->row1), p->c.y, 2);
    face_offer(&best, t, y.t1, p->row1, 1.0f - p->c.y, 3);
    face_offer(&best, t, z.t0, v3_neg(p->row2), p->c.z, 4);
    face_offer(&best, t, z.t1, p->row2, 1.0f - p->c.z, 5);
    surface_face(&best, ray, t, s);
#if HAS_UV
    box_uv(p, best.face, s);
#endif
}

#endif
