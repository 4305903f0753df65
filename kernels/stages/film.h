// Stage: film. Sums of a pixel's samples, in the order of the samples whatever is in flight together.
#ifndef CLRT_KERNELS_STAGES_FILM_H
#define CLRT_KERNELS_STAGES_FILM_H

#include "stages/camera.h"

// The tile that a group works on.
typedef struct {
    uint left, top;         // first pixel, counted from the crop's left edge and the band's first row
    uint width, height;     // pixels of the crop and rows of the band from there on
    int image_left, image_top; // first pixel in the image
} Tile;

// The scalar forms of slot_x and slot_y.
static inline uint pixel_x(uint pixel)
{
    return (pixel & 1) | (pixel >> 1 & 2) | (pixel >> 2 & 4) | (pixel >> 3 & 8);
}
static inline uint pixel_y(uint pixel) { return pixel_x(pixel >> 1); }

// Adds value to the unevaluated sum high + low without losing what the additions round away: 2e7 samples of 0.1
// still average to 0.1. Knuth's two-sum, and Dekker's to keep low below half an ulp of high; left to itself low
// grows until it loses as much as high would.
static inline void sum_add(real *high, real *low, real value)
{
    const real sum = *high + value;
    const real from_value = sum - *high;
    const real rest = *low + ((*high - (sum - from_value)) + (value - from_value));
    *high = sum + rest;
    *low = rest - (*high - sum);
}

// Takes over samples begin .. end - 1 of the tile's pixels, which its slots have finished, into the film (3
// numbers a pixel, rows of the crop's width): sums, and means after the last sample.
OUTLINE void film_add(const State *s, constant RenderParams *params, global real *film, global real *film_low,
                      const Tile *tile, uint begin, uint end)
{
    const uint log2 = params->slots_log2;
    for (uint pixel = GROUP_ITEM; pixel < TILE_SLOTS >> log2; pixel += GROUP) {
        const uint x = pixel_x(pixel), y = pixel_y(pixel);
        if (x >= tile->width || y >= tile->height)
            continue;
        const uint place = 3 * ((tile->top + y) * params->crop_width + tile->left + x);
        for (uint c = 0; c < 3; c++) {
            global const real *radiance = s->reals + (RADIANCE + c) * TILE_SLOTS + (pixel << log2);
#if HAS_SAMPLES
            real high = begin ? film[place + c] : 0.0f, low = begin ? film_low[place + c] : 0.0f;
            for (uint k = 0; k < end - begin; k++)
                sum_add(&high, &low, radiance[k]);
            film[place + c] = end == params->samples ? (high + low) / (real)params->samples : high;
            film_low[place + c] = low;
#else
            film[place + c] = radiance[0];
#endif
        }
    }
}

#endif
