// Checkers far out and at borders of their cells, texture coordinates at poles and seams.
#include <math.h>
#include <stdio.h>

#include "selftest/random.h"
#include "selftest/run.h"

enum { RAYS = 4096 };

static bool is_odd(f64 cell)
{
    return fmod(fabs(cell), 2) == 1;
}

// Squares of a floor as a camera sees them that stands far out, straight below it. Positions are multiples of
// 2^-12, so that double knows them exactly.
static bool far_checkers(Run *run)
{
    static const f64 PLACES[] = {0, 1e6, 8388608.5, 16777217, 3e9}, SCALES[] = {1, 2.5};
    Score score = {0};
    for (u32 c = 0; c < 10; c++) {
        const f64 place = PLACES[c / 2], scale = SCALES[c % 2];
        char text[512];
        snprintf(text, sizeof text,
                 "camera { position %.17g 0 0 look_at %.17g 0 -1 }\n"
                 "texture t checker { scale %g %g }\nmaterial m phong { diffuse t }\n"
                 "plane { point 0 -1 0 normal 0 1 0 material m }\n",
                 place, place, scale, scale);
        RayTable *table = run_rays(run, RAYS);
        u64 random = c;
        for (u32 i = 0; table && i < RAYS; i++) {
            const f64 x = floor(random_in(&random, -4, 4) * 4096) / 4096;
            const f64 z = floor(random_in(&random, -4, 4) * 4096) / 4096;
            ray_table_add_vec(table, 0, (Vec3){x, 0, z}, (Vec3){0, -1, 0});
        }
        if (!table || !run_scene(run, text, table))
            return false;
        for (u32 i = 0; i < RAYS; i++) {
            const Vec3 o = ray_vector(table, i, PROBE_ORG);
            const bool odd = is_odd(floor((place + o.x) * scale) + floor(-o.z * scale));
            score_wrong(&score, hit_number(table, i, PROBE_COLOR) != (odd ? 0 : 1));
        }
    }
    run_add(run, "C55", "checker at x = 1e6, 2^23 + 0.5, 2^24 + 1, 3e9", "double", UNIT_WRONG, 0, &score);
    return true;
}

// A floor and the top of a block that lie on borders of cells: the colours of the cells below.
static bool solid_checkers(Run *run)
{
    static const char *const SHAPES[] = {
        "plane { point 0 0 0 normal 0 1 0 material m }",
        "box { min -9 -3 -9 max 9 0 9 material m }",
    };
    Score score = {0};
    for (u32 c = 0; c < 2; c++) {
        char text[512];
        snprintf(text, sizeof text,
                 "camera { position 0.25 1.7 0.125 look_at 0.25 1.7 -1 }\n"
                 "texture t checker3d { }\nmaterial m phong { diffuse t }\n%s\n", SHAPES[c]);
        RayTable *table = run_rays(run, RAYS);
        u64 random = c;
        for (u32 i = 0; table && i < RAYS; i++) {
            const Vec3 d = {random_in(&random, -2, 2), -1, random_in(&random, -2, 2)};
            ray_table_add_vec(table, 0, (Vec3){0, 0, 0}, vec_normalize(d));
        }
        if (!table || !run_scene(run, text, table))
            return false;
        for (u32 i = 0; i < RAYS; i++) {
            const Vec3 o = ray_vector(table, i, PROBE_ORG), d = ray_vector(table, i, PROBE_DIR);
            const f64 t = -1.7 / d.y, x = o.x + t * d.x + 0.25, z = o.z + t * d.z + 0.125;
            if (fabs(x - round(x)) < 1e-5 || fabs(z - round(z)) < 1e-5)
                continue;
            const bool odd = is_odd(floor(x) - 1 + floor(z));
            score_wrong(&score, hit_number(table, i, PROBE_COLOR) != (odd ? 0 : 1));
        }
    }
    run_add(run, "C56", "checker3d on faces at y = 0: speckle", "the cells below", UNIT_WRONG, 0, &score);
    return true;
}

static bool poles_and_seams(Run *run)
{
    static const struct {
        Vec3 from;
        f64 u, v;
    } AIMS[] = {
        {{0, 3, 0}, 0.5, 1},  {{0, -3, 0}, 0.5, 0},     {{0, 0, 3}, 0.5, 0.5},   {{3, 0, 0}, 0.75, 0.5},
        {{0, 0, -3}, 0, 0.5}, {{-1e-9, 0, -3}, 0, 0.5}, {{-3, 0, 0}, 0.25, 0.5},
    };
    const Shape shape = {.kind = SHAPE_SPHERE, .as.sphere = {{0, 0, 0}, 1}};
    const Affine identity = affine_identity();
    const u32 count = sizeof AIMS / sizeof AIMS[0];
    Primitive sphere;
    RayTable *table = run_rays(run, count);
    if (!table || !run_bake(run, &shape, &identity, &sphere))
        return false;
    for (u32 i = 0; i < count; i++)
        ray_table_add_vec(table, 0, AIMS[i].from, vec_scale(AIMS[i].from, -1.0 / 3));
    if (!run_own(run, &sphere, 1, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < count; i++) {
        score_absolute(&score, AIMS[i].u, hit_number(table, i, PROBE_U));
        score_absolute(&score, AIMS[i].v, hit_number(table, i, PROBE_V));
    }
    run_add(run, "C57", "u and v at the poles and the seam of a sphere", "closed form", UNIT_ABSOLUTE, 1e-6,
            &score);
    return true;
}

bool texture_cases(Run *run)
{
    return far_checkers(run) && solid_checkers(run) && poles_and_seams(run);
}
