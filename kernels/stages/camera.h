// Stage: camera rays into the slots that need one.
#ifndef CLRT_KERNELS_STAGES_CAMERA_H
#define CLRT_KERNELS_STAGES_CAMERA_H

#include "base/ray.h"
#include "stages/lens.h"
#include "stages/random.h"

// Every second bit of x < 256, from the lowest on.
static inline vi even_bits(vi x)
{
    return (x & 1) | (x >> 1 & 2) | (x >> 2 & 4) | (x >> 3 & 8);
}

// The slots of a pixel follow each other, pixels of a tile follow the Morton curve: what is worked on
// together is compact.
static inline vi slot_x(vi slot, uint slots_log2) { return even_bits(slot >> slots_log2); }
static inline vi slot_y(vi slot, uint slots_log2) { return even_bits(slot >> slots_log2 >> 1); }

#if HAS_SAMPLES || HAS_APERTURE || HAS_HIT_RANDOM
// Where the random choices of the slots' samples come from.
typedef struct {
    vu key;    // of the pixel
    vu sample; // number
} SampleKey;

static inline SampleKey sample_key(constant RenderParams *params, int left, int top, const Slots *slots,
                                   uint sample_begin)
{
    SampleKey k;
    const uint log2 = params->slots_log2;
    const vi x = slot_x(slots->index, log2) + left, y = slot_y(slots->index, log2) + top;
    k.key = random_pixel_key(VU_FROM_VI(x), VU_FROM_VI(y), params->seed);
    k.sample = VU_FROM_VI((slots->index & ((1 << log2) - 1)) + (int)sample_begin);
    return k;
}
#endif

#if HAS_SAMPLES
// The sample's place in pixels from the centre of its pixel, right and down.
static inline SamplePoint sample_offset(const SampleKey *key, global const f32 *quantiles)
{
    SamplePoint point = sample_2d(key->key, key->sample, PAIR_PIXEL);
    point.x = filter_offset(point.x, quantiles);
    point.y = filter_offset(point.y, quantiles);
    return point;
}
#endif

#if HAS_FILTER_LOBES
// What the samples of the slots count for in the pixel: the sign of the filter times the ratio of the integrals
// of its absolute value and of itself.
OUTLINE void weigh_samples(const State *s, constant RenderParams *params, global const f32 *quantiles, int left,
                           int top, uint sample_begin)
{
    for (uint i = GROUP_ITEM * LANES; i < TILE_SLOTS; i += GROUP * LANES) {
        const Slots slots = slots_all(i);
        const SampleKey key = sample_key(params, left, top, &slots, sample_begin);
        const SamplePoint point = sample_offset(&key, quantiles);
        const vf weight = filter_sign(point.x) * filter_sign(point.y) * params->filter_ratio;
        state_store3(s, RADIANCE, &slots, v3_scale(state_load3(s, RADIANCE, &slots), weight), slots.valid);
#if HAS_CLAMP
        state_store3(s, CLAMPED, &slots, v3_scale(state_load3(s, CLAMPED, &slots), weight), slots.valid);
#endif
    }
    GROUP_BARRIER();
}
#endif

// Starts in the valid slots the sample number sample_begin + (number of the slot within its pixel). left and
// top: the tile's first pixel in the image.
// Offsets count from the middle of the image in pixels, whole and fraction apart: the whole part is exact
// and each coordinate is rounded once, at any width.
OUTLINE void camera_ray(const State *s, constant RenderParams *params, global const f32 *quantiles, int left,
                        int top, const Slots *slots, uint sample_begin)
{
    const uint log2 = params->slots_log2;
    const vi x = slot_x(slots->index, log2) + left, y = slot_y(slots->index, log2) + top;
    const vi whole_x = 2 * x + (1 - (int)params->width);
    const vi whole_y = ((int)params->height - 1) - 2 * y;
    vf fine_x = (vf)(0.0f), fine_y = (vf)(0.0f);
#if HAS_SAMPLES || HAS_APERTURE || HAS_HIT_RANDOM
    const SampleKey key = sample_key(params, left, top, slots, sample_begin);
#endif
#if HAS_SAMPLES
    const SamplePoint point = sample_offset(&key, quantiles);
    fine_x = 2.0f * point.x;
    fine_y = -2.0f * point.y;
#endif
    const vf scale = (vf)(params->pixel_scale);
    const vf view_x = fma(VF_FROM_VI(whole_x), scale, fine_x * scale);
    const vf view_y = fma(VF_FROM_VI(whole_y), scale, fine_y * scale);
    const v3 right = v3_from(params->camera_right), up = v3_from(params->camera_up);
    const v3 ahead = v3_neg(v3_from(params->camera_back));
#if HAS_ORTHOGRAPHIC
    const v3 org = v3_fma(right, view_x, v3_scale(up, view_y));
    const v3 dir = ahead;
#elif HAS_APERTURE
    // From a point of the lens through the point of the plane in focus.
    const SamplePoint lens = disk_point(sample_2d(key.key, key.sample, PAIR_LENS));
    const v3 org = v3_fma(right, lens.x * params->aperture, v3_scale(up, lens.y * params->aperture));
    const v3 seen = v3_fma(right, view_x, v3_fma(up, view_y, ahead));
    const v3 dir = v3_normalize(v3_sub(v3_scale(seen, (vf)(params->focus_distance)), org));
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
#if HAS_HIT_RANDOM
    state_store_int(s, PATH, slots, path_begin(key.key), slots->valid);
#endif
}

#endif
