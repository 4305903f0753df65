// Highlights, refraction, lights where they lie on surfaces: what shading makes of single hits.
#include <math.h>
#include <stdio.h>

#include "selftest/random.h"
#include "selftest/run.h"

#define CAMERA "camera { position 0 0 0 look_at 0 0 -1 }\n"

// A floor that shines, seen at the mirror angle of a lamp: the highlight is as bright as the lamp, no more.
static bool highlights(Run *run)
{
    enum { RAYS = 2048 };
    static const char *const KINDS[] = {"phong", "blinn_phong"};
    static const f64 EXPONENTS[] = {1, 50, 1e3, 1e5, 1e6};
    const Vec3 lamp = {0.3, 1.5, -2};
    Score brightness = {0}, above = {0};
    for (u32 c = 0; c < 10; c++) {
        char text[512];
        snprintf(text, sizeof text,
                 CAMERA "light point { position %g %g %g }\n"
                        "material m %s { diffuse 0 specular 1 shininess %g }\n"
                        "plane { point 0 -1 0 normal 0 1 0 material m }\n",
                 lamp.x, lamp.y, lamp.z, KINDS[c % 2], EXPONENTS[c / 2]);
        RayTable *table = run_rays(run, RAYS);
        u64 random = c;
        for (u32 i = 0; table && i < RAYS; i++) {
            const Vec3 p = {random_in(&random, -4, 4), -1, random_in(&random, -6, 2)};
            const Vec3 from = {2 * p.x - lamp.x, lamp.y, 2 * p.z - lamp.z};
            ray_table_add_vec(table, 0, from, vec_normalize(vec_sub(p, from)));
        }
        if (!table || !run_scene(run, text, table))
            return false;
        for (u32 i = 0; i < RAYS; i++) {
            score_absolute(&brightness, 1, hit_number(table, i, PROBE_LIT));
            score_wrong(&above, hit_number(table, i, PROBE_LIT) > 1);
        }
    }
    run_add(run, "C44", "highlights, exponents to 1e6, at the mirror angle", "1", UNIT_ABSOLUTE, 1e-5,
            &brightness);
    run_add(run, "C44", "highlights brighter than their lamp", "definition", UNIT_WRONG, 0, &above);
    return true;
}

#define GLASS "material m phong { diffuse 0 reflect 1 transmit 1 ior 1.5 %s }\n"

// From inside glass at the floats around the cosine of the critical angle.
static bool critical_angle(Run *run)
{
    enum { STEPS = 64, RAYS = 2 * STEPS + 1 };
    RayTable *table = run_rays(run, RAYS);
    f32 cosine = (f32)(sqrt(5) / 3);
    for (u32 i = 0; i < STEPS; i++)
        cosine = nextafterf(cosine, 0);
    for (u32 i = 0; table && i < RAYS; i++) {
        ray_table_add(table, 0, (f32[3]){0, -1.5F, 0}, (f32[3]){sqrtf(1 - cosine * cosine), cosine, 0});
        cosine = nextafterf(cosine, 1);
    }
    char text[512];
    snprintf(text, sizeof text, CAMERA GLASS "plane { point 0 -1 0 normal 0 1 0 material m }\n", "");
    if (!table || !run_scene(run, text, table))
        return false;
    Score verdicts = {0}, lengths = {0};
    for (u32 i = 0; i < RAYS; i++) {
        const f64 c = ray_number(table, i, PROBE_DIR + 1);
        const bool total = 1 - 2.25 * (1 - c * c) < 0;
        if (i < STEPS - 1 || i > STEPS + 1)
            score_wrong(&verdicts, (hit_number(table, i, PROBE_TRANSMIT_WEIGHT) == 0) != total ||
                                       hit_number(table, i, PROBE_REFLECT_WEIGHT) != (total ? 2 : 1));
        score_absolute(&lengths, 1, vec_length(hit_vector(table, i, PROBE_TRANSMIT)));
    }
    run_add(run, "C49", "128 floats about the critical cosine: total or not", "double", UNIT_WRONG, 0,
            &verdicts);
    run_add(run, "C49", "the directions beyond: length 1", "1", UNIT_ABSOLUTE, 4e-7, &lengths);
    return true;
}

// Into a plate of thickness 1 and out of it at 30 degrees; at the right angle.
static bool plate(Run *run)
{
    const f64 sine = 0.5, cosine = sqrt(0.75), inner = asin(sine / 1.5);
    char text[512];
    snprintf(text, sizeof text, CAMERA GLASS "box { min -9 -2 -9 max 9 -1 9 material m }\n", "fresnel on");
    RayTable *table = run_rays(run, 2), *within = run_rays(run, 1);
    if (!table || !within)
        return false;
    ray_table_add_vec(table, 0, (Vec3){0, 0, 0}, (Vec3){sine, -cosine, 0});
    ray_table_add_vec(table, 0, (Vec3){0, 0, 0}, (Vec3){0, -1, 0});
    if (!run_scene(run, text, table))
        return false;
    const Vec3 p = hit_vector(table, 0, PROBE_P), d = hit_vector(table, 0, PROBE_TRANSMIT);
    ray_table_add_vec(within, 0, (Vec3){p.x, p.y - 1e-3, p.z}, d);
    if (!run_scene(run, text, within))
        return false;
    Score refraction = {0}, normal = {0};
    score_absolute(&refraction, sin(inner), hit_number(table, 0, PROBE_TRANSMIT));
    score_absolute(&refraction, -cos(inner), hit_number(table, 0, PROBE_TRANSMIT + 1));
    score_absolute(&refraction, sine, hit_number(within, 0, PROBE_TRANSMIT));
    score_absolute(&refraction, -cosine, hit_number(within, 0, PROBE_TRANSMIT + 1));
    // The way from where the ray enters to where it leaves, across the ray.
    const Vec3 way = vec_sub(hit_vector(within, 0, PROBE_P), (Vec3){p.x, p.y - 1e-3, p.z});
    const f64 shift = (fabs(way.y) * sine - way.x * cosine) / fabs(way.y);
    score_absolute(&refraction, sin(asin(sine) - inner) / cos(inner), shift);
    score_absolute(&normal, 0.04, hit_number(table, 1, PROBE_REFLECT_WEIGHT));
    score_absolute(&normal, 0.96, hit_number(table, 1, PROBE_TRANSMIT_WEIGHT));
    run_add(run, "C50", "plate of index 1.5 at 30 degrees: directions, shift", "closed form", UNIT_ABSOLUTE,
            1e-6, &refraction);
    run_add(run, "C50", "straight on: 4 % are reflected", "closed form", UNIT_ABSOLUTE, 1e-6, &normal);
    return true;
}

// A lamp with attenuation d^2 on a floor: points beside it are in its plane, one is where it is.
static bool lamp_on_a_floor(Run *run)
{
    enum { RAYS = 4096 };
    RayTable *table = run_rays(run, RAYS);
    u64 random = 60;
    for (u32 i = 0; table && i < RAYS; i++) {
        const f64 off = i == 0 ? 0 : random_scale(&random, -30, 1), turn = random_in(&random, 0, 6.3);
        ray_table_add_vec(table, 0, (Vec3){off * cos(turn), 0, -2 + off * sin(turn)}, (Vec3){0, -1, 0});
    }
    const char *text = CAMERA "light point { position 0 -1 -2 attenuation 0 0 1 }\n"
                              "plane { point 0 -1 0 normal 0 1 0 }\n";
    if (!table || !run_scene(run, text, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < RAYS; i++)
        score_absolute(&score, 0, hit_number(table, i, PROBE_LIT));
    run_add(run, "C61", "light in the plane of a floor, also at distance 0", "0", UNIT_ABSOLUTE, 0, &score);
    return true;
}

// Lamps from just above a floor: bright, but a number.
static bool lamp_above_a_floor(Run *run)
{
    enum { RAYS = 1024 };
    static const f64 HEIGHTS[] = {1e-7, 1e-4, 1e-2};
    Score score = {0};
    for (u32 h = 0; h < 3; h++) {
        RayTable *table = run_rays(run, RAYS);
        u64 random = h;
        char text[256];
        snprintf(text, sizeof text, CAMERA "light point { position 0 %.9g -2 attenuation 0 0 1 }\n"
                 "plane { point 0 -1 0 normal 0 1 0 }\n", -1 + HEIGHTS[h]);
        for (u32 i = 0; table && i < RAYS; i++) {
            const f64 off = i == 0 ? 0 : random_scale(&random, -9, 1);
            ray_table_add_vec(table, 0, (Vec3){off, 0, -2}, (Vec3){0, -1, 0});
        }
        if (!table || !run_scene(run, text, table))
            return false;
        // 0.8 of the light, by cosine / distance^2, from the height that floats make of it.
        const f64 height = (f64)(f32)(-1 + HEIGHTS[h]) + 1;
        for (u32 i = 0; i < RAYS; i++) {
            const f64 x = ray_number(table, i, PROBE_ORG), squared = x * x + height * height;
            score_relative(&score, (f64)0.8F * height / (squared * sqrt(squared)),
                           hit_number(table, i, PROBE_LIT));
        }
    }
    run_add(run, "C60", "light 1e-7 to 1e-2 above a floor", "closed form", UNIT_RELATIVE, 1e-6, &score);
    return true;
}

bool shading_cases(Run *run)
{
    return highlights(run) && critical_angle(run) && plate(run) && lamp_above_a_floor(run) &&
           lamp_on_a_floor(run);
}
