// Point, directional and spot lights.
#ifndef CLRT_KERNELS_LIGHT_PUNCTUAL_H
#define CLRT_KERNELS_LIGHT_PUNCTUAL_H

#include "base/vec.h"
#include "shared/light.h"

// Keeps what arrives very near a light finite.
#define GAIN_MAX 1e30f

typedef struct {
    v3 dir;       // unit, towards the light
    vf distance;  // INFINITY for a directional light
    v3 intensity; // that arrives, attenuation and cone included; of an area light: irradiance over pi
#if HAS_AREA_LIGHTS
    bool area;
#endif
#if HAS_PATH
    vf density; // of dir over solid angle; 0: no other direction leads to the light
#endif
} LightSample;

// The light as point sees it. A point at the light's very position receives nothing.
OUTLINE LightSample punctual_sample(global const LightRecord *light, v3 point)
{
    LightSample sample;
    vf gain = (vf)(1.0f);
#if HAS_DIRECTIONAL
    const f32x4 travel = light->direction;
    sample.dir = v3_make((vf)(-travel.x), (vf)(-travel.y), (vf)(-travel.z));
    sample.distance = (vf)(INFINITY);
#endif
#if HAS_POINT || HAS_SPOT
#if HAS_DIRECTIONAL
    if (light->kind != LIGHT_KIND_DIRECTIONAL)
#endif
    {
        const f32x4 position = light->position;
        const v3 to = v3_sub(v3_make((vf)(position.x), (vf)(position.y), (vf)(position.z)), point);
        const vf squared = v3_dot(to, to);
        const vf distance = sqrt(squared);
        const vm away = distance > (vf)(0.0f);
        const vf inverse = (vf)(1.0f) / (away ? distance : (vf)(1.0f));
        sample.dir = v3_scale(to, inverse);
        sample.distance = distance;
        const vf fall = fma(squared, (vf)(light->attenuation[2]),
                            fma(distance, (vf)(light->attenuation[1]), (vf)(light->attenuation[0])));
        gain = away ? vf_min((vf)(1.0f) / fall, (vf)(GAIN_MAX)) : (vf)(0.0f);
#if HAS_SPOT
        if (light->kind == LIGHT_KIND_SPOT) {
            const f32x4 axis = light->direction;
            // 1 - cos of the angle to the axis, half the square of a difference: exact for narrow cones too.
            const v3 off = v3_add(sample.dir, v3_make((vf)(axis.x), (vf)(axis.y), (vf)(axis.z)));
            const vf above = light->versine_outer - 0.5f * v3_dot(off, off);
            const vf t = vf_clamp(above * light->inverse_range, 0.0f, 1.0f);
            const vf soft = t * t * (3.0f - 2.0f * t);
            const vf hard = above >= (vf)(0.0f) ? (vf)(1.0f) : (vf)(0.0f);
            gain = gain * (light->inverse_range > 0.0f ? soft : hard);
        }
#endif
    }
#endif
    const f32x4 intensity = light->intensity;
    sample.intensity = v3_make(gain * intensity.x, gain * intensity.y, gain * intensity.z);
#if HAS_AREA_LIGHTS
    sample.area = false;
#endif
#if HAS_PATH
    sample.density = (vf)(0.0f);
#endif
    return sample;
}

#endif
