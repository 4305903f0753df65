#include "accel/bvh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/collapse.h"

enum {
    BINS = 16,
    SAH_DEPTH = 20,        // below it ranges are halved by count, which bounds the depth
    TASK_PRIMITIVES = 4096 // smaller ranges are not worth a task
};

// A primitive while it is sorted: its box travels with it, so that every pass reads memory in order.
typedef struct Item {
    Box box;
    u32 index; // in the input
} Item;

typedef struct Build {
    Item *items;
    BinaryNode *nodes;
} Build;

typedef struct Bin {
    Box box;
    u32 count;
} Bin;

typedef struct Split {
    int axis; // -1: none found
    int bin;  // first bin of the right side
    f32 cost; // sum of area times count of the two sides
} Split;

static Box box_empty(void)
{
    return (Box){ { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
}

static void box_grow(Box *box, const Box *other)
{
    for (int axis = 0; axis < 3; axis++) {
        box->min[axis] = other->min[axis] < box->min[axis] ? other->min[axis] : box->min[axis];
        box->max[axis] = other->max[axis] > box->max[axis] ? other->max[axis] : box->max[axis];
    }
}

f32 box_half_area(const Box *box)
{
    const f32 x = box->max[0] - box->min[0], y = box->max[1] - box->min[1], z = box->max[2] - box->min[2];
    return x < 0 ? 0 : x * y + y * z + z * x;
}

// Twice the centre, halved first so that the sum cannot overflow.
static f32 centroid(const Box *box, int axis)
{
    return 0.5f * box->min[axis] + 0.5f * box->max[axis];
}

static int bin_of(const Box *box, int axis, f32 low, f32 scale)
{
    const int bin = (int)((centroid(box, axis) - low) * scale);
    return bin < 0 ? 0 : bin >= BINS ? BINS - 1 : bin;
}

// Bins per unit length, 0 where the centroids coincide or their distance is out of float's range.
static f32 bin_scale(f32 low, f32 high)
{
    const f32 scale = (f32)BINS * 0.9999f / (high - low);
    return isfinite(scale) && high - low <= FLT_MAX ? scale : 0;
}

// Bins of the three axes in one pass over the range.
static void fill_bins(const Build *build, u32 first, u32 count, const f32 low[3], const f32 scale[3],
                      Bin bins[3][BINS])
{
    for (int axis = 0; axis < 3; axis++)
        for (int i = 0; i < BINS; i++)
            bins[axis][i] = (Bin){ box_empty(), 0 };
    for (u32 i = first; i < first + count; i++) {
        const Box *box = &build->items[i].box;
        for (int axis = 0; axis < 3; axis++) {
            Bin *bin = &bins[axis][bin_of(box, axis, low[axis], scale[axis])];
            box_grow(&bin->box, box);
            bin->count++;
        }
    }
}

static void try_axis(const Bin bins[BINS], u32 count, int axis, Split *best)
{
    f32 right_cost[BINS];
    Box side = box_empty();
    u32 side_count = 0;
    for (int i = BINS - 1; i > 0; i--) {
        box_grow(&side, &bins[i].box);
        side_count += bins[i].count;
        right_cost[i] = box_half_area(&side) * (f32)side_count;
    }
    side = box_empty();
    side_count = 0;
    for (int i = 1; i < BINS; i++) {
        box_grow(&side, &bins[i - 1].box);
        side_count += bins[i - 1].count;
        const f32 cost = box_half_area(&side) * (f32)side_count + right_cost[i];
        if (side_count > 0 && side_count < count && cost < best->cost)
            *best = (Split){ axis, i, cost };
    }
}

// Reorders the range so that the left side comes first; returns its size.
static u32 partition(Build *build, u32 first, u32 count, Split split, f32 low, f32 scale)
{
    u32 i = first, j = first + count;
    while (i < j) {
        if (bin_of(&build->items[i].box, split.axis, low, scale) < split.bin) {
            i++;
        } else {
            const Item moved = build->items[i];
            build->items[i] = build->items[--j];
            build->items[j] = moved;
        }
    }
    return i - first;
}

// The number of primitives of the left child, or 0 where the range becomes a leaf.
static u32 split_range(Build *build, u32 first, u32 count, u32 depth, const Box *bounds, const Box *centroids)
{
    if (count <= 1)
        return 0;
    Split best = { -1, 0, INFINITY };
    f32 low[3], scale[3];
    if (depth < SAH_DEPTH) {
        Bin bins[3][BINS];
        for (int axis = 0; axis < 3; axis++) {
            low[axis] = centroids->min[axis];
            scale[axis] = bin_scale(centroids->min[axis], centroids->max[axis]);
        }
        fill_bins(build, first, count, low, scale, bins);
        for (int axis = 0; axis < 3; axis++)
            if (scale[axis] > 0)
                try_axis(bins[axis], count, axis, &best);
    }
    // One step down costs as much as one primitive.
    const f32 area = box_half_area(bounds);
    if (count <= BVH_MAX_LEAF && !(best.cost + area < area * (f32)count))
        return 0;
    return best.axis < 0 ? count / 2
                         : partition(build, first, count, best, low[best.axis], scale[best.axis]);
}

// Node of the range at nodes[node]; its subtree takes the 2 count - 1 places from there, whoever builds it.
static void build_range(Build *build, u32 node, u32 first, u32 count, u32 depth)
{
    Box bounds = box_empty(), centroids = box_empty();
    for (u32 i = first; i < first + count; i++) {
        const Box *box = &build->items[i].box;
        box_grow(&bounds, box);
        for (int axis = 0; axis < 3; axis++) {
            const f32 c = centroid(box, axis);
            centroids.min[axis] = c < centroids.min[axis] ? c : centroids.min[axis];
            centroids.max[axis] = c > centroids.max[axis] ? c : centroids.max[axis];
        }
    }
    const u32 left = split_range(build, first, count, depth, &bounds, &centroids);
    build->nodes[node] = (BinaryNode){ bounds, first, left ? 0 : count, node + 2 * left };
    if (left == 0)
        return;
#pragma omp task default(none) firstprivate(build, node, first, left, depth) if (left >= TASK_PRIMITIVES)
    build_range(build, node + 1, first, left, depth + 1);
    build_range(build, node + 2 * left, first + left, count - left, depth + 1);
}

bool bvh_build(const Box *boxes, u32 count, u32 first_node, u32 first_primitive, Bvh *bvh, Error *error)
{
    Build build = { malloc(sizeof(Item) * (size_t)count),
                    malloc(sizeof(BinaryNode) * (2 * (size_t)count - 1)) };
    Bvh result = { .order = malloc(sizeof(u32) * (size_t)count), .count = count };
    if (!build.items || !build.nodes || !result.order) {
        free(build.items);
        free(build.nodes);
        free(result.order);
        return error_set(error, ERROR_MEMORY, "no memory for the hierarchy of %u primitives", count);
    }
    for (u32 i = 0; i < count; i++)
        build.items[i] = (Item){ boxes[i], i };
#pragma omp parallel default(none) shared(build, count) if (count >= TASK_PRIMITIVES)
#pragma omp single
    build_range(&build, 0, 0, count, 0);
    for (u32 i = 0; i < count; i++)
        result.order[i] = build.items[i].index;
    free(build.items);
    const bool ok = bvh_collapse(build.nodes, first_node, first_primitive, &result, error);
    free(build.nodes);
    if (ok)
        *bvh = result;
    else
        bvh_destroy(&result);
    return ok;
}

void bvh_destroy(Bvh *bvh)
{
    free(bvh->nodes);
    free(bvh->order);
    memset(bvh, 0, sizeof *bvh);
}
