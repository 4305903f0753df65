// BOX: three pairs of parallel planes.
#ifndef CLRT_KERNELS_SHAPES_BOX_H
#define CLRT_KERNELS_SHAPES_BOX_H

#include "shapes/plane.h"

// t of the faces n.p = low and n.p = high of a pair; unordered.
typedef struct {
    vf low, high;
} SlabTimes;

// By the formula of intersect_plane, so that faces, planes and disks in one plane have the same t. A ray
// along the faces is between them always or never.
static inline SlabTimes slab_times(v3 n, vf low, vf high, const RayLanes *ray)
{
    SlabTimes s;
    const vf2 dot = plane_dot(n, ray->org);
    const vf above_low = plane_height(dot, low), above_high = plane_height(dot, high);
    const vf rate = v3_dot(n, ray->dir);
    const vm parallel = rate == (vf)(0.0f);
    const vm between = (above_low >= (vf)(0.0f)) & (above_high <= (vf)(0.0f));
    s.low = parallel ? (between ? (vf)(-INFINITY) : (vf)(INFINITY)) : -above_low / rate;
    s.high = parallel ? (vf)(INFINITY) : -above_high / rate;
    return s;
}

static inline Interval slab_interval(SlabTimes s)
{
    return interval_make(vf_min(s.low, s.high), vf_max(s.low, s.high));
}

static inline vf intersect_box(const PrimitiveLanes *p, const RayLanes *ray)
{
    const Interval x = slab_interval(slab_times(p->row0, p->c.x, p->p0, ray));
    const Interval y = slab_interval(slab_times(p->row1, p->c.y, p->p1, ray));
    const Interval z = slab_interval(slab_times(p->row2, p->c.z, p->p2, ray));
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

static inline void slab_offer(FaceChoice *best, const RayLanes *ray, vf t, v3 n, vf low, vf high, int face)
{
    const SlabTimes s = slab_times(n, low, high, ray);
    face_offer(best, t, s.low, v3_neg(n), -low, face);
    face_offer(best, t, s.high, n, high, face + 1);
}

#if HAS_UV
// Where a coordinate lies between the faces of a pair, 0 to 1.
static inline vf slab_share(v3 n, vf low, vf high, v3 at)
{
    return plane_distance(n, low, at) / (high - low);
}

// Right and up of somebody who faces the side; face = 2 axis + (1 on the side that looks along the axis).
static inline void box_uv(const PrimitiveLanes *p, vi face, SurfaceLanes *s)
{
    const v3 q = v3_make(slab_share(p->row0, p->c.x, p->p0, s->p), slab_share(p->row1, p->c.y, p->p1, s->p),
                         slab_share(p->row2, p->c.z, p->p2, s->p));
    const vi axis = face >> 1;
    const vm positive = (face & 1) != (vi)(0);
    const vm on_x = axis == (vi)(0), on_y = axis == (vi)(1);
    // The sides of x see z run to the left, the others x to the right; both turned round on negative sides.
    const vf along = on_x ? q.z : q.x;
    const vm left = (on_x & positive) | (!on_x & !positive);
    surface_uv(s, uv_clamp(left ? 1.0f - along : along), uv_clamp(on_y ? 1.0f - q.z : q.y));
#if HAS_NORMAL_MAP
    const vf turn = left ? (vf)(-1.0f) : (vf)(1.0f), none = (vf)(0.0f);
    surface_tangents(p, v3_make(on_x ? none : turn, none, on_x ? turn : none),
                     v3_select(on_y, v3_neg(v3_axis(2)), v3_axis(1)), s);
#endif
}
#endif

static inline void surface_box(const PrimitiveLanes *p, const RayLanes *ray, vf t, SurfaceLanes *s)
{
    FaceChoice best;
    best.miss = (vf)(INFINITY);
    best.row = p->row0;
    best.offset = (vf)(0.0f);
    best.face = (vi)(0);
    slab_offer(&best, ray, t, p->row0, p->c.x, p->p0, 0);
    slab_offer(&best, ray, t, p->row1, p->c.y, p->p1, 2);
    slab_offer(&best, ray, t, p->row2, p->c.z, p->p2, 4);
    s->p = v3_fma(ray->dir, t, ray->org);
    s->ng = best.row;
    surface_flat(s, best.offset);
#if HAS_UV
    box_uv(p, best.face, s);
#endif
}

#endif
