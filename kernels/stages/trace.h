// Stages: intersect_closest for the queue of rays, intersect_shadow for their shadow rays.
#ifndef CLRT_KERNELS_STAGES_TRACE_H
#define CLRT_KERNELS_STAGES_TRACE_H

#include "accel/batch.h"
#include "shared/light.h"
#include "stages/queue.h"
#if HAS_TRANSMIT_TEXTURE
#include "stages/shade.h"
#endif

// Origins of LANES rays at places first.. of a batch; self and instance: the surface that they start on. The
// batch meets all primitives; a shadow ray leaves out that of its light.
static inline void batch_start(BatchRays *rays, BatchHits *hits, int first, v3 org, vi self, vi instance)
{
    VF_STORE(org.x, &rays->org_x[first]);
    VF_STORE(org.y, &rays->org_y[first]);
    VF_STORE(org.z, &rays->org_z[first]);
    VI_STORE(self, &hits->self[first]);
#if HAS_INSTANCES
    VI_STORE(instance, &hits->self_instance[first]);
#endif
#if HAS_PATH
    VI_STORE((vi)(NO_HIT), &hits->left_out[first]);
    VI_STORE((vi)(0), &hits->planes_out[first]);
#elif HAS_AREA_LIGHTS
    hits->left_out = NO_HIT;
#endif
}

// Directions and ends; no hit yet.
static inline void batch_aim(BatchRays *rays, BatchHits *hits, int first, v3 dir, vf tfar)
{
    VF_STORE(dir.x, &rays->dir_x[first]);
    VF_STORE(dir.y, &rays->dir_y[first]);
    VF_STORE(dir.z, &rays->dir_z[first]);
    VF_STORE(tfar, &hits->tfar[first]);
    VI_STORE((vi)(NO_HIT), &hits->primitive[first]);
#if HAS_INSTANCES
    VI_STORE((vi)(NO_HIT), &hits->instance[first]);
#endif
#if HAS_TRANSMITTANCE
    VF_STORE((vf)(0.0f), &hits->tmin[first]);
    VI_STORE((vi)(NO_HIT), &hits->last_primitive[first]);
    VI_STORE((vi)(NO_HIT), &hits->last_instance[first]);
#endif
}

OUTLINE void intersect_closest(const State *s, const Hierarchy *scene, uint count)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint begin = GROUP_ITEM * BATCH; begin < count; begin += GROUP * BATCH) {
        BatchRays rays;
        BatchHits hits;
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            vi self_instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            self_instance = state_load_int(s, SELF_INSTANCE, &slots);
#endif
            batch_start(&rays, &hits, k, state_load3(s, RAY_ORG, &slots), state_load_int(s, SELF, &slots),
                        self_instance);
            batch_aim(&rays, &hits, k, state_load3(s, RAY_DIR, &slots), (vf)(INFINITY));
        }
        traverse(scene, &rays, &hits, batch_mask(count - begin), false, false, 0);
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            state_store(s, RAY_T, &slots, VF_LOAD(&hits.tfar[k]), slots.valid);
            state_store_int(s, PRIMITIVE, &slots, VI_LOAD(&hits.primitive[k]), slots.valid);
#if HAS_INSTANCES
            state_store_int(s, INSTANCE, &slots, VI_LOAD(&hits.instance[k]), slots.valid);
#endif
        }
    }
}

#if HAS_SHADOWS && HAS_PATH
// Traces the shadow ray of each slot of the queue that has one, and adds what arrives to its radiance.
OUTLINE void intersect_shadow(const State *s, const Hierarchy *scene, uint count, uint *traced)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint begin = GROUP_ITEM * BATCH; begin < count; begin += GROUP * BATCH) {
        BatchRays rays;
        BatchHits hits;
        uint mask = 0;
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            vi instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            instance = state_load_int(s, INSTANCE, &slots);
#endif
            mask |= vm_bits(slots.valid & ((state_load_int(s, FLAGS, &slots) & 1) != (vi)(0))) << k;
            batch_start(&rays, &hits, k, state_load3(s, SHADOW_ORG, &slots),
                        state_load_int(s, SHADOW_SELF, &slots), instance);
            batch_aim(&rays, &hits, k, state_load3(s, SHADOW_LIGHTS + SHADOW_DIR, &slots),
                      state_load(s, SHADOW_LIGHTS + SHADOW_T, &slots));
            VI_STORE(state_load_int(s, SHADOW_LEFT_OUT, &slots), &hits.left_out[k]);
            VI_STORE(state_load_int(s, SHADOW_PLANES, &slots), &hits.planes_out[k]);
        }
        if (!mask)
            continue;
        *traced += popcount(mask);
        traverse(scene, &rays, &hits, mask, true, false, 0);
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            const vm open = (VI_LOAD(&hits.primitive[k]) == (vi)(NO_HIT)) & vm_from_bits(mask >> k) & slots.valid;
            const v3 gain = state_load3(s, SHADOW_LIGHTS + SHADOW_GAIN, &slots);
            state_store3(s, RADIANCE, &slots, v3_add(state_load3(s, RADIANCE, &slots), gain), open);
        }
    }
}
#elif HAS_SHADOWS
#if HAS_TRANSMIT_TEXTURE
// What the surface that ray k has met lets through where textures say how much: all lanes look at that one hit.
OUTLINE void textured_transmit(const Hierarchy *scene, const Shading *shading, const BatchRays *rays,
                               const BatchHits *hits, int k, int primitive, int instance, real *weight)
{
    const v3 org = v3_make((vf)(rays->org_x[k]), (vf)(rays->org_y[k]), (vf)(rays->org_z[k]));
    const v3 dir = v3_make((vf)(rays->dir_x[k]), (vf)(rays->dir_y[k]), (vf)(rays->dir_z[k]));
    const Hit hit = hit_make(scene, shading, org, dir, (vf)(hits->tfar[k]), (vi)(primitive), (vi)(instance));
    const PbrLanes pbr = hit_pbr(&hit, shading);
    const v3 through = v3_scale(pbr.base_color, pbr_through(&pbr));
    const LanesF lanes[3] = { { through.x }, { through.y }, { through.z } };
    for (int c = 0; c < 3; c++)
        weight[c] = lanes[c].s[0];
}
#endif

#if HAS_TRANSMITTANCE
// Multiplies the gain of the shadow rays in mask by the transmit weights of all surfaces that they cross, one
// surface after the other in the order of the ray, so that the product is rounded alike everywhere. A ray
// ends when it meets a surface that lets nothing through or leaves nothing.
static inline void transmit_shadows(const Hierarchy *scene, const Shading *shading,
                                    const BatchRays *rays, BatchHits *hits, const real *tfar, uint mask,
                                    uint planes_out, real *gain)
{
    while (mask) {
        traverse(scene, rays, hits, mask, false, false, planes_out);
        for (uint rest = mask; rest; rest &= rest - 1) {
            const int k = lowest_bit(rest);
            const int primitive = hits->primitive[k];
            int instance = NO_HIT;
            if (primitive == NO_HIT) {
                mask &= ~(1u << k);
                continue;
            }
#if HAS_INSTANCES
            instance = hits->instance[k];
            hits->instance[k] = NO_HIT;
#endif
            global const MaterialRecord *material = &shading->materials[hit_material(scene, instance, primitive)];
            real weight[3] = { material->transmit[0], material->transmit[1], material->transmit[2] };
#if HAS_TRANSMIT_TEXTURE
            if (material->flags & MATERIAL_TRANSMIT_TEXTURE)
                textured_transmit(scene, shading, rays, hits, k, primitive, instance, weight);
#endif
            bool some = false;
            for (int c = 0; c < 3; c++) {
                gain[c * BATCH + k] *= weight[c];
                some = some || gain[c * BATCH + k] > 0.0f;
            }
            if (!some)
                mask &= ~(1u << k);
            hits->last_primitive[k] = primitive;
            hits->last_instance[k] = instance;
            hits->primitive[k] = NO_HIT;
            hits->tmin[k] = hits->tfar[k];
            hits->tfar[k] = tfar[k];
        }
    }
}
#endif

// Traces the shadow rays of a batch of slots towards the record, which is that of light number `light` of the
// pass, those of mask, and adds what arrives to the radiance of the batch.
static inline void shadow_batch(const State *s, const Hierarchy *scene,
                                const Shading *shading, global const LightRecord *record,
                                uint light, uint begin, uint count, uint mask, BatchRays *rays,
                                BatchHits *hits, real *radiance)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    const uint fields = SHADOW_LIGHTS + light * SHADOW_FIELDS, planes_out = record->planes;
#if HAS_OCCLUSION
    const bool through = HAS_TRANSMITTANCE && record->kind != LIGHT_KIND_OCCLUSION;
#else
    const bool through = HAS_TRANSMITTANCE;
#endif
#if HAS_AREA_LIGHTS
    hits->left_out = record->surface;
#endif
    real gain[3 * BATCH];
    for (int k = 0; k < BATCH; k += LANES) {
        const Slots slots = slots_make(queue, begin + (uint)k, count);
        const v3 dir = state_load3(s, fields + SHADOW_DIR, &slots);
        const v3 arriving = state_load3(s, fields + SHADOW_GAIN, &slots);
        batch_aim(rays, hits, k, dir, state_load(s, fields + SHADOW_T, &slots));
        VF_STORE(arriving.x, &gain[k]);
        VF_STORE(arriving.y, &gain[BATCH + k]);
        VF_STORE(arriving.z, &gain[2 * BATCH + k]);
    }
#if HAS_TRANSMITTANCE
    real tfar[BATCH];
    for (int k = 0; k < BATCH; k++)
        tfar[k] = hits->tfar[k];
#endif
    traverse(scene, rays, hits, mask, true, through, planes_out);
    uint open = 0;
    for (int k = 0; k < BATCH; k += LANES)
        open |= vm_bits(VI_LOAD(&hits->primitive[k]) == (vi)(NO_HIT)) << k;
    open &= mask;
#if HAS_TRANSMITTANCE
    if (through)
        transmit_shadows(scene, shading, rays, hits, tfar, open, planes_out, gain);
#endif
    for (int k = 0; k < BATCH; k += LANES) {
        const vm lit = vm_from_bits(open >> k);
        for (int c = 0; c < 3; c++) {
            const vf sum = VF_LOAD(&radiance[c * BATCH + k]);
            VF_STORE(lit ? sum + VF_LOAD(&gain[c * BATCH + k]) : sum, &radiance[c * BATCH + k]);
        }
    }
}

// Traces the shadow rays towards the lights of a pass, in the order of the lights, so that each slot adds its
// own light in that order.
OUTLINE void intersect_shadow(const State *s, const Hierarchy *scene, const Shading *shading,
                              global const LightRecord *lights, uint light_count, uint count, uint *traced)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint begin = GROUP_ITEM * BATCH; begin < count; begin += GROUP * BATCH) {
        BatchRays rays;
        BatchHits hits;
        real radiance[3 * BATCH];
        int flags[BATCH];
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            const v3 sum = state_load3(s, RADIANCE, &slots);
            vi instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            instance = state_load_int(s, INSTANCE, &slots);
#endif
            batch_start(&rays, &hits, k, state_load3(s, SHADOW_ORG, &slots),
                        state_load_int(s, SHADOW_SELF, &slots), instance);
            VF_STORE(sum.x, &radiance[k]);
            VF_STORE(sum.y, &radiance[BATCH + k]);
            VF_STORE(sum.z, &radiance[2 * BATCH + k]);
            VI_STORE(slots.valid ? state_load_int(s, FLAGS, &slots) : (vi)(0), &flags[k]);
        }
        for (uint light = 0; light < light_count; light++) {
            uint mask = 0;
            for (int k = 0; k < BATCH; k += LANES)
                mask |= vm_bits((VI_LOAD(&flags[k]) & (vi)(1 << light)) != (vi)(0)) << k;
            *traced += popcount(mask);
            if (mask)
                shadow_batch(s, scene, shading, &lights[light], light, begin, count, mask, &rays, &hits,
                             radiance);
        }
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            const v3 sum = v3_make(VF_LOAD(&radiance[k]), VF_LOAD(&radiance[BATCH + k]),
                                   VF_LOAD(&radiance[2 * BATCH + k]));
            state_store3(s, RADIANCE, &slots, sum, slots.valid);
        }
    }
}
#endif

#endif
