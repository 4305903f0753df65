// Stage: camera rays into the slots that need one.
#ifndef CLRT_KERNELS_STAGES_CAMERA_H
#define CLRT_KERNELS_STAGES_CAMERA_H

#include "base/ray.h"
#include "stages/state.h"
#if HAS_SAMPLES
#include "base/sampling.h"
#endif

// Pixel of a slot within its tile. Eight by four neighbours follow each other, so that a batch is compact.
static inline vi slot_x(vi slot) { return (slot & 7) | (slot >> 2 & 8); }
static inline vi slot_y(vi slot) { return (slot >> 3 & 3) | (slot >> 4 & 12); }

static inline v3 v3_from(f32x4 v) { return v3_make((vf)(v.x), (vf)(v.y), (vf)(v.z)); }

// Starts sample number `sample` of the pixels in the lanes of m. (left, top): the tile's first pixel.
// Offsets count from the middle of the image in pixels, whole and fraction apart: the whole part is exact
// and each coordinate is rounded once, at any width.
OUTLINE void camera_ray(const State *s, constant RenderParams *params, int left, int top,
                              const Slots *slots, vi sample, vm m)
{
    const vi x = slot_x(slots->index) + left, y = slot_y(slots->index) + top;
    const vi whole_x = 2 * x + (1 - (int)params->width);
    const vi whole_y = ((int)params->height - 1) - 2 * y;
    vf fine_x = (vf)(0.0f), fine_y = (vf)(0.0f);
#if HAS_SAMPLES
    const vu key = random_pixel_key(VU_FROM_VI(x), VU_FROM_VI(y), params->seed);
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
    state_store3(s, RAY_ORG, slots, org, m);
    state_store3(s, RAY_DIR, slots, dir, m);
    state_store3(s, THROUGHPUT, slots, v3_splat(1.0f), m);
    state_store3(s, RADIANCE, slots, v3_splat(0.0f), m);
    state_store_int(s, SELF, slots, (vi)(-1), m);
#if HAS_INSTANCES
    state_store_int(s, SELF_INSTANCE, slots, (vi)(NO_HIT), m);
#endif
    state_store_int(s, DEPTH, slots, (vi)(0), m);
    state_store_int(s, SAMPLE, slots, sample, m);
}

#endif
