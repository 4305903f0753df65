#include "layout/records.h"

#include <math.h>
#include <string.h>

static const f64 pi = 3.14159265358979323846;

static f32x4 f32x4_from(Vec3 v)
{
    return (f32x4){ (f32)v.x, (f32)v.y, (f32)v.z, 0 };
}

static void store3(f32 to[3], Vec3 v)
{
    to[0] = (f32)v.x;
    to[1] = (f32)v.y;
    to[2] = (f32)v.z;
}

// 1 - cos(half of an angle in degrees), without cancellation.
static f64 versine_of_half(f64 degrees)
{
    const f64 s = sin(degrees * pi / 720);
    return 2 * s * s;
}

LightRecord light_record(const Light *light, Vec3 camera)
{
    LightRecord record;
    memset(&record, 0, sizeof record);
    record.intensity = f32x4_from(light->intensity);
    record.attenuation[0] = 1;
    if (light->kind == LIGHT_DIRECTIONAL) {
        record.kind = LIGHT_KIND_DIRECTIONAL;
        record.direction = f32x4_from(vec_normalize(light->direction));
        return record;
    }
    if (light->kind == LIGHT_RECTANGLE) {
        const Vec3 across = vec_cross(light->edge1, light->edge2), n = vec_normalize(across);
        record.kind = LIGHT_KIND_RECTANGLE;
        record.position = f32x4_from(vec_sub(light->position, camera));
        record.direction = f32x4_from(light->edge1);
        record.edge = f32x4_from(light->edge2);
        record.normal = f32x4_from(n);
        record.normal.w = (f32)vec_dot(n, vec_sub(light->position, camera));
        record.size = (f32)vec_length(across);
        return record;
    }
    record.kind = LIGHT_KIND_POINT;
    record.position = f32x4_from(vec_sub(light->position, camera));
    if (light->kind == LIGHT_SPHERE) {
        record.kind = LIGHT_KIND_SPHERE;
        record.size = (f32)light->radius;
        return record;
    }
    for (int k = 0; k < 3; k++)
        record.attenuation[k] = (f32)light->attenuation[k];
    if (light->kind == LIGHT_SPOT) {
        const f64 outer = versine_of_half(light->outer), inner = versine_of_half(light->inner);
        record.kind = LIGHT_KIND_SPOT;
        record.direction = f32x4_from(vec_normalize(vec_sub(light->look_at, light->position)));
        record.versine_outer = (f32)outer;
        record.inverse_range = outer > inner ? (f32)(1 / (outer - inner)) : 0;
    }
    return record;
}

bool material_transmits(const Material *material)
{
    if (material->kind == MATERIAL_PBR)
        return material->pbr_transmit > 0 && (material->metallic.texture >= 0 || material->metallic.value < 1);
    return material->transmit.x > 0 || material->transmit.y > 0 || material->transmit.z > 0;
}

bool material_transmits_textured(const Material *material)
{
    const bool textured = material->base_color.texture >= 0 || material->metallic.texture >= 0;
    return material->kind == MATERIAL_PBR && textured && material_transmits(material);
}

bool material_mirrors(const Material *material)
{
    if (material->kind == MATERIAL_PBR)
        return material->roughness.texture >= 0 || material->roughness.value < 0.02 || material_transmits(material);
    return material->reflect.x > 0 || material->reflect.y > 0 || material->reflect.z > 0;
}

static void set_pbr(MaterialRecord *record, const Material *material, Vec3 ambient_light)
{
    const f64 edge = (material->ior - 1) / (material->ior + 1);
    const f64 metallic = material->metallic.texture >= 0 ? 0 : material->metallic.value;
    const f64 through = material->pbr_transmit * (1 - metallic);
    const Vec3 base = material->base_color.color, ka = base;
    record->flags = MATERIAL_IS_PBR | (material_transmits_textured(material) ? MATERIAL_TRANSMIT_TEXTURE : 0);
    store3(record->diffuse, base);
    store3(record->ambient, (Vec3){ka.x * ambient_light.x, ka.y * ambient_light.y, ka.z * ambient_light.z});
    store3(record->transmit, (Vec3){through * base.x, through * base.y, through * base.z});
    store3(record->specular, (Vec3){0, 0, 0});
    store3(record->reflect, (Vec3){0, 0, 0});
    record->diffuse_texture = record->ambient_texture = material->base_color.texture;
    record->metallic = (f32)material->metallic.value;
    record->roughness = (f32)material->roughness.value;
    record->occlusion = (f32)material->occlusion.value;
    record->metallic_texture = material->metallic.texture;
    record->roughness_texture = material->roughness.texture;
    record->occlusion_texture = material->occlusion.texture;
    record->base_reflectance = (f32)(edge * edge);
    record->pbr_transmit = (f32)material->pbr_transmit;
}

MaterialRecord material_record(const Material *material, Vec3 ambient_light)
{
    MaterialRecord record;
    memset(&record, 0, sizeof record);
    const f64 ior = material->ior;
    const Vec3 ka = material->ambient.color;
    store3(record.diffuse, material->diffuse.color);
    store3(record.specular, material->specular);
    store3(record.ambient,
           (Vec3){ ka.x * ambient_light.x, ka.y * ambient_light.y, ka.z * ambient_light.z });
    store3(record.reflect, material->reflect);
    store3(record.transmit, material->transmit);
    store3(record.emission, material->emission.color);
    record.shininess = (f32)material->shininess;
    record.ior = (f32)ior;
    record.inverse_ior = (f32)(1 / ior);
    // Of the numbers that the device multiplies with, so that near the critical angle nothing disagrees.
    record.eta_in_rest = (f32)(1 - (f64)record.inverse_ior * record.inverse_ior);
    record.eta_out_rest = (f32)(1 - (f64)record.ior * record.ior);
    record.flags = (material->kind == MATERIAL_BLINN_PHONG ? MATERIAL_BLINN : 0) |
                   (material->fresnel ? MATERIAL_FRESNEL : 0);
    record.diffuse_texture = material->diffuse.texture;
    record.ambient_texture = material->ambient.texture;
    record.emission_texture = material->emission.texture;
    record.normal_texture = material->normal_map;
    if (material->kind == MATERIAL_PBR)
        set_pbr(&record, material, ambient_light);
    return record;
}

RenderParams camera_params(const Scene *scene)
{
    RenderParams params;
    memset(&params, 0, sizeof params);
    const Camera *camera = &scene->camera;
    const Vec3 w = vec_normalize(vec_sub(camera->position, camera->look_at));
    const Vec3 u = vec_normalize(vec_cross(vec_normalize(camera->up), w));
    const f64 k = camera->orthographic ? camera->height / 2 : tan(camera->fov * pi / 360);
    params.camera_right = f32x4_from(u);
    params.camera_up = f32x4_from(vec_cross(w, u));
    params.camera_back = f32x4_from(w);
    params.background = f32x4_from(scene->background);
    params.pixel_scale = (f32)(k / scene->image.height);
    params.min_weight = (f32)scene->render.min_weight;
    params.width = params.crop_width = scene->image.width;
    params.height = params.crop_height = scene->image.height;
    params.samples = scene->image.samples;
    params.seed = scene->image.seed;
    params.max_depth = scene->render.max_depth;
    params.aperture = (f32)camera->aperture;
    params.focus_distance = (f32)camera->focus_distance;
    params.root = NO_INDEX;
    return params;
}
