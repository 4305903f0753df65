// Batch traversal: BATCH rays of one work-item walk an eight-way hierarchy together with one stack of
// (node, mask of rays). Each ray tests the eight boxes of a node in one vector operation; loading, sorting
// and stack are shared by the batch. In leaves one primitive is tested against LANES rays at a time.
// BATCH is 1 where the hardware runs one ray a work-item (GPUs): the same code is then the plain loop.
//
// Pro: needs no coherence, never tests a box for a ray that did not reach it. Con: for very coherent rays a
// packet with a frustum test does less. Boxes are tested by the robust slabs of Ize, "Robust BVH ray
// traversal", 2013, with the slack that the error of a primitive's t needs, so that the order of traversal
// can never change a hit: among hits the least t wins, ties go to the first-defined primitive.
#ifndef CLRT_KERNELS_ACCEL_BATCH_H
#define CLRT_KERNELS_ACCEL_BATCH_H

#include "base/ray.h"
#include "shapes/shapes.h"
#include "shared/bvh.h"
#include "shared/instance.h"
#include "shared/material.h"

// Relative slack of a box's far side: 32 rounding units, several times the error bound of any t.
#define BOX_SLACK 1.000004f

// What traversal reads of the scene.
typedef struct {
    global const Primitive *primitives;
    global const PrimitiveInfo *infos;
#if HAS_BVH
    global const BvhNode *nodes;
#endif
    uint plane_count;
    uint root;
} Hierarchy;

// The rays of a batch in one space.
typedef struct {
    real org_x[BATCH], org_y[BATCH], org_z[BATCH];
    real dir_x[BATCH], dir_y[BATCH], dir_z[BATCH];
} BatchRays;

// What a batch looks for and has found; the same in every space, because t is.
typedef struct {
    real tfar[BATCH];     // closest so far, or the end of the ray
    int self[BATCH];      // 2 * index of the primitive the ray starts on + (1 where it starts inward); -1
    int primitive[BATCH]; // hit, or NO_HIT
#if HAS_INSTANCES
    int self_instance[BATCH];
    int instance[BATCH]; // index of the INSTANCE primitive of the hit, or NO_HIT
#endif
#if HAS_TRANSMITTANCE
    real tmin[BATCH]; // hits have t > tmin, or t = tmin on a primitive after last_x in the order of ties
    int last_primitive[BATCH]; // surface that the ray has crossed at tmin, or NO_HIT
    int last_instance[BATCH];
#endif
} BatchHits;

static inline int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

// Bits of the rays of a batch that are meant, count of them or all.
static inline uint batch_mask(uint count)
{
    const uint rays = count < BATCH ? count : BATCH;
    return rays == 32 ? 0xffffffffu : (1u << rays) - 1u;
}

static inline PrimitiveLanes primitive_splat(global const Primitive *p)
{
    PrimitiveLanes lanes;
    const f32x4 row0 = p->row0, row1 = p->row1, row2 = p->row2;
    lanes.row0 = v3_make((vf)(row0.x), (vf)(row0.y), (vf)(row0.z));
    lanes.row1 = v3_make((vf)(row1.x), (vf)(row1.y), (vf)(row1.z));
    lanes.row2 = v3_make((vf)(row2.x), (vf)(row2.y), (vf)(row2.z));
    lanes.c = v3_make((vf)(row0.w), (vf)(row1.w), (vf)(row2.w));
    lanes.p0 = (vf)(p->p0);
    lanes.p1 = (vf)(p->p1);
    lanes.p2 = (vf)(p->p2);
    return lanes;
}

// Place of a hit in the order of definition.
static inline ulong hit_order(const Hierarchy *scene, int instance, int primitive)
{
    global const PrimitiveInfo *info = &scene->infos[primitive];
    ulong order = (ulong)info->order_high << 32 | info->order_low;
    if (instance >= 0)
        order += (ulong)scene->infos[instance].order_high << 32 | scene->infos[instance].order_low;
    return order;
}

// Lanes of `equal` whose hit on the primitive comes first in the order of definition.
static inline vm wins_tie(const Hierarchy *scene, const BatchHits *hits, int first, vm equal, int primitive,
                          int instance)
{
    uint bits = vm_bits(equal), winners = 0;
    for (; bits; bits &= bits - 1) {
        const int k = lowest_bit(bits);
#if HAS_INSTANCES
        const int other = hits->instance[first + k];
#else
        const int other = NO_HIT;
#endif
        if (hit_order(scene, instance, primitive) < hit_order(scene, other, hits->primitive[first + k]))
            winners |= 1u << k;
    }
    return vm_from_bits(winners);
}

#if HAS_TRANSMITTANCE
// tmin for the primitive: surfaces that come after the last one crossed may lie at the very same t.
static inline vf tmin_after_last(const Hierarchy *scene, const BatchHits *hits, int first, int primitive,
                                 int instance)
{
    LanesF tmin;
    tmin.v = VF_LOAD(&hits->tmin[first]);
    if (!vm_any(VI_LOAD(&hits->last_primitive[first]) != (vi)(NO_HIT)))
        return tmin.v;
    for (int k = 0; k < LANES; k++) {
        const int last = hits->last_primitive[first + k];
        const real t = hits->tmin[first + k];
        const bool open = last != NO_HIT && t > 0.0f &&
                          hit_order(scene, hits->last_instance[first + k], last) <
                              hit_order(scene, instance, primitive);
        tmin.s[k] = open ? as_float(as_int(t) - 1) : t;
    }
    return tmin.v;
}
#endif

// Tests one primitive against the rays of mask. Rays that it stops are reported in the result.
OUTLINE uint test_primitive(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  int primitive, int instance)
{
    global const Primitive *record = &scene->primitives[primitive];
    const PrimitiveLanes lanes = primitive_splat(record);
    uint found = 0;
    for (int first = 0; first < BATCH; first += LANES) {
        const uint bits = mask >> first & ((1u << LANES) - 1u);
        if (!bits)
            continue;
        RayLanes ray;
        ray.org = v3_make(VF_LOAD(&rays->org_x[first]), VF_LOAD(&rays->org_y[first]),
                          VF_LOAD(&rays->org_z[first]));
        ray.dir = v3_make(VF_LOAD(&rays->dir_x[first]), VF_LOAD(&rays->dir_y[first]),
                          VF_LOAD(&rays->dir_z[first]));
        const vi self = VI_LOAD(&hits->self[first]);
        ray.self = (self >> 1) == (vi)(primitive);
        ray.inward = (self & 1) != (vi)(0);
#if HAS_INSTANCES
        ray.self = ray.self & (VI_LOAD(&hits->self_instance[first]) == (vi)(instance));
#endif
#if HAS_TRANSMITTANCE
        ray.tmin = tmin_after_last(scene, hits, first, primitive, instance);
#else
        ray.tmin = (vf)(0.0f);
#endif
        const vf tfar = VF_LOAD(&hits->tfar[first]);
        const vf t = intersect_primitive(record->kind & PRIMITIVE_KIND_MASK, &lanes, &ray);
        const vm active = vm_from_bits(bits);
        vm closer = active & (t < tfar);
        const vm equal = active & (t == tfar) & (t < (vf)(INFINITY)) &
                         (VI_LOAD(&hits->primitive[first]) != (vi)(NO_HIT));
        if (vm_any(equal))
            closer = closer | wins_tie(scene, hits, first, equal, primitive, instance);
        const uint closer_bits = vm_bits(closer);
        if (!closer_bits)
            continue;
        found |= closer_bits << first;
        VF_STORE(closer ? t : tfar, &hits->tfar[first]);
        VI_STORE(closer ? (vi)(primitive) : VI_LOAD(&hits->primitive[first]), &hits->primitive[first]);
#if HAS_INSTANCES
        VI_STORE(closer ? (vi)(instance) : VI_LOAD(&hits->instance[first]), &hits->instance[first]);
#endif
    }
    return found;
}

#if HAS_BVH
#include "accel/traverse.h"
#endif

// Closest hits of the rays in mask (any_hit false), or any hit (true: then only the fact counts and tfar,
// primitive and instance of a ray that hit are those of some hit). opaque_only leaves out primitives that
// may let light through; bit k of planes_out leaves out plane k. tfar, tmin and self are set by the caller,
// primitive to NO_HIT.
OUTLINE void traverse(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask, bool any_hit,
                      bool opaque_only, uint planes_out)
{
#if HAS_PLANE
    for (uint i = 0; i < scene->plane_count && mask; i++) {
        if ((i < 32 && (planes_out >> i & 1u)) ||
            (opaque_only && !(scene->primitives[i].kind & PRIMITIVE_OPAQUE)))
            continue;
        const uint found = test_primitive(scene, rays, hits, mask, (int)i, NO_HIT);
        if (any_hit)
            mask &= ~found;
    }
#endif
#if HAS_BVH
    if (mask)
        traverse_scene(scene, rays, hits, mask, any_hit, opaque_only);
#endif
}

#endif
