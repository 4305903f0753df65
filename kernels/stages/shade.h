// Stage: shade_hits. For each ray of the queue: what it brings at once (background, emission, ambient),
// shadow rays towards the lights of this pass, and the rays that follow it.
#ifndef CLRT_KERNELS_STAGES_SHADE_H
#define CLRT_KERNELS_STAGES_SHADE_H

#if HAS_LIGHTS
#include "light/lights.h"
#endif
#if HAS_OCCLUSION
#include "base/frame.h"
#endif
#include "material/lobes.h"
#include "shared/light.h"
#include "stages/hit.h"
#include "stages/queue.h"

// Bits of FLAGS: a shadow ray towards light k of the pass is bit k; a next ray is this one.
#define FLAG_NEXT (1 << 30)

// Shadow rays end this little before the light, several times the error of any t, so that the surface that a
// light lies on does not stand before it.
#define LIGHT_NEARER 0.999998f

#if !HAS_PATH
// Lights first..last of params; opening and closing tell the first and the last pass over a hit.
typedef struct {
    uint first, last;
    bool opening, closing;
} LightPass;
#endif

// Light from directions below this plane through the hit does not count.
static inline v3 hit_horizon(const Hit *hit)
{
#if HAS_TERMINATOR
    return hit->horizon;
#else
    return hit->ng;
#endif
}

static inline v3 hit_diffuse(const Hit *hit, const Shading *shading)
{
    return hit_color(hit, shading, MATERIAL_DIFFUSE, row_int(&hit->material, MATERIAL_DIFFUSE_TEXTURE));
}

#if HAS_AMBIENT
// What the hit reflects of ambient light that comes from everywhere.
OUTLINE v3 hit_ambient(const Hit *hit, const Shading *shading)
{
    v3 ambient = hit_color(hit, shading, MATERIAL_AMBIENT, row_int(&hit->material, MATERIAL_AMBIENT_TEXTURE));
#if HAS_PBR
    const vf open = hit_number(hit, shading, MATERIAL_OCCLUSION, MATERIAL_OCCLUSION_TEXTURE);
    ambient = v3_select(hit_is_pbr(hit), v3_scale(ambient, open), ambient);
#endif
    return ambient;
}
#endif

#if HAS_PREFILTERED
// Light of the environment on pbr materials, as if nothing stood in its way.
OUTLINE v3 hit_prefiltered(const Hit *hit, const Shading *shading)
{
    const PbrLanes *m = &hit->pbr;
    const Environment *environment = &shading->environment;
    const vf along = v3_dot(hit->ns, hit->dir), cosine = vf_max(-along, (vf)(0.0f));
    const v3 mirrored = v3_normalize(v3_fma(hit->ns, -2.0f * along, hit->dir)), f0 = pbr_f0(m);
    const v3 reflectance = prefiltered_reflectance(environment, cosine, m->roughness);
    const vf lobe = m->roughness >= (vf)(PBR_MIRROR) ? 1.0f - pbr_through(m) : (vf)(0.0f);
    const vf body = (1.0f - m->metallic) * (1.0f - m->transmit) * reflectance.z;
    const v3 shine = v3_fma(f0, reflectance.x, v3_make(reflectance.y, reflectance.y, reflectance.y));
    const v3 base = v3_mul(m->base_color, v3_sub(v3_splat(1.0f), f0));
    const v3 sum = v3_add(
        v3_mul(v3_scale(shine, lobe), prefiltered_radiance(environment, mirrored, m->roughness)),
        v3_mul(v3_scale(base, body), prefiltered_irradiance(environment, hit->ns)));
    const vf open = hit_number(hit, shading, MATERIAL_OCCLUSION, MATERIAL_OCCLUSION_TEXTURE);
    return v3_select(hit_is_pbr(hit), v3_scale(sum, open), v3_splat(0.0f));
}
#endif

#if !HAS_PATH
// Emission and, where no rays look for what occludes it, ambient light.
OUTLINE v3 shade_unlit(const Hit *hit, const Shading *shading)
{
    v3 sum = v3_splat(0.0f);
#if HAS_EMISSION
    sum = hit_color(hit, shading, MATERIAL_EMISSION, row_int(&hit->material, MATERIAL_EMISSION_TEXTURE));
#if HAS_AREA_LIGHTS
    const vm one_sided = (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_ONE_SIDED) != (vi)(0);
    sum = v3_select(one_sided & hit->inside, v3_splat(0.0f), sum);
#endif
#endif
#if HAS_AMBIENT && !HAS_OCCLUSION
    sum = v3_add(sum, hit_ambient(hit, shading));
#endif
#if HAS_PREFILTERED
    sum = v3_add(sum, hit_prefiltered(hit, shading));
#endif
    return sum;
}
#endif

#if HAS_PBR
OUTLINE PbrLanes hit_pbr(const Hit *hit, const Shading *shading)
{
    PbrLanes m;
    m.base_color = hit_diffuse(hit, shading);
    m.metallic = hit_number(hit, shading, MATERIAL_METALLIC, MATERIAL_METALLIC_TEXTURE);
    m.roughness = hit_number(hit, shading, MATERIAL_ROUGHNESS, MATERIAL_ROUGHNESS_TEXTURE);
    m.transmit = row_real(&hit->material, MATERIAL_PBR_TRANSMIT);
    m.f = row_real(&hit->material, MATERIAL_BASE_REFLECTANCE);
    return m;
}
#endif

#if HAS_DIRECT_LIGHTS && !HAS_PATH
// Radiance that the light sends to the eye by way of the hit, were nothing between them; 0 where it cannot.
OUTLINE v3 shade_light(const Hit *hit, v3 diffuse, const LightSample *light)
{
    const vf cosine = v3_dot(hit->ns, light->dir);
    const vm lit = (cosine > (vf)(0.0f)) & (v3_dot(hit_horizon(hit), light->dir) > (vf)(0.0f));
    v3 reflected = v3_scale(diffuse, cosine);
#if HAS_SPECULAR
    const v3 specular = row_real3(&hit->material, MATERIAL_SPECULAR);
    if (vm_any(lit & ((specular.x > (vf)(0.0f)) | (specular.y > (vf)(0.0f)) | (specular.z > (vf)(0.0f))))) {
        const vf exponent = row_real(&hit->material, MATERIAL_SHININESS);
        const v3 to_eye = v3_neg(hit->dir);
        vf lobe;
#if HAS_BLINN && HAS_PHONG
        const vm blinn = (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_BLINN) != (vi)(0);
        lobe = blinn ? lobe_blinn(hit->ns, light->dir, to_eye, exponent)
                     : lobe_phong(hit->ns, light->dir, to_eye, exponent);
#elif HAS_BLINN
        lobe = lobe_blinn(hit->ns, light->dir, to_eye, exponent);
#else
        lobe = lobe_phong(hit->ns, light->dir, to_eye, exponent);
#endif
        reflected = v3_fma(specular, lobe, reflected);
    }
#endif
#if HAS_PBR
    const vm pbr = hit_is_pbr(hit);
    if (vm_any(lit & pbr)) {
        const v3 brdf = pbr_brdf(&hit->pbr, hit->ns, v3_neg(hit->dir), light->dir);
#if HAS_AREA_LIGHTS
        const vf irradiance = light->area ? cosine * PI : cosine; // of what is over pi for the others
#else
        const vf irradiance = cosine;
#endif
        reflected = v3_select(pbr, v3_scale(brdf, irradiance), reflected);
    }
#endif
    return v3_select(lit, v3_mul(light->intensity, reflected), v3_splat(0.0f));
}
#endif

#if HAS_LIGHTS
#if !HAS_PATH
// A ray from the hit towards a light, and what it brings to the eye where it meets nothing.
typedef struct {
    v3 dir, gain;
    vf length;
} LightRay;

#if HAS_OCCLUSION
static inline LightRay occlusion_ray(const Hit *hit, v3 ambient, global const LightRecord *light)
{
    LightRay ray;
    const SamplePoint u = hit_random_point(&hit->random, light);
    ray.dir = cosine_direction(hit->ns, u.x, u.y);
    ray.length = (vf)(light->size);
    const v3 share = v3_scale(ambient, (vf)(light->intensity.x));
    ray.gain = v3_select(v3_dot(hit_horizon(hit), ray.dir) > (vf)(0.0f), share, v3_splat(0.0f));
    return ray;
}
#endif

#if HAS_ENVIRONMENT_LIGHT
// One direction, from the map or from the material, each half of the time: so its density is the mean of both
// (the balance heuristic of Veach and Guibas, "Optimally Combining Sampling Techniques", 1995).
static inline LightRay environment_ray(const Hit *hit, const Environment *environment,
                                       global const LightRecord *light)
{
    LightRay ray;
    const v3 to_eye = v3_neg(hit->dir);
    // One coordinate of the point makes both choices and then, stretched, what is drawn: each choice has
    // points that are spread as well as all are.
    SampleBits bits = hit_random_bits(&hit->random, light);
    const vm by_map = VI_FROM_VU(bits.x) >= (vi)(0);
    bits.x = bits.x << 1;
    const EnvironmentSample drawn = environment_sample(environment, bits);
    const SamplePoint point = sample_point(bits);
    const vf share = pbr_lobe_share(&hit->pbr, hit->ns, to_eye);
    const vf u = point.x < share ? point.x / share : (point.x - share) / (1.0f - share);
    const v3 scattered =
        pbr_sample(&hit->pbr, hit->ns, to_eye, vf_clamp(u, 0.0f, 1.0f - ROUNDING), point.y, point.x);
    const EnvironmentSample seen = environment_look(environment, scattered);
    ray.dir = v3_select(by_map, drawn.dir, scattered);
    ray.length = (vf)(INFINITY);
    const v3 radiance = v3_select(by_map, drawn.radiance, seen.radiance);
    const vf cosine = v3_dot(hit->ns, ray.dir);
    const vm above = v3_dot(hit_horizon(hit), ray.dir) > (vf)(0.0f);
    const vm lit = hit_is_pbr(hit) & (cosine > (vf)(0.0f)) & above;
    const vf by_material = lit ? pbr_pdf(&hit->pbr, hit->ns, to_eye, ray.dir) : (vf)(0.0f);
    const vf density = (by_map ? drawn.density : seen.density) + by_material;
    const vf weight = cosine * (2.0f * light->intensity.x) / (density > (vf)(0.0f) ? density : (vf)(1.0f));
    const v3 brdf = pbr_brdf(&hit->pbr, hit->ns, to_eye, ray.dir);
    const v3 gain = v3_mul(radiance, v3_scale(brdf, weight));
    ray.gain = v3_select(lit & (density > (vf)(0.0f)), gain, v3_splat(0.0f));
    return ray;
}
#endif

// diffuse, ambient: what the hit reflects of lights and of ambient light.
OUTLINE LightRay light_ray(const Hit *hit, const Shading *shading, v3 diffuse, v3 ambient,
                           global const LightRecord *light)
{
    LightRay ray;
    ray.dir = ray.gain = v3_splat(0.0f);
    ray.length = (vf)(0.0f);
#if HAS_OCCLUSION
    if (light->kind == LIGHT_KIND_OCCLUSION)
        return occlusion_ray(hit, ambient, light);
#endif
#if HAS_ENVIRONMENT_LIGHT
    if (light->kind == LIGHT_KIND_ENVIRONMENT)
        return environment_ray(hit, &shading->environment, light);
#endif
#if HAS_DIRECT_LIGHTS
#if HAS_AREA_LIGHTS
    const LightSample sample = light_sample(light, hit->point, hit_random_point(&hit->random, light));
#else
    const LightSample sample = punctual_sample(light, hit->point);
#endif
    ray.dir = sample.dir;
    ray.gain = shade_light(hit, diffuse, &sample);
    ray.length = sample.distance * LIGHT_NEARER;
#if HAS_TERMINATOR
    // From where the ray starts to the same place at the same t.
    const v3 way = v3_sub(hit->raised_point, hit->point);
    const v3 bent = v3_sub(ray.dir, v3_scale(way, (vf)(1.0f) / sample.distance));
    ray.dir = v3_select(hit->raised & (sample.distance > (vf)(0.0f)), bent, ray.dir);
#endif
#endif
    return ray;
}

#endif

#if HAS_SHADOWS
static inline v3 shadow_origin(const Hit *hit)
{
#if HAS_TERMINATOR
    const v3 beside = offset_origin(hit->point, hit->error, hit->ng, hit->ng);
    return v3_select(hit->raised, hit->raised_point, beside);
#else
    return offset_origin(hit->point, hit->error, hit->ng, hit->ng);
#endif
}
#endif

#if !HAS_PATH
// Light of the pass: queued as shadow rays, or added at once where nothing casts shadows. Returns FLAGS.
OUTLINE vi shade_lights(const State *s, const Slots *slots, const Hit *hit, const Shading *shading,
                              global const LightRecord *lights, const LightPass *pass, v3 throughput,
                              v3 *radiance, vm shaded)
{
    vi flags = (vi)(0);
    v3 diffuse = v3_splat(0.0f), ambient = v3_splat(0.0f);
#if HAS_DIRECT_LIGHTS
    diffuse = hit_diffuse(hit, shading);
#endif
#if HAS_OCCLUSION
    ambient = hit_ambient(hit, shading);
#endif
    for (uint l = pass->first; l < pass->last; l++) {
        const LightRay ray = light_ray(hit, shading, diffuse, ambient, &lights[l]);
        const v3 gain = v3_mul(throughput, ray.gain);
        const vm arrives = shaded & ((gain.x > (vf)(0.0f)) | (gain.y > (vf)(0.0f)) | (gain.z > (vf)(0.0f)));
#if HAS_OCCLUSION
        if (lights[l].position.w == 0.0f) { // occlusion is traced where lights cast no shadows, too
            *radiance = v3_select(arrives, v3_add(*radiance, gain), *radiance);
            continue;
        }
#endif
#if HAS_SHADOWS
        const uint fields = SHADOW_LIGHTS + (l - pass->first) * SHADOW_FIELDS;
        flags = flags | (arrives ? (vi)(1 << (l - pass->first)) : (vi)(0));
        state_store3(s, fields + SHADOW_DIR, slots, ray.dir, slots->valid);
        state_store(s, fields + SHADOW_T, slots, ray.length, slots->valid);
        state_store3(s, fields + SHADOW_GAIN, slots, gain, slots->valid);
#else
        *radiance = v3_select(arrives, v3_add(*radiance, gain), *radiance);
#endif
    }
    return flags;
}
#endif
#endif

#include "stages/spawn.h"

#if !HAS_PATH
// Shades the rays of the queue for the lights of one pass.
OUTLINE void shade_hits(const State *s, const Hierarchy *scene, const Shading *shading,
                              global const LightRecord *lights, constant RenderParams *params,
                              const LightPass *pass, uint count, uint *rays)
{
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
#if HAS_SURFACES || HAS_BACKGROUND || HAS_ENVIRONMENT
        const vf t = state_load(s, RAY_T, &slots);
        const vm shaded = slots.valid & (t < (vf)(INFINITY));
        const v3 throughput = state_load3(s, THROUGHPUT, &slots);
#endif
        v3 radiance = state_load3(s, RADIANCE, &slots);
        vi flags = (vi)(0);
#if HAS_BACKGROUND
        if (pass->opening) {
            const v3 back = v3_mul(throughput, v3_from(params->background));
            radiance = v3_select(shaded, radiance, v3_add(radiance, back));
        }
#endif
#if HAS_ENVIRONMENT
        if (pass->opening && !vm_all(shaded)) {
            const v3 back = environment_radiance(&shading->environment, state_load3(s, RAY_DIR, &slots));
            radiance = v3_select(shaded, radiance, v3_add(radiance, v3_mul(throughput, back)));
        }
#endif
#if HAS_SURFACES
        if (vm_any(shaded)) {
            vi instance = (vi)(NO_HIT);
#if HAS_INSTANCES
            instance = state_load_int(s, INSTANCE, &slots);
#endif
            Hit hit = hit_make(scene, shading, state_load3(s, RAY_ORG, &slots),
                                     state_load3(s, RAY_DIR, &slots), t,
                                     state_load_int(s, PRIMITIVE, &slots), instance);
#if HAS_HIT_RANDOM
            hit.random = hit_random(s, &slots);
#endif
#if HAS_PBR
            hit.pbr = hit_pbr(&hit, shading);
#endif
            if (pass->opening) {
                const v3 unlit = v3_mul(throughput, shade_unlit(&hit, shading));
                radiance = v3_select(shaded, v3_add(radiance, unlit), radiance);
#if HAS_SHADOWS
                const vi self = hit.primitive * 2 + (hit.inside ? (vi)(1) : (vi)(0));
                state_store_int(s, SHADOW_SELF, &slots, self, shaded);
                state_store3(s, SHADOW_ORG, &slots, shadow_origin(&hit), shaded);
#endif
            }
#if HAS_LIGHTS
            flags = shade_lights(s, &slots, &hit, shading, lights, pass, throughput, &radiance, shaded);
#endif
#if HAS_REFLECT || HAS_TRANSMIT
            if (pass->closing)
                flags = flags | spawn_rays(s, &slots, &hit, params, throughput, instance, shaded, rays);
#endif
        }
#endif
        state_store3(s, RADIANCE, &slots, radiance, slots.valid);
        state_store_int(s, FLAGS, &slots, flags, slots.valid);
    }
}
#endif

#endif
