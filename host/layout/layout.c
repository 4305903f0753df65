#include "layout/layout.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "layout/hierarchy.h"
#include "layout/place.h"
#include "layout/records.h"

static bool positive(Vec3 v)
{
    return v.x > 0 || v.y > 0 || v.z > 0;
}

// Features that one used material brings.
static FeatureSet material_features(const Scene *scene, const Material *material, bool lights)
{
    FeatureSet set = 0;
    const bool mirrors = positive(material->reflect), transmits = positive(material->transmit);
    const bool deep = scene->render.max_depth > 0;
    const ColorInput inputs[2] = { material->diffuse, material->ambient };
    const bool seen[2] = { lights, positive(scene->ambient) };
    for (int k = 0; k < 2; k++) {
        if (!seen[k] || inputs[k].texture < 0)
            continue;
        const bool solid = scene->textures[inputs[k].texture].kind == TEXTURE_CHECKER3D;
        set |= solid ? feature_bit(FEATURE_CHECKER3D)
                     : feature_bit(FEATURE_CHECKER) | feature_bit(FEATURE_UV);
    }
    if (seen[1] && (material->ambient.texture >= 0 || positive(material->ambient.color)))
        set |= feature_bit(FEATURE_AMBIENT);
    if (positive(material->emission.color))
        set |= feature_bit(FEATURE_EMISSION);
    if (lights && positive(material->specular))
        set |= feature_bit(FEATURE_SPECULAR) |
               feature_bit(material->kind == MATERIAL_BLINN_PHONG ? FEATURE_BLINN : FEATURE_PHONG);
    if (lights && transmits && scene->render.shadows)
        set |= feature_bit(FEATURE_TRANSMITTANCE);
    if (deep && (mirrors || transmits))
        set |= feature_bit(FEATURE_REFLECT); // also what transmits: total internal reflection
    if (deep && transmits)
        set |= feature_bit(FEATURE_TRANSMIT);
    if (deep && transmits && mirrors)
        set |= feature_bit(FEATURE_BRANCHING);
    if (deep && material->fresnel && (mirrors || transmits))
        set |= feature_bit(FEATURE_FRESNEL);
    return set;
}

static FeatureSet scene_features(const Scene *scene, const Layout *layout, const Placer *placer)
{
    static const Feature light_features[] = { [LIGHT_KIND_POINT] = FEATURE_POINT,
                                              [LIGHT_KIND_DIRECTIONAL] = FEATURE_DIRECTIONAL,
                                              [LIGHT_KIND_SPOT] = FEATURE_SPOT };
    FeatureSet set = placer->features;
    const bool bounded = placer->top.count > 0, surfaces = bounded || placer->planes.count > 0;
    const bool lights = surfaces && layout->light_count > 0;
    if (surfaces)
        set |= feature_bit(FEATURE_SURFACES);
    if (bounded)
        set |= feature_bit(FEATURE_BVH);
    for (u32 i = 0; lights && i < layout->light_count; i++)
        set |= feature_bit(FEATURE_LIGHTS) | feature_bit(light_features[layout->lights[i].kind]);
    if (lights && scene->render.shadows)
        set |= feature_bit(FEATURE_SHADOWS);
    for (u32 i = 0; i < scene->material_count; i++)
        if (placer->material_used[i])
            set |= material_features(scene, &scene->materials[i], lights);
    if (!features_have(set, FEATURE_UV))
        set &= ~feature_bit(FEATURE_MESH_UVS);
    if (positive(scene->background))
        set |= feature_bit(FEATURE_BACKGROUND);
    if (scene->camera.orthographic)
        set |= feature_bit(FEATURE_ORTHOGRAPHIC);
    if (scene->image.samples > 1)
        set |= feature_bit(FEATURE_SAMPLES);
    return set;
}

// Bits of the planes (of the first 32) that the light lies on, within the rounding of both to float.
static u32 planes_of_light(const Layout *layout, const LightRecord *light)
{
    u32 planes = 0;
    for (u32 i = 0; i < layout->plane_count && i < 32 && light->kind != LIGHT_KIND_DIRECTIONAL; i++) {
        const Primitive *plane = &layout->primitives[i];
        const f64 x = (f64)plane->row2.x * light->position.x, y = (f64)plane->row2.y * light->position.y;
        const f64 z = (f64)plane->row2.z * light->position.z;
        const f64 size = fabs(x) + fabs(y) + fabs(z) + fabs((f64)plane->p0);
        if (fabs(x + y + z - plane->p0) <= 2 * FLT_EPSILON * size)
            planes |= 1u << i;
    }
    return planes;
}

static u32 bright_lights(const Scene *scene)
{
    u32 count = 0;
    for (u32 i = 0; i < scene->light_count; i++)
        count += positive(scene->lights[i].intensity);
    return count;
}

static bool add_records(Layout *layout, const Scene *scene, const Placer *placer, Error *error)
{
    layout->material_count = scene->material_count;
    layout->texture_count = scene->texture_count;
    layout->light_count = layout->params.light_count = bright_lights(scene); // a dark light is none
    layout->extra_count = placer->extra_count;
    layout->materials = page_alloc(layout->material_count * sizeof *layout->materials);
    layout->textures = page_alloc(layout->texture_count * sizeof *layout->textures);
    layout->lights = page_alloc(layout->light_count * sizeof *layout->lights);
    layout->extras = page_alloc(layout->extra_count * sizeof *layout->extras);
    if ((!layout->materials && layout->material_count > 0) ||
        (!layout->textures && layout->texture_count > 0) || (!layout->lights && layout->light_count > 0) ||
        (!layout->extras && layout->extra_count > 0))
        return error_set(error, ERROR_MEMORY, "no memory for materials and lights");
    for (u32 i = 0; i < scene->material_count; i++)
        layout->materials[i] = material_record(&scene->materials[i], scene->ambient);
    for (u32 i = 0; i < scene->texture_count; i++)
        layout->textures[i] = texture_record(&scene->textures[i]);
    u32 light = 0;
    for (u32 i = 0; i < scene->light_count; i++)
        if (positive(scene->lights[i].intensity))
            layout->lights[light++] = light_record(&scene->lights[i], scene->camera.position);
    if (layout->extra_count > 0)
        memcpy(layout->extras, placer->extras, layout->extra_count * sizeof *layout->extras);
    return true;
}

static void finish(Layout *layout)
{
    for (u32 i = 0; i < layout->light_count; i++)
        layout->lights[i].planes = planes_of_light(layout, &layout->lights[i]);
    layout->params.plane_count = layout->plane_count;
    layout->params.root = layout->root;
    layout->params.mesh_run_count = layout->mesh_run_count;
}

Layout *layout_create(const Scene *scene, Error *error)
{
    Placer placer;
    Layout *layout = calloc(1, sizeof *layout);
    if (!layout) {
        error_set(error, ERROR_MEMORY, "no memory for the layout of the scene");
        return NULL;
    }
    layout->params = camera_params(scene);
    layout->root = NO_INDEX;
    bool ok = placer_run(&placer, scene, error) && add_records(layout, scene, &placer, error);
    if (ok) {
        layout->features = scene_features(scene, layout, &placer);
        ok = hierarchies_add(layout, &placer, error);
    }
    if (ok)
        finish(layout);
    placer_destroy(&placer);
    if (!ok) {
        layout_destroy(layout);
        return NULL;
    }
    return layout;
}

void layout_arrays(const Layout *layout, LayoutArray arrays[LAYOUT_ARRAYS])
{
    const Layout *l = layout;
    const LayoutArray all[LAYOUT_ARRAYS] = {
        { "primitives", l->primitives, l->primitive_count * sizeof *l->primitives },
        { "infos", l->infos, l->primitive_count * sizeof *l->infos },
        { "frames", l->frames, l->frame_count * sizeof *l->frames },
        { "nodes", l->nodes, l->node_count * sizeof *l->nodes },
        { "blocks", l->blocks, l->block_count * sizeof *l->blocks },
        { "mesh_runs", l->mesh_runs, l->mesh_run_count * sizeof *l->mesh_runs },
        { "mesh_indices", l->mesh_indices, l->mesh_index_count * sizeof *l->mesh_indices },
        { "mesh_normals", l->mesh_normals, l->mesh_normal_count * sizeof *l->mesh_normals },
        { "mesh_uvs", l->mesh_uvs, l->mesh_uv_count * sizeof *l->mesh_uvs },
        { "extras", l->extras, l->extra_count * sizeof *l->extras },
        { "materials", l->materials, l->material_count * sizeof *l->materials },
        { "textures", l->textures, l->texture_count * sizeof *l->textures },
        { "lights", l->lights, l->light_count * sizeof *l->lights },
    };
    memcpy(arrays, all, sizeof all);
}

void layout_destroy(Layout *layout)
{
    if (!layout)
        return;
    LayoutArray arrays[LAYOUT_ARRAYS];
    layout_arrays(layout, arrays);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        page_free(arrays[i].data, arrays[i].bytes);
    free(layout);
}
