#include "accel/split.h"

#include <float.h>
#include <math.h>

// With 16, halls of a few large boxes and dense objects cost 40 % more nodes a ray; 64 gain nothing. Small
// ranges need fewer, but still one for every other item: so the cuts that leave full blocks are among the
// places, and blocks are filled with 7.4 triangles where a bin for 16 items gives 6.8.
enum { BINS = 32 };

typedef struct Bin {
    Quad low, high;
} Bin;

typedef struct Bins {
    Bin boxes[3][BINS]; // [axis][bin]
    u32 weights[3][BINS]; // beyond 2^32 they wrap: the choice gets worse, the hierarchy stays sound
} Bins;

// How centres map to bins. Where an axis is flat, its scale is 0 and all fall in the first.
typedef struct Mapping {
    Quad low, scale, last;
    f32 lows[4], scales[4];
    u32 count; // of bins
} Mapping;

f32 area_scale(const Bounds *bounds)
{
    f32 edges[4];
    quad_store(edges, quad_min(quad_sub(bounds->high, bounds->low), quad_all(FLT_MAX)));
    const f32 most = fmaxf(edges[0], fmaxf(edges[1], edges[2]));
    if (!(most > 0))
        return 1;
    int exponent;
    frexpf(most, &exponent);
    return ldexpf(1, exponent < -126 ? 126 : exponent > 126 ? -126 : -exponent);
}

static Mapping mapping(const Range *range)
{
    Mapping map;
    const u32 wished = 4 + range->count / 2;
    map.count = wished < BINS ? wished : BINS;
    f32 high[4];
    quad_store(map.lows, range->bounds.centre_low);
    quad_store(high, range->bounds.centre_high);
    for (int axis = 0; axis < 3; axis++) {
        // A little less than all bins, so that rounding does not lead beyond the last.
        const f32 scale = (f32)map.count * 0.99999f / (high[axis] - map.lows[axis]);
        map.scales[axis] = high[axis] - map.lows[axis] <= FLT_MAX && scale <= FLT_MAX ? scale : 0;
    }
    // What stands in the fourth lane of boxes becomes a zero, with no denormal number on the way.
    map.lows[3] = 1;
    map.scales[3] = 0;
    map.low = quad_load(map.lows);
    map.scale = quad_load(map.scales);
    map.last = quad_all((f32)(map.count - 1));
    return map;
}

static void bins_clear(Bins *bins, u32 count)
{
    const Bin empty = { quad_all(INFINITY), quad_all(-INFINITY) };
    for (int axis = 0; axis < 3; axis++) {
        for (u32 i = 0; i < count; i++) {
            bins->boxes[axis][i] = empty;
            bins->weights[axis][i] = 0;
        }
    }
}

static inline void bin_add(Bins *bins, int axis, u32 bin, Quad low, Quad high, u32 weight)
{
    Bin *box = &bins->boxes[axis][bin];
    box->low = quad_min(low, box->low);
    box->high = quad_max(high, box->high);
    bins->weights[axis][bin] += weight;
}

static inline void bins_add(Bins *bins, const Mapping *map, const Item *item)
{
    const Quad low = quad_load(item->min), high = quad_load(item->max);
    const Quad at = quad_mul(quad_sub(quad_add(low, high), map->low), map->scale);
    u32 bin[3];
    quad_to_indices(quad_min(quad_max(at, quad_all(0)), map->last), bin);
    bin_add(bins, 0, bin[0], low, high, item->weight);
    bin_add(bins, 1, bin[1], low, high, item->weight);
    bin_add(bins, 2, bin[2], low, high, item->weight);
}

// Neighbours often fall in the same bin and would wait for each other's stores, so items from four places of
// the range take turns.
static void bins_fill(Bins *bins, const Mapping *map, const Item *items, u32 first, u32 end)
{
    const Mapping local = *map;
    const u32 step = (end - first) / 4;
    for (u32 i = first; i < first + step; i++) {
        bins_add(bins, &local, &items[i]);
        bins_add(bins, &local, &items[i + step]);
        bins_add(bins, &local, &items[i + 2 * step]);
        bins_add(bins, &local, &items[i + 3 * step]);
    }
    for (u32 i = first + 4 * step; i < end; i++)
        bins_add(bins, &local, &items[i]);
}

static void bins_join(Bins *bins, const Bins *other, u32 count)
{
    for (int axis = 0; axis < 3; axis++) {
        for (u32 i = 0; i < count; i++) {
            Bin *box = &bins->boxes[axis][i];
            box->low = quad_min(other->boxes[axis][i].low, box->low);
            box->high = quad_max(other->boxes[axis][i].high, box->high);
            bins->weights[axis][i] += other->weights[axis][i];
        }
    }
}

static void fill_in_pieces(Bins *bins, const Mapping *map, const Item *items, const Range *range)
{
    Bins pieces[PIECES];
#pragma omp taskgroup
    for (u32 piece = 0; piece < PIECES; piece++) {
        const u32 first = range_piece(range->first, range->count, piece);
        const u32 end = range_piece(range->first, range->count, piece + 1);
#pragma omp task default(none) firstprivate(items, first, end, map, piece) shared(pieces)
        {
            bins_clear(&pieces[piece], map->count);
            bins_fill(&pieces[piece], map, items, first, end);
        }
    }
    for (u32 piece = 0; piece < PIECES; piece++)
        bins_join(bins, &pieces[piece], map->count);
}

// Leaves that the weight fills at least.
static f32 leaves(u32 weight)
{
    return (f32)((weight + LEAF_WEIGHT - 1) / LEAF_WEIGHT);
}

// The cheapest place between bins of the axis (it is the first bin of the right side; 0: none) and its cost:
// area times leaves, of both sides.
static u32 best_place(const Bins *bins, u32 count, int axis, f32 scale, f32 *cost)
{
    const Bin *boxes = bins->boxes[axis];
    const u32 *weights = bins->weights[axis];
    f32 right[BINS];
    u32 weight = 0;
    Quad low = quad_all(INFINITY), high = quad_all(-INFINITY);
    for (u32 i = count - 1; i > 0; i--) {
        low = quad_min(boxes[i].low, low);
        high = quad_max(boxes[i].high, high);
        weight += weights[i];
        right[i] = weight > 0 ? bounds_area(low, high, scale) * leaves(weight) : INFINITY;
    }
    weight = 0;
    low = quad_all(INFINITY), high = quad_all(-INFINITY);
    f32 least = INFINITY;
    u32 place = 0;
    for (u32 i = 1; i < count; i++) {
        low = quad_min(boxes[i - 1].low, low);
        high = quad_max(boxes[i - 1].high, high);
        weight += weights[i - 1];
        const f32 left = weight > 0 ? bounds_area(low, high, scale) * leaves(weight) : INFINITY;
        // Without a branch: none could predict it.
        const f32 sum = left + right[i];
        place = sum < least ? i : place;
        least = sum < least ? sum : least;
    }
    *cost = least;
    return place;
}

bool split_find(const Item *items, const Range *range, f32 scale, Cut *cut)
{
    const Mapping map = mapping(range);
    Bins bins;
    bins_clear(&bins, map.count);
    if (range->count < PARALLEL_ITEMS)
        bins_fill(&bins, &map, items, range->first, range->first + range->count);
    else
        fill_in_pieces(&bins, &map, items, range);
    f32 least = INFINITY;
    for (int axis = 0; axis < 3; axis++) {
        f32 cost;
        const u32 place = map.scales[axis] > 0 ? best_place(&bins, map.count, axis, scale, &cost) : 0;
        if (place > 0 && cost < least) {
            least = cost;
            *cut = (Cut){ axis, map.lows[axis], map.scales[axis], (f32)place };
        }
    }
    return least < INFINITY;
}
