// The same bits for every width of lanes: shapes of every kind side by side in one vector, and ray by ray.
#include "reference/placed.h"
#include "shapes_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHAPES = 16, RAYS = 32768, LONG_RAYS = 409600 };

// Whether a column of the hits means something where the ray hit.
static bool defined(const Family *family, int column)
{
    return column < HIT_B1 || family->kind == SHAPE_TRIANGLE;
}

static void same_bits(void **state)
{
    static Placed placed[FAMILY_COUNT * SHAPES];
    static Primitive primitives[FAMILY_COUNT * SHAPES];
    uint64_t random = 5;
    Error error;
    for (int i = 0; i < FAMILY_COUNT * SHAPES; ++i)
        assert_true(random_placed(&shape_families[i / SHAPES], PLACING_ANY, &placed[i], &primitives[i], &random,
                                  &error));
    RayTable table = ray_table_create(shapes_long_run() ? LONG_RAYS : RAYS);
    for (size_t i = 0; i < table.capacity; ++i) {
        // Runs of 64 rays at one shape, then 64 at shapes of all kinds.
        const size_t shape = (i & 64 ? i : i / 128) % (FAMILY_COUNT * SHAPES);
        const size_t mixed = i & 64 ? shape % FAMILY_COUNT * SHAPES + shape / FAMILY_COUNT : shape;
        ray_table_add_random(&table, (int)mixed, &placed[mixed], &random);
    }
    const size_t numbers = HIT_COLUMNS * table.capacity;
    float *wide = malloc(sizeof(float) * numbers);
    assert_non_null(wide);
    for (int lanes = 8; lanes >= 1; lanes /= 8) {
        KernelProgram *program = shapes_program(*state, -1, lanes);
        shapes_run(program, lanes, &table, primitives, FAMILY_COUNT * SHAPES);
        kernel_program_destroy(program);
        if (lanes == 8)
            memcpy(wide, table.hits, sizeof(float) * numbers);
    }
    size_t hits[FAMILY_COUNT] = {0};
    for (size_t i = 0; i < table.capacity; ++i) {
        const int family = table.index[i] / SHAPES;
        const bool hit = !isinf(table.hits[i]);
        hits[family] += hit;
        for (int k = 0; k < (hit ? HIT_COLUMNS : 1); ++k) {
            const size_t at = (size_t)k * table.capacity + i;
            if (defined(&shape_families[family], k))
                assert_memory_equal(&wide[at], &table.hits[at], sizeof(float));
        }
    }
    for (int k = 0; k < FAMILY_COUNT; ++k)
        assert_true(hits[k] > table.capacity / FAMILY_COUNT / 16);
    free(wide);
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(same_bits)};
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
