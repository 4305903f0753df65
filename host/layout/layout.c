#include "layout/layout.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
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
    const bool surfaces = layout->primitive_count > 0, lights = surfaces && layout->light_count > 0;
    if (surfaces)
        set |= feature_bit(FEATURE_SURFACES);
    if (layout->node_count > 0)
        set |= feature_bit(FEATURE_BVH);
    for (u32 i = 0; lights && i < layout->light_count; i++)
        set |= feature_bit(FEATURE_LIGHTS) | feature_bit(light_features[layout->lights[i].kind]);
    if (lights && scene->render.shadows)
        set |= feature_bit(FEATURE_SHADOWS);
    for (u32 i = 0; i < scene->material_count; i++)
        if (placer->material_used[i])
            set |= material_features(scene, &scene->materials[i], lights);
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

static bool add_records(Layout *layout, const Scene *scene, Error *error)
{
    layout->materials = calloc(scene->material_count + 1, sizeof *layout->materials);
    layout->textures = calloc(scene->texture_count + 1, sizeof *layout->textures);
    layout->lights = calloc(scene->light_count + 1, sizeof *layout->lights);
    if (!layout->materials || !layout->textures || !layout->lights)
        return error_set(error, ERROR_MEMORY, "no memory for materials and lights");
    for (u32 i = 0; i < scene->material_count; i++)
        layout->materials[layout->material_count++] = material_record(&scene->materials[i], scene->ambient);
    for (u32 i = 0; i < scene->texture_count; i++)
        layout->textures[layout->texture_count++] = texture_record(&scene->textures[i]);
    for (u32 i = 0; i < scene->light_count; i++)
        if (positive(scene->lights[i].intensity)) // a dark light is none
            layout->lights[layout->light_count++] = light_record(&scene->lights[i], scene->camera.position);
    layout->params.light_count = layout->light_count;
    return true;
}

// Builds the hierarchy of a list and appends its nodes and primitives to the layout.
static bool append_hierarchy(Layout *layout, PrimitiveList *list, u32 *root, Error *error)
{
    Bvh bvh = { .nodes = NULL };
    const f64 start = clock_seconds();
    if (!bvh_build(list->boxes, list->count, layout->node_count, layout->primitive_count, &bvh, error))
        return false;
    layout->build_seconds += clock_seconds() - start;
    BvhNode *nodes = realloc(layout->nodes, (layout->node_count + (size_t)bvh.node_count) * sizeof *nodes);
    layout->nodes = nodes ? nodes : layout->nodes;
    const bool ok = nodes && primitive_list_sort(list, bvh.order, error);
    if (ok)
        memcpy(nodes + layout->node_count, bvh.nodes, bvh.node_count * sizeof *nodes);
    else if (!nodes)
        error_set(error, ERROR_MEMORY, "no memory for %u nodes of the hierarchy", bvh.node_count);
    *root = layout->node_count;
    layout->node_count += ok ? bvh.node_count : 0;
    layout->primitive_count += ok ? list->count : 0;
    bvh_destroy(&bvh);
    return ok;
}

// Copies a list to the place in the layout's arrays that starts at *next.
static void copy_list(Layout *layout, const PrimitiveList *list, u32 *next)
{
    if (list->count == 0)
        return;
    memcpy(layout->primitives + *next, list->primitives, list->count * sizeof *list->primitives);
    memcpy(layout->infos + *next, list->infos, list->count * sizeof *list->infos);
    if (list->with_frames)
        memcpy(layout->frames + *next, list->frames, list->count * sizeof *list->frames);
    *next += list->count;
}

// Gives INSTANCE primitives the root node of their object in place of its index.
static void link_instances(PrimitiveList *top, const ObjectLayout *objects)
{
    for (u32 i = 0; i < top->count; i++) {
        if (top->primitives[i].kind == PRIMITIVE_INSTANCE) {
            u32 object;
            memcpy(&object, &top->primitives[i].p0, sizeof object);
            memcpy(&top->primitives[i].p0, &objects[object].root, sizeof object);
        }
    }
}

static bool add_primitives(Layout *layout, const Scene *scene, Placer *placer, Error *error)
{
    layout->plane_count = layout->primitive_count = placer->planes.count;
    if (placer->top.count > 0 && !append_hierarchy(layout, &placer->top, &layout->root, error))
        return false;
    for (u32 i = 0; i < scene->object_count; i++) {
        ObjectLayout *object = &placer->objects[i];
        if (object->listed && !append_hierarchy(layout, &object->list, &object->root, error))
            return false;
    }
    link_instances(&placer->top, placer->objects);
    const size_t count = layout->primitive_count + (size_t)1;
    layout->primitives = malloc(count * sizeof *layout->primitives);
    layout->infos = malloc(count * sizeof *layout->infos);
    layout->frames = placer->solid ? malloc(count * sizeof *layout->frames) : NULL;
    if (!layout->primitives || !layout->infos || (placer->solid && !layout->frames))
        return error_set(error, ERROR_MEMORY, "no memory for %u primitives", layout->primitive_count);
    u32 next = 0;
    copy_list(layout, &placer->planes, &next);
    copy_list(layout, &placer->top, &next);
    for (u32 i = 0; i < scene->object_count; i++)
        copy_list(layout, &placer->objects[i].list, &next);
    for (u32 i = 0; i < layout->light_count; i++)
        layout->lights[i].planes = planes_of_light(layout, &layout->lights[i]);
    layout->params.plane_count = layout->plane_count;
    layout->params.root = layout->root;
    return true;
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
    const bool ok = placer_run(&placer, scene, error) && add_records(layout, scene, error) &&
                    add_primitives(layout, scene, &placer, error);
    if (ok) {
        layout->features = scene_features(scene, layout, &placer);
        layout->extras = placer.extras;
        layout->extra_count = placer.extra_count;
        placer.extras = NULL;
    }
    placer_destroy(&placer);
    if (!ok) {
        layout_destroy(layout);
        return NULL;
    }
    return layout;
}

void layout_destroy(Layout *layout)
{
    if (!layout)
        return;
    free(layout->primitives);
    free(layout->infos);
    free(layout->frames);
    free(layout->nodes);
    free(layout->extras);
    free(layout->materials);
    free(layout->textures);
    free(layout->lights);
    free(layout);
}
