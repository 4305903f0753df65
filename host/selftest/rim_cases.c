// Edges and rims of solids: no ray from inside slips out between the pieces of the surface.
#include <math.h>

#include "selftest/random.h"
#include "selftest/run.h"

enum { RAYS = 8192 };

static const Vec3 CORNERS[4] = {{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}};

// A point of an edge or rim of a shape between y = -1 and y = 1.
static Vec3 rim_point(const Shape *s, u64 *random)
{
    const f64 angle = random_in(random, 0, 2 * acos(-1)), share = random_unit(random);
    const bool upper = random_unit(random) < 0.5;
    if (s->kind == SHAPE_BOX) {
        const u32 axis = (u32)(random_unit(random) * 3);
        f64 c[3] = {upper ? 1 : -1, random_unit(random) < 0.5 ? 1 : -1, random_unit(random) < 0.5 ? 1 : -1};
        c[axis] = 2 * share - 1;
        return (Vec3){c[0], c[1], c[2]};
    }
    if (s->kind == SHAPE_TETRAHEDRON) {
        const u32 from = (u32)(random_unit(random) * 4), to = (from + 1 + (u32)(random_unit(random) * 3)) % 4;
        return vec_add(CORNERS[from], vec_scale(vec_sub(CORNERS[to], CORNERS[from]), share));
    }
    const f64 r = s->kind == SHAPE_CONE && upper ? s->as.cone.top_radius : 1;
    return (Vec3){r * cos(angle), upper ? 1 : -1, r * sin(angle)};
}

static bool judge_rims(Run *run, const Shape *shape, u64 seed, Score *leaks, Score *normals)
{
    const Affine map =
        affine_compose(affine_translate((Vec3){3, -2, 5}),
                       affine_compose(affine_rotate((Vec3){1, 2, 3}, 37), affine_scale((Vec3){2, 1, 3})));
    Primitive primitive;
    RayTable *table = run_rays(run, RAYS);
    if (!table || !run_bake(run, shape, &map, &primitive))
        return false;
    u64 random = seed;
    for (u32 i = 0; i < RAYS; i++) {
        const Vec3 inside = {random_in(&random, -0.2, 0.2), random_in(&random, -0.9, -0.5),
                             random_in(&random, -0.2, 0.2)};
        const Vec3 o = affine_point(map, inside);
        ray_table_add_vec(table, 0, o,
                          vec_normalize(vec_sub(affine_point(map, rim_point(shape, &random)), o)));
    }
    if (!run_own(run, &primitive, 1, table))
        return false;
    for (u32 i = 0; i < RAYS; i++) {
        const Vec3 n = hit_vector(table, i, PROBE_NG);
        score_wrong(leaks, !isfinite(hit_number(table, i, PROBE_T)));
        score_absolute(normals, 1, vec_length(n));
    }
    return true;
}

bool rim_cases(Run *run)
{
    const Vec3 low = {0, -1, 0}, high = {0, 1, 0};
    const Shape shapes[] = {
        {.kind = SHAPE_CYLINDER, .as.cylinder = {low, high, 1, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0.5, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, high, 1, 0, true}},
        {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{CORNERS[0], CORNERS[1], CORNERS[2], CORNERS[3]}}},
    };
    Score rims = {0}, edges = {0}, normals = {0};
    for (u32 k = 0; k < sizeof shapes / sizeof shapes[0]; k++)
        if (!judge_rims(run, &shapes[k], k, k < 3 ? &rims : &edges, &normals))
            return false;
    run_add(run, "C33", "rims of cylinders and cones from inside", "closed surfaces", UNIT_LEAKS, 0, &rims);
    run_add(run, "C39", "edges and corners of boxes and tetrahedra", "closed surfaces", UNIT_LEAKS, 0,
            &edges);
    run_add(run, "C33", "their normals: length 1", "1", UNIT_ABSOLUTE, 4e-7, &normals);
    return true;
}
