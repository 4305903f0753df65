// No ray slips through where surfaces join, and none meets the surface that it starts on.
#include "shapes_reference.h"
#include "shapes_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 8, ICO_TRIANGLES = 1280 };

static const double U = 0x1p-24;

// ---- a closed mesh ----------------------------------------------------------------------------

typedef struct Ball {
    Vec3 triangle[ICO_TRIANGLES][3]; // on the unit sphere
    size_t count;
} Ball;

static void ball_split(Ball *ball, Vec3 a, Vec3 b, Vec3 c, int levels)
{
    if (levels == 0) {
        Vec3 *t = ball->triangle[ball->count++];
        t[0] = a;
        t[1] = b;
        t[2] = c;
        return;
    }
    const Vec3 ab = vec_normalize(vec_add(a, b)), bc = vec_normalize(vec_add(b, c));
    const Vec3 ca = vec_normalize(vec_add(c, a));
    ball_split(ball, a, ab, ca, levels - 1);
    ball_split(ball, ab, b, bc, levels - 1);
    ball_split(ball, ca, bc, c, levels - 1);
    ball_split(ball, ab, bc, ca, levels - 1);
}

static void ball_make(Ball *ball)
{
    static const int faces[20][3] = {
        {0, 11, 5}, {0, 5, 1}, {0, 1, 7}, {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4}, {11, 10, 2}, {10, 7, 6},
        {7, 1, 8},  {3, 9, 4}, {3, 4, 2}, {3, 2, 6},  {3, 6, 8},   {3, 8, 9}, {4, 9, 5},  {2, 4, 11},  {6, 2, 10},
        {8, 6, 7},  {9, 8, 1},
    };
    const double g = (1 + sqrt(5)) / 2;
    const Vec3 v[12] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g}, {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    ball->count = 0;
    for (int i = 0; i < 20; ++i)
        ball_split(ball, vec_normalize(v[faces[i][0]]), vec_normalize(v[faces[i][1]]),
                   vec_normalize(v[faces[i][2]]), 3);
    assert_int_equal(ball->count, ICO_TRIANGLES);
}

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
        size_t rays;
        bool ball; // rounding leaves it convex, so that each ray leaves once
    } cases[] = {
        {1, {0, 0, 0}, 204800, true},       {1e-4, {0, 0, 0}, 51200, true},  {1e6, {0, 0, 0}, 51200, true},
        {1, {1e3, 0, -1e3}, 51200, true},   {100, {148376, 1234, -223423}, 51200, true},
        {1, {1e6, 0, 1e6}, 51200, false},
    };
    static Ball ball;
    static Primitive mesh[ICO_TRIANGLES];
    ball_make(&ball);
    KernelProgram *program = shapes_program(*state, PRIMITIVE_TRIANGLE, LANES);
    print_message("radius    centre                 rays    leaks  counted twice\n");
    for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
        const double r = cases[k].radius;
        const Affine map = affine_compose(affine_translate(cases[k].center), affine_scale((Vec3){r, r, r}));
        for (size_t i = 0; i < ICO_TRIANGLES; ++i) {
            Shape s = {.kind = SHAPE_TRIANGLE};
            BakedBounds bounds;
            Error error;
            memcpy(s.as.triangle.vertices, ball.triangle[i], sizeof ball.triangle[i]);
            assert_true(bake_shape(&s, &map, &mesh[i], &bounds, &error));
        }
        RayTable table = ray_table_create(cases[k].rays);
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
        double c[3] = {upper ? 1 : -1, random_unit(random) < 0.5 ? 1 : -1, random_unit(random) < 0.5 ? 1 : -1};
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
    enum { RAYS = 100000 };
    const Vec3 low = {0, -1, 0}, high = {0, 1, 0};
    const Shape shapes[] = {
        {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{tetrahedron[0], tetrahedron[1], tetrahedron[2], tetrahedron[3]}}},
        {.kind = SHAPE_CYLINDER, .as.cylinder = {low, high, 1, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0.5, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0, true}},
    };
    RayTable table = ray_table_create(RAYS);
    for (size_t k = 0; k < sizeof shapes / sizeof *shapes; ++k) {
        const Affine map = affine_compose(affine_translate((Vec3){3, -2, 5}),
                                          affine_compose(affine_rotate((Vec3){1, 2, 3}, 37), affine_scale((Vec3){2, 1, 3})));
        Primitive p = {.id = 0};
        BakedBounds bounds;
        Error error;
        uint64_t random = k;
        assert_true(bake_shape(&shapes[k], &map, &p, &bounds, &error));
        ray_table_clear(&table);
        for (size_t i = 0; i < RAYS; ++i) {
            const Vec3 inside = {random_in(&random, -0.2, 0.2), random_in(&random, -0.9, -0.5), random_in(&random, -0.2, 0.2)};
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
        print_message("kind %u: %d rays at edges, %zu leaks, %zu normals not of unit length\n", p.kind, RAYS, leaks, broken);
        assert_int_equal(leaks, 0);
        assert_int_equal(broken, 0);
    }
    ray_table_destroy(&table);
}

// ---- rays that start on the surface -----------------------------------------------------------

typedef struct SelfCase {
    const char *name;
    Shape shape;
    Vec3 center;
    double scale;
    bool convex;
} SelfCase;

// Random directions to the outer or inner side of each hit's normal, some of them grazing.
static void leave_hits(RayTable *table, bool inward, uint64_t *random)
{
    for (size_t i = 0; i < table->count; ++i) {
        const Vec3 n = {hit_number(table, i, HIT_NG), hit_number(table, i, HIT_NG + 1),
                        hit_number(table, i, HIT_NG + 2)};
        double r[3];
        random_direction(random, r);
        Vec3 d = {r[0], r[1], r[2]};
        double side = vec_dot(d, n);
        if (i % 4 == 0) { // close to the tangent plane
            const double lift = random_scale(random, -6, -1);
            d = vec_add(vec_sub(d, vec_scale(n, side)), vec_scale(n, side > 0 ? lift : -lift));
            side = vec_dot(d, n);
        }
        if ((side < 0) != inward)
            d = vec_scale(d, -1);
        d = vec_normalize(d);
        const double parts[3] = {d.x, d.y, d.z};
        for (size_t k = 0; k < 3; ++k)
            table->rays[(RAY_DIR + k) * table->capacity + i] = (float)parts[k];
    }
}

static bool to_right_side(const RayTable *table, const float *normals, size_t i, bool inward)
{
    float side = 0;
    for (size_t k = 0; k < 3; ++k)
        side += normals[k * table->capacity + i] * table->rays[(RAY_DIR + k) * table->capacity + i];
    return inward ? side < 0 : side > 0;
}

static void set_self(RayTable *table, float self, float inward)
{
    for (size_t i = 0; i < table->capacity; ++i) {
        table->rays[RAY_SELF * table->capacity + i] = self;
        table->rays[RAY_INWARD * table->capacity + i] = inward;
    }
}

// Points of the surface, found by rays from a ring around it.
static size_t find_points(KernelProgram *program, RayTable *table, const Primitive *p, const Affine *map,
                          uint64_t *random)
{
    ray_table_clear(table);
    for (size_t i = 0; i < table->capacity; ++i) {
        double a[3], b[3];
        random_direction(random, a);
        random_direction(random, b);
        const Vec3 o = affine_point(*map, (Vec3){4 * a[0], 4 * a[1], 4 * a[2]});
        const Vec3 to = affine_point(*map, (Vec3){1.1 * b[0], 0.9 * b[1], 1.1 * b[2]});
        const Vec3 d = vec_normalize(vec_sub(to, o));
        ray_table_add(table, 0, (float[3]){(float)o.x, (float)o.y, (float)o.z},
                      (float[3]){(float)d.x, (float)d.y, (float)d.z});
    }
    set_self(table, 0, 0);
    shapes_run(program, LANES, table, p, 1);
    size_t kept = 0;
    for (size_t i = 0; i < table->capacity; ++i) {
        if (isinf(hit_number(table, i, HIT_T)))
            continue;
        for (size_t k = 0; k < HIT_COLUMNS; ++k)
            table->hits[k * table->capacity + kept] = table->hits[k * table->capacity + i];
        ++kept;
    }
    table->count = kept;
    return kept;
}

typedef struct SelfCounts {
    size_t points, with_rule, without_rule, lost, wrong;
    double widest; // move off the surface, in ulps of the coordinates
} SelfCounts;

// Inward rays against the reference: from the exact side of the surface they leave at the far one.
static void judge_inward(const RayTable *table, const SelfCase *c, const RealMap *inverse, SelfCounts *counts)
{
    for (size_t i = 0; i < table->count; ++i) {
        const Real3 o = real_map_point(inverse, real3(ray_number(table, i, 0), ray_number(table, i, 1), ray_number(table, i, 2)));
        const Real3 d = real_map_direction(inverse, real3(ray_number(table, i, 3), ray_number(table, i, 4), ray_number(table, i, 5)));
        const double size = (fabs(c->center.x) + fabs(c->center.y) + fabs(c->center.z)) / c->scale + 4;
        const real exact = reference_hit(&c->shape, o, d, 0, 0, 0), t = hit_number(table, i, HIT_T);
        // Chords of a few roundings may be lost; the point of exit is on the surface within some roundings,
        // seen along the chord (by the slope there).
        if (isinf((double)t)) {
            counts->lost += !isinf((double)exact) && exact * real3_length(d) > 4000 * sqrtl(U * size);
            continue;
        }
        real nearest = INFINITY;
        for (int k = 0; k < reference_pieces(&c->shape); ++k) {
            real distance, uv[2];
            Real3 normal;
            if (reference_piece(&c->shape, k, real3_add(o, real3_scale(d, t)), &distance, &normal, uv))
                nearest = fminl(nearest, fabsl(distance));
        }
        counts->wrong += nearest <= 32 * U * size ? 0 : 1;
    }
}

static void self_case(KernelDevice *device, const SelfCase *c, size_t rays)
{
    const double s = c->scale;
    const Affine map = affine_compose(affine_translate(c->center), affine_scale((Vec3){s, s, s}));
    const RealMap inverse = real_map_inverse(&map);
    Primitive p = {.id = 0};
    BakedBounds bounds;
    Error error;
    uint64_t random = 11;
    assert_true(bake_shape(&c->shape, &map, &p, &bounds, &error));
    KernelProgram *program = shapes_program(device, (int)p.kind, LANES);
    RayTable table = ray_table_create(rays);
    SelfCounts counts = {.points = find_points(program, &table, &p, &map, &random)};
    const size_t bytes = 3 * table.capacity * sizeof(float);
    float *points = malloc(bytes), *normals = malloc(bytes);
    assert_true(points && normals && counts.points > rays / 4);
    memcpy(points, table.hits + HIT_P * table.capacity, bytes);
    memcpy(normals, table.hits + HIT_NG * table.capacity, bytes);
    float *hits = malloc(HIT_COLUMNS * table.capacity * sizeof(float));
    assert_non_null(hits);
    memcpy(hits, table.hits, HIT_COLUMNS * table.capacity * sizeof(float));
    for (int inward = 0; inward < 2; ++inward) {
        memcpy(table.hits, hits, HIT_COLUMNS * table.capacity * sizeof(float));
        leave_hits(&table, inward, &random);
        shapes_leave(program, LANES, &table);
        for (size_t i = 0; i < table.count; ++i) {
            double moved = 0, size = 0;
            for (size_t k = 0; k < 3; ++k) {
                const size_t at = k * table.capacity + i;
                moved += fabs((double)table.rays[at] - (double)points[at]) * fabs((double)normals[at]);
                size += fabs((double)points[at]) * fabs((double)normals[at]);
            }
            counts.widest = fmax(counts.widest, moved / (2 * U * (size + c->scale)));
        }
        set_self(&table, 1, (float)inward);
        shapes_run(program, LANES, &table, &p, 1);
        if (inward) {
            judge_inward(&table, c, &inverse, &counts);
            continue;
        }
        for (size_t i = 0; i < table.count && c->convex; ++i)
            counts.with_rule += !isinf(hit_number(&table, i, HIT_T)) && to_right_side(&table, normals, i, false);
        set_self(&table, 0, 0);
        shapes_run(program, LANES, &table, &p, 1);
        for (size_t i = 0; i < table.count && c->convex; ++i)
            counts.without_rule += !isinf(hit_number(&table, i, HIT_T)) && to_right_side(&table, normals, i, false);
    }
    kernel_program_destroy(program);
    print_message("%-28s %7zu %6zu %8zu %6zu %6zu %8.2f\n", c->name, counts.points, counts.with_rule,
                  counts.without_rule, counts.lost, counts.wrong, counts.widest);
    free(points);
    free(normals);
    free(hits);
    ray_table_destroy(&table);
    assert_int_equal(counts.with_rule, 0);
    assert_int_equal(counts.without_rule, 0);
    assert_int_equal(counts.lost, 0);
    assert_int_equal(counts.wrong, 0);
    assert_true(counts.widest <= 16);
}

static void no_self_hits(void **state)
{
    const Vec3 o = {0, 0, 0}, low = {0, -1, 0}, high = {0, 1, 0};
    const Shape sphere = {.kind = SHAPE_SPHERE, .as.sphere = {o, 1}};
    const SelfCase cases[] = {
        {"sphere r = 1", sphere, {0, 0, 0}, 1, true},
        {"sphere r = 1e3", sphere, {0, 0, 0}, 1e3, true},
        {"sphere r = 1e6", sphere, {0, 0, 0}, 1e6, true},
        {"sphere r = 1 at 1e5", sphere, {1e5, 0, 1e5}, 1, true},
        {"sphere r = 1 at 1e6", sphere, {1e6, 0, 1e6}, 1, true},
        {"giant sphere r = 1e6", sphere, {0, -1e6, 100}, 1e6, true},
        {"box", {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}}, {3, 4, 5}, 1, true},
        {"tetrahedron", {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
         {3, 4, 5}, 1, true},
        {"cylinder", {.kind = SHAPE_CYLINDER, .as.cylinder = {low, high, 1, true}}, {3, 4, 5}, 1, true},
        {"cone", {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0, true}}, {3, 4, 5}, 1, true},
        {"cut cone", {.kind = SHAPE_CONE, .as.cone = {low, high, 0.5, 1, true}}, {30, 4, 5}, 1, true},
        {"torus", {.kind = SHAPE_TORUS, .as.torus = {o, high, 0.8, 0.3}}, {3, 4, 5}, 1, false},
        {"torus without a hole", {.kind = SHAPE_TORUS, .as.torus = {o, high, 0.6, 0.6}}, {3, 4, 5}, 1e3, false},
    };
    print_message("shape                         points  self  no rule   lost  wrong  moved (ulp)\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        self_case(*state, &cases[i], i < 5 ? 56000 : 20000);
}

// Outward rays from a torus against the reference, from the same origins.
static void torus_sees_itself(void **state)
{
    const Shape shape = {.kind = SHAPE_TORUS, .as.torus = {{0, 0, 0}, {0, 1, 0}, 0.8, 0.3}};
    const Affine map = affine_translate((Vec3){1, 2, 3});
    const RealMap inverse = real_map_inverse(&map);
    Primitive p = {.id = 0};
    BakedBounds bounds;
    Error error;
    uint64_t random = 21;
    assert_true(bake_shape(&shape, &map, &p, &bounds, &error));
    KernelProgram *program = shapes_program(*state, PRIMITIVE_TORUS, LANES);
    RayTable table = ray_table_create(60000);
    find_points(program, &table, &p, &map, &random);
    leave_hits(&table, false, &random);
    shapes_leave(program, LANES, &table);
    set_self(&table, 1, 0);
    shapes_run(program, LANES, &table, &p, 1);
    kernel_program_destroy(program);
    size_t again = 0, unclear = 0;
    for (size_t i = 0; i < table.count; ++i) {
        const Real3 o = real_map_point(&inverse, real3(ray_number(&table, i, 0), ray_number(&table, i, 1), ray_number(&table, i, 2)));
        const Real3 d = real3(ray_number(&table, i, 3), ray_number(&table, i, 4), ray_number(&table, i, 5));
        const real exact = reference_hit(&shape, o, d, 0, 0, 0), t = hit_number(&table, i, HIT_T);
        again += isfinite((double)t);
        if (isinf((double)exact) ? isinf((double)t) : fabsl(t - exact) < 1e-5L)
            continue;
        // Only rays that graze the tube may be judged otherwise.
        const real more = reference_hit(&shape, o, d, 2e-6L, 0, 1e-3L), less = reference_hit(&shape, o, d, -2e-6L, 0, 1e-3L);
        assert_true(isinf((double)more) || isinf((double)less) || fabsl(more - less) > 1e-4L || exact < 2e-3L);
        ++unclear;
    }
    print_message("torus: %zu of %zu outward rays meet it again, %zu on the edge\n", again, table.count, unclear);
    assert_true(again > table.count / 20 && unclear < table.count / 100);
    ray_table_destroy(&table);
}

int main(void)
{
    KernelDevice *device = kernel_device_create();
    if (!device)
        return KERNEL_TEST_SKIP;
    const struct CMUnitTest tests[] = {
        kernel_unit_test(meshes_are_tight, device),
        kernel_unit_test(rims_are_tight, device),
        kernel_unit_test(no_self_hits, device),
        kernel_unit_test(torus_sees_itself, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    kernel_device_destroy(device);
    return failed;
}
