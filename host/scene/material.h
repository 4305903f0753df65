// The material that serves where none is named.
#ifndef CLRT_SCENE_MATERIAL_H
#define CLRT_SCENE_MATERIAL_H

#include "scene/scene.h"

// `default`, which is also what a material's properties are where it does not give them.
Material material_default(void);

#endif
