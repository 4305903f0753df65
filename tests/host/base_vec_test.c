// Vectors and affine maps: exact where they promise it, in range for any finite input.
#include <float.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "base/vec.h"

static void assert_near(f64 found, f64 expected, f64 tolerance)
{
    if (!(fabs(found - expected) <= tolerance))
        fail_msg("%.17g is not within %g of %.17g", found, tolerance, expected);
}

static void assert_vec_near(Vec3 found, Vec3 expected, f64 tolerance)
{
    assert_near(found.x, expected.x, tolerance);
    assert_near(found.y, expected.y, tolerance);
    assert_near(found.z, expected.z, tolerance);
}

static void assert_vec(Vec3 found, f64 x, f64 y, f64 z)
{
    assert_vec_near(found, (Vec3){x, y, z}, 0);
}

static const Affine SAMPLE = {.row = {{1, 2, 3}, {0, -4, 1}, {5, 0, 2}}, .translation = {7, 8, 9}};

static void test_length(void **state)
{
    (void)state;
    static const f64 scales[] = {1, 1e-200, 1e-300, 5e-324 * 4, 1e200, 1e300};
    for (u32 i = 0; i < sizeof scales / sizeof *scales; ++i) {
        const f64 s = scales[i];
        assert_near(vec_length((Vec3){2 * s, -3 * s, 6 * s}) / s, 7, 4e-15);
        const Vec3 n = vec_normalize((Vec3){2 * s, -3 * s, 6 * s});
        assert_vec_near(n, (Vec3){2 / 7.0, -3 / 7.0, 6 / 7.0}, 2e-16);
    }
    assert_true(vec_length((Vec3){0, 0, 0}) == 0);
    assert_vec(vec_normalize((Vec3){0, -DBL_MAX, 0}), 0, -1, 0);
    assert_vec(vec_normalize((Vec3){0, 0, 5e-324}), 0, 0, 1);
    assert_vec(vec_cross((Vec3){1, 0, 0}, (Vec3){0, 1, 0}), 0, 0, 1);
    assert_true(vec_dot((Vec3){1, 2, 3}, (Vec3){4, 5, 6}) == 32);
}

static void test_rotations(void **state)
{
    (void)state;
    const Vec3 p = {1, 2, 3};
    assert_vec(affine_direction(affine_rotate((Vec3){2, 0, 0}, 90), p), 1, -3, 2);
    assert_vec(affine_direction(affine_rotate((Vec3){0, 9, 0}, 90), p), 3, 2, -1);
    assert_vec(affine_direction(affine_rotate((Vec3){0, 0, 1}, 90), p), -2, 1, 3);
    for (i32 turns = -9; turns <= 9; ++turns) {
        const i32 quarter = ((turns % 4) + 4) % 4;
        const f64 c = quarter == 0 ? 1 : quarter == 2 ? -1 : 0, s = quarter == 1 ? 1 : quarter == 3 ? -1 : 0;
        assert_vec(affine_direction(affine_rotate((Vec3){0, 0, 3}, 90.0 * turns), (Vec3){1, 0, 0}), c, s, 0);
    }
    assert_vec(affine_direction(affine_rotate((Vec3){1, 2, 3}, 0), p), 1, 2, 3);
    for (f64 degrees = -720; degrees <= 720; degrees += 7.25) {
        const f64 radians = fmod(degrees, 360) * acos(-1) / 180;
        const Affine m = affine_rotate((Vec3){0, 1, 0}, degrees);
        assert_near(m.row[0].x, cos(radians), 2e-15);
        assert_near(m.row[0].z, sin(radians), 2e-15);
        assert_true(m.row[1].y == 1); // the axis stays exactly
        const Affine n = affine_rotate((Vec3){1, -2, 0.5}, degrees);
        assert_near(affine_determinant(n), 1, 2e-15);
        assert_vec_near(affine_direction(n, (Vec3){1, -2, 0.5}), (Vec3){1, -2, 0.5}, 2e-15);
    }
}

static void test_compose(void **state)
{
    (void)state;
    const Affine move = affine_translate((Vec3){1, 2, 3}), grow = affine_scale((Vec3){2, 3, 4});
    assert_vec(affine_point(affine_compose(grow, move), (Vec3){1, 1, 1}), 4, 9, 16);
    assert_vec(affine_point(affine_compose(move, grow), (Vec3){1, 1, 1}), 3, 5, 7);
    const Vec3 p = {0.5, -1, 2};
    const Affine both = affine_compose(SAMPLE, affine_compose(grow, move));
    const Vec3 steps = affine_point(SAMPLE, affine_point(grow, affine_point(move, p)));
    assert_vec_near(affine_point(both, p), steps, 1e-14);
    assert_vec(affine_direction(move, p), p.x, p.y, p.z);
}

static void test_inverse(void **state)
{
    (void)state;
    assert_near(affine_determinant(SAMPLE), 62, 1e-13);
    static const f64 scales[] = {1, 1e-30, 1e-110, 1e30, 1e110};
    for (u32 i = 0; i < sizeof scales / sizeof *scales; ++i) {
        Affine m = SAMPLE;
        for (u32 j = 0; j < 3; ++j)
            m.row[j] = vec_scale(m.row[j], scales[i]);
        const Affine inverse = affine_inverse(m), one = affine_compose(inverse, m);
        assert_vec_near(one.row[0], (Vec3){1, 0, 0}, 1e-15);
        assert_vec_near(one.row[1], (Vec3){0, 1, 0}, 1e-15);
        assert_vec_near(one.row[2], (Vec3){0, 0, 1}, 1e-15);
        const Vec3 p = {1, -2, 3};
        assert_vec_near(affine_point(m, affine_point(inverse, p)), p, 1e-14);
    }
    assert_near(affine_determinant(affine_scale((Vec3){1e-60, 1e60, 1})), 1, 1e-15);
}

static void test_normals(void **state)
{
    (void)state;
    // Perpendicular to what the plane's directions become, and on the side of the normal.
    const Vec3 n = vec_normalize((Vec3){1, 2, -3}), t1 = {2, -1, 0}, t2 = {3, 0, 1};
    const Affine mirror = affine_scale((Vec3){-1, 1, 1});
    const Affine maps[] = {SAMPLE, mirror, affine_scale((Vec3){1e-30, 2e-30, 3e-30}),
                           affine_rotate((Vec3){1, 1, 0}, 33)};
    for (u32 i = 0; i < sizeof maps / sizeof *maps; ++i) {
        const Vec3 carried = affine_normal(maps[i], n);
        assert_near(vec_length(carried), 1, 1e-15);
        assert_near(vec_dot(carried, vec_normalize(affine_direction(maps[i], t1))), 0, 1e-15);
        assert_near(vec_dot(carried, vec_normalize(affine_direction(maps[i], t2))), 0, 1e-15);
        assert_true(vec_dot(carried, affine_direction(maps[i], n)) > 0);
    }
    assert_vec(affine_normal(mirror, (Vec3){1, 0, 0}), -1, 0, 0); // outward stays outward
}

static void test_singular_values(void **state)
{
    (void)state;
    f64 v[3];
    affine_singular_values(affine_scale((Vec3){-2, 5, 1e-9}), v);
    assert_near(v[0], 5, 1e-14);
    assert_near(v[1], 2, 1e-14);
    assert_near(v[2], 1e-9, 1e-23);
    // Turned on both sides, with a small value that the product with the transpose would lose.
    const Affine a = affine_rotate((Vec3){1, 2, 3}, 41), b = affine_rotate((Vec3){-3, 1, 1}, 67);
    const Affine m = affine_compose(a, affine_compose(affine_scale((Vec3){3, 1e-7, 0.5}), b));
    affine_singular_values(m, v);
    assert_near(v[0], 3, 1e-14);
    assert_near(v[1], 0.5, 1e-14);
    assert_near(v[2], 1e-7, 1e-15);
    affine_singular_values((Affine){.row = {{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}, v);
    assert_near(v[0], 16.848103352614210, 1e-13);
    assert_near(v[1], 1.0683695145547083, 1e-14);
    assert_near(v[2], 0, 1e-14);
    affine_singular_values(affine_scale((Vec3){0, 0, 0}), v);
    assert_true(v[0] == 0 && v[2] == 0);
    affine_singular_values(affine_scale((Vec3){1e100, 2e100, 1e-100}), v);
    assert_near(v[0] / 2e100, 1, 1e-15);
    assert_near(v[2] / 1e-100, 1, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_length),  cmocka_unit_test(test_rotations), cmocka_unit_test(test_compose),
        cmocka_unit_test(test_inverse), cmocka_unit_test(test_normals),
        cmocka_unit_test(test_singular_values),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
