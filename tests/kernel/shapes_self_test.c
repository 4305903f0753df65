// No ray meets the surface that it starts on, and none that starts on it is lost: by the rule of
// RayLanes.self, and for convex shapes also without it, because rays leave by the error bound of the point.
#include "reference/shapes.h"
#include "shapes_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LANES = 8 };

static const double U = 0x1p-24;

typedef struct SelfCase {
    const char *name;
    Shape shape;
    Vec3 center;
    double scale;
    bool convex;
} SelfCase;

static Real3 ray_vector(const RayTable *table, size_t i, int column)
{
    return real3(ray_number(table, i, column), ray_number(table, i, column + 1),
                 ray_number(table, i, column + 2));
}

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

// Hits of rays that go outward, also as the rounded numbers have it.
static size_t outward_hits(const RayTable *table, const float *normals)
{
    size_t count = 0;
    for (size_t i = 0; i < table->count; ++i) {
        float side = 0;
        for (size_t k = 0; k < 3; ++k)
            side += normals[k * table->capacity + i] * table->rays[(RAY_DIR + k) * table->capacity + i];
        count += side > 0 && isfinite(hit_number(table, i, HIT_T));
    }
    return count;
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

// How far origins stand off their points along the normal, at most, in ulps of coordinates and radius.
static double widest_move(const RayTable *table, const float *points, const float *normals, double radius)
{
    double widest = 0;
    for (size_t i = 0; i < table->count; ++i) {
        double moved = 0, size = radius;
        for (size_t k = 0; k < 3; ++k) {
            const size_t at = k * table->capacity + i;
            moved += fabs((double)table->rays[at] - (double)points[at]) * fabs((double)normals[at]);
            size += fabs((double)points[at]) * fabs((double)normals[at]);
        }
        widest = fmax(widest, moved / (2 * U * size));
    }
    return widest;
}

typedef struct SelfCounts {
    size_t points, with_rule, without_rule, lost, wrong;
    double widest; // move off the surface, in ulps of the coordinates
} SelfCounts;

// Inward rays against the reference: from the exact side of the surface they leave at the far one.
static void judge_inward(const RayTable *table, const SelfCase *c, const RealMap *inverse, SelfCounts *counts)
{
    for (size_t i = 0; i < table->count; ++i) {
        const Real3 o = real_map_point(inverse, ray_vector(table, i, RAY_ORG));
        const Real3 d = real_map_direction(inverse, ray_vector(table, i, RAY_DIR));
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
    Primitive p = {.kind = 0};
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
        counts.widest = fmax(counts.widest, widest_move(&table, points, normals, c->scale));
        set_self(&table, 1, (float)inward);
        shapes_run(program, LANES, &table, &p, 1);
        if (inward) {
            judge_inward(&table, c, &inverse, &counts);
            continue;
        }
        counts.with_rule = c->convex ? outward_hits(&table, normals) : 0;
        set_self(&table, 0, 0);
        shapes_run(program, LANES, &table, &p, 1);
        counts.without_rule = c->convex ? outward_hits(&table, normals) : 0;
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
        {"tetrahedron",
         {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
         {3, 4, 5},
         1,
         true},
        {"cylinder", {.kind = SHAPE_CYLINDER, .as.cylinder = {low, high, 1, true}}, {3, 4, 5}, 1, true},
        {"cone", {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0, true}}, {3, 4, 5}, 1, true},
        {"cut cone", {.kind = SHAPE_CONE, .as.cone = {low, high, 0.5, 1, true}}, {30, 4, 5}, 1, true},
        {"torus", {.kind = SHAPE_TORUS, .as.torus = {o, high, 0.8, 0.3}}, {3, 4, 5}, 1, false},
        {"torus without a hole",
         {.kind = SHAPE_TORUS, .as.torus = {o, high, 0.6, 0.6}},
         {3, 4, 5},
         1e3,
         false},
    };
    print_message("shape                         points  self  no rule   lost  wrong  moved (ulp)\n");
    for (size_t i = 0; i < sizeof cases / sizeof *cases; ++i)
        self_case(*state, &cases[i], (i < 5 ? 56000u : 20000u) / (shapes_long_run() ? 1 : 3));
}

// Outward rays from a torus against the reference, from the same origins.
static void torus_sees_itself(void **state)
{
    const Shape shape = {.kind = SHAPE_TORUS, .as.torus = {{0, 0, 0}, {0, 1, 0}, 0.8, 0.3}};
    const Affine map = affine_translate((Vec3){1, 2, 3});
    const RealMap inverse = real_map_inverse(&map);
    Primitive p = {.kind = 0};
    BakedBounds bounds;
    Error error;
    uint64_t random = 21;
    assert_true(bake_shape(&shape, &map, &p, &bounds, &error));
    KernelProgram *program = shapes_program(*state, PRIMITIVE_TORUS, LANES);
    RayTable table = ray_table_create(shapes_long_run() ? 60000 : 20000);
    find_points(program, &table, &p, &map, &random);
    leave_hits(&table, false, &random);
    shapes_leave(program, LANES, &table);
    set_self(&table, 1, 0);
    shapes_run(program, LANES, &table, &p, 1);
    kernel_program_destroy(program);
    size_t again = 0, unclear = 0;
    for (size_t i = 0; i < table.count; ++i) {
        const Real3 o = real_map_point(&inverse, ray_vector(&table, i, RAY_ORG));
        const Real3 d = ray_vector(&table, i, RAY_DIR);
        const real exact = reference_hit(&shape, o, d, 0, 0, 0), t = hit_number(&table, i, HIT_T);
        again += isfinite((double)t);
        if (isinf((double)exact) ? isinf((double)t) : fabsl(t - exact) < 1e-5L)
            continue;
        // Only rays that graze the tube may be judged otherwise.
        const real more = reference_hit(&shape, o, d, 2e-6L, 0, 1e-3L),
                   less = reference_hit(&shape, o, d, -2e-6L, 0, 1e-3L);
        assert_true(isinf((double)more) || isinf((double)less) || fabsl(more - less) > 1e-4L ||
                    exact < 2e-3L);
        ++unclear;
    }
    print_message("torus: %zu of %zu outward rays meet it again, %zu on the edge\n", again, table.count,
                  unclear);
    assert_true(again > table.count / 20 && unclear < table.count / 100);
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(no_self_hits),
        cmocka_unit_test(torus_sees_itself),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
