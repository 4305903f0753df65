// Cylinders and cones along axes and generators, tori by double roots and from far away.
#include <math.h>

#include "selftest/run.h"

typedef struct Aim {
    Vec3 org, dir;
    f64 t;
} Aim;

static void cylinders(Sheet *sheet)
{
    const Shape closed = {.kind = SHAPE_CYLINDER, .as.cylinder = {{0, 0, 0}, {0, 2, 0}, 1, true}};
    const Shape open = {.kind = SHAPE_CYLINDER, .as.cylinder = {{0, 0, 0}, {0, 2, 0}, 1, false}};
    sheet_case(sheet, "C32", "cylinder: parallel to the axis in and out, along a cap", "closed form",
               UNIT_ULP, 2);
    sheet_shape(sheet, &closed, affine_identity());
    sheet_ray(sheet, (Vec3){0.5, -3, 0}, (Vec3){0, 1, 0}, 3);
    sheet_ray(sheet, (Vec3){1.5, -3, 0}, (Vec3){0, 1, 0}, INFINITY);
    sheet_ray(sheet, (Vec3){1 + 0x1p-22, -3, 0}, (Vec3){0, 1, 0}, INFINITY);
    sheet_ray(sheet, (Vec3){1 - 0x1p-22, -3, 0}, (Vec3){0, 1, 0}, 3);
    sheet_ray(sheet, (Vec3){-3, 1, 0}, (Vec3){1, 0, 0}, 2);
    sheet_ray(sheet, (Vec3){-3, 2, 0}, (Vec3){1, 0, 0}, 2);
    sheet_shape(sheet, &open, affine_identity());
    sheet_ray(sheet, (Vec3){0.5, -3, 0}, (Vec3){0, 1, 0}, INFINITY);
    sheet_ray(sheet, (Vec3){0, 1, 0}, (Vec3){1, 0, 0}, 1);
    sheet_ray(sheet, (Vec3){0, 3, 0}, (Vec3){0.5, -1, 0}, 2);
}

// Returns the row of the first ray at an apex; another one follows COUNT rows later.
enum { CONE_RAYS = 6 };
static u32 cones(Sheet *sheet)
{
    static const Aim AIMS[CONE_RAYS] = {
        {{0, 5, 0}, {0, -1, 0}, 3},      {{0.25, -3, 0}, {0, 1, 0}, 3},
        {{-3, 1, 0}, {1, 0, 0}, 2.5},    {{-3, 1.999F, 0}, {1, 0, 0}, 3 - (2 - (f64)1.999F) / 2},
        {{-3, 2.0001, 0}, {1, 0, 0}, INFINITY}, {{0, -1, 0}, {-0.5, 1, 0}, 1},
    };
    const Shape cone = {.kind = SHAPE_CONE, .as.cone = {{0, 0, 0}, {0, 2, 0}, 1, 0, true}};
    const Shape turned = {.kind = SHAPE_CONE, .as.cone = {{0, 2, 0}, {0, 0, 0}, 0, 1, true}};
    sheet_case(sheet, "C34", "cone: onto and past the apex, along a generator", "closed form", UNIT_ULP, 4);
    const u32 first = sheet->table->count;
    for (u32 i = 0; i < 2 * CONE_RAYS; i++) {
        sheet_shape(sheet, i < CONE_RAYS ? &cone : &turned, affine_identity());
        sheet_ray(sheet, AIMS[i % CONE_RAYS].org, AIMS[i % CONE_RAYS].dir, AIMS[i % CONE_RAYS].t);
    }
    return first;
}

static void judge_apex(Run *run, const Sheet *sheet, u32 first)
{
    static const f64 AXIS[3] = {0, 1, 0};
    Score score = {0};
    for (u32 row = first; row <= first + CONE_RAYS; row += CONE_RAYS)
        for (u32 k = 0; k < 3; k++)
            score_absolute(&score, AXIS[k], hit_number(sheet->table, row, PROBE_NG + k));
    run_add(run, "C34", "the normal at the apex: the axis", "definition", UNIT_ABSOLUTE, 0, &score);
}

static void tori(Sheet *sheet)
{
    static const f64 HEIGHTS[] = {0.2499999, 0.24, 0}, STARTS[] = {3, 10, 100, 1000};
    static const Aim AIMS[] = {
        {{0, 0, -3}, {0, 0, 1}, INFINITY}, {{1, 0, 0}, {0, 1, 0}, 0.75}, {{1, 0, 0}, {1, 0, 0}, 0.25},
        {{0, 0, 0}, {1, 0, 0}, 0.75},      {{0, 1, 3}, {0, 0, -1}, 2.75},
        {{-3, 0, 0.2500001}, {1, 0, 0}, INFINITY},
    };
    const Shape torus = {.kind = SHAPE_TORUS, .as.torus = {.axis = {0, 0, 1}, .major = 1, .minor = 0.25}};
    sheet_shape(sheet, &torus, affine_identity());
    sheet_case(sheet, "C35", "torus from 3 to 1000 away, up to a double root", "closed form", UNIT_RELATIVE,
               1e-5);
    for (u32 i = 0; i < 12; i++) {
        const f64 z = (f32)HEIGHTS[i / 4], start = STARTS[i % 4];
        sheet_ray(sheet, (Vec3){-start, 0, z}, (Vec3){1, 0, 0}, start - 1 - sqrt(0.0625 - z * z));
    }
    sheet_case(sheet, "C36", "torus: through the hole, inside the tube, above it", "closed form", UNIT_ULP,
               8);
    for (u32 i = 0; i < sizeof AIMS / sizeof AIMS[0]; i++)
        sheet_ray(sheet, AIMS[i].org, AIMS[i].dir, AIMS[i].t);
}

// The four roots in the plane of symmetry, each asked for with the one before as the least t.
static bool roots_in_turn(Run *run)
{
    static const f64 ROOTS[] = {1.75, 2.25, 3.75, 4.25, INFINITY};
    const Shape torus = {.kind = SHAPE_TORUS, .as.torus = {.axis = {0, 0, 1}, .major = 1, .minor = 0.25}};
    const Affine identity = affine_identity();
    Primitive primitive;
    RayTable *table = run_rays(run, 1);
    if (!table || !run_bake(run, &torus, &identity, &primitive))
        return false;
    ray_table_add_vec(table, 0, (Vec3){-3, 0, 0}, (Vec3){1, 0, 0});
    Score score = {0};
    for (u32 i = 0; i < sizeof ROOTS / sizeof ROOTS[0]; i++) {
        if (!run_own(run, &primitive, 1, table))
            return false;
        const f32 t = hit_number(table, 0, PROBE_T);
        score_relative(&score, ROOTS[i], t);
        table->rays[PROBE_TMIN * table->stride] = t;
    }
    run_add(run, "C36", "torus: its four roots in turn", "closed form", UNIT_RELATIVE, 1e-5, &score);
    return true;
}

bool round_cases(Run *run)
{
    Sheet *sheet = sheet_create(run);
    if (!sheet)
        return false;
    cylinders(sheet);
    const u32 apex = cones(sheet);
    tori(sheet);
    if (!sheet_run(sheet))
        return false;
    judge_apex(run, sheet, apex);
    return roots_in_turn(run);
}
