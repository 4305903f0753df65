// Support: what the language has and the renderer does not draw yet. A line goes when its feature comes.
#ifndef CLRT_SCENE_SUPPORT_H
#define CLRT_SCENE_SUPPORT_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

// Adds an error for each thing in the scene that would make a wrong picture. scene_parse does this for a
// scene without errors; who changes the settings of a scene afterwards does it again.
void scene_check_support(const Scene *scene, Diagnostics *diagnostics);

#endif
