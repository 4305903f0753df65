// No ray slips through where surfaces join, and none counts a shared edge twice.
#include "shapes_support.h"

#include "selftest/surfaces.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 8, ICO_TRIANGLES = 1280 };

// ---- a closed mesh ----------------------------------------------------------------------------

static float vertex_part(const Primitive *p, int vertex, int axis)
{
    const f32x4 row = vertex == 0 ? p->row0 : vertex == 1 ? p->row1 : p->row2;
    return axis == 0 ? row.x : axis == 1 ? row.y : row.z;
}

// Rays from inside aimed at points of edges and at vertices of the mesh as it was rounded.
static void aim_at_edges(RayTable *table, const Primitive *mesh, Vec3 center, double radius)
{
    uint64_t random = 1;
    for (size_t i = 0; i < table->capacity; ++i) {
        const Primitive *p = &mesh[i % ICO_TRIANGLES];
        const int from = (int)(random_unit(&random) * 3), to = (from + 1) % 3;
        const float share = i % 5 == 0 ? 0.0f : (float)random_unit(&random);
        float o[3], d[3], length = 0;
        const double middle[3] = {center.x, center.y, center.z};
        for (int k = 0; k < 3; ++k) {
            const float a = vertex_part(p, from, k), b = vertex_part(p, to, k);
            o[k] = (float)(middle[k] + (i % 3 ? random_in(&random, -0.3, 0.3) * radius : 0));
            d[k] = a + share * (b - a) - o[k];
            length += d[k] * d[k];
        }
        length = sqrtf(length);
        for (int k = 0; k < 3 && i % 2; ++k)
            d[k] /= length;
        ray_table_add(table, 0, o, d);
    }
}

static void meshes_are_tight(void **state)
{
    static const struct {
        double radius;
        Vec3 center;
        size_t rays; // of the long run
        bool ball; // rounding leaves it convex, so that each ray leaves once
    } cases[] = {
        {1, {0, 0, 0}, 204800, true},
        {1e-4, {0, 0, 0}, 51200, true},
        {1e6, {0, 0, 0}, 51200, true},
        {1, {1e3, 0, -1e3}, 51200, true},
        {100, {148376, 1234, -223423}, 51200, true},
        {1, {1e6, 0, 1e6}, 51200, false},
    };
    static Primitive mesh[ICO_TRIANGLES];
    TriangleList ball = triangles_icosphere(3);
    assert_int_equal(ball.count, ICO_TRIANGLES);
    KernelProgram *program = shapes_program_alone(*state, PRIMITIVE_TRIANGLE, LANES);
    print_message("radius    centre                 rays    leaks  counted twice\n");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double r = cases[k].radius;
        const Affine map = affine_compose(affine_translate(cases[k].center), affine_scale((Vec3){r, r, r}));
        for (size_t i = 0; i < ICO_TRIANGLES; ++i) {
            Shape s = {.kind = SHAPE_TRIANGLE};
            BakedBounds bounds;
            Error error;
            memcpy(s.as.triangle.vertices, ball.vertices + 3 * i, 3 * sizeof *ball.vertices);
            assert_true(bake_shape(&s, &map, &mesh[i], &bounds, &error));
        }
        RayTable table = ray_table_create(shapes_long_run() ? cases[k].rays : cases[k].rays / 8);
        float *met = malloc(table.capacity * sizeof *met);
        assert_non_null(met);
        aim_at_edges(&table, mesh, cases[k].center, r);
        shapes_crossings(program, LANES, &table, mesh, ICO_TRIANGLES, met);
        size_t leaks = 0, twice = 0;
        for (size_t i = 0; i < table.capacity; ++i) {
            leaks += met[i] == 0;
            twice += cases[k].ball ? met[i] > 1 : fmodf(met[i], 2) == 0 && met[i] > 0;
        }
        print_message("%-8g (%g %g %g)  %zu  %zu  %zu\n", r, cases[k].center.x, cases[k].center.y,
                      cases[k].center.z, table.capacity, leaks, twice);
        assert_int_equal(leaks, 0);
        assert_int_equal(twice, 0);
        free(met);
        ray_table_destroy(&table);
    }
    triangles_destroy(&ball);
    kernel_program_destroy(program);
}

// ---- edges and rims of solids -----------------------------------------------------------------

static const Vec3 tetrahedron[4] = {{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}};

// A point of an edge or rim.
static Vec3 rim_point(const Shape *s, uint64_t *random)
{
    const double a = random_in(random, 0, 2 * acos(-1)), share = random_unit(random);
    const bool upper = random_unit(random) < 0.5;
    if (s->kind == SHAPE_BOX) {
        const int axis = (int)(random_unit(random) * 3);
        double c[3] = {upper ? 1 : -1, random_unit(random) < 0.5 ? 1 : -1,
                       random_unit(random) < 0.5 ? 1 : -1};
        c[axis] = 2 * share - 1;
        return (Vec3){c[0], c[1], c[2]};
    }
    if (s->kind == SHAPE_TETRAHEDRON) {
        const int from = (int)(random_unit(random) * 4), to = (from + 1 + (int)(random_unit(random) * 3)) % 4;
        return vec_add(tetrahedron[from], vec_scale(vec_sub(tetrahedron[to], tetrahedron[from]), share));
    }
    const double r = s->kind == SHAPE_CONE && upper ? s->as.cone.top_radius : 1;
    return (Vec3){r * cos(a), upper ? 1 : -1, r * sin(a)};
}

static void rims_are_tight(void **state)
{
    enum { RAYS = 30000, LONG_RAYS = 100000 };
    const Vec3 low = {0, -1, 0}, high = {0, 1, 0};
    const Shape shapes[] = {
        {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}},
        {.kind = SHAPE_TETRAHEDRON,
         .as.tetrahedron = {{tetrahedron[0], tetrahedron[1], tetrahedron[2], tetrahedron[3]}}},
        {.kind = SHAPE_CYLINDER, .as.cylinder = {low, high, 1, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0.5, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0, true}},
    };
    const size_t rays = shapes_long_run() ? LONG_RAYS : RAYS;
    RayTable table = ray_table_create(rays);
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; ++k) {
        const Affine map =
            affine_compose(affine_translate((Vec3){3, -2, 5}),
                           affine_compose(affine_rotate((Vec3){1, 2, 3}, 37), affine_scale((Vec3){2, 1, 3})));
        Primitive p = {.kind = 0};
        BakedBounds bounds;
        Error error;
        uint64_t random = k;
        assert_true(bake_shape(&shapes[k], &map, &p, &bounds, &error));
        ray_table_clear(&table);
        for (size_t i = 0; i < rays; ++i) {
            const Vec3 inside = {random_in(&random, -0.2, 0.2), random_in(&random, -0.9, -0.5),
                                 random_in(&random, -0.2, 0.2)};
            const Vec3 o = affine_point(map, inside);
            const Vec3 d = vec_normalize(vec_sub(affine_point(map, rim_point(&shapes[k], &random)), o));
            ray_table_add(&table, 0, (float[3]){(float)o.x, (float)o.y, (float)o.z},
                          (float[3]){(float)d.x, (float)d.y, (float)d.z});
        }
        KernelProgram *program = shapes_program(*state, (int)p.kind, LANES);
        shapes_run(program, LANES, &table, &p, 1);
        kernel_program_destroy(program);
        size_t leaks = 0, broken = 0;
        for (size_t i = 0; i < table.count; ++i) {
            double n = 0;
            for (int c = 0; c < 3; ++c)
                n += pow((double)hit_number(&table, i, HIT_NG + c), 2);
            leaks += isfinite(hit_number(&table, i, HIT_T)) ? 0 : 1;
            broken += fabs(n - 1) < 1e-5 ? 0 : 1;
        }
        print_message("kind %u: %zu rays at edges, %zu leaks, %zu normals not of unit length\n", p.kind, rays,
                      leaks, broken);
        assert_int_equal(leaks, 0);
        assert_int_equal(broken, 0);
    }
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_tight),
        cmocka_unit_test(rims_are_tight),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
