// The check of clrt-bench accepts hits that are right and finds each kind of wrong one.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

#include "check.h"

typedef struct Fixture {
    BenchScene *scene;
    RaySet *rays;
    RayHits *hits; // right ones
    Pool *pool;
} Fixture;

// Nearest face by Moeller and Trumbore's solution, in double.
static void hit_faces(const BenchScene *scene, Vec3 org, Vec3 dir, RayHits *hits, u32 i)
{
    f64 nearest = INFINITY;
    hits->primitive[i] = NO_PRIMITIVE;
    for (u32 f = 0; f < scene->primitive_count; f++) {
        Vec3 c[3];
        assert_true(bench_scene_triangle(scene, f, 0, c));
        const Vec3 ab = vec_sub(c[1], c[0]), ac = vec_sub(c[2], c[0]), p = vec_cross(dir, ac);
        const Vec3 from = vec_sub(org, c[0]), q = vec_cross(from, ab);
        const f64 det = vec_dot(ab, p), u = vec_dot(from, p) / det, v = vec_dot(dir, q) / det;
        const f64 t = vec_dot(ac, q) / det;
        if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < nearest))
            continue;
        nearest = t;
        hits->t[i] = (f32)t;
        hits->u[i] = (f32)u;
        hits->v[i] = (f32)v;
        hits->primitive[i] = f;
    }
}

static void hit_spheres(const BenchScene *scene, Vec3 org, Vec3 dir, RayHits *hits, u32 i)
{
    f64 nearest = INFINITY;
    hits->primitive[i] = NO_PRIMITIVE;
    for (u32 s = 0; s < scene->primitive_count; s++) {
        const Shape *shape = &scene->scene->shapes[s];
        const Vec3 from = vec_sub(org, shape->as.sphere.center);
        const f64 b = vec_dot(from, dir), c = vec_dot(from, from) - pow(shape->as.sphere.radius, 2);
        const f64 t = -b - sqrt(b * b - c * vec_dot(dir, dir));
        if (!(t > 0 && t < nearest))
            continue;
        nearest = t;
        hits->t[i] = (f32)t;
        hits->primitive[i] = s;
    }
}

static Fixture fixture_make(const char *name, u32 triangles)
{
    Error error;
    Fixture f = {bench_scene_create(name, triangles, &error), NULL, NULL, pool_create(2, &error)};
    assert_true(f.scene && f.pool);
    f.rays = rays_create(RAYS_CAMERA, f.scene, 24, NULL, NULL, &error);
    assert_non_null(f.rays);
    f.hits = ray_hits_create(f.rays->count, &error);
    assert_non_null(f.hits);
    for (u32 i = 0; i < f.rays->count; i++) {
        const Vec3 org = ray_origin(f.rays, i), dir = ray_direction(f.rays, i);
        if (f.scene->mesh)
            hit_faces(f.scene, org, dir, f.hits, i);
        else
            hit_spheres(f.scene, org, dir, f.hits, i);
    }
    return f;
}

static void fixture_end(Fixture *f)
{
    rays_destroy(f->rays);
    ray_hits_destroy(f->hits);
    bench_scene_destroy(f->scene);
    pool_destroy(f->pool);
}

static u32 wrong(const Fixture *f)
{
    const Verdict verdict = hits_check(f->scene, f->pool, f->rays, f->hits);
    assert_int_equal(verdict.checked, f->rays->count);
    return verdict.wrong;
}

// The first ray that hits (or misses).
static u32 ray_that(const Fixture *f, bool hits)
{
    for (u32 i = f->rays->count / 2; i < f->rays->count; i++)
        if ((f->hits->primitive[i] != NO_PRIMITIVE) == hits)
            return i;
    fail_msg("no such ray");
    return 0;
}

static void test_right_hits_pass(void **state)
{
    (void)state;
    static const char *const names[] = {"blob", "hall", "sphereflake", "needles", "teapots"};
    for (size_t k = 0; k < sizeof names / sizeof *names; k++) {
        Fixture f = fixture_make(names[k], 500);
        assert_int_equal(wrong(&f), 0);
        fixture_end(&f);
    }
}

static void test_wrong_hits_are_found(void **state)
{
    (void)state;
    for (int spheres = 0; spheres < 2; spheres++) {
        Fixture f = fixture_make(spheres ? "sphereflake" : "blob", 500);
        const u32 hit = ray_that(&f, true), miss = ray_that(&f, false);
        const f32 t = f.hits->t[hit];
        f.hits->t[hit] = t * 1.00001f;
        assert_int_equal(wrong(&f), 1);
        f.hits->t[hit] = t * 0.99999f;
        assert_int_equal(wrong(&f), 1);
        f.hits->t[hit] = t;
        const u32 primitive = f.hits->primitive[hit];
        f.hits->primitive[hit] = NO_PRIMITIVE;
        assert_int_equal(wrong(&f), 1);
        f.hits->primitive[hit] = primitive;
        f.hits->primitive[miss] = 0;
        f.hits->t[miss] = 1;
        assert_int_equal(wrong(&f), 1);
        f.hits->primitive[miss] = NO_PRIMITIVE;
        assert_int_equal(wrong(&f), 0);
        fixture_end(&f);
    }
}

static void test_wrong_faces_and_weights_are_found(void **state)
{
    (void)state;
    Fixture f = fixture_make("blob", 500);
    const u32 hit = ray_that(&f, true), face = f.hits->primitive[hit];
    f.hits->primitive[hit] = (face + 250) % f.scene->primitive_count;
    assert_int_equal(wrong(&f), 1);
    f.hits->primitive[hit] = face;
    f.hits->u[hit] += 1e-3f;
    assert_int_equal(wrong(&f), 1);
    fixture_end(&f);
}

static void test_any_hits(void **state)
{
    (void)state;
    Fixture f = fixture_make("blob", 500);
    f.rays->any_hit = true;
    const u32 hit = ray_that(&f, true), miss = ray_that(&f, false);
    assert_int_equal(wrong(&f), 0);
    f.hits->primitive[miss] = 0;
    assert_int_equal(wrong(&f), 1);
    f.hits->primitive[hit] = NO_PRIMITIVE;
    assert_int_equal(wrong(&f), 2);
    // A ray that ends before the surface does not hit.
    f.hits->primitive[miss] = NO_PRIMITIVE;
    f.rays->columns[(size_t)RAY_FAR * f.rays->stride + hit] = f.hits->t[hit] * 0.9f;
    assert_int_equal(wrong(&f), 0);
    fixture_end(&f);
}

static void test_compare(void **state)
{
    (void)state;
    Error error;
    Fixture f = fixture_make("blob", 500);
    RayHits *other = ray_hits_create(f.rays->count, &error);
    assert_non_null(other);
    for (u32 i = 0; i < f.rays->count; i++) {
        other->t[i] = f.hits->t[i];
        other->primitive[i] = f.hits->primitive[i];
    }
    const u32 hit = ray_that(&f, true), miss = ray_that(&f, false);
    Mismatch m = hits_compare(f.rays, f.hits, other);
    assert_true(m.hit_miss == 0 && m.other == 0 && m.t_error == 0);
    other->primitive[hit]++; // the same t: an edge
    m = hits_compare(f.rays, f.hits, other);
    assert_true(m.hit_miss == 0 && m.other == 0);
    other->t[hit] *= 1.25f;
    other->primitive[miss] = 3;
    m = hits_compare(f.rays, f.hits, other);
    assert_true(m.hit_miss == 1 && m.other == 1);
    assert_true(fabs(m.t_error - 0.2) < 1e-6);
    Verdict verdict = hits_arbitrate(f.scene, f.pool, f.rays, f.hits, other);
    assert_true(verdict.checked == 2 && verdict.wrong == 0);
    verdict = hits_arbitrate(f.scene, f.pool, f.rays, other, f.hits);
    assert_true(verdict.checked == 2 && verdict.wrong == 2);
    ray_hits_destroy(other);
    fixture_end(&f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_right_hits_pass),
        cmocka_unit_test(test_wrong_hits_are_found),
        cmocka_unit_test(test_wrong_faces_and_weights_are_found),
        cmocka_unit_test(test_any_hits),
        cmocka_unit_test(test_compare),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
