#include "scene/support.h"

#include "scene/report.h"

void scene_check_support(const Scene *scene, Diagnostics *diagnostics)
{
    (void)scene;
    (void)diagnostics;
}
