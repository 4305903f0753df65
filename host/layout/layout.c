#include "layout/layout.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "layout/environment.h"
#include "layout/filter.h"
#include "layout/hierarchy.h"
#include "layout/lights.h"
#include "layout/place.h"
#include "layout/records.h"
#include "layout/textures.h"

static bool positive(Vec3 v)
{
    return v.x > 0 || v.y > 0 || v.z > 0;
}

// The ambient intensity that a material gets: an environment lights pbr in its place.
static Vec3 ambient_light(const Scene *scene, const Material *material)
{
    const bool lit = material->kind == MATERIAL_PBR && scene->environment.present;
    return lit || scene->render.integrator == INTEGRATOR_PATH ? (Vec3){ 0, 0, 0 } : scene->ambient;
}

// Indices of the textures of a used material that can be seen; returns how many.
static u32 seen_textures(const Scene *scene, const Material *material, bool lights,
                         i32 textures[MATERIAL_TEXTURES_MAX])
{
    const bool mirrors = material_mirrors(material) && scene->render.max_depth > 0;
    const bool lit = lights || (material->kind == MATERIAL_PBR && mirrors);
    return material_textures(material, lit, positive(ambient_light(scene, material)), textures);
}

// Whether some light can shine on surfaces of the material.
static bool material_lit(const Layout *layout, const Material *material)
{
    return layout->path.on || lights_direct(layout) || (material->kind == MATERIAL_PBR && layout->environment);
}

// Features that one used material brings. lights: as material_lit.
static FeatureSet material_features(const Scene *scene, const Material *material, bool lights)
{
    FeatureSet set = 0;
    const bool mirrors = material_mirrors(material), transmits = material_transmits(material);
    const bool pbr = material->kind == MATERIAL_PBR;
    const Vec3 ambient = ambient_light(scene, material);
    const bool deep = scene->render.max_depth > 0;
    i32 textures[MATERIAL_TEXTURES_MAX];
    for (u32 i = seen_textures(scene, material, lights, textures); i-- > 0;)
        set |= texture_features(&scene->textures[textures[i]]);
    if (material->normal_map >= 0)
        set |= feature_bit(FEATURE_NORMAL_MAP) | feature_bit(FEATURE_UV);
    if (positive(ambient) && positive(pbr ? material->base_color.color : material->ambient.color))
        set |= feature_bit(FEATURE_AMBIENT);
    if (positive(material->emission.color))
        set |= feature_bit(FEATURE_EMISSION);
    if (pbr && (lights || (mirrors && deep) || positive(ambient)))
        set |= feature_bit(FEATURE_PBR);
    if (lights && !pbr && positive(material->specular))
        set |= feature_bit(FEATURE_SPECULAR) |
               feature_bit(material->kind == MATERIAL_BLINN_PHONG ? FEATURE_BLINN : FEATURE_PHONG);
    if (deep && (mirrors || transmits))
        set |= feature_bit(FEATURE_REFLECT); // also what transmits: total internal reflection
    if (deep && transmits)
        set |= feature_bit(FEATURE_TRANSMIT);
    if (deep && transmits && mirrors && scene->render.integrator != INTEGRATOR_PATH)
        set |= feature_bit(FEATURE_BRANCHING);
    if (deep && (pbr ? transmits : material->fresnel && (mirrors || transmits)))
        set |= feature_bit(FEATURE_FRESNEL);
    return set;
}

// A background lights surfaces as an environment does.
static PathLayout path_layout(const Scene *scene, const Placer *placer)
{
    const LightSampling sampling = scene->render.light_sampling;
    PathLayout path = { .on = scene->render.integrator == INTEGRATOR_PATH &&
                              (placer->top.count > 0 || placer->planes.count > 0) };
    path.techniques = LIGHTS_BY_LIGHTS | LIGHTS_BY_SURFACES;
    if (sampling == LIGHT_SAMPLING_LIGHTS || !scene->render.shadows)
        path.techniques = LIGHTS_BY_LIGHTS;
    else if (sampling == LIGHT_SAMPLING_SURFACES)
        path.techniques = LIGHTS_BY_SURFACES;
    path.area_materials = scene->material_count;
    return path;
}

static LightUse light_use(const Scene *scene, const Placer *placer)
{
    LightUse use = { false, false };
    for (u32 i = 0; i < scene->material_count; i++) {
        const Material *material = &scene->materials[i];
        if (!placer->material_used[i])
            continue;
        const bool pbr = material->kind == MATERIAL_PBR;
        const ColorInput ambient = pbr ? material->base_color : material->ambient;
        use.pbr = use.pbr || pbr;
        use.ambient = use.ambient || (positive(ambient_light(scene, material)) && positive(ambient.color));
    }
    return use;
}

static FeatureSet filter_features(Filter filter)
{
    switch (filter) {
    case FILTER_TENT: return feature_bit(FEATURE_FILTER_TENT);
    case FILTER_GAUSSIAN: return feature_bit(FEATURE_FILTER_TABLE);
    case FILTER_MITCHELL: return feature_bit(FEATURE_FILTER_TABLE) | feature_bit(FEATURE_FILTER_LOBES);
    default: return 0;
    }
}

// Of a material that lets shadow rays through.
static FeatureSet transmittance_features(const Material *material)
{
    const FeatureSet textured = feature_bit(FEATURE_TRANSMIT_TEXTURE);
    return feature_bit(FEATURE_TRANSMITTANCE) | (material_transmits_textured(material) ? textured : 0);
}

static FeatureSet scene_features(const Scene *scene, const Layout *layout, const Placer *placer)
{
    FeatureSet set = placer->features;
    const bool bounded = placer->top.count > 0, surfaces = bounded || placer->planes.count > 0;
    if (surfaces)
        set |= feature_bit(FEATURE_SURFACES);
    if (bounded)
        set |= feature_bit(FEATURE_BVH);
    if (surfaces)
        set |= lights_features(layout, scene->render.shadows);
    if (layout->path.on)
        set |= feature_bit(FEATURE_PATH) | feature_bit(FEATURE_HIT_RANDOM);
    if (layout->light_table)
        set |= feature_bit(FEATURE_MANY_LIGHTS);
    if (layout->environment)
        set |= feature_bit(FEATURE_ENVIRONMENT);
    if (surfaces && layout->environment_levels)
        set |= feature_bit(FEATURE_PREFILTERED);
    if (features_have(set, FEATURE_SPHERE_LIGHT) || features_have(set, FEATURE_RECTANGLE_LIGHT))
        set |= feature_bit(FEATURE_EMISSION);
    for (u32 i = 0; i < scene->material_count; i++)
        if (placer->material_used[i])
            set |= material_features(scene, &scene->materials[i], material_lit(layout, &scene->materials[i]));
    const bool shadows = scene->render.shadows && lights_shine(layout) && !layout->path.on;
    for (u32 i = 0; shadows && i < scene->material_count; i++)
        if (placer->material_used[i] && material_transmits(&scene->materials[i]))
            set |= transmittance_features(&scene->materials[i]);
    if (!features_have(set, FEATURE_UV))
        set &= ~feature_bit(FEATURE_MESH_UVS);
    // Paths meet lights by rays from the surface itself as well: both have to find the same.
    if (!features_have(set, FEATURE_LIGHTS) || layout->path.on)
        set &= ~feature_bit(FEATURE_TERMINATOR);
    if (positive(scene->background) && !layout->path.on)
        set |= feature_bit(FEATURE_BACKGROUND);
    if (scene->camera.orthographic)
        set |= feature_bit(FEATURE_ORTHOGRAPHIC);
    if (scene->image.samples > 1)
        set |= feature_bit(FEATURE_SAMPLES) | filter_features(scene->image.filter);
    if (scene->camera.aperture > 0)
        set |= feature_bit(FEATURE_APERTURE);
    return set;
}

static bool add_records(Layout *layout, const Scene *scene, const Placer *placer, Error *error)
{
    layout->material_count = scene->material_count + placer->area_lights;
    layout->extra_count = placer->extra_count;
    layout->materials = page_alloc(layout->material_count * sizeof *layout->materials);
    layout->extras = page_alloc(layout->extra_count * sizeof *layout->extras);
    if ((!layout->materials && layout->material_count > 0) ||
        (!layout->extras && layout->extra_count > 0))
        return error_set(error, ERROR_MEMORY, "no memory for materials");
    for (u32 i = 0; i < scene->material_count; i++)
        layout->materials[i] =
            material_record(&scene->materials[i], ambient_light(scene, &scene->materials[i]));
    u32 surface = scene->material_count;
    for (u32 i = 0; i < scene->light_count; i++)
        if (scene->lights[i].kind == LIGHT_SPHERE || scene->lights[i].kind == LIGHT_RECTANGLE)
            layout->materials[surface++] = light_material(&scene->lights[i]);
    if (layout->extra_count > 0)
        memcpy(layout->extras, placer->extras, layout->extra_count * sizeof *layout->extras);
    return true;
}

static bool add_filter(Layout *layout, const Scene *scene, Error *error)
{
    layout->params.filter_ratio = (f32)filter_ratio(scene->image.filter);
    if (!features_have(layout->features, FEATURE_FILTER_TABLE))
        return true;
    layout->quantile_count = FILTER_STEPS + 1;
    layout->quantiles = page_alloc(layout->quantile_count * sizeof *layout->quantiles);
    if (!layout->quantiles)
        return error_set(error, ERROR_MEMORY, "no memory for the pixel filter");
    filter_quantiles(scene->image.filter, layout->quantiles);
    return true;
}

static bool finish(Layout *layout, Error *error)
{
    layout->params.plane_count = layout->plane_count;
    layout->params.root = layout->root;
    layout->params.mesh_run_count = layout->mesh_run_count;
    return lights_finish(layout, error);
}

// Textures, and the texels of those that can be seen.
static bool add_textures(Layout *layout, const Scene *scene, const Placer *placer, Error *error)
{
    bool *used = calloc(scene->texture_count + (size_t)1, sizeof *used);
    if (!used)
        return error_set(error, ERROR_MEMORY, "no memory for %u textures", scene->texture_count);
    for (u32 i = 0; i < scene->material_count; i++) {
        i32 textures[MATERIAL_TEXTURES_MAX];
        if (!placer->material_used[i])
            continue;
        const bool lit = material_lit(layout, &scene->materials[i]);
        for (u32 k = seen_textures(scene, &scene->materials[i], lit, textures); k-- > 0;)
            used[textures[k]] = true;
    }
    const bool ok = textures_add(layout, scene, used, error);
    free(used);
    return ok;
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
        layout->path = path_layout(scene, &placer);
        const LightUse use = light_use(scene, &placer);
        ok = environment_add(layout, scene, use.pbr || layout->path.on, error) &&
             lights_add(layout, scene, use, error);
    }
    if (ok) {
        layout->features = scene_features(scene, layout, &placer);
        ok = add_filter(layout, scene, error) && add_textures(layout, scene, &placer, error) &&
             hierarchies_add(layout, &placer, error) && finish(layout, error);
    }
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
        { "texels", l->texels, l->texel_bytes },
        { "lights", l->lights, l->light_count * sizeof *l->lights },
        { "light_table", l->light_table, l->light_table ? l->light_count * sizeof *l->light_table : 0 },
        { "environment", l->environment, l->environment ? sizeof *l->environment : 0 },
        { "environment_texels", l->environment_texels,
          l->environment_texel_count * sizeof *l->environment_texels },
        { "environment_cdf", l->environment_cdf, l->environment_cdf_count * sizeof *l->environment_cdf },
        { "environment_edges", l->environment_edges,
          l->environment_edge_count * sizeof *l->environment_edges },
        { "environment_guides", l->environment_guides,
          l->environment_guide_count * sizeof *l->environment_guides },
        { "environment_levels", l->environment_levels,
          l->environment_level_count * sizeof *l->environment_levels },
        { "quantiles", l->quantiles, l->quantile_count * sizeof *l->quantiles },
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
