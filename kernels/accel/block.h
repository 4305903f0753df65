// Blocks of eight triangles: one ray against the eight, or one triangle against LANES rays where a packet of
// them has come. The numbers are the same either way, and those of shapes/woop.h.
#ifndef CLRT_KERNELS_ACCEL_BLOCK_H
#define CLRT_KERNELS_ACCEL_BLOCK_H

#include "accel/hits.h"
#include "shapes/woop.h"

// Triangles that one vector operation tests, and rays: vectors of 16 take two rays.
#define TRIANGLES_A_TEST (LANES < BLOCK_WIDTH ? LANES : BLOCK_WIDTH)

// The rays of a batch as triangles want them: axes permuted so that the last is the main one. axis_x: offset
// in numbers into a vertex of a block.
typedef struct {
    real org_x[BATCH], org_y[BATCH], org_z[BATCH];
    real shear_x[BATCH], shear_y[BATCH], shear_z[BATCH];
    int axis_x[BATCH], axis_y[BATCH], axis_z[BATCH];
} BatchShear;

// For the rays k .. k + LANES - 1.
static inline void prepare_shear(const BatchRays *rays, int k, BatchShear *s)
{
    const v3 org = v3_make(VF_LOAD(&rays->org_x[k]), VF_LOAD(&rays->org_y[k]), VF_LOAD(&rays->org_z[k]));
    const v3 dir = v3_make(VF_LOAD(&rays->dir_x[k]), VF_LOAD(&rays->dir_y[k]), VF_LOAD(&rays->dir_z[k]));
    const RayShear shear = shear_make(dir);
    const v3 o = shear_permute(&shear, org);
    const vi x = (vi)(0), y = (vi)(BLOCK_WIDTH), z = (vi)(2 * BLOCK_WIDTH);
    VF_STORE(o.x, &s->org_x[k]);
    VF_STORE(o.y, &s->org_y[k]);
    VF_STORE(o.z, &s->org_z[k]);
    VF_STORE(shear.shear_x, &s->shear_x[k]);
    VF_STORE(shear.shear_y, &s->shear_y[k]);
    VF_STORE(shear.shear_z, &s->shear_z[k]);
    VI_STORE(shear.z_is_x ? y : shear.z_is_y ? z : x, &s->axis_x[k]);
    VI_STORE(shear.z_is_x ? z : shear.z_is_y ? x : y, &s->axis_y[k]);
    VI_STORE(shear.z_is_x ? x : shear.z_is_y ? y : z, &s->axis_z[k]);
}

// t > 0 of the face at `slot` for ray k: takes it over where it comes first. True where it does.
static inline bool offer_face(const Hierarchy *scene, BatchHits *hits, int k, real t, int slot, int instance,
                              bool opaque_only)
{
    const int primitive = slot | HIT_MESH;
    if (t > hits->tfar[k])
        return false;
    if (opaque_only && (scene->blocks[slot >> 3].face[slot & 7] & FACE_TRANSMITS))
        return false;
    if (starts_on(hits, k, primitive, instance))
        return false;
#if HAS_TRANSMITTANCE
    if (!comes_after_last(scene, hits, k, t, primitive, instance))
        return false;
#endif
    if (t == hits->tfar[k] && !(t < INFINITY && precedes_hit(scene, hits, k, primitive, instance)))
        return false;
    take_hit(hits, k, t, primitive, instance);
    return true;
}

// A number of ray k for each lane; of rays k and other where a vector holds two.
static inline vf ray_lanes(const real *x, int k, int other)
{
#if LANES == 16
    return (float16)((float8)(x[k]), (float8)(x[other]));
#else
    return (vf)(x[k]);
#endif
}

// A coordinate of a vertex of the triangles from `first` of the block on, along the axis of ray k.
static inline vf block_lanes(global const f32 *vertex, const int *axis, int k, int other, int first)
{
#if LANES == 16
    return (float16)(vload8(0, vertex + axis[k]), vload8(0, vertex + axis[other]));
#else
    return VF_LOAD(vertex + axis[k] + first);
#endif
}

static inline v3 block_vertex(global const f32 *vertex, const BatchShear *s, int k, int other, int first)
{
    const v3 v = v3_make(block_lanes(vertex, s->axis_x, k, other, first),
                         block_lanes(vertex, s->axis_y, k, other, first),
                         block_lanes(vertex, s->axis_z, k, other, first));
    const v3 org = v3_make(ray_lanes(s->org_x, k, other), ray_lanes(s->org_y, k, other),
                           ray_lanes(s->org_z, k, other));
    return shear_flat(v3_sub(v, org), ray_lanes(s->shear_x, k, other), ray_lanes(s->shear_y, k, other));
}

// What tests of a block have found: written for every test and kept where something was, so that the loop of
// tests has no branch to guess.
typedef struct {
    LanesF t[BATCH];
    LanesF on_edge[BATCH]; // 0: the ray meets an edge, or so nearly that only exact arithmetic can tell
    uint lanes[BATCH];     // that pass within
    int ray[BATCH], other[BATCH];
} BlockOffers;

// Tests rays of mask one after the other (vectors of 16: two) against TRIANGLES_A_TEST triangles of a block,
// those from number `first` on; returns the number of offers.
static inline int test_triangles(global const f32 *vertices, const BatchShear *s, const BatchHits *hits,
                                 uint mask, int first, BlockOffers *offers)
{
    int count = 0;
    for (uint rest = mask; rest;) {
        const int k = lowest_bit(rest);
        rest &= rest - 1;
        int other = k;
#if LANES == 16
        other = rest ? lowest_bit(rest) : k;
        rest &= rest - 1;
#endif
        const v3 a = block_vertex(vertices, s, k, other, first);
        const v3 b = block_vertex(vertices + 3 * BLOCK_WIDTH, s, k, other, first);
        const v3 c = block_vertex(vertices + 6 * BLOCK_WIDTH, s, k, other, first);
        const FaceWeights w = face_weights(a, b, c);
        const vf t = face_distance(&w, a, b, c, ray_lanes(s->shear_z, k, other));
        const uint lanes = vm_bits(w.inside & (t > (vf)(0.0f)) & (t <= ray_lanes(hits->tfar, k, other)));
        offers->t[count].v = t;
        offers->on_edge[count].v = w.least * w.most;
        offers->lanes[count] = lanes;
        offers->ray[count] = k;
        offers->other[count] = other;
        count += lanes != 0;
    }
    return count;
}

// Whether ray k passes within the face at the slot, by exact arithmetic.
OUTLINE bool meets_face(const Hierarchy *scene, const BatchShear *s, int k, int slot)
{
    global const f32 *x = (global const f32 *)&scene->blocks[slot >> 3] + (slot & 7);
    const v3 org = v3_make((vf)(s->org_x[k]), (vf)(s->org_y[k]), (vf)(s->org_z[k]));
    const vf shear_x = (vf)(s->shear_x[k]), shear_y = (vf)(s->shear_y[k]);
    v3 v[3];
    for (int j = 0; j < 3; j++) {
        const v3 vertex = v3_make((vf)(x[s->axis_x[k]]), (vf)(x[s->axis_y[k]]), (vf)(x[s->axis_z[k]]));
        v[j] = shear_flat(v3_sub(vertex, org), shear_x, shear_y);
        x += 3 * BLOCK_WIDTH;
    }
    return vm_any(woop_weights(v[0], v[1], v[2]).within);
}

// One ray of mask after the other against the triangles of a block. Returns the rays that it stops.
static inline uint test_block_by_ray(const Hierarchy *scene, const BatchShear *s, BatchHits *hits, uint mask,
                                     int block, int instance, bool opaque_only)
{
    global const f32 *vertices = (global const f32 *)&scene->blocks[block];
    uint found = 0;
    BlockOffers offers;
    for (int first = 0; first < BLOCK_WIDTH; first += TRIANGLES_A_TEST) {
        const int count = test_triangles(vertices, s, hits, mask, first, &offers);
        for (int i = 0; i < count; i++) {
            for (uint lanes = offers.lanes[i]; lanes; lanes &= lanes - 1) {
                const int lane = lowest_bit(lanes);
                const int ray = lane < BLOCK_WIDTH ? offers.ray[i] : offers.other[i];
                const int slot = block * BLOCK_WIDTH + first + lane % BLOCK_WIDTH;
                if (offers.on_edge[i].s[lane] == 0.0f && !meets_face(scene, s, ray, slot))
                    continue;
                if (offer_face(scene, hits, ray, offers.t[i].s[lane], slot, instance, opaque_only))
                    found |= 1u << ray;
            }
        }
    }
    return found;
}

#if LANES > 1
// The same for the lanes of `on` among the rays from `first` on; returns their bits.
static inline uint offer_face_lanes(const Hierarchy *scene, BatchHits *hits, int first, vm on, vf t, int slot,
                                    int instance, bool opaque_only)
{
    const int primitive = slot | HIT_MESH;
    if (opaque_only && (scene->blocks[slot >> 3].face[slot & 7] & FACE_TRANSMITS))
        return 0;
    vm self = VI_LOAD(&hits->self[first]) >> 1 == (vi)(primitive);
#if HAS_INSTANCES
    self = self & (VI_LOAD(&hits->self_instance[first]) == (vi)(instance));
#endif
    on = on & !self & (t > tmin_after_last(scene, hits, first, primitive, instance));
    return take_closer(scene, hits, first, on, t, primitive, instance);
}

// One triangle after the other against the rays of mask, which share their main axis.
static inline uint test_block_by_triangle(const Hierarchy *scene, const BatchShear *s, BatchHits *hits,
                                          uint mask, int block, int count, int instance, bool opaque_only)
{
    const int some = lowest_bit(mask);
    global const f32 *base = (global const f32 *)&scene->blocks[block];
    global const f32 *x = base + s->axis_x[some], *y = base + s->axis_y[some], *z = base + s->axis_z[some];
    uint found = 0;
    for (int i = 0; i < count; i++) {
        for (int k = 0; k < BATCH; k += LANES) {
            const uint bits = mask >> k & ((1u << LANES) - 1u);
            if (!bits)
                continue;
            const v3 org = v3_make(VF_LOAD(&s->org_x[k]), VF_LOAD(&s->org_y[k]), VF_LOAD(&s->org_z[k]));
            const vf shear_x = VF_LOAD(&s->shear_x[k]), shear_y = VF_LOAD(&s->shear_y[k]);
            v3 v[3];
            for (int j = 0; j < 3; j++) {
                const int at = 3 * j * BLOCK_WIDTH + i;
                v[j] = shear_flat(v3_sub(v3_make((vf)(x[at]), (vf)(y[at]), (vf)(z[at])), org), shear_x,
                                  shear_y);
            }
            const FaceWeights w = face_weights(v[0], v[1], v[2]);
            vm within = w.inside & vm_from_bits(bits);
            if (!vm_any(within))
                continue;
            const vm on_edge = w.least * w.most == (vf)(0.0f);
            if (vm_any(within & on_edge))
                within = within & (!on_edge | woop_on_edge(v[0], v[1], v[2]));
            const vf t = face_distance(&w, v[0], v[1], v[2], VF_LOAD(&s->shear_z[k]));
            found |= offer_face_lanes(scene, hits, k, within, t, block * BLOCK_WIDTH + i, instance, opaque_only)
                     << k;
        }
    }
    return found;
}

static inline int block_count(global const TriangleBlock *block)
{
    return popcount(sign_bits8(as_int8(vload8(0, block->face)) != (int8)(-1)));
}

// Groups of LANES rays of which mask has some.
static inline int group_count(uint mask)
{
    int groups = 0;
    for (int k = 0; k < BATCH; k += LANES)
        groups += (mask >> k & ((1u << LANES) - 1u)) != 0;
    return groups;
}
#endif

// one_axis: all rays of the batch have the same main axis.
OUTLINE uint test_block(const Hierarchy *scene, const BatchShear *s, BatchHits *hits, uint mask, int block,
                        int instance, bool opaque_only, bool one_axis)
{
#if LANES > 1
    const int rays = popcount(mask);
    if (one_axis && rays > 4) {
        const int count = block_count(&scene->blocks[block]);
        if (count * group_count(mask) * LANES < rays * BLOCK_WIDTH)
            return test_block_by_triangle(scene, s, hits, mask, block, count, instance, opaque_only);
    }
#endif
    return test_block_by_ray(scene, s, hits, mask, block, instance, opaque_only);
}

#endif
