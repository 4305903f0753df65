#include "accel/range.h"

#include <float.h>
#include <math.h>

static Range range_empty(u32 first)
{
    const Quad least = quad_all(-INFINITY), most = quad_all(INFINITY);
    return (Range){ .bounds = { most, least, most, least }, .first = first };
}

// Twice the centres are kept finite: those beyond float's range are as far as it goes.
static void range_close(Range *range)
{
    const Quad most = quad_all(FLT_MAX), least = quad_all(-FLT_MAX);
    Bounds *bounds = &range->bounds;
    bounds->centre_low = quad_max(quad_min(bounds->centre_low, most), least);
    bounds->centre_high = quad_max(quad_min(bounds->centre_high, most), least);
}

static void range_join(Range *range, const Range *other)
{
    Bounds *a = &range->bounds;
    const Bounds *b = &other->bounds;
    a->low = quad_min(b->low, a->low);
    a->high = quad_max(b->high, a->high);
    a->centre_low = quad_min(b->centre_low, a->centre_low);
    a->centre_high = quad_max(b->centre_high, a->centre_high);
    range->weight += other->weight;
    range->count += other->count;
}

// Range of items first .. end - 1.
static Range measure(const Item *items, u32 first, u32 end)
{
    Range range = range_empty(first);
    Bounds bounds = range.bounds;
    u64 weight = 0;
    for (u32 i = first; i < end; i++) {
        const Quad low = quad_load(items[i].min), high = quad_load(items[i].max);
        const Quad centre = quad_add(low, high);
        bounds.low = quad_min(low, bounds.low);
        bounds.high = quad_max(high, bounds.high);
        bounds.centre_low = quad_min(centre, bounds.centre_low);
        bounds.centre_high = quad_max(centre, bounds.centre_high);
        weight += items[i].weight;
    }
    range.bounds = bounds;
    range.weight = weight;
    range.count = end - first;
    return range;
}

Range range_create(const BvhInput *input, Item *items)
{
    Range pieces[PIECES];
#pragma omp parallel for schedule(dynamic, 1) default(none) shared(input, items, pieces)                    \
    if (input->count >= PARALLEL_ITEMS)
    for (u32 piece = 0; piece < PIECES; piece++) {
        const u32 first = range_piece(0, input->count, piece), end = range_piece(0, input->count, piece + 1);
        for (u32 i = first; i < end; i++) {
            const Box *box = &input->boxes[i];
            items[i] = (Item){ { box->min[0], box->min[1], box->min[2] }, i,
                               { box->max[0], box->max[1], box->max[2] },
                               i < input->singles ? LEAF_WEIGHT : 1 };
        }
        pieces[piece] = measure(items, first, end);
    }
    Range all = range_empty(0);
    for (u32 piece = 0; piece < PIECES; piece++)
        range_join(&all, &pieces[piece]);
    range_close(&all);
    return all;
}

// The order of the items afterwards follows from that before, and nothing is to be predicted: every item is
// written twice, whichever side it goes to. Returns the first item of the right side.
static u32 partition(Item *items, u32 first, u32 end, Cut cut)
{
    u32 middle = first;
    for (u32 i = first; i < end; i++) {
        Item *const from = &items[i], *const to = &items[middle];
        const f32 at = (from->min[cut.axis] + from->max[cut.axis] - cut.low) * cut.scale;
        const Quad low = quad_load(from->min), high = quad_load(from->max);
        *from = *to;
        quad_store(to->min, low);
        quad_store(to->max, high);
        middle += !(at >= cut.place); // as bins take what is no number for the first
    }
    return middle;
}

static u32 partition_kinds(Item *items, u32 first, u32 end)
{
    u32 middle = first;
    for (u32 i = first; i < end; i++) {
        const Item item = items[i];
        items[i] = items[middle];
        items[middle] = item;
        middle += item.weight == LEAF_WEIGHT;
    }
    return middle;
}

static void cut_piece(Item *items, u32 first, u32 end, Cut cut, Range sides[2])
{
    const u32 middle =
        cut.axis < 0 ? partition_kinds(items, first, end) : partition(items, first, end, cut);
    sides[0] = measure(items, first, middle);
    sides[1] = measure(items, middle, end);
}

// The run of items that piece has on a side of the range where they do not belong: from *first, returns how
// many. side 0: items of the right among the places of the left.
static u32 misplaced(Range pieces[PIECES][2], u32 piece, int side, u32 middle, u32 *first)
{
    const Range *run = &pieces[piece][1 - side];
    const u32 end = run->first + run->count;
    const u32 from = side == 1 && run->first < middle ? middle : run->first;
    const u32 to = side == 0 && end > middle ? middle : end;
    *first = from;
    return to > from ? to - from : 0;
}

typedef struct Runs {
    u32 first[PIECES];
    u32 before[PIECES + 1]; // of all misplaced items, how many stand in earlier pieces
} Runs;

// Swaps the misplaced items number from .. to - 1 of the two sides.
static void swap_misplaced(Item *items, const Runs runs[2], u32 from, u32 to)
{
    u32 at[2] = { 0, 0 };
    while (from < to) {
        u32 place[2], length = to - from;
        for (int side = 0; side < 2; side++) {
            while (runs[side].before[at[side] + 1] <= from)
                at[side]++;
            place[side] = runs[side].first[at[side]] + (from - runs[side].before[at[side]]);
            const u32 left = runs[side].before[at[side] + 1] - from;
            length = left < length ? left : length;
        }
        for (u32 i = 0; i < length; i++) {
            const Item item = items[place[0] + i];
            items[place[0] + i] = items[place[1] + i];
            items[place[1] + i] = item;
        }
        from += length;
    }
}

// Pieces are sorted each for itself; then what stands on the wrong side of the range changes places, the nth
// of one side with the nth of the other.
static void cut_in_pieces(Item *items, const Range *range, Cut cut, Range sides[2])
{
    Range pieces[PIECES][2];
#pragma omp taskgroup
    for (u32 piece = 0; piece < PIECES; piece++) {
        const u32 first = range_piece(range->first, range->count, piece);
        const u32 end = range_piece(range->first, range->count, piece + 1);
#pragma omp task default(none) firstprivate(items, first, end, cut, piece) shared(pieces)
        cut_piece(items, first, end, cut, pieces[piece]);
    }
    for (int side = 0; side < 2; side++)
        for (u32 piece = 0; piece < PIECES; piece++)
            range_join(&sides[side], &pieces[piece][side]);
    const u32 middle = range->first + sides[0].count;
    Runs runs[2];
    for (int side = 0; side < 2; side++) {
        runs[side].before[0] = 0;
        for (u32 piece = 0; piece < PIECES; piece++) {
            const u32 count = misplaced(pieces, piece, side, middle, &runs[side].first[piece]);
            runs[side].before[piece + 1] = runs[side].before[piece] + count;
        }
    }
    const u32 count = runs[0].before[PIECES];
#pragma omp taskgroup
    for (u32 piece = 0; piece < PIECES; piece++) {
#pragma omp task default(none) firstprivate(items, count, piece) shared(runs)
        swap_misplaced(items, runs, range_piece(0, count, piece), range_piece(0, count, piece + 1));
    }
    sides[1].first = middle;
}

bool range_cut(Item *items, const Range *range, Cut cut, Range sides[2])
{
    if (range->count < PARALLEL_ITEMS) {
        cut_piece(items, range->first, range->first + range->count, cut, sides);
    } else {
        sides[0] = sides[1] = range_empty(range->first);
        cut_in_pieces(items, range, cut, sides);
    }
    range_close(&sides[0]);
    range_close(&sides[1]);
    return sides[0].count > 0 && sides[1].count > 0;
}

void range_cut_at(Item *items, const Range *range, u32 left, Range sides[2])
{
    const u32 middle = range->first + left;
    sides[0] = measure(items, range->first, middle);
    sides[1] = measure(items, middle, range->first + range->count);
    range_close(&sides[0]);
    range_close(&sides[1]);
}
