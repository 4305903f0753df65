#include "output/quantize.h"

#include "image/color.h"

#include <assert.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

// Floats that are not negative are in the order of their bits. So a monotone curve is a list of
// thresholds: the bits of the first float of each level. The levels of all curves are monotone: the curves
// are, as far as a level can tell (image/color.h), and the steps between neighbouring floats are large
// beside the rounding of a double. So bisection finds each threshold exactly. A table over the high bits
// says the level at the start of each cell; most cells have one threshold at the most.
struct Quantizer {
    u32 bits;
    u32 lowest, highest; // bits of the first floats of level 1 and of the last level
    u32 shift;           // bits of a float within a cell
    u32 *thresholds;     // of level k at [k]; one more at the end that no float reaches
    u16 *cells;          // level of the first float of each cell, cells counted from `lowest`
};

// As many as serve: 8 KiB stay in the first cache; at 16 bits there are ten thousands of thresholds.
enum { CELLS_8 = 1 << 12, CELLS_16 = 1 << 18, INFINITY_BITS = 0x7F800000 };

// Settings with what does not change from float to float.
typedef struct Curve {
    const OutputSettings *settings;
    f64 scale;
    u32 last; // level
} Curve;

// A float by its bits, and the level it has before rounding.
typedef struct Probe {
    u32 bits;
    f64 value;
} Probe;

static u32 float_bits(f32 value)
{
    u32 bits;
    memcpy(&bits, &value, sizeof bits);
    return bits;
}

static f32 bits_float(u32 bits)
{
    f32 value;
    memcpy(&value, &bits, sizeof value);
    return value;
}

static f64 tone_map(const OutputSettings *settings, f64 c)
{
    switch (settings->tone_map) {
    case TONE_MAP_NONE:
        break;
    case TONE_MAP_REINHARD:
        return tone_map_reinhard(c);
    case TONE_MAP_REINHARD_EXTENDED:
        return tone_map_reinhard_extended(c, settings->white);
    case TONE_MAP_ACES:
        return tone_map_aces(c);
    case TONE_MAP_HABLE:
        return tone_map_hable(c);
    }
    return tone_map_none(c);
}

static Curve make_curve(const OutputSettings *settings, u32 bits)
{
    // Beyond 2^1000 and 2^-1000 every float has long become white or black; a factor that is infinite
    // or 0 would make NaN of 0 or infinity.
    const f64 scale = exp2(fmin(fmax(settings->exposure, -1000), 1000));
    return (Curve){settings, scale, (1u << bits) - 1};
}

static f64 curve_value(const Curve *curve, f32 radiance)
{
    const f64 mapped = tone_map(curve->settings, (f64)radiance * curve->scale);
    const f64 encoded = curve->settings->encoding == ENCODING_SRGB ? srgb_encode(mapped) : mapped;
    return encoded * curve->last;
}

u32 quantize_exact(const OutputSettings *settings, u32 bits, f32 radiance)
{
    const Curve curve = make_curve(settings, bits);
    return (u32)round(curve_value(&curve, radiance));
}

// Takes the float with these bits as the new end of the bracket on its side of `half`.
static void narrow(const Curve *curve, f64 half, u32 bits, Probe *low, Probe *high)
{
    if (bits <= low->bits || bits >= high->bits)
        return;
    const Probe probe = {bits, curve_value(curve, bits_float(bits))};
    *(probe.value >= half ? high : low) = probe;
}

// Bits of the first float at or above `half`, which lies between the two. Where the bracket is short the
// curve is nearly straight, so that the interpolated float and its neighbour are most often the two sought.
static u32 find_threshold(const Curve *curve, f64 half, Probe low, Probe high)
{
    while (high.bits - low.bits > 1) {
        const f64 part = (half - low.value) / (high.value - low.value);
        const u32 guess = low.bits + (u32)(part * (high.bits - low.bits));
        narrow(curve, half, guess, &low, &high);
        narrow(curve, half, guess + 1, &low, &high);
        narrow(curve, half, low.bits + (high.bits - low.bits) / 2, &low, &high);
    }
    return high.bits;
}

// Sets the thresholds of the levels above low's up to high's.
static void find_thresholds(const Curve *curve, u32 *thresholds, Probe low, Probe high)
{
    const u32 low_level = (u32)round(low.value);
    const u32 high_level = (u32)round(high.value);
    if (low_level == high_level)
        return;
    if (high_level - low_level == 1 || high.bits - low.bits == 1) {
        const u32 threshold = find_threshold(curve, low_level + 0.5, low, high);
        for (u32 level = low_level + 1; level <= high_level; level++)
            thresholds[level] = threshold;
        return;
    }
    const u32 bits = low.bits + (high.bits - low.bits) / 2;
    const Probe middle = {bits, curve_value(curve, bits_float(bits))};
    find_thresholds(curve, thresholds, low, middle);
    find_thresholds(curve, thresholds, middle, high);
}

// The level at the start of each cell.
static bool build_cells(Quantizer *quantizer, u32 most)
{
    const u32 span = quantizer->highest - quantizer->lowest;
    while (span >> quantizer->shift >= most)
        quantizer->shift++;
    const u32 count = (span >> quantizer->shift) + 1;
    quantizer->cells = malloc(count * sizeof(u16));
    if (!quantizer->cells)
        return false;
    u32 level = 1;
    for (u32 i = 0; i < count; i++) {
        const u32 first = quantizer->lowest + (i << quantizer->shift);
        while (first >= quantizer->thresholds[level + 1])
            level++;
        quantizer->cells[i] = (u16)level;
    }
    return true;
}

static bool build(Quantizer *quantizer, const OutputSettings *settings)
{
    const Curve curve = make_curve(settings, quantizer->bits);
    quantizer->thresholds = calloc(curve.last + 2, sizeof(u32));
    if (!quantizer->thresholds)
        return false;
    // Under every setting 0 is the first level and infinity the last.
    find_thresholds(&curve, quantizer->thresholds, (Probe){0, 0}, (Probe){INFINITY_BITS, curve.last});
    quantizer->thresholds[curve.last + 1] = UINT32_MAX;
    quantizer->lowest = quantizer->thresholds[1];
    quantizer->highest = quantizer->thresholds[curve.last];
    return build_cells(quantizer, quantizer->bits == 8 ? CELLS_8 : CELLS_16);
}

Quantizer *quantizer_create(const OutputSettings *settings, u32 bits, Error *error)
{
    assert(bits == 8 || bits == 16);
    Quantizer *quantizer = calloc(1, sizeof *quantizer);
    if (quantizer)
        quantizer->bits = bits;
    if (!quantizer || !build(quantizer, settings)) {
        quantizer_destroy(quantizer);
        error_set(error, ERROR_MEMORY, "no memory for the table of output levels");
        return NULL;
    }
    return quantizer;
}

void quantizer_destroy(Quantizer *quantizer)
{
    if (!quantizer)
        return;
    free(quantizer->thresholds);
    free(quantizer->cells);
    free(quantizer);
}

static inline u32 find_level(const Quantizer *quantizer, f32 value)
{
    const u32 bits = float_bits(value);
    // Also what is negative or NaN: as bits, both lie above infinity.
    if (bits < quantizer->lowest || bits > INFINITY_BITS)
        return 0;
    const u32 within = bits < quantizer->highest ? bits : quantizer->highest;
    u32 level = quantizer->cells[(within - quantizer->lowest) >> quantizer->shift];
    // Whether a cell's one threshold is passed cannot be foretold in a noisy picture, so that a branch on
    // it would cost more than this sum; the loop is for the few cells with more.
    level += bits >= quantizer->thresholds[level + 1];
    while (bits >= quantizer->thresholds[level + 1])
        level++;
    return level;
}

void quantizer_apply(const Quantizer *quantizer, const f32 *values, size_t count, u8 *bytes)
{
    // A copy whose address stays here: writes through `bytes` could otherwise change it, for all that the
    // compiler knows, and it would be read anew for each value.
    const Quantizer table = *quantizer;
    if (table.bits == 8) {
        for (size_t i = 0; i < count; i++)
            bytes[i] = (u8)find_level(&table, values[i]);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        const u32 level = find_level(&table, values[i]);
        bytes[2 * i] = (u8)(level >> 8);
        bytes[2 * i + 1] = (u8)level;
    }
}
