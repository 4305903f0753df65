// The hierarchy over boxes: whatever the boxes, it is a sound tree that holds each of them once, within the
// bounds that the traversal relies on.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <float.h>
#include <math.h>
#ifdef _OPENMP
#include <omp.h>
#endif
#ifdef __linux__
#include <sys/resource.h>
#include <unistd.h>
#endif

#include "accel/bvh.h"
#include "shared/mesh.h"

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

static Bvh build(const BvhInput *input)
{
    Bvh bvh = {.nodes = NULL};
    Error error = {0};
    if (!bvh_build(input, &bvh, &error))
        fail_msg("%s", error.text);
    assert_int_equal(bvh.single_count, input->singles);
    return bvh;
}

#if defined __linux__
// Bytes of address space that the process has now.
static rlim_t address_space(void)
{
    FILE *file = fopen("/proc/self/statm", "r");
    assert_non_null(file);
    unsigned long pages;
    assert_int_equal(fscanf(file, "%lu", &pages), 1);
    fclose(file);
    return (rlim_t)pages * (rlim_t)sysconf(_SC_PAGESIZE);
}
#endif

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
    const BvhInput *input;
    u32 deepest;
    u32 nodes_seen, singles_seen, blocks_seen;
    unsigned char *seen; // of each box of the input: whether it is in a leaf
} Walk;

static void check_box(Walk *walk, u32 index, const Box *bounds)
{
    assert_true(index < walk->input->count);
    assert_false(walk->seen[index]);
    walk->seen[index] = 1;
    assert_true(contains(bounds, &walk->input->boxes[index]));
}

// The leaves are numbered in the order in which a walk meets them.
static void check_leaf(Walk *walk, u32 leaf, const Box *bounds)
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
static void check_node(Walk *walk, u32 index, u32 depth, const Box *outer)
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
static u32 check(const Bvh *bvh, const BvhInput *input)
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

static void assert_same(const Bvh *a, const Bvh *b)
{
    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->single_count, b->single_count);
    assert_int_equal(a->block_count, b->block_count);
    assert_memory_equal(a->nodes, b->nodes, a->node_count * sizeof *a->nodes);
    assert_memory_equal(a->singles, b->singles, a->single_count * sizeof *a->singles);
    assert_memory_equal(a->blocks, b->blocks, a->block_count * sizeof *a->blocks * BLOCK_WIDTH);
}

// Builds with none, a few, half and all as singles, checks and frees; returns the greatest depth.
static u32 build_and_check(const Box *boxes, u32 count)
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
}

static void test_one(void **state)
{
    (void)state;
    const Box one = {{1, 2, 3}, {4, 5, 6}};
    for (u32 singles = 0; singles <= 1; singles++) {
        const BvhInput input = {&one, 1, singles, 10, 20, 30};
        Bvh bvh = build(&input);
        assert_int_equal(bvh.node_count, 1);
        assert_int_equal(bvh.block_count, 1 - singles);
        assert_int_equal(bvh.nodes[0].child[0], singles ? ~(20 << 1) : ~(30 << 1 | 1));
        const Box stored = slot_box(&bvh.nodes[0], 0);
        assert_memory_equal(&stored, &one, sizeof one);
        bvh_destroy(&bvh);
        bvh_destroy(&bvh);
    }
    // Up to eight triangles are one block.
    Box *boxes = random_boxes(BLOCK_WIDTH, 10, 1);
    const BvhInput input = {.boxes = boxes, .count = BLOCK_WIDTH};
    Bvh bvh = build(&input);
    assert_int_equal(bvh.node_count, 1);
    assert_int_equal(bvh.block_count, 1);
    bvh_destroy(&bvh);
    free(boxes);
}

static void test_many(void **state)
{
    (void)state;
    enum { COUNT = 50000 };
    Box *boxes = random_boxes(COUNT, 100, 0.5);
    assert_true(build_and_check(boxes, COUNT) <= 12);
    const BvhInput input = {.boxes = boxes, .count = COUNT};
    Bvh bvh = build(&input);
    // Memory is part of the bargain: of a block of eight, more than five triangles on average.
    assert_true(BLOCK_WIDTH * bvh.block_count < COUNT * BLOCK_WIDTH / 5);
    bvh_destroy(&bvh);
    free(boxes);
}

static void test_bases(void **state)
{
    (void)state;
    enum { COUNT = 3000, SINGLES = 500 };
    Box *boxes = random_boxes(COUNT, 10, 1);
    const BvhInput at_zero = {boxes, COUNT, SINGLES, 0, 0, 0}, at_bases = {boxes, COUNT, SINGLES, 777, 123, 4567};
    Bvh plain = build(&at_zero), moved = build(&at_bases);
    check(&plain, &at_zero);
    check(&moved, &at_bases);
    for (u32 i = 0; i < plain.node_count; i++)
        memcpy(moved.nodes[i].child, plain.nodes[i].child, sizeof plain.nodes[i].child);
    assert_same(&plain, &moved);
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
    enum { COUNT = 300000 };
    Box *boxes = random_boxes(COUNT, 100, 1);
    const int before = omp_get_max_threads();
    for (u32 singles = 0; singles < COUNT; singles += COUNT / 3) {
        const BvhInput input = {boxes, COUNT, singles, 5, 6, 7};
        omp_set_num_threads(1);
        Bvh one = build(&input);
        check(&one, &input);
        static const int threads[] = {2, 7};
        for (int i = 0; i < 2; i++) {
            omp_set_num_threads(threads[i]);
            Bvh more = build(&input);
            assert_same(&one, &more);
            bvh_destroy(&more);
        }
        bvh_destroy(&one);
    }
    omp_set_num_threads(before);
    free(boxes);
#else
    skip();
#endif
}

// Where the address space ends at some point of the build, it says so and leaves nothing behind.
static void test_no_memory(void **state)
{
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__ || !defined __linux__
    skip(); // their shadows need more than any limit
#else
    enum { COUNT = 1500000, STEP = 8 << 20 };
    Box *boxes = random_boxes(COUNT, 100, 1);
    const BvhInput input = {.boxes = boxes, .count = COUNT, .singles = COUNT / 4};
    struct rlimit before;
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
#ifdef _OPENMP
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1); // its runtime ends the program where it has no memory for its own
#endif
    bool built = false;
    u32 failures = 0;
    for (rlim_t limit = address_space(); !built; limit += STEP) {
        const struct rlimit small = {limit, before.rlim_max};
        Bvh bvh = {.node_count = 123};
        Error error = {0};
        assert_int_equal(setrlimit(RLIMIT_AS, &small), 0);
        built = bvh_build(&input, &bvh, &error);
        setrlimit(RLIMIT_AS, &before);
        if (built) {
            check(&bvh, &input);
            bvh_destroy(&bvh);
        } else {
            failures++;
            assert_int_equal(error.code, ERROR_MEMORY);
            assert_int_equal(bvh.node_count, 123);
            assert_null(bvh.nodes);
        }
    }
    assert_true(failures > 0);
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
    free(boxes);
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few),       cmocka_unit_test(test_one),
        cmocka_unit_test(test_many),      cmocka_unit_test(test_bases),     cmocka_unit_test(test_identical),
        cmocka_unit_test(test_chain),     cmocka_unit_test(test_extreme_numbers),
        cmocka_unit_test(test_no_extent), cmocka_unit_test(test_threads),
        cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
