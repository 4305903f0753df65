// The hierarchy over boxes: whatever the boxes, it is a sound tree that holds each of them once, within the
// bounds that the traversal relies on, the same for any number of threads.
#ifdef _OPENMP
#include <omp.h>
#endif
#include <stdio.h>

// Sanitizers need more address space than any limit leaves.
#if defined __linux__ && !defined __SANITIZE_ADDRESS__ && !defined __SANITIZE_THREAD__
#define CAN_LIMIT_MEMORY 1
#include <sys/resource.h>
#include <unistd.h>
#else
#define CAN_LIMIT_MEMORY 0
#endif

#include "accel_fixture.h"

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
    const BvhInput at_zero = {boxes, COUNT, SINGLES, 0, 0, 0};
    const BvhInput at_bases = {boxes, COUNT, SINGLES, 777, 123, 4567};
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

#if CAN_LIMIT_MEMORY
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

// Where the address space ends at some point of the build, it says so and leaves nothing behind.
static void test_no_memory(void **state)
{
    (void)state;
#if CAN_LIMIT_MEMORY
    enum { COUNT = 200000, STEP = 1 << 20 };
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
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few),   cmocka_unit_test(test_one),     cmocka_unit_test(test_many),
        cmocka_unit_test(test_bases), cmocka_unit_test(test_threads), cmocka_unit_test(test_no_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
