#include "scene/effect.h"

#include "scene/report.h"

void scene_check_effect(const Scene *scene, Diagnostics *diagnostics)
{
    const RenderSettings *render = &scene->render;
    if (render->integrator != INTEGRATOR_PATH)
        return;
    if (render->ambient_occlusion_at.line > 0)
        scene_report(scene, diagnostics, SEVERITY_WARNING, render->ambient_occlusion_at,
                     "'ambient_occlusion' has no effect with 'integrator path', which has no ambient light");
    if (render->environment_lighting_at.line > 0 && render->environment_lighting == ENVIRONMENT_PREFILTERED)
        scene_report(scene, diagnostics, SEVERITY_WARNING, render->environment_lighting_at,
                     "'prefiltered' has no effect with 'integrator path', which samples the environment");
    for (u32 i = 0; i < scene->shape_count; i++)
        if (scene->shapes[i].kind == SHAPE_MESH && scene->shapes[i].as.mesh.terminator) {
            scene_report(scene, diagnostics, SEVERITY_WARNING, scene->shapes[i].at,
                         "'terminator' has no effect with 'integrator path'");
            return;
        }
}
