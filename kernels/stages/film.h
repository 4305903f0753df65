// Stage: film. Sums of a pixel's samples, in the order of the samples whatever the batch.
#ifndef CLRT_KERNELS_STAGES_FILM_H
#define CLRT_KERNELS_STAGES_FILM_H

#include "stages/camera.h"

#if HAS_SAMPLES
// Adds value to the unevaluated sum high + low without losing what the addition rounds away (Knuth's two-sum;
// Kahan, "Further remarks on reducing truncation errors", 1965): 2e7 samples of 0.1 still average to 0.1.
static inline void film_add_channel(const State *s, uint channel, const Slots *slots, vf value, vm m)
{
    const vf high = state_load(s, FILM + channel, slots), low = state_load(s, FILM_LOW + channel, slots);
    const vf sum = high + value;
    const vf from_value = sum - high;
    const vf rest = (high - (sum - from_value)) + (value - from_value);
    state_store(s, FILM + channel, slots, sum, m);
    state_store(s, FILM_LOW + channel, slots, low + rest, m);
}
#endif

// Takes over the finished sample of the slots of m.
OUTLINE void film_add(const State *s, const Slots *slots, vm m)
{
    const v3 radiance = state_load3(s, RADIANCE, slots);
#if HAS_SAMPLES
    film_add_channel(s, 0, slots, radiance.x, m);
    film_add_channel(s, 1, slots, radiance.y, m);
    film_add_channel(s, 2, slots, radiance.z, m);
#else
    state_store3(s, FILM, slots, radiance, m);
#endif
}

// Where a slot's pixel stands in the band's film (3 numbers a pixel, rows of the crop's width).
static inline uint film_place(constant RenderParams *params, int slot, uint tile_left, uint tile_row)
{
    const uint x = tile_left + (uint)((slot & 7) | (slot >> 2 & 8));
    const uint y = tile_row + (uint)((slot >> 3 & 3) | (slot >> 4 & 12));
    return 3 * (y * params->crop_width + x);
}

#endif
