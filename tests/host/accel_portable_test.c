// The builder for hosts without SSE2 makes the same hierarchy, bit by bit, as the one of the library.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

// A second copy of the module, its names beside those of the library.
#define QUAD_PORTABLE
#define bvh_build portable_build
#define bvh_destroy portable_destroy
#define bvh_collapse portable_collapse
#define binary_build portable_binary_build
#define binary_destroy portable_binary_destroy
#define range_create portable_range_create
#define range_cut portable_range_cut
#define range_cut_at portable_range_cut_at
#define split_find portable_split_find
#define area_scale portable_area_scale
#include "accel/binary.c"
#include "accel/bvh.c"
#include "accel/collapse.c"
#include "accel/range.c"
#include "accel/split.c"
#undef bvh_build
#undef bvh_destroy
bool bvh_build(const BvhInput *input, Bvh *bvh, Error *error);
void bvh_destroy(Bvh *bvh);

// Boxes of many sizes; every seventh a neighbour's twin, a few without extent, a few beyond all others.
static Box *boxes_create(u32 count, f32 scale)
{
    Box *boxes = malloc(count * sizeof *boxes);
    assert_non_null(boxes);
    u32 state = 1;
    for (u32 i = 0; i < count; i++) {
        for (int k = 0; k < 3; k++) {
            state = state * 1664525u + 1013904223u;
            boxes[i].min[k] = ((f32)(state >> 8) * 0x1p-23f - 1) * scale;
            const f32 size = (f32)(state >> 4 & 255u) * 0x1p-13f * scale;
            boxes[i].max[k] = boxes[i].min[k] + (i % 100 == 0 ? 0 : i % 1000 == 1 ? 100 * size : size);
        }
        if (i % 7 == 6)
            boxes[i] = boxes[i - 1];
    }
    return boxes;
}

static void assert_same_trees(u32 count, u32 singles, f32 scale)
{
    Box *boxes = boxes_create(count, scale);
    const BvhInput input = { boxes, count, singles, 0, 0, 0 };
    Bvh a, b;
    Error error;
    assert_true(bvh_build(&input, &a, &error));
    assert_true(portable_build(&input, &b, &error));
    assert_int_equal(a.node_count, b.node_count);
    assert_int_equal(a.single_count, b.single_count);
    assert_int_equal(a.block_count, b.block_count);
    assert_memory_equal(a.nodes, b.nodes, a.node_count * sizeof *a.nodes);
    if (a.single_count > 0)
        assert_memory_equal(a.singles, b.singles, a.single_count * sizeof *a.singles);
    if (a.block_count > 0)
        assert_memory_equal(a.blocks, b.blocks, a.block_count * sizeof *a.blocks * BLOCK_WIDTH);
    bvh_destroy(&a);
    portable_destroy(&b);
    free(boxes);
}

static void test_same_bits(void **state)
{
    (void)state;
    static const f32 scales[] = { 1e-38f, 1e-20f, 1, 1e20f, 1e35f };
    for (int i = 0; i < 5; i++) {
        assert_same_trees(5000, 0, scales[i]);
        assert_same_trees(5000, 1000, scales[i]);
        assert_same_trees(5000, 5000, scales[i]);
    }
    assert_same_trees(150000, 100, 1); // large enough for tasks and pieces
}

int main(void)
{
    const struct CMUnitTest tests[] = { cmocka_unit_test(test_same_bits) };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
