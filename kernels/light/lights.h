// The lights that shine from somewhere behind one function. A scene without area lights draws nothing.
#ifndef CLRT_KERNELS_LIGHT_LIGHTS_H
#define CLRT_KERNELS_LIGHT_LIGHTS_H

#include "light/punctual.h"
#if HAS_AREA_LIGHTS
#include "light/area.h"
#endif

#if HAS_AREA_LIGHTS && !HAS_PATH
static inline LightSample light_sample(global const LightRecord *light, v3 point, SamplePoint u)
{
#if HAS_SPHERE_LIGHT
    if (light->kind == LIGHT_KIND_SPHERE)
        return sphere_light_sample(light, point, u);
#endif
#if HAS_RECTANGLE_LIGHT
    if (light->kind == LIGHT_KIND_RECTANGLE)
        return rectangle_light_sample(light, point, u);
#endif
#if HAS_POINT || HAS_DIRECTIONAL || HAS_SPOT
    return punctual_sample(light, point);
#else
    LightSample none;
    none.dir = none.intensity = v3_splat(0.0f);
    none.distance = (vf)(0.0f);
    none.area = true;
    return none;
#endif
}
#endif

#endif
