// Rays that start on surfaces: none meets its own, and none starts farther off than it must.
#include <math.h>
#include <string.h>

#include "selftest/random.h"
#include "selftest/run.h"

enum { RAYS = 8192 };

typedef struct Place {
    Shape shape;
    Vec3 center;
    f64 scale;
} Place;

// Points of the surface, found by rays from around it; rays that miss leave the table.
static bool find_points(Run *run, const Primitive *primitive, const Affine *map, RayTable *table)
{
    u64 random = 8;
    for (u32 i = 0; i < RAYS; i++) {
        const Vec3 o = affine_point(*map, vec_scale(random_direction(&random), 4));
        const Vec3 to = affine_point(*map, vec_scale(random_direction(&random), 0.9));
        ray_table_add_vec(table, 0, o, vec_normalize(vec_sub(to, o)));
    }
    if (!run_own(run, primitive, 1, table))
        return false;
    u32 kept = 0;
    for (u32 i = 0; i < RAYS; i++) {
        if (isinf(hit_number(table, i, PROBE_T)))
            continue;
        for (size_t k = 0; k < PROBE_HIT_REALS; k++)
            table->hits[k * table->stride + kept] = table->hits[k * table->stride + i];
        kept++;
    }
    table->count = kept;
    return true;
}

// A direction to the outer side of n, some close to the tangent plane.
static Vec3 outward(Vec3 n, bool grazing, u64 *random)
{
    Vec3 d = random_direction(random);
    if (grazing)
        d = vec_add(vec_sub(d, vec_scale(n, vec_dot(d, n))), vec_scale(n, random_scale(random, -6, -1)));
    return vec_normalize(vec_dot(d, n) < 0 ? vec_scale(d, -1) : d);
}

// The rays of the table become rays that leave the points of its hits.
static bool leave_points(Run *run, RayTable *table, NumberTable *leave)
{
    static const u32 COLUMNS[3] = {PROBE_P, PROBE_ERROR, PROBE_NG};
    u64 random = 9;
    const size_t n = table->stride;
    for (u32 i = 0; i < table->count; i++) {
        for (u32 k = 0; k < 9; k++)
            number_set(leave, i, k, hit_number(table, i, COLUMNS[k / 3] + k % 3));
        const Vec3 d = outward(hit_vector(table, i, PROBE_NG), i % 4 == 0, &random);
        number_set(leave, i, 9, d.x);
        number_set(leave, i, 10, d.y);
        number_set(leave, i, 11, d.z);
    }
    if (!probe_numbers(run->probe, FUNCTION_LEAVE, leave, run->error))
        return false;
    for (size_t i = 0; i < table->count; i++)
        for (size_t k = 0; k < 3; k++) {
            table->rays[(PROBE_ORG + k) * n + i] = leave->out[k * leave->stride + i];
            table->rays[(PROBE_DIR + k) * n + i] = leave->in[(9 + k) * leave->stride + i];
        }
    return true;
}

static f64 along_normal(const NumberTable *leave, u32 i, const f32 *numbers)
{
    f64 sum = 0;
    for (size_t k = 0; k < 3; k++)
        sum += fabs((f64)numbers[k * leave->stride + i]) * fabs((f64)leave->in[(6 + k) * leave->stride + i]);
    return sum;
}

// How far origins stand off their points along the normal, in ulps of the coordinates and the size.
static void score_moves(Score *score, const NumberTable *leave, u32 count, f64 size)
{
    for (u32 i = 0; i < count; i++) {
        f64 moved = 0;
        for (size_t k = 0; k < 3; k++) {
            const size_t at = k * leave->stride + i;
            moved += fabs((f64)leave->out[at] - (f64)leave->in[at]) *
                     fabs((f64)leave->in[at + 6 * (size_t)leave->stride]);
        }
        score_value(score, moved / ((along_normal(leave, i, leave->in) + size) * 0x1p-23));
    }
}

// Rays that go outward, also as their rounded numbers have it, and meet the surface.
static void score_hits(Score *score, const RayTable *table, const NumberTable *leave)
{
    for (u32 i = 0; i < table->count; i++) {
        f64 side = 0;
        for (size_t k = 0; k < 3; k++)
            side += (f64)leave->in[(6 + k) * leave->stride + i] * (f64)leave->in[(9 + k) * leave->stride + i];
        score_wrong(score, side > 0 && isfinite(hit_number(table, i, PROBE_T)));
    }
}

typedef struct OriginScores {
    Score with_rule, without_rule, moves;
} OriginScores;

static bool judge_place(Run *run, const Place *place, OriginScores *scores)
{
    const f64 s = place->scale;
    const Affine map = affine_compose(affine_translate(place->center), affine_scale((Vec3){s, s, s}));
    Primitive primitive;
    RayTable *table = run_rays(run, RAYS);
    NumberTable *leave = run_numbers(run, RAYS, NUMBERS_IN);
    if (!table || !leave || !run_bake(run, &place->shape, &map, &primitive) ||
        !find_points(run, &primitive, &map, table) || !leave_points(run, table, leave))
        return false;
    score_moves(&scores->moves, leave, table->count, s);
    if (!run_own(run, &primitive, 1, table))
        return false;
    score_hits(&scores->without_rule, table, leave);
    memset(table->targets + (size_t)PROBE_SELF * table->stride, 0, table->count * sizeof(i32)); // primitive 0
    if (!run_own(run, &primitive, 1, table))
        return false;
    score_hits(&scores->with_rule, table, leave);
    return true;
}

static bool self_hits(Run *run)
{
    const Shape sphere = {.kind = SHAPE_SPHERE, .as.sphere = {{0, 0, 0}, 1}};
    const Vec3 none = {0, 0, 0}, far = {3e3, -2e3, 1e3};
    const Place spheres[] = {{sphere, none, 1},
                             {sphere, none, 1e3},
                             {sphere, none, 1e6},
                             {sphere, {1e5, 0, 0}, 1},
                             {sphere, {1e6, 0, 0}, 1}};
    const Place others[] = {
        {{.kind = SHAPE_BOX, .as.box = {{-1, -0.7, -0.5}, {1, 0.6, 0.8}}}, far, 1},
        {{.kind = SHAPE_CYLINDER, .as.cylinder = {{0, -1, 0}, {0.3, 1, 0}, 0.8, true}}, far, 10},
        {{.kind = SHAPE_CONE, .as.cone = {{0, -1, 0}, {0.3, 1, 0}, 1, 0.3, true}}, far, 10},
        {{.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
         far, 1},
        {{.kind = SHAPE_DISK, .as.disk = {{0, 0, 0}, {0.3, 1, 0.5}, 1.2}}, far, 100},
    };
    OriginScores round = {{0}, {0}, {0}}, rest = {{0}, {0}, {0}};
    for (u32 i = 0; i < 5; i++)
        if (!judge_place(run, &spheres[i], &round) || !judge_place(run, &others[i], &rest))
            return false;
    run_add(run, "C8", "rays off spheres, r 1 to 1e6, at 0 to 1e6: self-hits", "0", UNIT_WRONG, 0,
            &round.with_rule);
    run_add(run, "C8", "the same by the offset alone", "0", UNIT_WRONG, 0, &round.without_rule);
    run_add(run, "C8", "rays off boxes, cylinders, cones ... 4e3 away", "0", UNIT_WRONG, 0, &rest.with_rule);
    run_add(run, "C9", "how far rays start off spheres", "size of the numbers", UNIT_ULP, 16, &round.moves);
    run_add(run, "C9", "off boxes, cylinders, cones ...", "size of the numbers", UNIT_ULP, 16, &rest.moves);
    return true;
}

// A sphere of radius 1e-6 on a floor, light straight from above: its shadow reaches to where it stands.
static bool contact_shadow(Run *run)
{
    enum { POINTS = 512 };
    const f64 height = 1e-3, r = 1e-6;
    const Shape shapes[2] = {{.kind = SHAPE_PLANE, .as.plane = {{0, -height, 0}, {0, 1, 0}}},
                             {.kind = SHAPE_SPHERE, .as.sphere = {{0, r - height, 0}, r}}};
    const Affine identity = affine_identity();
    Primitive primitives[2];
    RayTable *table = run_rays(run, POINTS);
    NumberTable *leave = run_numbers(run, POINTS, NUMBERS_IN);
    if (!table || !leave || !run_bake(run, &shapes[0], &identity, &primitives[0]) ||
        !run_bake(run, &shapes[1], &identity, &primitives[1]))
        return false;
    for (u32 i = 0; i < POINTS; i++) {
        const f64 x = 2 * r * (i + 0.5) / POINTS;
        ray_table_add_vec(table, 0, (Vec3){x, 0, 0}, (Vec3){0, -1, 0});
    }
    if (!run_own(run, primitives, 2, table))
        return false;
    for (u32 i = 0; i < POINTS; i++) {
        for (u32 k = 0; k < 3; k++) {
            number_set(leave, i, k, hit_number(table, i, PROBE_P + k));
            number_set(leave, i, 3 + k, hit_number(table, i, PROBE_ERROR + k));
            number_set(leave, i, 6 + k, hit_number(table, i, PROBE_NG + k));
        }
        number_set(leave, i, 10, 1);
    }
    if (!probe_numbers(run->probe, FUNCTION_LEAVE, leave, run->error))
        return false;
    table->count = 0;
    for (u32 i = 0; i < POINTS; i++) {
        const size_t n = leave->stride;
        ray_table_add(table, 1, (f32[3]){leave->out[i], leave->out[n + i], leave->out[2 * n + i]},
                      (f32[3]){0, 1, 0});
    }
    if (!run_own(run, primitives, 2, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < POINTS; i++) {
        const f64 share = 2 * (i + 0.5) / POINTS;
        if (share < 0.99 || share > 1.01)
            score_wrong(&score, isfinite(hit_number(table, i, PROBE_T)) != (share < 1));
    }
    run_add(run, "C9", "shadow of a sphere of radius 1e-6 where it stands", "closed form", UNIT_WRONG, 0,
            &score);
    return true;
}

bool origin_cases(Run *run)
{
    return self_hits(run) && contact_shadow(run);
}
