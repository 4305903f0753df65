// The lights of a scene as records, one for each shadow ray of a hit, and what they ask of programs. Area lights
// are surfaces as well; those are the placer's.
#ifndef CLRT_LAYOUT_LIGHTS_H
#define CLRT_LAYOUT_LIGHTS_H

#include "layout/layout.h"

// What the materials in use make of light that comes from everywhere.
typedef struct LightUse {
    bool ambient; // some reflect ambient light
    bool pbr;     // some are lit by an environment
} LightUse;

// Adds the records, once the environment is there; lights that are black have none. Fails with ERROR_MEMORY and where there are too many samples
// (ERROR_SCENE).
bool lights_add(Layout *layout, const Scene *scene, LightUse use, Error *error);

// Of the records, in a scene that has surfaces. shadows: the scene's setting.
FeatureSet lights_features(const Layout *layout, bool shadows);

// Whether some record shines on materials of all kinds; whether some one is a light at all.
bool lights_direct(const Layout *layout);
bool lights_shine(const Layout *layout);

// Once primitives and planes have their places: which of them are never before a light. Fails with ERROR_MEMORY.
bool lights_finish(Layout *layout, Error *error);

// The material of an area light's surface: black, shining on its outer side.
MaterialRecord light_material(const Light *light);

#endif
