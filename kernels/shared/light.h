// Light: a punctual light in render space.
#ifndef CLRT_SHARED_LIGHT_H
#define CLRT_SHARED_LIGHT_H

#include "shared/types.h"

#define LIGHT_KIND_POINT 0
#define LIGHT_KIND_DIRECTIONAL 1
#define LIGHT_KIND_SPOT 2

typedef struct LightRecord {
    f32x4 position;    // point, spot; w unused
    f32x4 direction;   // unit vector of travel: directional; spot: from its position to look_at
    f32x4 intensity;   // rgb
    f32 attenuation[3]; // KC, KL, KQ; 1 0 0 for directional
    u32 kind;          // LIGHT_KIND_X
    f32 versine_outer; // spot: 1 - cosine of half the outer angle
    f32 inverse_range; // spot: 1 / (cos(inner / 2) - cos(outer / 2)); 0: hard edge
    u32 planes; // bit k: the light lies on plane k, which so is never between it and anything
    u32 padding;
} LightRecord;
LAYOUT_SIZE(LightRecord, 80);
LAYOUT_OFFSET(LightRecord, attenuation, 48);
LAYOUT_OFFSET(LightRecord, versine_outer, 64);

#endif
