// Random numbers at hits: of the pixel, the sample, the path from the camera to the hit, and the light.
// Nothing of it depends on which slot, lane or tile a sample is in.
#ifndef CLRT_KERNELS_STAGES_RANDOM_H
#define CLRT_KERNELS_STAGES_RANDOM_H

#include "stages/state.h"
#if HAS_HIT_RANDOM
#include "base/sampling.h"
#include "shared/light.h"

typedef struct {
    vu path;   // hash of the pixel and of the ways that the rays took
    vu sample; // of the pixel
} HitRandom;


// The path of a camera ray. Not the pixel's key itself, with which the camera draws.
static inline vi path_begin(vu pixel_key)
{
    return VI_FROM_VU(random_hash(pixel_key, (vu)(0u), (vu)(0x85ebca6bu)).x);
}

// The path of a ray that is mirrored at the hit, or goes through.
static inline vi path_follow(const HitRandom *random, vm through)
{
    const vi way = through ? (vi)(2) : (vi)(1);
    return VI_FROM_VU(random_hash(random->path, VU_FROM_VI(way), (vu)(0xc2b2ae35u)).x);
}

static inline HitRandom hit_random(const State *s, const Slots *slots)
{
    HitRandom random;
    random.path = VU_FROM_VI(state_load_int(s, PATH, slots));
#if HAS_PATH
    random.sample = VU_FROM_VI(state_load_int(s, SAMPLE, slots));
#else
    random.sample = VU_FROM_VI((slots->index & s->sample_mask) + s->sample_begin);
#endif
    return random;
}

#if HAS_PATH
// The pairs of numbers that a path draws at each hit.
#define PAIR_LIGHT 0u   // the point of a light
#define PAIR_SCATTER 1u // the direction in which the path goes on
#define PAIR_CHOICE 2u  // which light; whether the path goes on
#define PAIR_PICK 3u    // lights of the table

static inline SampleBits hit_random_pair(const HitRandom *random, uint pair)
{
    return sample_2d_bits(random->path, random->sample, pair);
}
#else
// The bits, and the point, of the light's record. All samples of a pixel, and of the light at one hit,
// are one sequence: they are spread over the light together.
static inline SampleBits hit_random_bits(const HitRandom *random, global const LightRecord *light)
{
    return sample_2d_bits(random->path, random->sample * light->samples + light->sample, light->sequence);
}

static inline SamplePoint hit_random_point(const HitRandom *random, global const LightRecord *light)
{
    return sample_point(hit_random_bits(random, light));
}
#endif
#endif

#endif
