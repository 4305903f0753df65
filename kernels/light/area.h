// Points of sphere and rectangle lights.
#ifndef CLRT_KERNELS_LIGHT_AREA_H
#define CLRT_KERNELS_LIGHT_AREA_H

#include "base/frame.h"
#include "base/sampling.h"
#include "light/punctual.h"

#if HAS_SPHERE_LIGHT
// Uniform in the solid angle of the sphere. With q = 1 - cos of half the angle that it fills, the cosine is 1
// - v with v uniform in [0, q): neither a small sphere far away nor the surface next to a large one cancels,
// because q comes from (r / d)^2 and the distance of the surface from d - r.
OUTLINE LightSample sphere_light_sample(global const LightRecord *light, v3 point, SamplePoint u)
{
    LightSample sample;
    const f32x4 center = light->position, radiance = light->intensity;
    const vf radius = (vf)(light->size);
    const v3 to = v3_sub(v3_make((vf)(center.x), (vf)(center.y), (vf)(center.z)), point);
    const vf distance = sqrt(v3_dot(to, to));
    const vm outside = distance > radius;
    const vf inverse = (vf)(1.0f) / (outside ? distance : (vf)(1.0f));
    const vf sine = radius * inverse, surface = (distance - radius) * inverse;
    const vf tangent = surface * ((distance + radius) * inverse); // (1 - (r / d)^2)
    const vf q = sine * sine / (1.0f + sqrt(vf_max(tangent, (vf)(0.0f))));
    const vf v = u.x * q, cosine = 1.0f - v;
    const Frame frame = frame_about(v3_scale(to, inverse));
    sample.dir = frame_direction(&frame, sqrt(v * (1.0f + cosine)), cosine, u.y);
    // The near root of the ray with the sphere; its discriminant is a difference of two versines.
    const vf half_chord = sqrt(vf_max((q - v) * (2.0f - (q + v)), (vf)(0.0f)));
    sample.distance = distance * tangent / (cosine + half_chord);
    const vf gain = outside ? 2.0f * q : (vf)(0.0f); // solid angle over pi
#if HAS_PATH
    sample.density = outside ? INVERSE_PI / gain : (vf)(0.0f);
#endif
    sample.intensity = v3_make(gain * radiance.x, gain * radiance.y, gain * radiance.z);
    sample.area = true;
    return sample;
}
#endif

#if HAS_RECTANGLE_LIGHT
// Uniform over the area. The distance from the plane is the same for all points of it, and exact enough.
OUTLINE LightSample rectangle_light_sample(global const LightRecord *light, v3 point, SamplePoint u)
{
    LightSample sample;
    const f32x4 corner = light->position, radiance = light->intensity;
    const v3 edge1 = v3_from(light->direction), edge2 = v3_from(light->edge), normal = v3_from(light->normal);
    const v3 to_corner = v3_sub(v3_make((vf)(corner.x), (vf)(corner.y), (vf)(corner.z)), point);
    const v3 to = v3_fma(edge2, u.y, v3_fma(edge1, u.x, to_corner));
    const vf height =
        fma(normal.z, point.z, fma(normal.y, point.y, fma(normal.x, point.x, (vf)(-light->normal.w))));
    const vf distance = sqrt(v3_dot(to, to));
    const vm before = (height > (vf)(0.0f)) & (distance > (vf)(0.0f));
    const vf inverse = (vf)(1.0f) / (before ? distance : (vf)(1.0f));
    sample.dir = v3_scale(to, inverse);
    sample.distance = distance;
    const vf seen = (light->size * inverse) * (vf_min(height * inverse, (vf)(1.0f)) * inverse) * INVERSE_PI;
    const vf gain = before ? vf_min(seen, (vf)(GAIN_MAX)) : (vf)(0.0f);
#if HAS_PATH
    sample.density = before ? INVERSE_PI / gain : (vf)(0.0f);
#endif
    sample.intensity = v3_make(gain * radiance.x, gain * radiance.y, gain * radiance.z);
    sample.area = true;
    return sample;
}
#endif

#endif
