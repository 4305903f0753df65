// Rays from memory on the way of a render: intersection or traversal, surface, colour, light, the rays that
// follow. And sums of the film.
#ifndef CLRT_KERNELS_SELFTEST_RAYS_H
#define CLRT_KERNELS_SELFTEST_RAYS_H

#include "selftest/numbers.h"
#include "stages/shade.h"
#include "stages/trace.h"

#include "stages/film.h"

// The mean of so many samples of one value, as the film takes it.
static inline vf mean_of_samples(vf value, vf samples)
{
    LanesF x, n;
    x.v = value;
    n.v = samples;
    for (int k = 0; k < LANES; k++) {
        const uint count = (uint)n.s[k];
        const vf each = (vf)(x.s[k]);
        vf high = (vf)(0.0f), low = (vf)(0.0f);
        for (uint i = 0; i < count; i++)
            sum_add(&high, &low, each);
        LanesF mean;
        mean.v = (high + low) / (real)count;
        x.s[k] = mean.s[0];
    }
    return x.v;
}

static inline void probe_load(global const f32 *reals, global const int *ints, uint stride, BatchRays *rays,
                              BatchHits *hits)
{
    for (int k = 0; k < BATCH; k += LANES) {
        batch_start(rays, hits, k, column3(reals + k, stride), VI_LOAD(ints + PROBE_SELF * stride + k),
                    VI_LOAD(ints + PROBE_SELF_INSTANCE * stride + k));
        batch_aim(rays, hits, k, column3(reals + PROBE_DIR * stride + k, stride),
                  VF_LOAD(reals + PROBE_TFAR * stride + k));
        VF_STORE(VF_LOAD(reals + PROBE_TMIN * stride + k), &hits->tmin[k]);
    }
}

// Each ray at the primitive of its own; those of one primitive together.
OUTLINE void probe_own(const Hierarchy *scene, global const int *primitive, global const int *instance,
                       const BatchRays *rays, BatchHits *hits)
{
    for (uint rest = batch_mask(BATCH); rest;) {
        const int some = lowest_bit(rest);
        uint same = 0;
        for (int k = some; k < BATCH; k++)
            same |= (uint)(primitive[k] == primitive[some] && instance[k] == instance[some]) << k;
        rest &= ~same;
        BatchRays inner = *rays;
        if (instance[some] >= 0) {
            const PrimitiveLanes map = primitive_splat(&scene->primitives[instance[some]]);
            enter_instance(&map, rays, same, &inner);
        }
        test_primitive(scene, &inner, hits, same, primitive[some], instance[some]);
    }
}

// Every block and every primitive, whatever boxes would say.
OUTLINE void probe_each(const Hierarchy *scene, uint primitive_count, uint block_count, const BatchRays *rays,
                        BatchHits *hits)
{
    const uint mask = valid_rays(rays, batch_mask(BATCH));
    BatchSpace space;
    if (!mask)
        return;
    prepare_space(rays, mask, &space);
    for (uint i = 0; i < block_count; i++)
        test_block(scene, &space.shear, hits, mask, (int)i, NO_HIT, false, space.one_axis);
    for (uint i = 0; i < primitive_count; i++)
        test_primitive(scene, rays, hits, mask, (int)i, NO_HIT);
}

// What stands behind a hit: the number of a face, or the index of a primitive; NO_HIT.
static inline int probe_number(const Hierarchy *scene, int primitive)
{
    return primitive >= 0 && (primitive & HIT_MESH) ? (int)face_of_slot(scene, primitive & (HIT_MESH - 1))
                                                    : primitive;
}

// Follows each ray from hit to hit until it has met `steps` or none is left. hits keeps the first ones.
OUTLINE void probe_walk(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint steps,
                        int *crossings)
{
    real ends[BATCH];
    for (int k = 0; k < BATCH; k++)
        ends[k] = hits->tfar[k];
    traverse(scene, rays, hits, batch_mask(BATCH), false, false, 0);
    BatchHits next = *hits;
    uint mask = batch_mask(BATCH);
    for (uint step = 1; mask; step++) {
        for (int k = 0; k < BATCH; k++) {
            if (!(mask >> k & 1u))
                continue;
            if (next.primitive[k] == NO_HIT || step > steps) {
                mask &= ~(1u << k);
                continue;
            }
            crossings[k] = (int)step;
            next.last_primitive[k] = next.primitive[k];
            next.last_instance[k] = next.instance[k];
            next.primitive[k] = next.instance[k] = NO_HIT;
            next.tmin[k] = next.tfar[k];
            next.tfar[k] = ends[k];
        }
        if (mask && step < steps)
            traverse(scene, rays, &next, mask, false, false, 0);
        else
            mask = 0;
    }
}

// Everything that shading makes of the hits of LANES rays.
OUTLINE void probe_shade(const Hierarchy *scene, const Shading *shading, global const LightRecord *lights,
                         uint light_count, const BatchRays *rays, const BatchHits *hits, int k,
                         global f32 *out, uint stride)
{
    const v3 org = v3_make(VF_LOAD(&rays->org_x[k]), VF_LOAD(&rays->org_y[k]), VF_LOAD(&rays->org_z[k]));
    const v3 dir = v3_make(VF_LOAD(&rays->dir_x[k]), VF_LOAD(&rays->dir_y[k]), VF_LOAD(&rays->dir_z[k]));
    const Hit hit = hit_make(scene, shading, org, dir, VF_LOAD(&hits->tfar[k]), VI_LOAD(&hits->primitive[k]),
                             VI_LOAD(&hits->instance[k]));
    const v3 color = hit_diffuse(&hit, shading);
    const Scatter scatter = scatter_make(&hit);
    vf lit = (vf)(0.0f);
    if (light_count > 0) {
        const LightSample light = punctual_sample(lights, hit.point);
        lit = shade_light(&hit, color, &light).x;
    }
    store_column3(hit.point, out + PROBE_P * stride, stride);
    store_column3(hit.error, out + PROBE_ERROR * stride, stride);
    store_column3(v3_select(hit.inside, v3_neg(hit.ng), hit.ng), out + PROBE_NG * stride, stride);
    VF_STORE(hit.at.u, out + PROBE_U * stride);
    VF_STORE(hit.at.v, out + PROBE_V * stride);
    VF_STORE(hit.at.u_whole, out + PROBE_U_WHOLE * stride);
    VF_STORE(hit.at.v_whole, out + PROBE_V_WHOLE * stride);
    VF_STORE(color.x, out + PROBE_COLOR * stride);
    VF_STORE(lit, out + PROBE_LIT * stride);
    store_column3(scatter.reflect_dir, out + PROBE_REFLECT * stride, stride);
    VF_STORE(scatter.reflect_weight.x, out + PROBE_REFLECT_WEIGHT * stride);
    store_column3(scatter.transmit_dir, out + PROBE_TRANSMIT * stride, stride);
    VF_STORE(scatter.transmit_weight.x, out + PROBE_TRANSMIT_WEIGHT * stride);
}

#endif
