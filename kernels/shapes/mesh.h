// Faces of meshes: the surface at a hit. Their intersection, eight at a time, is in accel/block.h.
#ifndef CLRT_KERNELS_SHAPES_MESH_H
#define CLRT_KERNELS_SHAPES_MESH_H

#include "base/offset.h"
#include "base/table.h"
#include "shapes/surface.h"
#include "shapes/tangents.h"
#include "shapes/woop.h"
#include "shared/mesh.h"

#define BLOCK_NUMBERS 80

// The three vertices of a face for each lane, and the number of the face.
typedef struct {
    v3 a, b, c;
    vi face;
} FaceLanes;

// Of the faces at the slots (8 * block + place in the block), all of which must be valid.
static inline FaceLanes face_gather(global const TriangleBlock *blocks, vi slot)
{
    FaceLanes f;
    const Row row = row_make(blocks, slot >> 3, BLOCK_NUMBERS);
    // A row's numbers are wanted at a place of each lane's own, so there is no broadcast.
    const vi at = row.offset + (slot & 7);
    f.a = v3_make(vf_gather(row.base, at), vf_gather(row.base, at + 8), vf_gather(row.base, at + 16));
    f.b = v3_make(vf_gather(row.base, at + 24), vf_gather(row.base, at + 32), vf_gather(row.base, at + 40));
    f.c = v3_make(vf_gather(row.base, at + 48), vf_gather(row.base, at + 56), vf_gather(row.base, at + 64));
    f.face = vi_gather((global const int *)row.base, at + 72) & (int)~FACE_TRANSMITS;
    return f;
}

static inline FaceWeights face_lanes_weights(const FaceLanes *f, v3 org, v3 dir)
{
    const RayShear shear = shear_make(dir);
    return face_weights(shear_apply(&shear, f->a, org), shear_apply(&shear, f->b, org),
                        shear_apply(&shear, f->c, org));
}

// Unit normal (b-a) x (c-a); of a face so thin that floats know none, the direction it is seen from.
static inline v3 face_normal(const FaceLanes *f, v3 dir)
{
    const v3 ab = scaled_to_one(v3_sub(f->b, f->a)), ac = scaled_to_one(v3_sub(f->c, f->a));
    const v3 n = v3_make(difference_of_products(ab.y, ac.z, ab.z, ac.y),
                         difference_of_products(ab.z, ac.x, ab.x, ac.z),
                         difference_of_products(ab.x, ac.y, ab.y, ac.x));
    const v3 unit = v3_normalize(scaled_to_one(n));
    const vm known = v3_dot(unit, unit) > (vf)(0.5f);
    return v3_select(known, unit, v3_neg(v3_normalize(dir)));
}

// The surface where the ray meets the face: the point is the mean of the vertices by their weights, whose
// error is that of the sum (Pharr, Jakob, Humphreys, "Physically Based Rendering", 4th ed., 6.8.5).
static inline void surface_mesh_face(const FaceLanes *f, v3 org, v3 dir, SurfaceLanes *s)
{
    const FaceWeights w = face_lanes_weights(f, org, dir);
    const vf inverse = (vf)(1.0f) / w.det;
    const vf b0 = w.b0 * inverse;
    s->b1 = w.b1 * inverse;
    s->b2 = w.b2 * inverse;
    s->p = v3_fma(f->c, s->b2, v3_fma(f->b, s->b1, v3_scale(f->a, b0)));
    const v3 terms = v3_fma(v3_abs(f->c), s->b2, v3_fma(v3_abs(f->b), s->b1, v3_scale(v3_abs(f->a), b0)));
    s->error = v3_scale(v3_abs(terms), (vf)(8.0f * ROUNDING));
    s->ng = face_normal(f, dir);
#if HAS_NORMAL_MAP
    s->tangent_u = v3_sub(f->b, f->a);
    s->tangent_v = v3_sub(f->c, f->a);
#endif
#if HAS_UV
    surface_uv(s, s->b1, s->b2);
#endif
}

#endif
