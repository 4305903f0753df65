#include "layout/lights.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "layout/light_table.h"
#include "layout/records.h"

// Records of a scene. Many more than anybody waits for.
enum { RECORDS_MAX = 1 << 22 };

static const Feature KIND_FEATURES[LIGHT_KIND_COUNT] = {
    [LIGHT_KIND_POINT] = FEATURE_POINT,           [LIGHT_KIND_DIRECTIONAL] = FEATURE_DIRECTIONAL,
    [LIGHT_KIND_SPOT] = FEATURE_SPOT,             [LIGHT_KIND_SPHERE] = FEATURE_SPHERE_LIGHT,
    [LIGHT_KIND_RECTANGLE] = FEATURE_RECTANGLE_LIGHT, [LIGHT_KIND_OCCLUSION] = FEATURE_OCCLUSION,
    [LIGHT_KIND_ENVIRONMENT] = FEATURE_ENVIRONMENT_LIGHT,
};

static bool bright(const Light *light)
{
    return light->intensity.x > 0 || light->intensity.y > 0 || light->intensity.z > 0;
}

static bool is_area(const Light *light)
{
    return light->kind == LIGHT_SPHERE || light->kind == LIGHT_RECTANGLE;
}

// Records of a light. Paths look for one point of a light at a time, and find area lights by their number.
static u32 light_samples(const Light *light, bool path)
{
    if (is_area(light))
        return path ? 1 : bright(light) ? light->samples : 0;
    return bright(light);
}

static u32 occlusion_samples(const Scene *scene, const Layout *layout, LightUse use)
{
    return use.ambient && !layout->path.on ? scene->render.ambient_occlusion_samples : 0;
}

static u32 environment_samples(const Scene *scene, const Layout *layout)
{
    return layout->environment_cdf ? layout->path.on ? 1 : scene->render.environment_samples : 0;
}

// Puts `samples` copies of the record, which has all but what tells them apart.
static void put(Layout *layout, u32 *count, LightRecord record, u32 samples, u32 *sequence)
{
    if (samples == 0)
        return;
    record.intensity.x = (f32)((f64)record.intensity.x / samples);
    record.intensity.y = (f32)((f64)record.intensity.y / samples);
    record.intensity.z = (f32)((f64)record.intensity.z / samples);
    record.samples = samples;
    record.sequence = (*sequence)++;
    for (u32 k = 0; k < samples; k++) {
        record.sample = k;
        layout->lights[(*count)++] = record;
    }
}

// Puts the records of lights that are area lights, or not.
static void put_lights(Layout *layout, const Scene *scene, bool area, bool punctual, u32 *count, u32 *sequence)
{
    u32 surface = scene->material_count; // material of the next area light's surface
    for (u32 i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        LightRecord record = light_record(light, scene->camera.position);
        record.surface = is_area(light) ? (i32)surface++ : -1;
        record.position.w = scene->render.shadows ? 1 : 0;
        if (is_area(light) ? area : punctual)
            put(layout, count, record, light_samples(light, layout->path.on), sequence);
    }
}

bool lights_add(Layout *layout, const Scene *scene, LightUse use, Error *error)
{
    const u32 occlusion = occlusion_samples(scene, layout, use), sky = environment_samples(scene, layout);
    u64 total = (u64)occlusion + sky;
    for (u32 i = 0; i < scene->light_count; i++)
        total += light_samples(&scene->lights[i], layout->path.on);
    if (total > RECORDS_MAX)
        return error_set(error, ERROR_SCENE, "the lights have %llu samples in all, more than %d",
                         (unsigned long long)total, RECORDS_MAX);
    layout->light_count = layout->params.light_count = (u32)total;
    layout->lights = page_alloc(total * sizeof *layout->lights);
    if (!layout->lights && total > 0)
        return error_set(error, ERROR_MEMORY, "no memory for %llu lights", (unsigned long long)total);
    u32 count = 0, sequence = 0;
    put_lights(layout, scene, true, !layout->path.on, &count, &sequence);
    if (layout->path.on)
        put_lights(layout, scene, false, true, &count, &sequence);
    const LightRecord everywhere = { .position = { 0, 0, 0, scene->render.shadows ? 1 : 0 },
                                     .intensity = { 1, 1, 1, 0 }, .surface = -1 };
    LightRecord record = everywhere;
    record.kind = LIGHT_KIND_ENVIRONMENT;
    put(layout, &count, record, sky, &sequence);
    record = everywhere;
    record.kind = LIGHT_KIND_OCCLUSION;
    record.position.w = 1;
    record.size = (f32)scene->render.ambient_occlusion_distance;
    put(layout, &count, record, occlusion, &sequence);
    return !layout->path.on || light_table_plan(layout, error);
}

bool lights_direct(const Layout *layout)
{
    for (u32 i = 0; i < layout->light_count; i++)
        if (layout->lights[i].kind <= LIGHT_KIND_RECTANGLE)
            return true;
    return false;
}

bool lights_shine(const Layout *layout)
{
    for (u32 i = 0; i < layout->light_count; i++)
        if (layout->lights[i].kind != LIGHT_KIND_OCCLUSION)
            return true;
    return false;
}

FeatureSet lights_features(const Layout *layout, bool shadows)
{
    FeatureSet set = 0;
    for (u32 i = 0; i < layout->light_count; i++) {
        const LightRecord *light = &layout->lights[i];
        set |= feature_bit(FEATURE_LIGHTS) | feature_bit(KIND_FEATURES[light->kind]);
        if (shadows || light->kind == LIGHT_KIND_OCCLUSION)
            set |= feature_bit(FEATURE_SHADOWS);
        if (light->kind >= LIGHT_KIND_SPHERE)
            set |= feature_bit(FEATURE_HIT_RANDOM);
    }
    return set;
}

static bool plane_holds(const Primitive *plane, f64 x, f64 y, f64 z)
{
    const f64 a = (f64)plane->row2.x * x, b = (f64)plane->row2.y * y, c = (f64)plane->row2.z * z;
    const f64 size = fabs(a) + fabs(b) + fabs(c) + fabs((f64)plane->p0);
    return fabs(a + b + c - (f64)plane->p0) <= 2 * FLT_EPSILON * size;
}

// Whether all of the light lies on the plane, within the rounding of both to float.
static bool light_lies_on(const LightRecord *light, const Primitive *plane)
{
    const f32x4 p = light->position, a = light->direction, b = light->edge;
    if (light->kind == LIGHT_KIND_RECTANGLE)
        return plane_holds(plane, p.x, p.y, p.z) && plane_holds(plane, p.x + a.x, p.y + a.y, p.z + a.z) &&
               plane_holds(plane, p.x + b.x, p.y + b.y, p.z + b.z);
    return (light->kind == LIGHT_KIND_POINT || light->kind == LIGHT_KIND_SPOT) &&
           plane_holds(plane, p.x, p.y, p.z);
}

// The primitive that has a material for itself.
static i32 primitive_of_material(const Layout *layout, u32 material)
{
    for (u32 i = 0; i < layout->primitive_count; i++)
        if ((layout->primitives[i].kind & PRIMITIVE_KIND_MASK) != PRIMITIVE_INSTANCE &&
            layout->infos[i].material == material)
            return (i32)i;
    return -1;
}

bool lights_finish(Layout *layout, Error *error)
{
    for (u32 i = 0; i < layout->light_count; i++) {
        LightRecord *light = &layout->lights[i];
        if (light->sample > 0) { // as that of the sample before
            light->planes = light[-1].planes;
            light->surface = light[-1].surface;
            continue;
        }
        for (u32 k = 0; k < layout->plane_count && k < 32; k++)
            if (light_lies_on(light, &layout->primitives[k]))
                light->planes |= 1u << k;
        if (light->surface >= 0)
            light->surface = primitive_of_material(layout, (u32)light->surface);
    }
    return !layout->light_table || light_table_fill(layout, error);
}

MaterialRecord light_material(const Light *light)
{
    const Material black = { .kind = MATERIAL_PHONG,
                             .ior = 1,
                             .shininess = 1,
                             .emission = { light->intensity, -1 },
                             .ambient.texture = -1,
                             .diffuse.texture = -1,
                             .base_color.texture = -1,
                             .metallic.texture = -1,
                             .roughness.texture = -1,
                             .occlusion.texture = -1,
                             .normal_map = -1 };
    MaterialRecord record = material_record(&black, (Vec3){ 0, 0, 0 });
    record.flags |= MATERIAL_ONE_SIDED;
    return record;
}
