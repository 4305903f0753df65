// What traversal reads of the scene, what a batch of rays looks for and has found, and which of two hits
// counts: the least t; of equal ones, the first in the order of definition.
#ifndef CLRT_KERNELS_ACCEL_HITS_H
#define CLRT_KERNELS_ACCEL_HITS_H

#include "accel/slabs.h"
#include "base/exact.h"
#include "shared/instance.h"
#include "shared/material.h"
#include "shared/mesh.h"

// For programs that count what a ray visits; nothing else is changed by them.
#ifndef COUNT_VISITS
#define COUNT_VISITS 0
#endif

// In BatchHits.primitive: the rest is not the index of a primitive but the slot of a face, 8 * block + place.
#define HIT_MESH 0x20000000

typedef struct {
    global const Primitive *primitives;
    global const PrimitiveInfo *infos;
#if HAS_BVH
    global const BvhNode *nodes;
#endif
#if HAS_MESH
    global const TriangleBlock *blocks;
    global const MeshRun *mesh_runs;
    uint mesh_run_count;
#endif
    uint plane_count;
    uint root;
} Hierarchy;

// The same in every space, because t is.
typedef struct {
    real tfar[BATCH];     // closest so far, or the end of the ray
    int self[BATCH];      // 2 * what the ray starts on, as in primitive, + (1 where it starts inward); -1
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
#if HAS_PATH
    int left_out[BATCH]; // a primitive that is not there for the ray, or NO_HIT
    int planes_out[BATCH]; // bit k: plane k is not there
#elif HAS_AREA_LIGHTS
    int left_out; // a primitive that is not there for these rays, or NO_HIT
#endif
#if COUNT_VISITS
    uint nodes_visited, leaves_visited; // a node or leaf counts once for each ray that reaches it
#endif
} BatchHits;

#if COUNT_VISITS
#define COUNT_NODE(hits, rays) ((hits)->nodes_visited += (rays))
#define COUNT_LEAF(hits, rays) ((hits)->leaves_visited += (rays))
#else
#define COUNT_NODE(hits, rays)
#define COUNT_LEAF(hits, rays)
#endif

static inline int lowest_bit(uint bits) { return 31 - (int)clz(bits & -bits); }

// Bits of the rays of a batch that are meant, count of them or all.
static inline uint batch_mask(uint count)
{
    const uint rays = count < BATCH ? count : BATCH;
    return rays == 32 ? 0xffffffffu : (1u << rays) - 1u;
}

#if HAS_MESH
// Index of the run that a face belongs to.
static inline uint run_of_face(global const MeshRun *runs, uint count, uint face)
{
    uint low = 0;
    for (uint high = count; high - low > 1;) {
        const uint middle = low + (high - low) / 2;
        if (runs[middle].first <= face)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static inline uint face_of_slot(const Hierarchy *scene, int slot)
{
    return scene->blocks[slot >> 3].face[slot & 7] & ~FACE_TRANSMITS;
}

static inline global const MeshRun *face_run(const Hierarchy *scene, int slot)
{
    const uint face = face_of_slot(scene, slot);
    return &scene->mesh_runs[run_of_face(scene->mesh_runs, scene->mesh_run_count, face)];
}

static inline ulong face_order(const Hierarchy *scene, int slot)
{
    global const MeshRun *run = face_run(scene, slot);
    return ((ulong)run->order_high << 32 | run->order_low) + (face_of_slot(scene, slot) - run->first);
}
#endif

// Place of a hit in the order of definition.
static inline ulong hit_order(const Hierarchy *scene, int instance, int primitive)
{
    ulong order = 0;
    if (instance >= 0)
        order = (ulong)scene->infos[instance].order_high << 32 | scene->infos[instance].order_low;
#if HAS_MESH
    if (primitive & HIT_MESH)
        return order + face_order(scene, primitive & (HIT_MESH - 1));
#endif
    global const PrimitiveInfo *info = &scene->infos[primitive];
    return order + ((ulong)info->order_high << 32 | info->order_low);
}

// Index of the material of a hit: its own, or that of the instance, or what its file names.
static inline uint hit_material(const Hierarchy *scene, int instance, int primitive)
{
#if HAS_MESH
    const uint own = primitive & HIT_MESH ? face_run(scene, primitive & (HIT_MESH - 1))->material
                                          : scene->infos[primitive].material;
#else
    const uint own = scene->infos[primitive].material;
#endif
    if (instance < 0 || !(own & MATERIAL_INHERITED))
        return own & ~MATERIAL_INHERITED;
    const uint named = scene->infos[instance].material;
    return named == NO_INDEX ? own & ~MATERIAL_INHERITED : named;
}

// Whether a hit of ray k comes before the one that it has at the same t.
static inline bool precedes_hit(const Hierarchy *scene, const BatchHits *hits, int k, int primitive,
                                int instance)
{
#if HAS_INSTANCES
    const int other = hits->instance[k];
#else
    const int other = NO_HIT;
#endif
    return hits->primitive[k] != NO_HIT &&
           hit_order(scene, instance, primitive) < hit_order(scene, other, hits->primitive[k]);
}

// Whether ray k starts on the primitive.
static inline bool starts_on(const BatchHits *hits, int k, int primitive, int instance)
{
#if HAS_INSTANCES
    if (hits->self_instance[k] != instance)
        return false;
#endif
    return hits->self[k] >> 1 == primitive;
}

#if HAS_TRANSMITTANCE
// Whether the surface that ray k crossed last, at tmin, comes before the primitive, which may then lie at the
// very same t.
static inline bool follows_last(const Hierarchy *scene, const BatchHits *hits, int k, int primitive,
                                int instance)
{
    const int last = hits->last_primitive[k];
    return last != NO_HIT && hits->tmin[k] > 0.0f &&
           hit_order(scene, hits->last_instance[k], last) < hit_order(scene, instance, primitive);
}

// Whether a hit at t is one that ray k has yet to come to.
static inline bool comes_after_last(const Hierarchy *scene, const BatchHits *hits, int k, real t,
                                    int primitive, int instance)
{
    return t > hits->tmin[k] ||
           (t == hits->tmin[k] && follows_last(scene, hits, k, primitive, instance));
}
#endif

static inline void take_hit(BatchHits *hits, int k, real t, int primitive, int instance)
{
    hits->tfar[k] = t;
    hits->primitive[k] = primitive;
#if HAS_INSTANCES
    hits->instance[k] = instance;
#endif
}

// Lanes of `equal` whose hit on the primitive comes first in the order of definition.
static inline vm wins_tie(const Hierarchy *scene, const BatchHits *hits, int first, vm equal, int primitive,
                          int instance)
{
    uint winners = 0;
    for (uint bits = vm_bits(equal); bits; bits &= bits - 1) {
        const int k = lowest_bit(bits);
        if (precedes_hit(scene, hits, first + k, primitive, instance))
            winners |= 1u << k;
    }
    return vm_from_bits(winners);
}

// tmin for the primitive: surfaces that come after the last one crossed may lie at the very same t.
static inline vf tmin_after_last(const Hierarchy *scene, const BatchHits *hits, int first, int primitive,
                                 int instance)
{
#if HAS_TRANSMITTANCE
    LanesF tmin;
    tmin.v = VF_LOAD(&hits->tmin[first]);
    if (!vm_any(VI_LOAD(&hits->last_primitive[first]) != (vi)(NO_HIT)))
        return tmin.v;
    for (int k = 0; k < LANES; k++) {
        const real t = hits->tmin[first + k];
        if (follows_last(scene, hits, first + k, primitive, instance))
            tmin.s[k] = real_before(t);
    }
    return tmin.v;
#else
    return (vf)(0.0f);
#endif
}

// Takes over t in the lanes of `active` where it comes first, for the rays from `first` on; returns their bits.
static inline uint take_closer(const Hierarchy *scene, BatchHits *hits, int first, vm active, vf t,
                               int primitive, int instance)
{
    const vf tfar = VF_LOAD(&hits->tfar[first]);
    vm closer = active & (t < tfar);
    const vm equal = active & (t == tfar) & (t < (vf)(INFINITY)) &
                     (VI_LOAD(&hits->primitive[first]) != (vi)(NO_HIT));
    if (vm_any(equal))
        closer = closer | wins_tie(scene, hits, first, equal, primitive, instance);
    const uint bits = vm_bits(closer);
    if (!bits)
        return 0;
    VF_STORE(closer ? t : tfar, &hits->tfar[first]);
    VI_STORE(closer ? (vi)(primitive) : VI_LOAD(&hits->primitive[first]), &hits->primitive[first]);
#if HAS_INSTANCES
    VI_STORE(closer ? (vi)(instance) : VI_LOAD(&hits->instance[first]), &hits->instance[first]);
#endif
    return bits;
}

#endif
