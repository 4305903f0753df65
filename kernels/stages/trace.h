// Stages: intersect_closest for the queue of rays, intersect_shadow for the queue of one light.
#ifndef CLRT_KERNELS_STAGES_TRACE_H
#define CLRT_KERNELS_STAGES_TRACE_H

#include "accel/batch.h"
#include "stages/queue.h"

// Loads LANES rays into places first.. of a batch.
static inline void batch_set(BatchRays *rays, BatchHits *hits, int first, v3 org, v3 dir, vf tfar, vi self,
                             vi self_instance)
{
    VF_STORE(org.x, &rays->org_x[first]);
    VF_STORE(org.y, &rays->org_y[first]);
    VF_STORE(org.z, &rays->org_z[first]);
    VF_STORE(dir.x, &rays->dir_x[first]);
    VF_STORE(dir.y, &rays->dir_y[first]);
    VF_STORE(dir.z, &rays->dir_z[first]);
    VF_STORE((vf)(0.0f), &hits->tmin[first]);
    VF_STORE(tfar, &hits->tfar[first]);
    VI_STORE(self, &hits->self[first]);
    VI_STORE((vi)(NO_HIT), &hits->primitive[first]);
#if HAS_INSTANCES
    VI_STORE(self_instance, &hits->self_instance[first]);
    VI_STORE((vi)(NO_HIT), &hits->instance[first]);
#endif
#if HAS_TRANSMITTANCE
    VI_STORE((vi)(NO_HIT), &hits->last_primitive[first]);
    VI_STORE((vi)(NO_HIT), &hits->last_instance[first]);
#endif
}

static inline void intersect_closest(const State *s, const Hierarchy *scene, uint count)
{
    global const int *queue = s->ints + QUEUE * TILE_PIXELS;
    for (uint begin = GROUP_ITEM * BATCH; begin < count; begin += GROUP * BATCH) {
        BatchRays rays;
        BatchHits hits;
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            vi self_instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            self_instance = state_load_int(s, SELF_INSTANCE, &slots);
#endif
            batch_set(&rays, &hits, k, state_load3(s, RAY_ORG, &slots), state_load3(s, RAY_DIR, &slots),
                      (vf)(INFINITY), state_load_int(s, SELF, &slots), self_instance);
        }
        traverse(scene, &rays, &hits, batch_mask(count - begin), false, false);
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

#if HAS_SHADOWS
#if HAS_TRANSMITTANCE
// Multiplies the gain of the shadow rays in mask by the transmit weights of all surfaces that they cross, one
// surface after the other in the order of the ray, so that the product is rounded alike everywhere. A ray
// ends when it meets a surface that lets nothing through or leaves nothing.
static inline void transmit_shadows(const Hierarchy *scene, global const MaterialRecord *materials,
                                    const BatchRays *rays, BatchHits *hits, const real *tfar, uint mask,
                                    real *gain_r, real *gain_g, real *gain_b)
{
    while (mask) {
        traverse(scene, rays, hits, mask, false, false);
        for (uint rest = mask; rest; rest &= rest - 1) {
            const int k = lowest_bit(rest);
            const int primitive = hits->primitive[k];
            int instance = NO_HIT;
            if (primitive == NO_HIT) {
                mask &= ~(1u << k);
                continue;
            }
            uint material = scene->infos[primitive].material;
#if HAS_INSTANCES
            instance = hits->instance[k];
            if (material == NO_INDEX)
                material = scene->infos[instance].material;
            hits->instance[k] = NO_HIT;
#endif
            gain_r[k] *= materials[material].transmit[0];
            gain_g[k] *= materials[material].transmit[1];
            gain_b[k] *= materials[material].transmit[2];
            if (!(gain_r[k] > 0.0f || gain_g[k] > 0.0f || gain_b[k] > 0.0f))
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

// Traces the shadow rays towards light `light` of the pass and adds what arrives to the radiance of its slot.
static inline void intersect_shadow(const State *s, const Hierarchy *scene,
                                    global const MaterialRecord *materials, uint light, uint count)
{
    global const int *queue = s->ints + QUEUE_NEXT * TILE_PIXELS;
    const uint fields = SHADOW_LIGHTS + light * SHADOW_FIELDS;
    for (uint begin = GROUP_ITEM * BATCH; begin < count; begin += GROUP * BATCH) {
        BatchRays rays;
        BatchHits hits;
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            vi self_instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            self_instance = state_load_int(s, INSTANCE, &slots);
#endif
            batch_set(&rays, &hits, k, state_load3(s, SHADOW_ORG, &slots),
                      state_load3(s, fields + SHADOW_DIR, &slots), state_load(s, fields + SHADOW_T, &slots),
                      state_load_int(s, SHADOW_SELF, &slots), self_instance);
        }
        const uint all = batch_mask(count - begin);
        traverse(scene, &rays, &hits, all, true, HAS_TRANSMITTANCE);
        real gain_r[BATCH], gain_g[BATCH], gain_b[BATCH];
        uint open = 0;
        for (int k = 0; k < BATCH; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            const vm lit = VI_LOAD(&hits.primitive[k]) == (vi)(NO_HIT);
            open |= vm_bits(lit & slots.valid) << k;
            const v3 gain = state_load3(s, fields + SHADOW_GAIN, &slots);
            VF_STORE(lit ? gain.x : (vf)(0.0f), &gain_r[k]);
            VF_STORE(lit ? gain.y : (vf)(0.0f), &gain_g[k]);
            VF_STORE(lit ? gain.z : (vf)(0.0f), &gain_b[k]);
        }
#if HAS_TRANSMITTANCE
        real tfar[BATCH];
        for (int k = 0; k < BATCH; k++)
            tfar[k] = hits.tfar[k];
        transmit_shadows(scene, materials, &rays, &hits, tfar, open, gain_r, gain_g, gain_b);
#endif
        for (int k = 0; k < BATCH && open; k += LANES) {
            const Slots slots = slots_make(queue, begin + (uint)k, count);
            const v3 gain = v3_make(VF_LOAD(&gain_r[k]), VF_LOAD(&gain_g[k]), VF_LOAD(&gain_b[k]));
            const v3 radiance = v3_add(state_load3(s, RADIANCE, &slots), gain);
            state_store3(s, RADIANCE, &slots, radiance, slots.valid);
        }
    }
}
#endif

#endif
