#include "scene/support.h"

#include "scene/report.h"

static void refuse(const Scene *scene, Diagnostics *diagnostics, SourcePos at, bool used, const char *what)
{
    if (used)
        scene_report(scene, diagnostics, SEVERITY_ERROR, at, "%s not supported yet", what);
}

static void check_settings(const Scene *scene, Diagnostics *diagnostics)
{
    const ImageSettings *image = &scene->image;
    refuse(scene, diagnostics, image->filter_at, image->filter != FILTER_BOX && image->samples > 1,
           "filters other than box are");
    refuse(scene, diagnostics, scene->camera.aperture_at, scene->camera.aperture > 0, "'aperture' is");
    refuse(scene, diagnostics, scene->render.integrator_at, scene->render.integrator == INTEGRATOR_PATH,
           "'integrator path' is");
    refuse(scene, diagnostics, scene->render.ambient_occlusion_at,
           scene->render.ambient_occlusion_samples > 0, "'ambient_occlusion' is");
    refuse(scene, diagnostics, scene->environment.at, scene->environment.present, "'environment' is");
}

void scene_check_support(const Scene *scene, Diagnostics *diagnostics)
{
    check_settings(scene, diagnostics);
    for (u32 i = 0; i < scene->light_count; ++i) {
        const Light *light = &scene->lights[i];
        refuse(scene, diagnostics, light->at, light->kind == LIGHT_SPHERE, "sphere lights are");
        refuse(scene, diagnostics, light->at, light->kind == LIGHT_RECTANGLE, "rectangle lights are");
    }
    for (u32 i = 0; i < scene->texture_count; ++i) {
        const Texture *texture = &scene->textures[i];
        refuse(scene, diagnostics, texture->at, texture->kind == TEXTURE_IMAGE, "image textures are");
    }
    for (u32 i = 0; i < scene->material_count; ++i) {
        const Material *material = &scene->materials[i];
        refuse(scene, diagnostics, material->at, material->kind == MATERIAL_PBR, "pbr materials are");
        refuse(scene, diagnostics, material->normal_map_at, material->normal_map >= 0, "'normal_map' is");
    }
}
