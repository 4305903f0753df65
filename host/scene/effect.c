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
}
