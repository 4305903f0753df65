// Light that reaches a hit of a path: one shadow ray, and what a ray that meets a light counts for.
#ifndef CLRT_KERNELS_STAGES_PATH_LIGHT_H
#define CLRT_KERNELS_STAGES_PATH_LIGHT_H

#include "stages/path_scatter.h"

#define LIGHT_NUMBERS 32 // of a LightRecord
// Numbers of a LightRecord.
enum { LIGHT_POSITION = 0, LIGHT_NORMAL = 16, LIGHT_KIND = 23, LIGHT_SIZE = 28 };

// What the density of a light's own directions is multiplied by where several lights are drawn of many.
static inline vf light_draws(const PathSettings *path, vi light)
{
#if HAS_MANY_LIGHTS
    const Row entry = row_make(path->table, light, 4);
    return row_real(&entry, 2) * (real)path->light_choices;
#else
    return (vf)(1.0f);
#endif
}

#if HAS_LIGHTS
// A point of a light, as a hit sees it.
typedef struct {
    v3 dir, irradiance; // irradiance: over the density of dir where it has one, without the cosine
    vf distance;
    vf density;         // 0: no other direction leads to the light
    vi left_out, planes; // for the shadow ray
} PathLight;

static inline LightSample record_sample(const Shading *shading, global const LightRecord *record, v3 point,
                                        SampleBits bits)
{
#if HAS_SPHERE_LIGHT
    if (record->kind == LIGHT_KIND_SPHERE)
        return sphere_light_sample(record, point, sample_point(bits));
#endif
#if HAS_RECTANGLE_LIGHT
    if (record->kind == LIGHT_KIND_RECTANGLE)
        return rectangle_light_sample(record, point, sample_point(bits));
#endif
#if HAS_ENVIRONMENT_LIGHT
    if (record->kind == LIGHT_KIND_ENVIRONMENT) {
        LightSample sky;
        const EnvironmentSample drawn = environment_sample(&shading->environment, bits);
        sky.dir = drawn.dir;
        sky.distance = (vf)(INFINITY);
        sky.density = drawn.density;
        const vm some = drawn.density > (vf)(0.0f);
        sky.intensity = v3_scale(drawn.radiance, some ? INVERSE_PI / drawn.density : (vf)(0.0f));
#if HAS_AREA_LIGHTS
        sky.area = true;
#endif
        return sky;
    }
#endif
    return punctual_sample(record, point);
}

// Points of the lights whose indices the lanes have: one light after the other, all lanes that want it at once.
OUTLINE PathLight path_light(const Hit *hit, const Shading *shading, global const LightRecord *lights, vi index,
                             vm wanted, SampleBits bits)
{
    PathLight light;
    LanesI indices;
    light.dir = light.irradiance = v3_splat(0.0f);
    light.distance = light.density = (vf)(0.0f);
    light.left_out = (vi)(NO_HIT);
    light.planes = (vi)(0);
    indices.v = index;
#if HAS_PBR
    const vf punctual = hit_is_pbr(hit) ? (vf)(1.0f) : (vf)(PI);
#else
    const vf punctual = (vf)(PI);
#endif
    for (uint rest = vm_bits(wanted); rest;) {
        const int k = indices.s[lowest_bit(rest)];
        const vm here = wanted & (index == (vi)(k));
        const LightSample sample = record_sample(shading, &lights[k], hit->point, bits);
        const vf factor = sample.density > (vf)(0.0f) ? (vf)(PI) : punctual;
        light.dir = v3_select(here, sample.dir, light.dir);
        light.irradiance = v3_select(here, v3_scale(sample.intensity, factor), light.irradiance);
        light.distance = here ? sample.distance : light.distance;
        light.density = here ? sample.density : light.density;
        light.left_out = here ? (vi)(lights[k].surface) : light.left_out;
        light.planes = here ? (vi)((int)lights[k].planes) : light.planes;
        rest &= ~vm_bits(here);
    }
    return light;
}

// The light number `choice` of those that are looked at.
static inline vi light_choice(const PathSettings *path, const HitRandom *random, uint choice, vf *draws)
{
#if HAS_MANY_LIGHTS
    // The choices of a hit are spread over the table together.
    const SamplePoint point = sample_point(hit_random_pair(random, PAIR_PICK));
    const vf at = (point.x + (real)choice) / (real)path->light_choices * (real)path->light_count;
    const vi entry = VI_FROM_VF(vf_min(at, (vf)((real)(path->light_count - 1))));
    const Row row = row_make(path->table, entry, 4);
    const vi light = point.y < row_real(&row, 0) ? entry : row_int(&row, 1);
    *draws = light_draws(path, light);
    return light;
#else
    *draws = (vf)(1.0f);
    return (vi)((int)choice);
#endif
}

// A ray from the hit towards a light, and what it brings to the eye where it meets nothing.
typedef struct {
    v3 dir, gain;
    vf length;
    vi left_out, planes; // as BatchHits
} PathLightRay;

// The share of it that light from that point counts for, once the surface is known for the direction.
static inline vf light_weight(const PathSettings *path, vf density, vf draws, vf surface)
{
    const vm alone = density == (vf)(0.0f);
    if (!(path->techniques & LIGHTS_BY_LIGHTS))
        return alone ? (vf)(1.0f) / draws : (vf)(0.0f);
    if (!(path->techniques & LIGHTS_BY_SURFACES))
        return (vf)(1.0f) / draws;
    return (alone ? (vf)(1.0f) : power_heuristic(density * draws, surface)) / draws;
}

static inline v3 light_gain(const Hit *hit, const PathSettings *path, const PathParts *parts,
                            const PathLight *light, vf draws)
{
    const vf cosine = v3_dot(hit->ns, light->dir);
    const vm lit = (cosine > (vf)(0.0f)) & (v3_dot(hit_horizon(hit), light->dir) > (vf)(0.0f));
    if (!vm_any(lit))
        return v3_splat(0.0f);
    const Scattering s = path_scattering(hit, parts, light->dir);
    const vf weight = cosine * light_weight(path, light->density, draws, s.density);
    return v3_select(lit, v3_mul(light->irradiance, v3_scale(s.brdf, weight)), v3_splat(0.0f));
}

// Looks at a point of each light, or of some of many, and takes one of them for the shadow ray with a probability in
// proportion to what it would bring (Talbot, Cline and Egbert, "Importance Resampling for Global Illumination",
// 2005): the mean is that of a shadow ray to each of them. Where nothing casts shadows the ray stands for all.
OUTLINE PathLightRay path_light_ray(const Hit *hit, const Shading *shading, global const LightRecord *lights,
                                    const PathSettings *path, const PathParts *parts, vf choice, vm wanted)
{
    PathLightRay ray;
    ray.dir = ray.gain = v3_splat(0.0f);
    ray.length = (vf)(0.0f);
    ray.left_out = (vi)(NO_HIT);
    ray.planes = (vi)(0);
#if HAS_SHADOWS
    vf sum = (vf)(0.0f), taken_weight = (vf)(1.0f);
#endif
    const SampleBits bits = hit_random_pair(&hit->random, PAIR_LIGHT);
    for (uint k = 0; k < path->light_choices; k++) {
        vf draws;
        const vi index = light_choice(path, &hit->random, k, &draws);
        const PathLight light = path_light(hit, shading, lights, index, wanted, bits);
        const v3 gain = light_gain(hit, path, parts, &light, draws);
#if HAS_SHADOWS
        const vf weight = brightness(gain);
        sum += weight;
        const vf part = weight / (sum > (vf)(0.0f) ? sum : (vf)(1.0f));
        const vm taken = choice < part;
        const vf stretched = taken ? choice / part : (choice - part) / (part < (vf)(1.0f) ? 1.0f - part : (vf)(1.0f));
        choice = vf_clamp(stretched, 0.0f, 1.0f - ROUNDING);
        taken_weight = taken ? weight : taken_weight;
        ray.dir = v3_select(taken, light.dir, ray.dir);
        ray.gain = v3_select(taken, gain, ray.gain);
        ray.length = taken ? light.distance * LIGHT_NEARER : ray.length;
        ray.left_out = taken ? light.left_out : ray.left_out;
        ray.planes = taken ? light.planes : ray.planes;
#else
        ray.gain = v3_add(ray.gain, gain);
#endif
    }
#if HAS_SHADOWS
    ray.gain = v3_scale(ray.gain, sum / taken_weight);
#endif
    return ray;
}
#endif

// What light counts for that a ray meets which was drawn with density `drawn` (0: it had no choice), where lights
// are drawn with density `by_light`.
static inline vf met_weight(const PathSettings *path, vf drawn, vf by_light)
{
    const vm free = drawn > (vf)(0.0f);
    if (!(path->techniques & LIGHTS_BY_LIGHTS))
        return (vf)(1.0f);
    if (!(path->techniques & LIGHTS_BY_SURFACES))
        return free ? (vf)(0.0f) : (vf)(1.0f);
    return free ? power_heuristic(free ? drawn : (vf)(1.0f), by_light) : (vf)(1.0f);
}

#if HAS_AREA_LIGHTS
// Density over solid angle with which the lanes' area lights draw dir from org, which meets them at t.
OUTLINE vf area_light_density(global const LightRecord *lights, vi index, v3 org, v3 dir, vf t)
{
    const Row row = row_make(lights, index, LIGHT_NUMBERS);
    const vf size = row_real(&row, LIGHT_SIZE);
    vf density = (vf)(0.0f);
#if HAS_RECTANGLE_LIGHT
    const vf cosine = fabs(v3_dot(row_real3(&row, LIGHT_NORMAL), dir));
    density = t * t / (size * (cosine > (vf)(0.0f) ? cosine : (vf)(1.0f)));
#endif
#if HAS_SPHERE_LIGHT
    const v3 to = v3_sub(row_real3(&row, LIGHT_POSITION), org);
    const vf inverse = (vf)(1.0f) / sqrt(v3_dot(to, to)), sine = size * inverse;
    const vf tangent = vf_clamp(fma(-sine, sine, (vf)(1.0f)), 0.0f, 1.0f);
    const vf by_sphere = (0.5f * INVERSE_PI) * (1.0f + sqrt(tangent)) / (sine * sine);
#if HAS_RECTANGLE_LIGHT
    density = row_int(&row, LIGHT_KIND) == (vi)(LIGHT_KIND_SPHERE) ? by_sphere : density;
#else
    density = by_sphere;
#endif
#endif
    return density;
}
#endif

#if HAS_EMISSION
// What the surface itself shines towards the ray. deep: lanes whose ray looks for lights alone.
OUTLINE v3 path_emission(const Hit *hit, const Shading *shading, global const LightRecord *lights,
                         const PathSettings *path, v3 org, vf t, vf drawn, vm deep)
{
    v3 sum = hit_color(hit, shading, MATERIAL_EMISSION, row_int(&hit->material, MATERIAL_EMISSION_TEXTURE));
    vf weight = deep ? (vf)(0.0f) : (vf)(1.0f);
#if HAS_AREA_LIGHTS
    const vm light = (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_ONE_SIDED) != (vi)(0);
    if (vm_any(light)) {
        const vi material = hit->material.offset / MATERIAL_NUMBERS - (vi)((int)path->area_materials);
        const vi index = light ? material : (vi)(0);
        const vf density = area_light_density(lights, index, org, hit->dir, t) * light_draws(path, index);
        const vf met = hit->inside ? (vf)(0.0f) : met_weight(path, drawn, density);
        weight = light ? met : weight;
    }
#endif
    return v3_scale(sum, weight);
}
#endif

#if HAS_ENVIRONMENT
// Radiance of the environment that a ray meets.
OUTLINE v3 path_sky(const Shading *shading, const PathSettings *path, v3 dir, vf drawn)
{
#if HAS_ENVIRONMENT_LIGHT
    const EnvironmentSample sky = environment_look(&shading->environment, dir);
#if HAS_MANY_LIGHTS
    const vf draws = light_draws(path, (vi)((int)path->light_count - 1)); // the environment is the last light
#else
    const vf draws = (vf)(1.0f);
#endif
    return v3_scale(sky.radiance, met_weight(path, drawn, sky.density * draws));
#else
    return environment_radiance(&shading->environment, dir);
#endif
}
#endif

#endif
