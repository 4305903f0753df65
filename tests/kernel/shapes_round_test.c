// Hard cases of curved shapes with known answers: distant, giant, tiny and grazed spheres; tori by double
// roots; cylinders and cones along axes and generators.
#include "reference/shapes.h"
#include "shapes_support.h"

#include <math.h>

static const Vec3 no_shift = {0, 0, 0};

static Shape sphere_shape(Vec3 center, double radius)
{
    return (Shape){.kind = SHAPE_SPHERE, .as.sphere = {center, radius}};
}

// A primitive of kind SPHERE, also where baking would make it a giant.
static Primitive plain_sphere(Vec3 center, double radius)
{
    return (Primitive){.row0 = {1, 0, 0, (f32)center.x},
                       .row1 = {0, 1, 0, (f32)center.y},
                       .row2 = {0, 0, 1, (f32)center.z},
                       .p0 = (f32)radius,
                       .kind = PRIMITIVE_SPHERE};
}

static void spheres(void **state)
{
    RayTable table = ray_table_create(32);
    Primitive p[32] = {0};
    Answer a[32];
    size_t n = 0;
    static const double far[] = {100, 2000, 4100, 8000, 1e5, 1e6, 1e7};
    for (size_t i = 0; i < sizeof far / sizeof *far; ++i, ++n) {
        p[n] = plain_sphere((Vec3){0, 0, far[i]}, 1);
        a[n] = (Answer){"far unit sphere", far[i] - sqrt(0.75), 2};
        ray_table_add_next(&table, (Vec3){0.5, 0, 0}, (Vec3){0, 0, 1});
    }
    static const double giant[3][2] = {{1e5, 1.41422065791}, {1e6, 1.41421429448}, {6.4e6, 1.41421369743}};
    for (size_t i = 0; i < 3; ++i, ++n) {
        p[n] = plain_sphere((Vec3){0, -giant[i][0], 0}, giant[i][0]);
        const float d = 0.70710677f;
        Shape s = sphere_shape((Vec3){0, -giant[i][0], 0}, giant[i][0]);
        a[n] =
            (Answer){"giant floor", (double)reference_hit(&s, real3(0, 1, 0), real3(d, -d, 0), 0, 0, 0), 4};
        assert_true(fabs(a[n].exact - giant[i][1]) < 1e-6);
        ray_table_add_next(&table, (Vec3){0, 1, 0}, (Vec3){d, -d, 0});
    }
    p[n] = plain_sphere((Vec3){0, -6.4e6, 0}, 6.4e6);
    const Vec3 grazing = {0.99995f, -0.0099998f, 0};
    Shape s = sphere_shape((Vec3){0, -6.4e6, 0}, 6.4e6);
    a[n++] = (Answer){"giant floor, grazing",
                      (double)reference_hit(&s, real3(0, 1, 0), real3(grazing.x, grazing.y, 0), 0, 0, 0), 8};
    ray_table_add_next(&table, (Vec3){0, 1, 0}, grazing);
    static const double tiny[3][2] = {{1e-6, 1}, {1e-4, 1}, {1e-4, 10}};
    for (size_t i = 0; i < 3; ++i, ++n) {
        p[n] = plain_sphere((Vec3){0, 0, tiny[i][1]}, tiny[i][0]);
        a[n] = (Answer){"tiny sphere", tiny[i][1] - (double)(float)tiny[i][0], 1};
        ray_table_add_next(&table, no_shift, (Vec3){0, 0, 1});
    }
    const float below = nextafterf(1, 0), above = nextafterf(1, 2);
    p[n] = p[n + 1] = plain_sphere(no_shift, 1);
    a[n++] = (Answer){"tangent, an ulp inside", 5 - sqrt(1 - (double)below * (double)below), 2};
    ray_table_add_next(&table, (Vec3){below, 0, -5}, (Vec3){0, 0, 1});
    a[n++] = (Answer){"tangent, an ulp outside", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){above, 0, -5}, (Vec3){0, 0, 1});
    for (int k = 0; k < 3; ++k)
        p[n + (size_t)k] = plain_sphere(no_shift, 1);
    a[n++] = (Answer){"on the surface, outward", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){0, 1, 0}, (Vec3){0, 1, 0});
    a[n++] = (Answer){"an ulp inside, outward", 0x1p-23, 4};
    ray_table_add_next(&table, (Vec3){0, 1 - 0x1p-23, 0}, (Vec3){0, 1, 0});
    a[n++] = (Answer){"from the centre", 1, 0};
    ray_table_add_next(&table, no_shift, (Vec3){0, 1, 0});
    static const double lengths[] = {1e-6, 1e-3, 1e3, 1e6};
    for (size_t i = 0; i < 4; ++i, ++n) {
        p[n] = plain_sphere(no_shift, 1);
        a[n] = (Answer){"direction not of unit length", 4 / (double)(float)lengths[i], 2};
        ray_table_add_next(&table, (Vec3){0, 0, -5}, (Vec3){0, 0, lengths[i]});
    }
    p[n] = plain_sphere(no_shift, 1);
    a[n++] = (Answer){"direction of length 1e-25", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){0, 0, -5}, (Vec3){0, 0, 1e-25});
    p[n] = plain_sphere(no_shift, 1e20);
    a[n++] = (Answer){"radius 1e20", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){0, 0, -3e20}, (Vec3){0, 0, 1});
    expect_answers(*state, PRIMITIVE_SPHERE, &table, p, a);
    ray_table_destroy(&table);
}

// The same floor where the camera is the origin: a rounded centre would be off by a quarter.
static void giant_spheres(void **state)
{
    RayTable table = ray_table_create(64);
    Primitive p[64] = {0};
    Answer a[64];
    uint64_t random = 5;
    for (size_t i = 0; i < 60; ++i) {
        const double r = i % 3 == 0 ? 1e5 : i % 3 == 1 ? 1e6 : 6.4e6;
        double up[3], side[3];
        random_direction(&random, up);
        random_direction(&random, side);
        const Vec3 n = {up[0], up[1], up[2]};
        Vec3 d = vec_cross(n, (Vec3){side[0], side[1], side[2]});
        d = vec_normalize(vec_sub(vec_normalize(d), vec_scale(n, random_in(&random, 0.1, 2))));
        const Vec3 center = vec_scale(n, -(r + 1.7));
        Shape s = sphere_shape(center, r);
        p[i] = bake_at(&s, no_shift);
        assert_int_equal(p[i].kind, PRIMITIVE_GIANT_SPHERE);
        ray_table_add_next(&table, no_shift, d);
        const Real3 df = real3(ray_number(&table, i, RAY_DIR), ray_number(&table, i, RAY_DIR + 1),
                               ray_number(&table, i, RAY_DIR + 2));
        // Rounding the centre and the direction tilts the ground by about an ulp.
        const double slope = -(double)real3_dot(df, real3(n.x, n.y, n.z));
        a[i] = (Answer){"giant floor, 1.7 below the camera",
                        (double)reference_hit(&s, real3(0, 0, 0), df, 0, 0, 0), 4 + 2 / slope};
    }
    expect_answers(*state, PRIMITIVE_GIANT_SPHERE, &table, p, a);
    ray_table_destroy(&table);
}

static void tori(void **state)
{
    RayTable table = ray_table_create(64);
    Primitive p[64] = {0};
    Answer a[64];
    const Shape s = {.kind = SHAPE_TORUS, .as.torus = {.axis = {0, 0, 1}, .major = 1, .minor = 0.25}};
    static const double heights[] = {0.2499999, 0.24, 0}, starts[] = {3, 10, 100, 1000};
    size_t n = 0;
    for (size_t h = 0; h < 3; ++h)
        for (size_t k = 0; k < 4; ++k, ++n) {
            const double z = (float)heights[h];
            p[n] = bake_at(&s, no_shift);
            const double exact = starts[k] - 1 - sqrt(0.0625 - z * z);
            a[n] = (Answer){"torus from afar", exact, 1e-5 * exact / ulp_of(exact)};
            ray_table_add_next(&table, (Vec3){-starts[k], 0, z}, (Vec3){1, 0, 0});
        }
    for (size_t i = 0; i < 6; ++i)
        p[n + i] = bake_at(&s, no_shift);
    a[n++] = (Answer){"along the axis, through the hole", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){0, 0, -3}, (Vec3){0, 0, 1});
    a[n++] = (Answer){"inside the tube, along it", 0.75, 8};
    ray_table_add_next(&table, (Vec3){1, 0, 0}, (Vec3){0, 1, 0});
    a[n++] = (Answer){"inside the tube, outward", 0.25, 8};
    ray_table_add_next(&table, (Vec3){1, 0, 0}, (Vec3){1, 0, 0});
    a[n++] = (Answer){"from the hole, inward side", 0.75, 4};
    ray_table_add_next(&table, no_shift, (Vec3){1, 0, 0});
    a[n++] = (Answer){"above the tube", INFINITY, 0};
    ray_table_add_next(&table, (Vec3){-3, 0, 0.2500001}, (Vec3){1, 0, 0});
    a[n++] = (Answer){"down onto the tube", 2.75, 4};
    ray_table_add_next(&table, (Vec3){0, 1, 3}, (Vec3){0, 0, -1});
    expect_answers(*state, PRIMITIVE_TORUS, &table, p, a);
    // All four roots in turn, each asked for with the one before as tmin.
    static const double roots[] = {1.75, 2.25, 3.75, 4.25, INFINITY};
    KernelProgram *program = shapes_program(*state, PRIMITIVE_TORUS, 8);
    float tmin = 0;
    for (size_t i = 0; i < 5; ++i) {
        ray_table_clear(&table);
        ray_table_add_next(&table, (Vec3){-3, 0, 0}, (Vec3){1, 0, 0});
        table.rays[RAY_TMIN * table.capacity] = tmin;
        shapes_run(program, 8, &table, p, 1);
        tmin = hit_number(&table, 0, HIT_T);
        assert_true(isinf(roots[i]) ? isinf(tmin) : fabs((double)tmin - roots[i]) < 1e-6);
    }
    kernel_program_destroy(program);
    ray_table_destroy(&table);
}

static void round_solids(void **state)
{
    RayTable table = ray_table_create(64);
    Primitive p[64] = {0};
    Answer a[64];
    const Shape cylinder = {.kind = SHAPE_CYLINDER, .as.cylinder = {{0, 0, 0}, {0, 2, 0}, 1, true}};
    const Shape tube = {.kind = SHAPE_CYLINDER, .as.cylinder = {{0, 0, 0}, {0, 2, 0}, 1, false}};
    static const struct {
        const char *name;
        bool caps;
        Vec3 o, d;
        double t;
    } cases[] = {
        {"parallel to the axis, inside", true, {0.5, -3, 0}, {0, 1, 0}, 3},
        {"parallel to the axis, outside", true, {1.5, -3, 0}, {0, 1, 0}, INFINITY},
        {"parallel to the axis, open", false, {0.5, -3, 0}, {0, 1, 0}, INFINITY},
        {"across", true, {-3, 1, 0}, {1, 0, 0}, 2},
        {"across, open, from inside", false, {0, 1, 0}, {1, 0, 0}, 1},
        {"in at the open end", false, {0, 3, 0}, {0.5, -1, 0}, 2},
        {"within the plane of a cap", true, {-3, 2, 0}, {1, 0, 0}, 2},
    };
    size_t count = sizeof cases / sizeof *cases;
    for (size_t i = 0; i < count; ++i) {
        p[i] = bake_at(cases[i].caps ? &cylinder : &tube, no_shift);
        a[i] = (Answer){cases[i].name, cases[i].t, 2};
        ray_table_add_next(&table, cases[i].o, cases[i].d);
    }
    expect_answers(*state, PRIMITIVE_CYLINDER, &table, p, a);

    ray_table_clear(&table);
    const Shape cone = {.kind = SHAPE_CONE, .as.cone = {{0, 0, 0}, {0, 2, 0}, 1, 0, true}};
    const Shape reversed = {.kind = SHAPE_CONE, .as.cone = {{0, 2, 0}, {0, 0, 0}, 0, 1, true}};
    static const struct {
        const char *name;
        Vec3 o, d;
        double t;
    } pointed[] = {
        {"down onto the apex", {0, 5, 0}, {0, -1, 0}, 3},
        {"up through the base", {0.25, -3, 0}, {0, 1, 0}, 3},
        {"across below the apex", {-3, 1, 0}, {1, 0, 0}, 2.5},
        {"across close to the apex", {-3, 1.999, 0}, {1, 0, 0}, 3 - (2 - (double)1.999f) / 2},
        {"above the apex", {-3, 2.0001, 0}, {1, 0, 0}, INFINITY},
        {"parallel to a generator, inside", {0, -1, 0}, {-0.5, 1, 0}, 1},
    };
    count = sizeof pointed / sizeof *pointed;
    for (size_t i = 0; i < 2 * count; ++i) {
        p[i] = bake_at(i < count ? &cone : &reversed, no_shift);
        a[i] = (Answer){pointed[i % count].name, pointed[i % count].t, 4};
        ray_table_add_next(&table, pointed[i % count].o, pointed[i % count].d);
    }
    expect_answers(*state, PRIMITIVE_CONE, &table, p, a);
    for (int k = 0; k < 3; ++k) // at the apex the axis
        assert_true(hit_number(&table, 0, HIT_NG + k) == (k == 1 ? 1.0f : 0.0f));
    ray_table_destroy(&table);
}

// Texture coordinates at poles and on both sides of the seam.
static void poles_and_seam(void **state)
{
    RayTable table = ray_table_create(16);
    const Primitive p = plain_sphere(no_shift, 1);
    static const struct {
        Vec3 from;
        double u, v;
    } cases[] = {
        {{0, 3, 0}, 0.5, 1},  {{0, -3, 0}, 0.5, 0},     {{0, 0, 3}, 0.5, 0.5},   {{3, 0, 0}, 0.75, 0.5},
        {{0, 0, -3}, 0, 0.5}, {{-1e-9, 0, -3}, 0, 0.5}, {{-3, 0, 0}, 0.25, 0.5},
    };
    const size_t count = sizeof cases / sizeof *cases;
    for (size_t i = 0; i < count; ++i) {
        ray_table_add_next(&table, cases[i].from, vec_scale(cases[i].from, -1.0 / 3));
        table.index[i] = 0;
    }
    KernelProgram *program = shapes_program(*state, PRIMITIVE_SPHERE, 8);
    shapes_run(program, 8, &table, &p, 1);
    kernel_program_destroy(program);
    for (size_t i = 0; i < count; ++i) {
        const double u = hit_number(&table, i, HIT_U), v = hit_number(&table, i, HIT_V);
        assert_true(u >= 0 && u < 1 && v >= 0 && v <= 1);
        assert_true(fabs(u - cases[i].u) < 1e-6 && fabs(v - cases[i].v) < 1e-6);
    }
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres),        cmocka_unit_test(giant_spheres),
        cmocka_unit_test(tori),           cmocka_unit_test(round_solids),
        cmocka_unit_test(poles_and_seam),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
