#include "budget/bounds.h"

#include <math.h>
#include <stdlib.h>

#include "budget/nearest.h"
#include "layout/records.h"

// For what rounding adds to radiance on a device.
#define MARGIN (1 + 1e-5)

// What a used material adds at a hit, and passes on, in one channel.
typedef struct Weights {
    f64 direct;           // emission, ambient and all lights together
    f64 reflect, transmit;
    f64 total;            // of the rays that follow a hit
} Weights;

static f64 channel(Vec3 v, u32 c)
{
    return c == 0 ? v.x : c == 1 ? v.y : v.z;
}

// Why the brightness of this scene is not bounded by rules known here; NULL where it is.
static const char *unknown_setting(const Scene *scene)
{
    if (scene->environment.present)
        return "an environment map";
    if (scene->image.samples > 1 && scene->image.filter == FILTER_MITCHELL)
        return "a filter with negative weights";
    for (u32 i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        if (light->kind != LIGHT_POINT && light->kind != LIGHT_DIRECTIONAL && light->kind != LIGHT_SPOT)
            return "area lights";
    }
    return NULL;
}

// One byte a material: whether a ray can meet it. NULL without memory: then all count.
static bool *used_materials(const Scene *scene, const Layout *layout)
{
    bool *used = calloc(scene->material_count ? scene->material_count : 1, sizeof *used);
    if (!used)
        return NULL;
    for (u32 i = 0; i < layout->primitive_count + layout->mesh_run_count; i++) {
        const bool of_mesh = i >= layout->primitive_count;
        const u32 named = of_mesh ? layout->mesh_runs[i - layout->primitive_count].material
                                  : layout->infos[i].material;
        const u32 index = named & ~MATERIAL_INHERITED;
        if (named != NO_INDEX && index < scene->material_count)
            used[index] = true;
    }
    return used;
}

// Images of levels are at most 1, decoded and filtered too; those of floats may hold anything.
static f64 greatest_texel(const Texture *texture, u32 c)
{
    if (texture->kind == TEXTURE_CHECKER || texture->kind == TEXTURE_CHECKER3D)
        return fmax(channel(texture->colors[0], c), channel(texture->colors[1], c));
    const Bitmap *bitmap = texture->kind == TEXTURE_IMAGE ? texture->bitmap : NULL;
    return bitmap && (bitmap->type == BITMAP_U8 || bitmap->type == BITMAP_U16) ? 1 : INFINITY;
}

// Product in which 0 wins over infinity: what is not there adds nothing.
static f64 times(f64 a, f64 b)
{
    return a == 0 || b == 0 ? 0 : a * b;
}

// The texture scales the color.
static f64 greatest_input(const Scene *scene, const ColorInput *input, u32 c)
{
    const f64 color = channel(input->color, c);
    return input->texture < 0 ? color : times(greatest_texel(&scene->textures[input->texture], c), color);
}

// Gain of each light where it is greatest; NULL without memory.
static f64 *greatest_gains(const Scene *scene, const Layout *layout)
{
    f64 *gains = calloc((size_t)scene->light_count + 1, sizeof *gains);
    for (u32 i = 0; gains && i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        const f64 *k = light->attenuation;
        gains[i] = 1;
        if (light->kind == LIGHT_DIRECTIONAL)
            continue;
        const f64 d = nearest_surface(layout, vec_sub(light->position, scene->camera.position));
        const f64 fall = isinf(d) ? INFINITY : k[0] + k[1] * d + k[2] * d * d;
        gains[i] = fall > 0 ? 1 / fall : INFINITY;
    }
    return gains;
}

static f64 greatest_irradiance(const Scene *scene, const f64 *gains, u32 c)
{
    f64 sum = 0;
    for (u32 i = 0; i < scene->light_count; i++)
        sum += times(channel(scene->lights[i].intensity, c), gains ? gains[i] : INFINITY);
    return sum;
}

static bool is_phong(const Material *material)
{
    return material->kind == MATERIAL_PHONG || material->kind == MATERIAL_BLINN_PHONG;
}

// A narrow lobe of pbr is as bright as it likes; what it mirrors and lets through is at most all.
static Weights weights_of_pbr(const Material *material)
{
    const bool mirrors = material_mirrors(material), transmits = material_transmits(material);
    return (Weights){.direct = INFINITY, .reflect = mirrors, .transmit = transmits, .total = mirrors || transmits};
}

static Weights weights_of(const Scene *scene, const Material *material, f64 irradiance, u32 c)
{
    if (!is_phong(material))
        return weights_of_pbr(material);
    const f64 lit = greatest_input(scene, &material->diffuse, c) + channel(material->specular, c);
    const f64 ambient = times(greatest_input(scene, &material->ambient, c), channel(scene->ambient, c));
    Weights w = {.reflect = channel(material->reflect, c), .transmit = channel(material->transmit, c)};
    w.direct = greatest_input(scene, &material->emission, c) + ambient + times(lit, irradiance);
    w.total = material->fresnel ? fmax(w.reflect, w.transmit) : w.reflect + w.transmit;
    return w;
}

// The numbers of one channel, over all used materials.
typedef struct Channel {
    f64 radiance;    // L(max_depth)
    f64 before;      // L(max_depth - 1), of rays that follow one; 0 where there are none
    f64 limit;       // L(infinity)
    f64 weight;      // greatest total
    f64 least;       // smallest weight of a ray in this channel, of those that are traced in any
} Channel;

// Light may pass surfaces that make it stronger: its irradiance then has no bound.
static f64 irradiance_of(const Scene *scene, const bool *used, const f64 *gains, u32 c)
{
    for (u32 i = 0; scene->render.shadows && i < scene->material_count; i++)
        if ((!used || used[i]) && channel(scene->materials[i].transmit, c) > 1 && scene->light_count > 0)
            return INFINITY;
    return greatest_irradiance(scene, gains, c);
}

// L(depth), or its limit; limit: where no material passes on all, each meets its own at direct / (1 - total).
static Channel bound_channel(const Scene *scene, const bool *used, const f64 *gains, u32 c)
{
    const f64 background = channel(scene->background, c), irradiance = irradiance_of(scene, used, gains, c);
    Channel bound = {.radiance = background, .limit = background, .least = INFINITY};
    for (u32 depth = 0; depth <= scene->render.max_depth; depth++) {
        const f64 before = depth ? bound.radiance : 0;
        f64 most = background;
        for (u32 i = 0; i < scene->material_count; i++) {
            const Material *material = &scene->materials[i];
            if (used && !used[i])
                continue;
            const Weights w = weights_of(scene, material, irradiance, c);
            const bool varying = material->fresnel || !is_phong(material); // with the angle, down to 0
            most = fmax(most, w.direct + times(w.total, before));
            bound.limit = fmax(bound.limit, w.total < 1 ? w.direct / (1 - w.total) : INFINITY);
            bound.weight = fmax(bound.weight, w.total);
            if (material_mirrors(material))
                bound.least = fmin(bound.least, varying ? 0 : w.reflect);
            if (material_transmits(material))
                bound.least = fmin(bound.least, varying ? 0 : w.transmit);
        }
        bound.before = before;
        bound.radiance = most;
    }
    return bound;
}

static bool branches(const Scene *scene, const bool *used)
{
    for (u32 i = 0; i < scene->material_count; i++)
        if ((!used || used[i]) && material_mirrors(&scene->materials[i]) && material_transmits(&scene->materials[i]))
            return true;
    return false;
}

static f64 depth_bound(const Channel *bound, u32 max_depth)
{
    if (bound->weight == 0)
        return 0;
    return bound->weight < 1 ? pow(bound->weight, max_depth + 1.0) * bound->limit : INFINITY;
}

// Each ray that is cut off had a weight below min_weight; on one way there is one, in a tree of depth D at
// most 2^D; and all of them together weigh no more than what was passed on.
static f64 weight_bound(const Channel *bound, const RenderSettings *render, bool branching)
{
    const f64 depth = render->max_depth;
    const f64 rays = branching ? exp2(depth) : 1;
    const f64 passed = fmax(bound->weight, pow(bound->weight, depth));
    return times(fmin(rays * render->min_weight, passed), bound->before);
}

// ---- paths ----------------------------------------------------------------------------------

static bool is_area_light(const Light *light)
{
    return light->kind == LIGHT_SPHERE || light->kind == LIGHT_RECTANGLE;
}

// The most that a highlight of weight 1 passes on of light from everywhere: seen along the normal. Of phong it is
// all; of blinn_phong up to 7.6 % more. pbr has no bound below 1.
static f64 highlight_albedo(const Material *material)
{
    const f64 n = material->shininess;
    return material->kind == MATERIAL_PHONG ? 1 : (n + 8) * (n + exp2(-n / 2)) / ((n + 2) * (n + 4));
}

// The greatest weight of all that is gathered at a hit.
static f64 path_weight(const Scene *scene, const Material *material, u32 c)
{
    if (!is_phong(material))
        return INFINITY;
    const f64 clear = weights_of(scene, material, 0, c).total;
    return greatest_input(scene, &material->diffuse, c) + channel(material->specular, c) * highlight_albedo(material) +
           clear;
}

// What point, spot and directional lights make of the material where it is brightest.
static f64 path_peak(const Scene *scene, const Material *material, const f64 *gains, u32 c)
{
    const f64 n = material->shininess, highlight = material->kind == MATERIAL_PHONG ? (n + 2) / 2 : (n + 8) / 8;
    f64 brdf = INFINITY, sum = 0;
    if (is_phong(material))
        brdf = greatest_input(scene, &material->diffuse, c) + channel(material->specular, c) * highlight;
    for (u32 i = 0; i < scene->light_count; i++)
        if (!is_area_light(&scene->lights[i]))
            sum += times(channel(scene->lights[i].intensity, c), gains ? gains[i] : INFINITY);
    return times(brdf, sum);
}

// The brightest light that comes to a hit from one direction and was not scattered before. Lights that nothing hides
// shine through each other.
static f64 path_source(const Scene *scene, const Layout *layout, const bool *used, u32 c)
{
    f64 lights = 0, emission = 0, sky = 0;
    for (u32 i = 0; i < scene->light_count; i++)
        if (is_area_light(&scene->lights[i])) {
            const f64 light = channel(scene->lights[i].intensity, c);
            lights = scene->render.shadows ? fmax(lights, light) : lights + light;
        }
    for (u32 i = 0; i < scene->material_count; i++)
        if (!used || used[i])
            emission = fmax(emission, greatest_input(scene, &scene->materials[i].emission, c));
    for (u64 i = c; i < layout->environment_texel_count; i += 3)
        sky = fmax(sky, (f64)layout->environment_texels[i]);
    return scene->render.shadows ? fmax(fmax(lights, emission), sky) : lights + emission + sky;
}

// Light that is scattered more than max_depth times before it comes to the hit that the camera sees, or once more
// there: w^(max_depth + 1) of what shines, the same again and so on.
static f64 path_depth_bound(const Scene *scene, const Layout *layout, const bool *used, const f64 *gains, u32 c)
{
    f64 weight = 0, peak = 0;
    for (u32 i = 0; i < scene->material_count; i++)
        if (!used || used[i]) {
            weight = fmax(weight, path_weight(scene, &scene->materials[i], c));
            peak = fmax(peak, path_peak(scene, &scene->materials[i], gains, c));
        }
    const f64 shines = path_source(scene, layout, used, c) + peak;
    const f64 lobes = scene->image.samples > 1 ? (f64)layout->params.filter_ratio : 1;
    const f64 passed = weight < 1 ? pow(weight, scene->render.max_depth + 1.0) / (1 - weight) : INFINITY;
    return times(passed, shines) * lobes;
}

static SceneBounds path_bounds(const Scene *scene, const Layout *layout, const bool *used, const f64 *gains)
{
    SceneBounds bounds = {.radiance = {INFINITY, INFINITY, INFINITY}, .unbounded = "paths of any weight"};
    for (u32 c = 0; c < 3; c++)
        bounds.depth = fmax(bounds.depth, path_depth_bound(scene, layout, used, gains, c));
    return bounds;
}

// ---- both -----------------------------------------------------------------------------------

static SceneBounds ray_bounds(const Scene *scene, const bool *used, const f64 *gains)
{
    SceneBounds bounds = {.unbounded = unknown_setting(scene)};
    const RenderSettings *render = &scene->render;
    const bool branching = branches(scene, used);
    bool cut = render->max_depth > 0 && render->min_weight > 0;
    for (u32 c = 0; c < 3; c++) {
        Channel bound = bound_channel(scene, used, gains, c);
        cut = cut && !(pow(bound.least, render->max_depth) >= render->min_weight * MARGIN);
        if (bounds.unbounded)
            bound.radiance = bound.limit = bound.before = INFINITY;
        bounds.radiance[c] = bound.radiance * MARGIN;
        bounds.depth = fmax(bounds.depth, depth_bound(&bound, render->max_depth));
        bounds.min_weight = fmax(bounds.min_weight, weight_bound(&bound, render, branching));
        if (!bounds.unbounded && !isfinite(bound.radiance))
            bounds.unbounded = "a light at a surface, or a material without a known bound";
    }
    if (!cut)
        bounds.min_weight = 0;
    return bounds;
}

SceneBounds scene_bounds(const Scene *scene, const Layout *layout)
{
    bool *used = used_materials(scene, layout);
    f64 *gains = greatest_gains(scene, layout);
    const SceneBounds bounds =
        layout->path.on ? path_bounds(scene, layout, used, gains) : ray_bounds(scene, used, gains);
    free(used);
    free(gains);
    return bounds;
}
