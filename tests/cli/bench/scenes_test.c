// The scenes and ray sets of clrt-bench are what its tables say they are.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "rays.h"

static BenchScene *scene_of(const char *name, u32 triangles)
{
    Error error;
    BenchScene *scene = bench_scene_create(name, triangles, &error);
    if (!scene)
        fail_msg("%s: %s", name, error.text);
    return scene;
}

static void test_sizes(void **state)
{
    (void)state;
    static const struct { const char *name; u32 asked, least, most; } cases[] = {
        {"blob", 70000, 69000, 71000},       {"hall", 70000, 65000, 75000},
        {"sphereflake", 7381, 7381, 7381},   {"sphereflake", 7380, 820, 820},
        {"needles", 5000, 5000, 5000},       {"instances", 80000, 7500, 8500},
        {"teapots", 90000, 80000, 110000},   {"blob", 1, 20, 20},
    };
    for (size_t k = 0; k < sizeof cases / sizeof *cases; k++) {
        BenchScene *scene = scene_of(cases[k].name, cases[k].asked);
        assert_in_range(scene->primitive_count, cases[k].least, cases[k].most);
        assert_int_equal(scene->instance_count, strcmp(cases[k].name, "instances") == 0 ? 10 : 0);
        assert_true(scene->diagonal > 0 && isfinite(scene->diagonal));
        bench_scene_destroy(scene);
    }
}

typedef struct Edge {
    u32 from, to;
} Edge;

static int compare_edges(const void *a, const void *b)
{
    const Edge *x = a, *y = b;
    return x->from != y->from ? (x->from < y->from ? -1 : 1) : x->to < y->to ? -1 : x->to > y->to;
}

// Each edge is met once in each direction: closed, and wound one way.
static void test_blob_is_closed(void **state)
{
    (void)state;
    BenchScene *scene = scene_of("blob", 3000);
    const Mesh *mesh = scene->mesh;
    const size_t count = 3 * (size_t)mesh->face_count;
    Edge *edges = malloc(count * sizeof *edges);
    assert_non_null(edges);
    for (size_t i = 0; i < count; i++)
        edges[i] = (Edge){mesh->faces[i / 3][i % 3], mesh->faces[i / 3][(i + 1) % 3]};
    qsort(edges, count, sizeof *edges, compare_edges);
    for (size_t i = 0; i < count; i++) {
        const Edge back = {edges[i].to, edges[i].from};
        assert_true(i == 0 || compare_edges(&edges[i - 1], &edges[i]) != 0);
        assert_non_null(bsearch(&back, edges, count, sizeof back, compare_edges));
    }
    f64 volume = 0; // six times that; outward faces make it positive
    for (u32 f = 0; f < mesh->face_count; f++) {
        const Vec3 *p = mesh->positions;
        const u32 *v = mesh->faces[f];
        volume += vec_dot(p[v[0]], vec_cross(p[v[1]], p[v[2]]));
    }
    assert_in_range((u32)(volume / 6 * 100), 250, 700); // the unit sphere has 419
    free(edges);
    bench_scene_destroy(scene);
}

static void test_positions_are_floats(void **state)
{
    (void)state;
    BenchScene *scene = scene_of("hall", 2000);
    for (u32 i = 0; i < scene->mesh->position_count; i++) {
        const Vec3 p = scene->mesh->positions[i];
        assert_true((f64)(f32)p.x == p.x && (f64)(f32)p.y == p.y && (f64)(f32)p.z == p.z);
    }
    bench_scene_destroy(scene);
}

static void test_unknown_scenes(void **state)
{
    (void)state;
    Error error;
    assert_null(bench_scene_create("none", 0, &error));
    assert_int_equal(error.code, ERROR_USAGE);
    assert_null(bench_scene_create("none/none.obj", 0, &error));
    assert_int_equal(error.code, ERROR_SCENE);
}

static void test_camera_rays_cover_the_image(void **state)
{
    (void)state;
    Error error;
    BenchScene *scene = scene_of("blob", 100);
    RaySet *rays = rays_create(RAYS_CAMERA, scene, 20, NULL, NULL, &error);
    assert_non_null(rays);
    assert_int_equal(rays->count, 400);
    // The first pixels of the Morton order of the first tile.
    const Vec3 d0 = ray_direction(rays, 0), d1 = ray_direction(rays, 1), d2 = ray_direction(rays, 2);
    const Vec3 d3 = ray_direction(rays, 3);
    const f64 pixel = vec_length(vec_sub(d1, d0));
    assert_true(fabs(vec_length(vec_sub(d2, d0)) / pixel - 1) < 0.1);
    assert_true(fabs(vec_length(vec_sub(d3, d0)) / pixel - sqrt(2)) < 0.1);
    for (u32 i = 0; i < rays->count; i++) {
        assert_true(fabs(vec_length(ray_direction(rays, i)) - 1) < 1e-6);
        for (u32 k = 0; k < i; k++)
            assert_true(vec_length(vec_sub(ray_direction(rays, i), ray_direction(rays, k))) > 0.5 * pixel);
    }
    rays_destroy(rays);
    bench_scene_destroy(scene);
}

static int compare_reals(const void *a, const void *b)
{
    const f32 x = *(const f32 *)a, y = *(const f32 *)b;
    return x < y ? -1 : x > y;
}

// Rays from made-up hits: all camera rays hit face 0 or miss, by turns.
static void test_secondary_rays(void **state)
{
    (void)state;
    Error error;
    BenchScene *scene = scene_of("blob", 100);
    RaySet *camera = rays_create(RAYS_CAMERA, scene, 16, NULL, NULL, &error);
    RayHits *hits = ray_hits_create(256, &error);
    assert_true(camera && hits);
    for (u32 i = 0; i < 256; i++) {
        hits->t[i] = 2;
        hits->primitive[i] = i % 2 ? NO_PRIMITIVE : 0;
    }
    const Vec3 n = bench_scene_normal(scene, 0, 0, (Vec3){0, 0, 0});
    RaySet *sets[RAY_KINDS];
    for (int kind = RAYS_MIRROR; kind < RAY_KINDS; kind++) {
        const bool later = ray_kind_source((RayKind)kind) == RAYS_DIFFUSE;
        sets[kind] = rays_create((RayKind)kind, scene, 0, later ? sets[RAYS_DIFFUSE] : camera, hits, &error);
        assert_non_null(sets[kind]);
    }
    assert_int_equal(sets[RAYS_MIRROR]->count, 128);
    assert_int_equal(sets[RAYS_DIFFUSE]->count, 128);
    assert_int_equal(sets[RAYS_SHUFFLED]->count, 128);
    assert_true(sets[RAYS_AO]->any_hit && sets[RAYS_SUN]->any_hit && !sets[RAYS_DIFFUSE]->any_hit);
    for (u32 i = 0; i < 128; i++) {
        const f64 in = vec_dot(n, ray_direction(camera, 2 * i));
        assert_true(fabs(vec_dot(n, ray_direction(sets[RAYS_MIRROR], i)) + in) < 1e-6);
        // To the side of the surface that the ray came from.
        assert_true(vec_dot(n, ray_direction(sets[RAYS_DIFFUSE], i)) * in < 0);
        const f32 end = sets[RAYS_AO]->columns[(size_t)RAY_FAR * sets[RAYS_AO]->stride + i];
        assert_true(fabs(end - 0.1 * scene->diagonal) < 1e-5);
    }
    // The same rays, in another order.
    f32 *a = sets[RAYS_DIFFUSE]->columns + RAY_DIR * sets[RAYS_DIFFUSE]->stride;
    f32 *b = sets[RAYS_SHUFFLED]->columns + RAY_DIR * sets[RAYS_SHUFFLED]->stride;
    assert_int_not_equal(memcmp(a, b, 128 * sizeof *a), 0);
    qsort(a, 128, sizeof *a, compare_reals);
    qsort(b, 128, sizeof *b, compare_reals);
    assert_memory_equal(a, b, 128 * sizeof *a);
    for (int kind = RAYS_MIRROR; kind < RAY_KINDS; kind++)
        rays_destroy(sets[kind]);
    rays_destroy(camera);
    ray_hits_destroy(hits);
    bench_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sizes),
        cmocka_unit_test(test_blob_is_closed),
        cmocka_unit_test(test_positions_are_floats),
        cmocka_unit_test(test_unknown_scenes),
        cmocka_unit_test(test_camera_rays_cover_the_image),
        cmocka_unit_test(test_secondary_rays),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
