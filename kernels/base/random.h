// Random numbers without state: hashes of (seed, pixel, sample, dimension), integers until the last step, so
// that every device draws the same ones in any order.
#ifndef CLRT_KERNELS_BASE_RANDOM_H
#define CLRT_KERNELS_BASE_RANDOM_H

#include "base/lanes.h"

typedef struct { vu x, y, z; } vu3;

// Three hashes of three integers: pcg3d of Jarzynski and Olano, "Hash Functions for GPU Rendering", 2020.
static inline vu3 random_hash(vu x, vu y, vu z)
{
    x = x * 1664525u + 1013904223u;
    y = y * 1664525u + 1013904223u;
    z = z * 1664525u + 1013904223u;
    x += y * z;
    y += z * x;
    z += x * y;
    x ^= x >> 16;
    y ^= y >> 16;
    z ^= z >> 16;
    x += y * z;
    y += z * x;
    z += x * y;
    vu3 r;
    r.x = x;
    r.y = y;
    r.z = z;
    return r;
}

// What all random numbers of a pixel start from.
static inline vu random_pixel_key(vu x, vu y, uint seed)
{
    return random_hash(x, y, (vu)(seed)).z;
}

// Three independent numbers of a pixel's sample. Draws with different dimensions are independent too.
static inline vu3 random_bits(vu pixel_key, vu sample, uint dimension)
{
    return random_hash(pixel_key, sample, (vu)(dimension));
}

// Uniform in [0, 1): a multiple of 2^-24, at most 1 - 2^-24.
static inline vf random_unit(vu bits)
{
    return VF_FROM_VI(VI_FROM_VU(bits >> 8)) * 0x1p-24f;
}

#endif
