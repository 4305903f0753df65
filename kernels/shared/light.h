// Light: what one shadow ray of a hit is aimed at, in render space. A light of N samples is N records.
#ifndef CLRT_SHARED_LIGHT_H
#define CLRT_SHARED_LIGHT_H

#include "shared/types.h"

#define LIGHT_KIND_POINT 0
#define LIGHT_KIND_DIRECTIONAL 1
#define LIGHT_KIND_SPOT 2
#define LIGHT_KIND_SPHERE 3
#define LIGHT_KIND_RECTANGLE 4
#define LIGHT_KIND_ENVIRONMENT 5
#define LIGHT_KIND_OCCLUSION 6 // ambient light, where a ray of some length meets nothing
#define LIGHT_KIND_COUNT 7

typedef struct LightRecord {
    f32x4 position;    // point, spot; sphere: centre; rectangle: corner; w: 0 where no shadow rays are traced
    f32x4 direction;   // unit vector of travel: directional, and spot: towards look_at; rectangle: edge1
    f32x4 intensity;   // rgb; sphere, rectangle: radiance; all that have samples: over their number
    f32x4 edge;        // rectangle: edge2
    f32x4 normal;      // rectangle: unit normal of the side that shines; w: normal.p on it
    f32 attenuation[3]; // KC, KL, KQ; 1 0 0 for directional
    u32 kind;          // LIGHT_KIND_X
    f32 versine_outer; // spot: 1 - cosine of half the outer angle
    f32 inverse_range; // spot: 1 / (cos(inner / 2) - cos(outer / 2)); 0: hard edge
    u32 planes;        // bit k: the light lies on plane k, which so is never between it and anything
    i32 surface;       // sphere, rectangle: index of its own primitive; else -1
    f32 size;          // sphere: radius; rectangle: area; occlusion: length of the ray
    u32 sample;        // of `samples`, from 0: which one this record is
    u32 samples;
    u32 sequence;      // of random points, the same for all samples of the light
} LightRecord;
LAYOUT_SIZE(LightRecord, 128);
LAYOUT_OFFSET(LightRecord, attenuation, 80);
LAYOUT_OFFSET(LightRecord, versine_outer, 96);
LAYOUT_OFFSET(LightRecord, size, 112);

#endif
