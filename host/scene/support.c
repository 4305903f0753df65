#include "scene/support.h"

#include "scene/report.h"

static void refuse(const Scene *scene, Diagnostics *diagnostics, SourcePos at, bool used, const char *what)
{
    if (used)
        scene_report(scene, diagnostics, SEVERITY_ERROR, at, "%s not supported yet", what);
}

static void check_settings(const Scene *scene, Diagnostics *diagnostics)
{
    refuse(scene, diagnostics, scene->render.integrator_at, scene->render.integrator == INTEGRATOR_PATH,
           "'integrator path' is");
}

void scene_check_support(const Scene *scene, Diagnostics *diagnostics)
{
    check_settings(scene, diagnostics);
}
