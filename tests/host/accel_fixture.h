// Random boxes, and what is true of every hierarchy over boxes.
#ifndef CLRT_TESTS_ACCEL_FIXTURE_H
#define CLRT_TESTS_ACCEL_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <math.h>

#include "accel/bvh.h"
#include "shared/mesh.h"

static inline f64 random_unit(u64 *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (f64)(*state >> 11) * 0x1p-53;
}

static inline Box random_box(u64 *state, f64 spread, f64 size)
{
    Box box;
    for (int k = 0; k < 3; k++) {
        const f64 at = spread * (2 * random_unit(state) - 1), half = size * random_unit(state);
        box.min[k] = (f32)(at - half);
        box.max[k] = (f32)(at + half);
    }
    return box;
}

static inline Box *boxes_create(u32 count)
{
    Box *boxes = malloc(count * sizeof *boxes);
    assert_non_null(boxes);
    return boxes;
}

static inline Box *random_boxes(u32 count, f64 spread, f64 size)
{
    u64 state = 42 + count;
    Box *boxes = boxes_create(count);
    for (u32 i = 0; i < count; i++)
        boxes[i] = random_box(&state, spread, size);
    return boxes;
}

static inline Bvh build(const BvhInput *input)
{
    Bvh bvh = {.nodes = NULL};
    Error error = {0};
    if (!bvh_build(input, &bvh, &error))
        fail_msg("%s", error.text);
    assert_int_equal(bvh.single_count, input->singles);
    return bvh;
}

static inline Box slot_box(const BvhNode *node, int slot)
{
    return (Box){{node->lower_x[slot], node->lower_y[slot], node->lower_z[slot]},
                 {node->upper_x[slot], node->upper_y[slot], node->upper_z[slot]}};
}

static inline bool contains(const Box *outer, const Box *inner)
{
    for (int k = 0; k < 3; k++)
        if (!(outer->min[k] <= inner->min[k] && inner->max[k] <= outer->max[k]))
            return false;
    return true;
}

typedef struct Walk {
    const Bvh *bvh;
    const BvhInput *input;
    u32 deepest;
    u32 nodes_seen, singles_seen, blocks_seen;
    unsigned char *seen; // of each box of the input: whether it is in a leaf
} Walk;

static inline void check_box(Walk *walk, u32 index, const Box *bounds)
{
    assert_true(index < walk->input->count);
    assert_false(walk->seen[index]);
    walk->seen[index] = 1;
    assert_true(contains(bounds, &walk->input->boxes[index]));
}

// The leaves are numbered in the order in which a walk meets them.
static inline void check_leaf(Walk *walk, u32 leaf, const Box *bounds)
{
    if (leaf & 1) {
        const u32 block = (leaf >> 1) - walk->input->first_block;
        assert_int_equal(block, walk->blocks_seen++);
        const u32 *ids = walk->bvh->blocks + (size_t)BLOCK_WIDTH * block;
        u32 used = 0;
        for (; used < BLOCK_WIDTH && ids[used] != UINT32_MAX; used++) {
            assert_true(ids[used] >= walk->input->singles);
            check_box(walk, ids[used], bounds);
        }
        assert_in_range(used, 1, BLOCK_WIDTH);
        for (u32 i = used; i < BLOCK_WIDTH; i++)
            assert_int_equal(ids[i], UINT32_MAX);
    } else {
        const u32 single = (leaf >> 1) - walk->input->first_single;
        assert_int_equal(single, walk->singles_seen++);
        assert_true(walk->bvh->singles[single] < walk->input->singles);
        check_box(walk, walk->bvh->singles[single], bounds);
    }
}

// index: as references in the tree are. outer: the box that the parent gives the node, NULL for the root.
static inline void check_node(Walk *walk, u32 index, u32 depth, const Box *outer)
{
    assert_int_equal(index, walk->input->first_node + walk->nodes_seen++); // depth first
    assert_true(walk->nodes_seen <= walk->bvh->node_count);
    const BvhNode *node = &walk->bvh->nodes[index - walk->input->first_node];
    walk->deepest = depth > walk->deepest ? depth : walk->deepest;
    int used = 0;
    for (; used < BVH_WIDTH && node->lower_x[used] <= node->upper_x[used]; used++) {
        const Box box = slot_box(node, used);
        if (outer)
            assert_true(contains(outer, &box));
        if (node->child[used] >= 0)
            check_node(walk, (u32)node->child[used], depth + 1, &box);
        else
            check_leaf(walk, ~(u32)node->child[used], &box);
    }
    assert_true(used >= 1 && (used >= 2 || walk->bvh->node_count == 1));
    for (int slot = used; slot < BVH_WIDTH; slot++) { // empty ones, which no ray hits
        const Box box = slot_box(node, slot);
        for (int k = 0; k < 3; k++)
            assert_true(box.min[k] == INFINITY && box.max[k] == -INFINITY);
        assert_true(node->child[slot] < 0);
    }
    for (int slot = 0; slot < BVH_WIDTH; slot++)
        assert_int_equal(node->padding[slot], 0);
}

// Everything in exactly one leaf, within all boxes on the way there. Returns the depth.
static inline u32 check(const Bvh *bvh, const BvhInput *input)
{
    Walk walk = {.bvh = bvh, .input = input, .seen = calloc(input->count, 1)};
    assert_non_null(walk.seen);
    check_node(&walk, input->first_node, 0, NULL);
    assert_int_equal(walk.nodes_seen, bvh->node_count);
    assert_int_equal(walk.singles_seen, bvh->single_count);
    assert_int_equal(walk.blocks_seen, bvh->block_count);
    for (u32 i = 0; i < input->count; i++)
        assert_true(walk.seen[i]);
    assert_true(walk.deepest <= BVH_MAX_DEPTH);
    free(walk.seen);
    return walk.deepest;
}

static inline void assert_same(const Bvh *a, const Bvh *b)
{
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->single_count, b->single_count);
    assert_int_equal(a->block_count, b->block_count);
    assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
    assert_memory_equal(a->singles, b->singles, a->single_count * sizeof *a->singles);
    assert_memory_equal(a->blocks, b->blocks, a->block_count * sizeof *a->blocks * BLOCK_WIDTH);
}

// Builds with none, a few, half and all as singles, checks and frees; returns the greatest depth.
static inline u32 build_and_check(const Box *boxes, u32 count)
{
    const u32 singles[] = {0, count / 50 + 1, count / 2, count};
    u32 deepest = 0;
    for (int i = 0; i < 4; i++) {
        const BvhInput input = {.boxes = boxes, .count = count, .singles = singles[i]};
        Bvh bvh = build(&input);
        const u32 depth = check(&bvh, &input);
        deepest = depth > deepest ? depth : deepest;
        bvh_destroy(&bvh);
    }
    return deepest;
}

#endif
