// The hierarchy over boxes: whatever the boxes, it is a sound tree that holds each of them once, within the
// bounds that the traversal relies on.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include "accel/bvh.h"

static f64 random_unit(u64 *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (f64)(*state >> 11) * 0x1p-53;
}

static Box random_box(u64 *state, f64 spread, f64 size)
{
    Box box;
    for (int k = 0; k < 3; k++) {
        const f64 at = spread * (2 * random_unit(state) - 1), half = size * random_unit(state);
        box.min[k] = (f32)(at - half);
        box.max[k] = (f32)(at + half);
    }
    return box;
}

static Box *boxes_create(u32 count)
{
    Box *boxes = malloc(count * sizeof *boxes);
    assert_non_null(boxes);
    return boxes;
}

static Box *random_boxes(u32 count, f64 spread, f64 size)
{
    u64 state = 42 + count;
    Box *boxes = boxes_create(count);
    for (u32 i = 0; i < count; i++)
        boxes[i] = random_box(&state, spread, size);
    return boxes;
}

static Bvh build(const Box *boxes, u32 count, u32 first_node, u32 first_primitive)
{
    Bvh bvh = {.nodes = NULL};
    Error error = {0};
    if (!bvh_build(boxes, count, first_node, first_primitive, &bvh, &error))
        fail_msg("%s", error.text);
    assert_int_equal(bvh.count, count);
    return bvh;
}

static Box slot_box(const BvhNode *node, int slot)
{
    return (Box){{node->lower_x[slot], node->lower_y[slot], node->lower_z[slot]},
                 {node->upper_x[slot], node->upper_y[slot], node->upper_z[slot]}};
}

static bool contains(const Box *outer, const Box *inner)
{
    for (int k = 0; k < 3; k++)
        if (!(outer->min[k] <= inner->min[k] && inner->max[k] <= outer->max[k]))
            return false;
    return true;
}

typedef struct Walk {
    const Bvh *bvh;
    const Box *boxes;
    u32 first_node, first_primitive;
    u32 deepest;
    u32 nodes_seen;
    unsigned char *in_leaf; // of each place of the leaves
} Walk;

static void check_leaf(Walk *walk, u32 leaf, const Box *bounds)
{
    const u32 first = (leaf >> 4) - walk->first_primitive, count = leaf & 15u;
    assert_in_range(count, 1, BVH_MAX_LEAF);
    for (u32 place = first; place < first + count; place++) {
        assert_true(place < walk->bvh->count);
        assert_false(walk->in_leaf[place]);
        walk->in_leaf[place] = 1;
        assert_true(contains(bounds, &walk->boxes[walk->bvh->order[place]]));
    }
}

// index: as references in the tree are. outer: the box that the parent gives the node, NULL for the root.
static void check_node(Walk *walk, u32 index, u32 depth, const Box *outer)
{
    assert_in_range(index, walk->first_node, walk->first_node + walk->bvh->node_count - 1);
    const BvhNode *node = &walk->bvh->nodes[index - walk->first_node];
    walk->nodes_seen++;
    walk->deepest = depth > walk->deepest ? depth : walk->deepest;
    bool ended = false;
    u32 used = 0;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        const Box box = slot_box(node, slot);
        if (box.min[0] > box.max[0]) { // an empty slot, which no ray hits; only empty ones follow
            for (int k = 0; k < 3; k++)
                assert_true(box.min[k] == INFINITY && box.max[k] == -INFINITY);
            ended = true;
            continue;
        }
        assert_false(ended);
        used++;
        if (outer)
            assert_true(contains(outer, &box));
        if (node->child[slot] >= 0)
            check_node(walk, (u32)node->child[slot], depth + 1, &box);
        else
            check_leaf(walk, ~(u32)node->child[slot], &box);
    }
    assert_true(used >= 1 && (used >= 2 || walk->bvh->node_count == 1));
}

// Every primitive in exactly one leaf, within all boxes on the way there. Returns the depth.
static u32 check(const Bvh *bvh, const Box *boxes, u32 first_node, u32 first_primitive)
{
    Walk walk = {bvh, boxes, first_node, first_primitive, 0, 0, calloc(bvh->count, 1)};
    unsigned char *ordered = calloc(bvh->count, 1);
    assert_true(walk.in_leaf && ordered);
    check_node(&walk, first_node, 0, NULL);
    assert_int_equal(walk.nodes_seen, bvh->node_count);
    for (u32 i = 0; i < bvh->count; i++) {
        assert_true(walk.in_leaf[i]);
        assert_true(bvh->order[i] < bvh->count);
        assert_false(ordered[bvh->order[i]]);
        ordered[bvh->order[i]] = 1;
    }
    assert_true(walk.deepest <= BVH_MAX_DEPTH);
    free(walk.in_leaf);
    free(ordered);
    return walk.deepest;
}

// Builds, checks and frees; returns the depth.
static u32 build_and_check(const Box *boxes, u32 count)
{
    Bvh bvh = build(boxes, count, 0, 0);
    const u32 depth = check(&bvh, boxes, 0, 0);
    bvh_destroy(&bvh);
    return depth;
}

static void test_few(void **state)
{
    (void)state;
    for (u32 count = 1; count <= 40; count++) {
        Box *boxes = random_boxes(count, 10, 1);
        const u32 depth = build_and_check(boxes, count);
        if (count <= BVH_WIDTH)
            assert_int_equal(depth, 0);
        free(boxes);
    }
    const Box one = {{1, 2, 3}, {4, 5, 6}};
    Bvh bvh = build(&one, 1, 0, 0);
    assert_int_equal(bvh.node_count, 1);
    assert_int_equal(bvh.nodes[0].child[0], ~(0 << 4 | 1));
    const Box stored = slot_box(&bvh.nodes[0], 0);
    assert_memory_equal(&stored, &one, sizeof one);
    bvh_destroy(&bvh);
    bvh_destroy(&bvh);
}

static void test_many(void **state)
{
    (void)state;
    Box *boxes = random_boxes(50000, 100, 0.5);
    // A tree of eights over leaves of up to four: a balanced one is 5 deep.
    assert_true(build_and_check(boxes, 50000) <= 12);
    free(boxes);
}

static void test_bases(void **state)
{
    (void)state;
    Box *boxes = random_boxes(3000, 10, 1);
    Bvh plain = build(boxes, 3000, 0, 0), moved = build(boxes, 3000, 777, 123456);
    check(&moved, boxes, 777, 123456);
    assert_int_equal(plain.node_count, moved.node_count);
    assert_memory_equal(plain.order, moved.order, 3000 * sizeof(u32));
    for (u32 i = 0; i < plain.node_count; i++) {
        assert_memory_equal(plain.nodes[i].lower_x, moved.nodes[i].lower_x, 6 * BVH_WIDTH * sizeof(f32));
        for (int slot = 0; slot < BVH_WIDTH; slot++) {
            const i32 a = plain.nodes[i].child[slot], b = moved.nodes[i].child[slot];
            if (plain.nodes[i].lower_x[slot] > plain.nodes[i].upper_x[slot])
                continue;
            assert_true(a >= 0 ? b == a + 777 : ~(u32)b == ~(u32)a + (123456u << 4));
        }
    }
    bvh_destroy(&plain);
    bvh_destroy(&moved);
    free(boxes);
}

// 100 000 boxes at one place: no split separates them, and the tree is as balanced as can be. A builder that
// split off one at a time would be deep, and would not end within the time that CTest grants.
static void test_identical(void **state)
{
    (void)state;
    enum { COUNT = 100000 };
    Box *boxes = boxes_create(COUNT);
    for (u32 i = 0; i < COUNT; i++)
        boxes[i] = (Box){{1, 2, 3}, {2, 3, 4}};
    assert_true(build_and_check(boxes, COUNT) <= 17);
    for (u32 i = 0; i < COUNT; i++) // one centre, many sizes
        for (int k = 0; k < 3; k++) {
            boxes[i].min[k] = -1 - (f32)(i % 1000);
            boxes[i].max[k] = 1 + (f32)(i % 1000);
        }
    build_and_check(boxes, COUNT);
    for (u32 i = 1; i < COUNT; i++) // all but one at one place
        boxes[i] = boxes[0];
    boxes[0] = (Box){{9, 9, 9}, {10, 10, 10}};
    build_and_check(boxes, COUNT);
    free(boxes);
}

// Boxes whose sizes and distances halve: the surface-area heuristic splits off one at a time.
static void test_chain(void **state)
{
    (void)state;
    enum { COUNT = 120 };
    Box boxes[COUNT];
    for (int i = 0; i < COUNT; i++) {
        const f32 size = ldexpf(1, -i);
        boxes[i] = (Box){{size, size, size}, {1.5f * size, 1.5f * size, 1.5f * size}};
    }
    build_and_check(boxes, COUNT);
    for (int i = 0; i < COUNT; i++) { // nested ones
        const f32 size = ldexpf(1, -i);
        boxes[i] = (Box){{-size, -size, -size}, {size, size, size}};
    }
    build_and_check(boxes, COUNT);
    // Fifty of each size, so that the chain goes on after the depth where ranges are halved.
    Box *many = boxes_create(50 * COUNT);
    for (int i = 0; i < 50 * COUNT; i++)
        many[i] = boxes[i / 50];
    build_and_check(many, 50 * COUNT);
    free(many);
}

static void test_extreme_numbers(void **state)
{
    (void)state;
    static const f64 scales[] = {1e-45, 1e-38, 1e-30, 1e-19, 1e-6, 1e6, 1e18, 1e30, 1e37, 1e38};
    for (size_t s = 0; s < sizeof scales / sizeof *scales; s++) {
        Box *boxes = random_boxes(2000, 2.5 * scales[s], 0.5 * scales[s]);
        build_and_check(boxes, 2000);
        free(boxes);
    }
    enum { COUNT = 500 };
    Box boxes[COUNT];
    u64 seed = 7;
    // As wide as float goes, and flat in one or two directions or in none.
    for (u32 flat = 0; flat < 8; flat++) {
        for (int i = 0; i < COUNT; i++) {
            boxes[i] = random_box(&seed, 1, 0.1);
            for (int k = 0; k < 3; k++) {
                boxes[i].min[k] = flat >> k & 1 ? 0 : i % 2 ? -FLT_MAX : boxes[i].min[k];
                boxes[i].max[k] = flat >> k & 1 ? 0 : i % 3 ? FLT_MAX : boxes[i].max[k];
            }
        }
        build_and_check(boxes, COUNT);
    }
    // One box beyond all others, the rest without a difference that its float can tell.
    for (int i = 0; i < COUNT; i++)
        boxes[i] = random_box(&seed, 1, 0.1);
    boxes[COUNT / 2] = (Box){{FLT_MAX, FLT_MAX, FLT_MAX}, {FLT_MAX, FLT_MAX, FLT_MAX}};
    build_and_check(boxes, COUNT);
}

static void test_no_extent(void **state)
{
    (void)state;
    enum { COUNT = 4096 };
    Box *boxes = boxes_create(COUNT);
    u64 seed = 3;
    for (u32 flat = 1; flat < 8; flat++) { // each set of axes without extent
        for (int i = 0; i < COUNT; i++) {
            boxes[i] = random_box(&seed, 10, 1);
            for (int k = 0; k < 3; k++)
                if (flat >> k & 1)
                    boxes[i].max[k] = boxes[i].min[k];
        }
        // Points have no area, but still their order along an axis.
        assert_true(build_and_check(boxes, COUNT) <= 24);
    }
    for (int i = 0; i < COUNT; i++) // squares of one plane
        boxes[i] = (Box){{(f32)(i % 64), 0, (f32)(i / 64)}, {(f32)(i % 64 + 1), 0, (f32)(i / 64 + 1)}};
    assert_true(build_and_check(boxes, COUNT) <= 12);
    free(boxes);
}

static void test_threads(void **state)
{
    (void)state;
#ifdef _OPENMP
    enum { COUNT = 60000 };
    Box *boxes = random_boxes(COUNT, 100, 1);
    const int before = omp_get_max_threads();
    omp_set_num_threads(1);
    Bvh one = build(boxes, COUNT, 5, 6);
    for (int threads = 2; threads <= 5; threads++) {
        omp_set_num_threads(threads);
        Bvh more = build(boxes, COUNT, 5, 6);
        assert_int_equal(more.node_count, one.node_count);
        assert_memory_equal(more.nodes, one.nodes, one.node_count * sizeof *one.nodes);
        assert_memory_equal(more.order, one.order, COUNT * sizeof *one.order);
        bvh_destroy(&more);
    }
    omp_set_num_threads(before);
    bvh_destroy(&one);
    free(boxes);
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few),       cmocka_unit_test(test_many),
        cmocka_unit_test(test_bases),     cmocka_unit_test(test_identical),
        cmocka_unit_test(test_chain),     cmocka_unit_test(test_extreme_numbers),
        cmocka_unit_test(test_no_extent), cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
