// Effect: what a scene says that changes nothing in its picture. Knows the rules of the language, not who draws.
#ifndef CLRT_SCENE_EFFECT_H
#define CLRT_SCENE_EFFECT_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

// Adds a warning for each setting of the file that the scene's integrator does not look at. For scenes without
// errors, once their settings are final.
void scene_check_effect(const Scene *scene, Diagnostics *diagnostics);

#endif
