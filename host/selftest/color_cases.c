// Radiance to levels, on the host: the encoding, and what is no number or too large.
#include <float.h>
#include <math.h>

#include "image/color.h"
#include "output/quantize.h"
#include "selftest/run.h"

// The level of one value by the tables that pictures are written with.
static u32 level_of(const Quantizer *quantizer, f32 value)
{
    u8 byte;
    quantizer_apply(quantizer, &value, 1, &byte);
    return byte;
}

bool color_cases(Run *run)
{
    static const f32 ENDS[] = {NAN, INFINITY, -INFINITY, -1, 1e38F, -0.0F};
    static const u32 LEVELS[] = {0, 255, 0, 0, 255, 0};
    const OutputSettings settings = {.tone_map = TONE_MAP_NONE, .encoding = ENCODING_SRGB};
    Quantizer *quantizer = quantizer_create(&settings, 8, run->error);
    if (!quantizer)
        return false;
    Score levels = {0}, ends = {0}, maps = {0};
    for (u32 level = 0; level < 256; level++)
        score_wrong(&levels, level_of(quantizer, (f32)srgb_decode(level / 255.0)) != level);
    for (u32 i = 0; i < 4096; i++) // about the joint of the two pieces
        score_wrong(&levels, level_of(quantizer, 0.0031308F + (f32)i * 1e-8F) <
                                 level_of(quantizer, 0.0031308F + ((f32)i - 1) * 1e-8F));
    for (u32 i = 0; i < sizeof ENDS / sizeof ENDS[0]; i++)
        score_wrong(&ends, level_of(quantizer, ENDS[i]) != LEVELS[i]);
    quantizer_destroy(quantizer);
    static const f64 LARGE[] = {INFINITY, FLT_MAX, DBL_MAX};
    for (u32 i = 0; i < sizeof LARGE / sizeof LARGE[0]; i++) {
        score_absolute(&maps, 1, tone_map_reinhard(LARGE[i]));
        score_absolute(&maps, 1, tone_map_reinhard_extended(LARGE[i], 4));
        score_absolute(&maps, 1, tone_map_aces(LARGE[i]));
        score_absolute(&maps, 1, tone_map_hable(LARGE[i]));
    }
    run_add(run, "C62", "sRGB: 256 levels there and back, monotone", "identity", UNIT_WRONG, 0, &levels);
    run_add(run, "C62", "levels of NaN, infinities, -1, 1e38", "0 or 255", UNIT_WRONG, 0, &ends);
    run_add(run, "C63", "tone maps of infinity and the largest floats", "1", UNIT_ABSOLUTE, 1e-12, &maps);
    return true;
}
