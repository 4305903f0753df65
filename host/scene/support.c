#include "scene/support.h"

#include "scene/report.h"

void scene_check_support(const Scene *scene, Diagnostics *diagnostics)
{
    if (scene->render.integrator == INTEGRATOR_PATH)
        scene_report(scene, diagnostics, SEVERITY_ERROR, scene->render.integrator_at,
                     "'integrator path' is not supported yet");
}
