// Hard cases of flat shapes with known answers: rays along faces, needles and degenerate triangles, points
// exactly on planes, checkers far out; and invalid rays at every shape.
#include "shapes_support.h"

#include <math.h>

static const Vec3 no_shift = {0, 0, 0};

static void boxes(void **state)
{
    RayTable table = ray_table_create(64);
    Primitive p[64] = {0};
    Answer a[64];
    const Shape s = {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}};
    static const struct {
        const char *name;
        Vec3 o, d;
        double t;
    } cases[] = {
        {"zero component, inside", {0, 0, 0}, {1, 0, 0}, 1},
        {"negative zero component, inside", {0, 0, 0}, {1, -0.0, -0.0}, 1},
        {"zero component, outside", {-3, 2, 0}, {1, 0, 0}, INFINITY},
        {"negative zero component, outside", {-3, 2, 0}, {1, -0.0, 0}, INFINITY},
        {"within the plane of a face", {-3, 1, 0}, {1, 0, 0}, 2},
        {"within the plane of a face, -0", {-3, -1, 0}, {1, -0.0, -0.0}, 2},
        {"along an edge", {-3, 1, 1}, {1, 0, 0}, 2},
        {"through a corner", {-3, -3, -3}, {1, 1, 1}, 2},
        {"through an edge", {-3, -3, 0}, {1, 1, 0}, 2},
        {"on a face, outward", {1, 0, 0}, {1, 0, 0}, INFINITY},
        {"on a face, inward", {1, 0, 0}, {-1, 0, 0}, 2},
        {"behind", {3, 0, 0}, {1, 0, 0}, INFINITY},
    };
    const size_t count = sizeof cases / sizeof *cases;
    for (size_t i = 0; i < count; ++i) {
        p[i] = bake_at(&s, no_shift);
        a[i] = (Answer){cases[i].name, cases[i].t, 1};
        ray_table_add_next(&table, cases[i].o, cases[i].d);
    }
    expect_answers(*state, PRIMITIVE_BOX, &table, p, a);
    for (size_t i = 0; i < count; ++i) {
        const double n = fabs(hit_number(&table, i, HIT_NG)) + fabs(hit_number(&table, i, HIT_NG + 1)) +
                         fabs(hit_number(&table, i, HIT_NG + 2));
        assert_true(isinf(cases[i].t) || n == 1);
    }
    ray_table_destroy(&table);
}

static Primitive triangle_at(Vec3 a, Vec3 b, Vec3 c)
{
    const Shape s = {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {a, b, c}}};
    Primitive p = {.kind = 0};
    BakedBounds bounds;
    Error error;
    const Affine map = affine_identity();
    if (!bake_shape(&s, &map, &p, &bounds, &error)) { // no normal: leave the vertices alone
        p.row0.w = p.row1.w = 0;
        p.row2.w = 1;
        p.p1 = 0;
    }
    return p;
}

static void triangles(void **state)
{
    RayTable table = ray_table_create(64);
    Primitive p[64] = {0};
    Answer a[64];
    const double s = 2e-4;
    p[0] = triangle_at((Vec3){0, 0, -1}, (Vec3){s, 0, -1}, (Vec3){0, s, -1});
    a[0] = (Answer){"small triangle", 1, 1};
    ray_table_add_next(&table, (Vec3){s / 3, s / 3, 0}, (Vec3){0, 0, -1});
    p[1] = triangle_at((Vec3){-0.5, 0, -1}, (Vec3){0.5, 0, -1}, (Vec3){0.5, 1e-7, -1});
    a[1] = (Answer){"needle 1 : 1e-7", 1, 1};
    ray_table_add_next(&table, (Vec3){0.25, 3e-8, 0}, (Vec3){0, 0, -1});
    p[2] = triangle_at((Vec3){-500, 0, -1}, (Vec3){500, 0, -1}, (Vec3){500, 1e-4, -1});
    a[2] = (Answer){"needle 1e3 : 1e-4", 1, 1};
    ray_table_add_next(&table, (Vec3){250, 3e-5, 0}, (Vec3){0, 0, -1});
    p[3] = triangle_at((Vec3){-1113.45459, -79.049614, -56.2431908},
                       (Vec3){-1113.45459, -87.0922699, -56.2431908},
                       (Vec3){-1113.45459, -79.2090149, -56.2431908});
    a[3] = (Answer){"three points on a line", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){-1081.47925, 99.9999542, 87.7701111},
                       (Vec3){-32.1072998, -183.355865, -144.607635});
    p[4] = triangle_at((Vec3){1, 2, 3}, (Vec3){1, 2, 3}, (Vec3){4, 5, 6});
    a[4] = (Answer){"two equal vertices", INFINITY, 0};
    ray_table_add_next(&table, no_shift, (Vec3){1, 2, 3});
    p[5] = triangle_at((Vec3){1, 2, 3}, (Vec3){1, 2, 3}, (Vec3){1, 2, 3});
    a[5] = (Answer){"three equal vertices", INFINITY, 0};
    ray_table_add_next(&table, no_shift, (Vec3){1, 2, 3});
    // A ground of a million units seen from eye height: the mean of far vertices would be worth nothing.
    p[6] = triangle_at((Vec3){-1e6, -1.7, -1e6}, (Vec3){0, -1.7, 2e6}, (Vec3){1e6, -1.7, -1e6});
    a[6] = (Answer){"giant triangle", (double)1.7f, 1};
    ray_table_add_next(&table, no_shift, (Vec3){0, -1, 0});
    expect_answers(*state, PRIMITIVE_TRIANGLE, &table, p, a);
    ray_table_destroy(&table);
}

static void planes(void **state)
{
    enum { COUNT = 100000 };
    RayTable table = ray_table_create(COUNT);
    const Shape s = {.kind = SHAPE_PLANE, .as.plane = {{0, 0, 0}, {0, 1, 0}}};
    const Primitive p = bake_at(&s, (Vec3){0, -1.7, 0});
    const float height = -1.7f;
    uint64_t random = 3;
    for (int i = 0; i < COUNT; ++i) {
        double d[3];
        random_direction(&random, d);
        const float dir[3] = {(float)d[0], (float)(-fabs(d[1]) - 1e-7), (float)d[2]};
        ray_table_add(&table, 0, (float[3]){0, 0, 0}, dir);
    }
    KernelProgram *program = shapes_program(*state, PRIMITIVE_PLANE, 8);
    shapes_run(program, 8, &table, &p, 1);
    for (size_t i = 0; i < COUNT; ++i) // every hit point lies on the plane exactly
        assert_true(isfinite(hit_number(&table, i, HIT_T)) && hit_number(&table, i, HIT_P + 1) == height);
    ray_table_clear(&table);
    ray_table_add_next(&table, no_shift, (Vec3){1, 0, 0});
    ray_table_add_next(&table, (Vec3){0, height, 0}, (Vec3){1, 0, 0});
    ray_table_add_next(&table, no_shift, (Vec3){1, -1e-7, 0});
    ray_table_add_next(&table, no_shift, (Vec3){1, 1e-7, 0});
    for (size_t i = 0; i < table.count; ++i)
        table.index[i] = 0;
    shapes_run(program, 8, &table, &p, 1);
    assert_true(isinf(hit_number(&table, 0, HIT_T)) && isinf(hit_number(&table, 1, HIT_T)));
    assert_true(fabs((double)hit_number(&table, 2, HIT_T) / 1.7e7 - 1) < 1e-5);
    assert_true(isinf(hit_number(&table, 3, HIT_T)));
    // Coordinates far out: what was written, to far below a cell, seen by a camera that stands there.
    static const double places[] = {1e6, 8388608.5, 16777217, 3e9};
    for (size_t i = 0; i < 4; ++i) {
        const Primitive far = bake_at(&s, (Vec3){-places[i], -1, 0});
        ray_table_clear(&table);
        ray_table_add_next(&table, no_shift, (Vec3){0, -1, 0});
        shapes_run(program, 8, &table, &far, 1);
        const double u = (double)hit_number(&table, 0, HIT_U) + (double)hit_number(&table, 0, HIT_U_WHOLE);
        assert_true(u == places[i]);
        assert_true(floor((double)hit_number(&table, 0, HIT_U_WHOLE)) ==
                    (double)hit_number(&table, 0, HIT_U_WHOLE));
    }
    kernel_program_destroy(program);
    ray_table_destroy(&table);
}

// Rays with NaN or infinity anywhere hit nothing, whatever the shape.
static void invalid_rays(void **state)
{
    enum { KINDS = 10 };
    const Vec3 z = {0, 0, 0}, y = {0, 1, 0};
    const Shape shapes[KINDS] = {
        {.kind = SHAPE_SPHERE, .as.sphere = {z, 1}},
        {.kind = SHAPE_SPHERE, .as.sphere = {{0, -1000, 0}, 1000}},
        {.kind = SHAPE_PLANE, .as.plane = {{0, -1, 0}, y}},
        {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
        {.kind = SHAPE_DISK, .as.disk = {{0, -1, 0}, y, 2}},
        {.kind = SHAPE_CYLINDER, .as.cylinder = {{0, -1, 0}, y, 1, true}},
        {.kind = SHAPE_CONE, .as.cone = {{0, -1, 0}, y, 1, 0, true}},
        {.kind = SHAPE_TORUS, .as.torus = {z, y, 1, 0.4}},
        {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {{-2, -1, -2}, {2, -1, -2}, {0, -1, 3}}}},
    };
    static const float bad[] = {NAN, INFINITY, -INFINITY};
    Primitive p[KINDS];
    RayTable table = ray_table_create(KINDS * 6 * 3 * 8);
    uint64_t random = 9;
    for (int k = 0; k < KINDS; ++k) {
        p[k] = bake_at(&shapes[k], no_shift);
        for (int i = 0; i < 6 * 3 * 8; ++i) {
            double d[3];
            random_direction(&random, d);
            float ray[6] = {0, 0, 0, (float)d[0], (float)d[1], (float)d[2]};
            if (i % 8 == 0)
                ray[3] = ray[5] = 0; // zeros beside infinities
            ray[i / 8 % 6] = bad[i / 48];
            ray_table_add(&table, k, ray, ray + 3);
        }
    }
    KernelProgram *program = shapes_program(*state, -1, 8);
    shapes_run(program, 8, &table, p, KINDS);
    kernel_program_destroy(program);
    for (size_t i = 0; i < table.count; ++i) {
        if (!isinf(hit_number(&table, i, HIT_T)))
            print_message("kind %u: %g\n", p[table.index[i]].kind, hit_number(&table, i, HIT_T));
        assert_true(hit_number(&table, i, HIT_T) == INFINITY);
    }
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(boxes),
        cmocka_unit_test(triangles),
        cmocka_unit_test(planes),
        cmocka_unit_test(invalid_rays),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
