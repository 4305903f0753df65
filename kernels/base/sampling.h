// Well-distributed points: an Owen-scrambled Sobol' sequence for each pixel and pair of dimensions.
#ifndef CLRT_KERNELS_BASE_SAMPLING_H
#define CLRT_KERNELS_BASE_SAMPLING_H

#include "base/random.h"

typedef struct { vf x, y; } SamplePoint;
typedef struct { vu x, y; } SampleBits; // 2^32 is 1

static inline vu reverse_bits(vu x)
{
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

// Flips each bit by a hash of the seed and of the bits below it: an Owen scramble of a number with its bits
// reversed. Hash in the manner of Laine and Karras, constants of Vegdahl, "Building a Better LK Hash", 2021.
static inline vu owen_scramble_reversed(vu x, vu seed)
{
    x ^= x * 0x3d20adeau;
    x += seed;
    x *= (seed >> 16) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return x;
}

// The second dimension of the Sobol' sequence, its bits reversed (the first is the reversed index, thus the
// index itself). Bit i is the parity of the index bits j with C(j, i) odd: those whose number j has all bits
// of i (Lucas), so one step for each bit of the bit number does.
static inline vu sobol_second_reversed(vu index)
{
    index ^= (index >> 1) & 0x55555555u;
    index ^= (index >> 2) & 0x33333333u;
    index ^= (index >> 4) & 0x0f0f0f0fu;
    index ^= (index >> 8) & 0x00ff00ffu;
    return index ^ (index >> 16);
}

// Point number index of a pixel's sequence in [0, 1)^2. Every 2^m points from a multiple of 2^m on have one
// point in each of the 2^m boxes of any 2^-a x 2^(a-m); the scrambles and the order differ from pixel to
// pixel and from pair to pair, so that pairs combine to more dimensions by padding.
// Burley, "Practical Hash-based Owen Scrambling", 2020.
static inline SampleBits sample_2d_bits(vu pixel_key, vu index, uint pair)
{
    const vu3 seeds = random_hash(pixel_key, (vu)(pair), (vu)(0x9e3779b9u));
    const vu shuffled = reverse_bits(owen_scramble_reversed(reverse_bits(index), seeds.x));
    SampleBits bits;
    bits.x = reverse_bits(owen_scramble_reversed(shuffled, seeds.y));
    bits.y = reverse_bits(owen_scramble_reversed(sobol_second_reversed(shuffled), seeds.z));
    return bits;
}

static inline SamplePoint sample_point(SampleBits bits)
{
    SamplePoint point;
    point.x = random_unit(bits.x);
    point.y = random_unit(bits.y);
    return point;
}

static inline SamplePoint sample_2d(vu pixel_key, vu index, uint pair)
{
    return sample_point(sample_2d_bits(pixel_key, index, pair));
}

#endif
