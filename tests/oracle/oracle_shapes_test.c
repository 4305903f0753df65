/* Crossings, normals and texture coordinates of the shapes against closed forms. */
#include <stdio.h>

#include "oracle_test.h"
#include "shape.h"

/* The only shape of a scene of one statement, copied out. */
static Shape shape_of(const char *text)
{
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene, text);
    assert_int_equal(scene.primitive_count, 1);
    Shape shape = *scene.primitives[0].shape;
    scene_free(&scene);
    return shape;
}

/* The i-th smallest crossing; `count` is how many there must be. */
static Crossing crossing_of(const Shape *shape, Vec o, Vec d, int count, int index)
{
    Line line = {o, d};
    Crossing all[CROSSINGS_MAX];
    int found = shape_crossings(shape, &line, all);
    assert_int_equal(found, count);
    for (int i = 0; i < found; i++) {
        int before = 0;
        for (int k = 0; k < found; k++)
            before += all[k].t < all[i].t;
        if (before == index)
            return all[i];
    }
    return all[0];
}

static real t_of(const Shape *shape, Vec o, Vec d, int count, int index)
{
    return crossing_of(shape, o, d, count, index).t;
}

static void test_sphere_far(void **state)
{
    (void)state;
    static const real DISTANCES[] = {100, 2000, 4100, 8000, 1e5L, 1e6L, 1e7L};
    for (size_t i = 0; i < CASES(DISTANCES); i++) {
        char text[80];
        snprintf(text, sizeof text, "sphere { center 0 0 %.1Lf radius 1 }", DISTANCES[i]);
        Shape shape = shape_of(text);
        assert_near(t_of(&shape, vec(0.5L, 0, 0), vec(0, 0, 1), 2, 0), DISTANCES[i] - sqrtl(0.75L),
                    DISTANCES[i] * 1e-15L);
    }
}

static void test_sphere_giant(void **state)
{
    (void)state;
    Vec slope = vec(0.707106769084930419921875L, -0.707106769084930419921875L, 0);
    Shape shape = shape_of("sphere { center 0 -1e5 0 radius 1e5 }");
    assert_near(t_of(&shape, vec(0, 1, 0), slope, 2, 0), 1.414220658L, 1e-9L);
    shape = shape_of("sphere { center 0 -6.4e6 0 radius 6.4e6 }");
    assert_near(t_of(&shape, vec(0, 1, 0), slope, 2, 0), 1.414213697L, 1e-9L);
    /* Exactly: the smaller root of |o + t d - c|^2 = r^2. */
    real r = 6.4e6L;
    Vec flat = vec(0.99995F, -0.0099998F, 0);
    real b = (1 + r) * flat.y;
    real a = dot(flat, flat);
    real t = (1 + 2 * r) / (-b + sqrtl(b * b - a * (1 + 2 * r)));
    assert_near(t, 100.0802488L, 1e-6L);
    assert_near(t_of(&shape, vec(0, 1, 0), flat, 2, 0), t, 1e-8L);
}

static void test_sphere_surface(void **state)
{
    (void)state;
    Shape shape = shape_of("sphere { center 1 2 3 radius 2 }");
    Surface s = shape_surface(&shape, vec(1, 2, 5), 0);
    assert_near(s.u, 0.5L, 0);
    assert_near(s.v, 0.5L, 1e-18L);
    s = shape_surface(&shape, vec(3, 2, 3), 0);
    assert_near(s.u, 0.75L, 1e-18L);
    assert_vec_near(s.normal, vec(1, 0, 0), 0);
    s = shape_surface(&shape, vec(1, 4, 3), 0);
    assert_near(s.u, 0.5L, 0);
    assert_near(s.v, 1, 0);
    /* atan2(+0, -1) = pi: u would be 1 and is 0. */
    assert_near(shape_surface(&shape, vec(1, 2, 1), 0).u, 0, 0);
}

static void test_box(void **state)
{
    (void)state;
    Shape shape = shape_of("box { min -1 0 1 max 3 2 4 }");
    Crossing c = crossing_of(&shape, vec(0, 1, 9), vec(0, 0, -2), 2, 0);
    assert_near(c.t, 2.5L, 0);
    Surface s = shape_surface(&shape, vec(0, 1, 4), c.patch);
    assert_vec_near(s.normal, vec(0, 0, 1), 0);
    assert_near(s.u, 0.25L, 1e-18L);
    assert_near(s.v, 0.5L, 1e-18L);
    c = crossing_of(&shape, vec(0, 9, 1.75L), vec(0, -1, 0), 2, 0);
    s = shape_surface(&shape, vec(0, 2, 1.75L), c.patch);
    assert_near(s.u, 0.25L, 1e-18L);
    assert_near(s.v, 0.75L, 1e-18L); /* t2 = -z */
    c = crossing_of(&shape, vec(9, 1.5L, 1.75L), vec(-1, 0, 0), 2, 0);
    s = shape_surface(&shape, vec(3, 1.5L, 1.75L), c.patch);
    assert_near(s.u, 0.75L, 1e-18L); /* t1 = y x x = -z */
    assert_near(s.v, 0.75L, 1e-18L);
    assert_near(t_of(&shape, vec(0, 1, 2), vec(0, 0, 1), 2, 0), -1, 0);
    crossing_of(&shape, vec(0, 2.5L, 2), vec(0, 0, 1), 0, 0);
}

static void test_flat(void **state)
{
    (void)state;
    Shape shape = shape_of("plane { point 1 2 3 normal 0 5 0 }");
    Surface s = shape_surface(&shape, vec(4, 2, 1), 0);
    assert_near(s.u, 3, 0);
    assert_near(s.v, 2, 0);
    crossing_of(&shape, vec(0, 0, 0), vec(1, 0, 1), 0, 0);
    shape = shape_of("disk { center 0 0 1 normal 0 0 2 radius 2 }");
    assert_near(t_of(&shape, vec(1.2L, 1.6L, 0), vec(0, 0, 1), 1, 0), 1, 0);
    crossing_of(&shape, vec(1.21L, 1.6L, 0), vec(0, 0, 1), 0, 0);
    s = shape_surface(&shape, vec(1, -1, 1), 0);
    assert_near(s.u, 0.75L, 0);
    assert_near(s.v, 0.25L, 0);
    shape = shape_of("triangle { vertices 0 0 0  2 0 0  0 4 0  normals 0 0 1  3 0 3  0 0 1 "
                     "uvs 0 0  1 0  0 1 }");
    s = shape_surface(&shape, vec(1, 1, 0), 0);
    assert_near(s.u, 0.5L, 1e-18L);
    assert_near(s.v, 0.25L, 1e-18L);
    assert_vec_near(s.normal, vec(0, 0, 1), 0);
    assert_vec_near(s.shading, vec(sqrtl(0.5L) / 2, 0, 0.5L + sqrtl(0.5L) / 2), 1e-18L);
    assert_true(crossing_of(&shape, vec(1, 0, 1), vec(0, 0, -1), 1, 0).on_edge);
    assert_false(crossing_of(&shape, vec(0.5L, 1, 1), vec(0, 0, -1), 1, 0).on_edge);
    crossing_of(&shape, vec(1.1L, 2, 1), vec(0, 0, -1), 0, 0);
}

static void test_tetrahedron(void **state)
{
    (void)state;
    Shape shape = shape_of("tetrahedron { center 1 1 1 size 3 }");
    const Vec *v = shape.vertices;
    real volume = dot(cross(sub(v[1], v[0]), sub(v[2], v[0])), sub(v[3], v[0])) / 6;
    assert_near(fabsl(volume), 27 / (6 * sqrtl(2)), 1e-17L);
    for (int i = 0; i < 4; i++) {
        for (int k = 0; k < i; k++)
            assert_near(length(sub(shape.vertices[i], shape.vertices[k])), 3, 1e-17L);
        Surface s = shape_surface(&shape, shape.vertices[i == 3 ? 1 : i], i == 3 ? 3 : 0);
        assert_true(dot(s.normal, sub(shape.vertices[i == 3 ? 3 : 0], vec(1, 1, 1))) > 0);
    }
    /* Face abd: its second vertex is b, its third d. */
    Surface s = shape_surface(&shape, shape.vertices[1], 1);
    assert_near(s.u, 1, 1e-17L);
    assert_near(s.v, 0, 1e-17L);
    s = shape_surface(&shape, shape.vertices[3], 1);
    assert_near(s.v, 1, 1e-17L);
    real h = 3 * sqrtl(2.0L / 3);
    assert_near(t_of(&shape, vec(1, 9, 1), vec(0, -1, 0), 2, 0), 8 - 3 * h / 4, 1e-16L);
    assert_near(t_of(&shape, vec(1, 9, 1), vec(0, -1, 0), 2, 1), 8 + h / 4, 1e-16L);
}

static void test_cylinder(void **state)
{
    (void)state;
    Shape shape = shape_of("cylinder { base 0 0 0 top 0 4 0 radius 1 }");
    Crossing c = crossing_of(&shape, vec(3, 1, 0.6L), vec(-1, 0, 0), 2, 0);
    assert_near(c.t, 2.2L, 1e-17L);
    Surface s = shape_surface(&shape, vec(0.8L, 1, 0.6L), c.patch);
    assert_vec_near(s.normal, vec(0.8L, 0, 0.6L), 1e-18L);
    assert_near(s.u, 1 - atan2l(0.6L, 0.8L) / (2 * PI), 1e-18L); /* t1 = x, t2 = -z */
    assert_near(s.v, 0.25L, 1e-18L);
    c = crossing_of(&shape, vec(0.5L, 9, 0), vec(0, -1, 0), 2, 0);
    assert_near(c.t, 5, 0);
    assert_near(shape_surface(&shape, vec(0.5L, 4, 0), c.patch).u, 0.75L, 1e-18L);
    c = crossing_of(&shape, vec(0.5L, 9, 0), vec(0, -1, 0), 2, 1);
    /* n = -y: t1 = -x, t2 = -z. */
    assert_near(shape_surface(&shape, vec(0, 0, 0.5L), c.patch).v, 0.25L, 1e-18L);
    shape = shape_of("cylinder { base 0 0 0 top 0 4 0 radius 1 caps off }");
    crossing_of(&shape, vec(0.5L, 9, 0), vec(0, -1, 0), 0, 0);
}

static void test_cone(void **state)
{
    (void)state;
    Shape shape = shape_of("cone { base 0 0 0 top 0 2 0 radius 1 }");
    assert_near(t_of(&shape, vec(3, 1, 0), vec(-1, 0, 0), 2, 0), 2.5L, 1e-17L);
    assert_near(t_of(&shape, vec(3, 1, 0), vec(-1, 0, 0), 2, 1), 3.5L, 1e-17L);
    Surface s = shape_surface(&shape, vec(0.5L, 1, 0), 0);
    assert_vec_near(s.normal, normalized(vec(2, 1, 0)), 1e-18L);
    assert_near(s.v, 0.5L, 1e-18L);
    /* Along a generator of the side: one root of the cone, and the base. */
    crossing_of(&shape, vec(0.9L, -1, 0), vec(-0.5L, 1, 0), 2, 0);
    assert_near(t_of(&shape, vec(0, 9, 0.25L), vec(0, -1, 0), 2, 0), 7.5L, 1e-17L);
    shape = shape_of("cone { base 0 0 0 top 0 0 4 radius 1 top_radius 3 }");
    assert_near(t_of(&shape, vec(9, 0, 2), vec(-1, 0, 0), 2, 0), 7, 1e-17L);
    assert_vec_near(shape_surface(&shape, vec(2, 0, 2), 0).normal, normalized(vec(2, 0, -1)), 1e-18L);
}

static void test_torus(void **state)
{
    (void)state;
    Shape shape = shape_of("torus { center 0 0 0 axis 0 0 1 major 1 minor 0.25 }");
    static const real HEIGHTS[] = {0, 0.1L, 0.24L, 0.2499999L};
    static const real STARTS[] = {3, 10, 100, 1000};
    for (size_t i = 0; i < CASES(HEIGHTS); i++) {
        for (size_t k = 0; k < CASES(STARTS); k++) {
            real half = sqrtl(0.0625L - HEIGHTS[i] * HEIGHTS[i]);
            Vec o = vec(-STARTS[k], 0, HEIGHTS[i]);
            assert_near(t_of(&shape, o, vec(1, 0, 0), 4, 0), STARTS[k] - 1 - half, 1e-11L);
            assert_near(t_of(&shape, o, vec(1, 0, 0), 4, 1), STARTS[k] - 1 + half, 1e-11L);
            assert_near(t_of(&shape, o, vec(0.5L, 0, 0), 4, 3), 2 * (STARTS[k] + 1 + half), 1e-11L);
        }
    }
    crossing_of(&shape, vec(0, 0, -5), vec(0, 0, 1), 0, 0);
    crossing_of(&shape, vec(1, 0, 0), vec(0, 0, 1), 2, 0);
    crossing_of(&shape, vec(-1, 0, 0.2500001L), vec(1, 0, 0), 0, 0);
    Surface s = shape_surface(&shape, vec(0, 1, 0.25L), 0);
    assert_vec_near(s.normal, vec(0, 0, 1), 1e-18L);
    assert_near(s.u, 0.25L, 1e-18L); /* t1 = y x z = x, t2 = y */
    assert_near(s.v, 0.25L, 1e-18L);
    s = shape_surface(&shape, vec(0.75L, 0, 0), 0);
    assert_vec_near(s.normal, vec(-1, 0, 0), 1e-18L);
    assert_near(s.v, 0.5L, 1e-18L);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere_far),
        cmocka_unit_test(test_sphere_giant),
        cmocka_unit_test(test_sphere_surface),
        cmocka_unit_test(test_box),
        cmocka_unit_test(test_flat),
        cmocka_unit_test(test_tetrahedron),
        cmocka_unit_test(test_cylinder),
        cmocka_unit_test(test_cone),
        cmocka_unit_test(test_torus),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
