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

// Adds value to the unevaluated sum high + low of each lane without losing what the additions round away: 2e7
// samples of 0.1 still average to 0.1. Knuth's two-sum, and Dekker's to keep low below half an ulp of high;
// left to itself low grows until it loses as much as high would.
static inline void sum_add(vf *high, vf *low, vf value)
{
    const vf sum = *high + value;
    const vf from_value = sum - *high;
    const vf rest = *low + ((*high - (sum - from_value)) + (value - from_value));
    *high = sum + rest;
    *low = rest - (*high - sum);
}

// The numbers of LANES pixels that follow each other in a tile, and where their film is.
typedef struct {
    bool inside[LANES]; // of the crop and the band
    uint place[LANES];  // rows of the crop's width
} FilmPixels;

static inline FilmPixels film_pixels(constant RenderParams *params, const Tile *tile, uint pixel)
{
    FilmPixels pixels;
    for (uint l = 0; l < LANES; l++) {
        const uint x = pixel_x(pixel + l), y = pixel_y(pixel + l);
        pixels.inside[l] = x < tile->width && y < tile->height;
        pixels.place[l] = (tile->top + y) * params->crop_width + tile->left + x;
    }
    return pixels;
}

// One number of each of LANES pixels, which are `stride` apart.
static inline vf film_load(global const real *numbers, uint stride)
{
    LanesF loaded;
    for (uint l = 0; l < LANES; l++)
        loaded.s[l] = numbers[l * stride];
    return loaded.v;
}

// What the float high leaves of the sum high + low of reals.
static inline f32 film_rest(real high, real low)
{
#if MATH_DOUBLE
    return (f32)(low + (high - (f32)high));
#else
    return low;
#endif
}

// Takes over samples begin .. end - 1 of the tile's pixels, which its slots have finished, into the film (3
// numbers a pixel, rows of the crop's width): sums, and means after the last sample. film_m2 (1 number a
// pixel) becomes the sum over samples and channels of the squares of what each sample differs from the mean:
// that of the samples before it, weighted as Youngs and Cramer do ("Some Results Relevant to Choice of Sum
// and Sum-of-Product Algorithms", 1971), which loses nothing where the mean is large, and first within a
// round, so that a million small terms do not vanish beside their sum.
OUTLINE void film_add(const State *s, constant RenderParams *params, global f32 *film, global f32 *film_low,
                      global float *film_m2, const Tile *tile, uint begin, uint end)
{
    const uint log2 = params->slots_log2;
    for (uint pixel = GROUP_ITEM * LANES; pixel < TILE_SLOTS >> log2; pixel += GROUP * LANES) {
        const FilmPixels pixels = film_pixels(params, tile, pixel);
        global const real *radiance = s->reals + RADIANCE * TILE_SLOTS + (pixel << log2);
#if HAS_SAMPLES
        LanesF high[3], low[3], m2;
        for (uint l = 0; l < LANES; l++) {
            const bool more = begin > 0 && pixels.inside[l];
            for (uint c = 0; c < 3; c++) {
                high[c].s[l] = more ? film[3 * pixels.place[l] + c] : 0.0f;
                low[c].s[l] = more ? film_low[3 * pixels.place[l] + c] : 0.0f;
            }
        }
        m2.v = (vf)(0.0f);
        real inverse = begin ? 1.0f / (real)begin : 0.0f; // of the number of samples in the sums
        for (uint k = begin; k < end; k++) {
            const real next = 1.0f / (real)(k + 1);
            for (uint c = 0; c < 3; c++) {
                const vf value = film_load(radiance + c * TILE_SLOTS + (k - begin), 1u << log2);
                const vf apart = fma(high[c].v, (vf)(-inverse), value);
                m2.v = fma(apart * (1.0f - next), apart, m2.v);
                sum_add(&high[c].v, &low[c].v, value);
            }
            inverse = next;
        }
        if (end == params->samples)
            for (uint c = 0; c < 3; c++)
                high[c].v = (high[c].v + low[c].v) / (real)params->samples;
        for (uint l = 0; l < LANES; l++) {
            const uint place = pixels.place[l];
            for (uint c = 0; c < 3 && pixels.inside[l]; c++) {
                film[3 * place + c] = (f32)high[c].s[l];
                film_low[3 * place + c] = film_rest(high[c].s[l], low[c].s[l]);
            }
            if (pixels.inside[l])
                film_m2[place] = begin ? film_m2[place] + (float)m2.s[l] : (float)m2.s[l];
        }
#else
        for (uint l = 0; l < LANES; l++)
            for (uint c = 0; c < 3 && pixels.inside[l]; c++)
                film[3 * pixels.place[l] + c] = radiance[c * TILE_SLOTS + l];
#endif
    }
}

#if HAS_CLAMP
// Scales the samples in the tile's slots that have a channel above limit, so that their largest one is limit,
// and keeps what they lose as CLAMPED. What is not finite stays, so that it can be counted. field: the first
// of their radiance.
OUTLINE void clamp_samples(const State *s, uint field, f32 limit)
{
    for (uint i = GROUP_ITEM * LANES; i < TILE_SLOTS; i += GROUP * LANES) {
        const Slots slots = slots_all(i);
        const v3 radiance = state_load3(s, field, &slots);
        const vf largest = vf_max(vf_max(radiance.x, radiance.y), radiance.z), most = (vf)(limit);
        const vm finite = (fabs(radiance.x) < (vf)(INFINITY)) & (fabs(radiance.y) < (vf)(INFINITY)) &
                          (fabs(radiance.z) < (vf)(INFINITY));
        const vm over = finite & (largest > most);
        // Quotients first: limit over largest may be smaller than devices agree on. They are at most 1, and a
        // little more in fast arithmetic.
        const vf whole = over ? largest : (vf)(1.0f);
        const v3 kept = v3_make(vf_min(radiance.x / whole * most, most), vf_min(radiance.y / whole * most, most),
                                vf_min(radiance.z / whole * most, most));
        state_store3(s, CLAMPED, &slots, v3_splat(0.0f), slots.valid);
        state_store3(s, CLAMPED, &slots, v3_sub(radiance, kept), over);
        state_store3(s, field, &slots, kept, over);
    }
    GROUP_BARRIER();
}

// Takes over what samples begin .. end - 1 of the tile's pixels lost, weighted as the samples are, into
// film_clamped, 4 numbers a pixel: the sums of the channels and how many samples lost anything. First within
// a round, as in film_add.
OUTLINE void film_add_clamped(const State *s, constant RenderParams *params, global f32 *film_clamped,
                              const Tile *tile, uint begin, uint end)
{
    const uint log2 = params->slots_log2;
    for (uint pixel = GROUP_ITEM; pixel < TILE_SLOTS >> log2; pixel += GROUP) {
        const uint x = pixel_x(pixel), y = pixel_y(pixel);
        if (x >= tile->width || y >= tile->height)
            continue;
        global const real *lost = s->reals + CLAMPED * TILE_SLOTS + (pixel << log2);
        global f32 *to = film_clamped + 4 * ((tile->top + y) * params->crop_width + tile->left + x);
        real sums[4] = { 0.0f, 0.0f, 0.0f, 0.0f };
        for (uint k = 0; k < end - begin; k++) {
            const real r = lost[k], g = lost[TILE_SLOTS + k], b = lost[2 * TILE_SLOTS + k];
            sums[0] += r;
            sums[1] += g;
            sums[2] += b;
            sums[3] += r != 0.0f || g != 0.0f || b != 0.0f ? 1.0f : 0.0f;
        }
        for (uint c = 0; c < 4; c++)
            to[c] = begin ? to[c] + (f32)sums[c] : (f32)sums[c];
    }
}
#endif

#endif
