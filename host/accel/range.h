// Items: what is built over, sorted in place into ranges while the hierarchy is built.
#ifndef CLRT_ACCEL_RANGE_H
#define CLRT_ACCEL_RANGE_H

#include "accel/bvh.h"
#include "accel/quad.h"

// The box travels with its index, so that every pass reads memory in order.
typedef struct Item {
    f32 min[3];
    u32 index; // in the input
    f32 max[3];
    u32 weight; // eighths of a leaf that it fills: 8 for a single, 1 for a triangle
} Item;

enum {
    LEAF_WEIGHT = 8,        // a range up to this weight is a leaf: a single, or up to a block of triangles
    PARALLEL_ITEMS = 65536, // from here on, passes over a range are cut into pieces, tasks of their own
    PIECES = 16             // a constant: the order of the items must not depend on the threads
};

// Box and twice the centres of what was measured. Fourth lanes mean nothing.
typedef struct Bounds {
    Quad low, high;               // low is +infinity, high -infinity where nothing was
    Quad centre_low, centre_high; // within float's finite range
} Bounds;

typedef struct Range {
    Bounds bounds;
    u64 weight;
    u32 first, count;
} Range;

// Which of two sides an item belongs to.
typedef struct Cut {
    int axis;     // 0..2; -1: singles go left, triangles right
    f32 low;      // an item goes left where (twice its centre - low) * scale < place
    f32 scale;
    f32 place;
} Cut;

// Of a piece of a range: its first item; that of piece PIECES is the end of the range.
static inline u32 range_piece(u32 first, u32 count, u32 piece)
{
    return first + (u32)((u64)count * piece / PIECES);
}

// Copies the boxes of the input to items, in parallel, and measures them.
Range range_create(const BvhInput *input, Item *items);

// Reorders the items so that those of the left side come first; sets both sides and measures them. In
// parallel where the range is large; to be called in a task. False, with the order changed, where a side
// would be empty.
bool range_cut(Item *items, const Range *range, Cut cut, Range sides[2]);

// Cuts between two items, whatever they are: left (1 .. count - 1) go left.
void range_cut_at(Item *items, const Range *range, u32 left, Range sides[2]);

#endif
