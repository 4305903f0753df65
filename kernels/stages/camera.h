// Stage: camera rays into the slots that need one.
#ifndef CLRT_KERNELS_STAGES_CAMERA_H
#define CLRT_KERNELS_STAGES_CAMERA_H

#include "base/ray.h"
#include "stages/state.h"
#if HAS_SAMPLES
#include "base/sampling.h"
#endif

// Every second bit of x < 256, from the lowest on.
static inline vi even_bits(vi x)
{
    return (x & 1) | (x >> 1 & 2) | (x >> 2 & 4) | (x >> 3 & 8);
}

// The slots of a pixel follow each other, pixels of a tile follow the Morton curve: what is worked on
// together is compact.
static inline vi slot_x(vi slot, uint slots_log2) { return even_bits(slot >> slots_log2); }
static inline vi slot_y(vi slot, uint slots_log2) { return even_bits(slot >> slots_log2 >> 1); }

// Starts in the valid slots the sample number sample_begin + (number of the slot within its pixel). left and
// top: the tile's first pixel in the image.
// Offsets count from the middle of the image in pixels, whole and fraction apart: the whole part is exact
// and each coordinate is rounded once, at any width.
OUTLINE void camera_ray(const State *s, constant RenderParams *params, int left, int top, const Slots *slots,
                        uint sample_begin)
{
    const uint log2 = params->slots_log2;
    const vi x = slot_x(slots->index, log2) + left, y = slot_y(slots->index, log2) + top;
    const vi whole_x = 2 * x + (1 - (int)params->width);
    const vi whole_y = ((int)params->height - 1) - 2 * y;
    vf fine_x = (vf)(0.0f), fine_y = (vf)(0.0f);
#if HAS_SAMPLES
    const vu key = random_pixel_key(VU_FROM_VI(x), VU_FROM_VI(y), params->seed);
    const vi sample = (slots->index & ((1 << log2) - 1)) + (int)sample_begin;
    const SamplePoint point = sample_2d(key, VU_FROM_VI(sample), 0u);
    fine_x = fma(point.x, (vf)(2.0f), (vf)(-1.0f));
    fine_y = fma(point.y, (vf)(-2.0f), (vf)(1.0f));
#endif
    const vf scale = (vf)(params->pixel_scale);
    const vf view_x = fma(VF_FROM_VI(whole_x), scale, fine_x * scale);
    const vf view_y = fma(VF_FROM_VI(whole_y), scale, fine_y * scale);
    const v3 right = v3_from(params->camera_right), up = v3_from(params->camera_up);
    const v3 ahead = v3_neg(v3_from(params->camera_back));
#if HAS_ORTHOGRAPHIC
    const v3 org = v3_fma(right, view_x, v3_scale(up, view_y));
    const v3 dir = ahead;
#else
    const v3 org = v3_splat(0.0f);
    const v3 dir = v3_normalize(v3_fma(right, view_x, v3_fma(up, view_y, ahead)));
#endif
    state_store3(s, RAY_ORG, slots, org, slots->valid);
    state_store3(s, RAY_DIR, slots, dir, slots->valid);
    state_store3(s, THROUGHPUT, slots, v3_splat(1.0f), slots->valid);
    state_store3(s, RADIANCE, slots, v3_splat(0.0f), slots->valid);
    state_store_int(s, SELF, slots, (vi)(-1), slots->valid);
#if HAS_INSTANCES
    state_store_int(s, SELF_INSTANCE, slots, (vi)(NO_HIT), slots->valid);
#endif
    state_store_int(s, DEPTH, slots, (vi)(0), slots->valid);
}

#endif
