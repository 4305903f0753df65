// The hierarchy over boxes that no plane separates, or whose numbers are as large or small as they come.
#include <float.h>

#include "accel_fixture.h"

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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_identical),
        cmocka_unit_test(test_chain),
        cmocka_unit_test(test_extreme_numbers),
        cmocka_unit_test(test_no_extent),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
