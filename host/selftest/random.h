// Random numbers of test inputs: the same ones on every machine. *state is any number.
#ifndef CLRT_SELFTEST_RANDOM_H
#define CLRT_SELFTEST_RANDOM_H

#include <math.h>

#include "base/vec.h"

// Uniform in [0, 1). Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014.
static inline f64 random_unit(u64 *state)
{
    *state += 0x9e3779b97f4a7c15u;
    u64 x = *state;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return (f64)((x ^ (x >> 31)) >> 11) * 0x1p-53;
}

static inline f64 random_in(u64 *state, f64 low, f64 high)
{
    return low + (high - low) * random_unit(state);
}

// 10 to a power that is uniform in [low, high].
static inline f64 random_scale(u64 *state, f64 low, f64 high)
{
    return pow(10, random_in(state, low, high));
}

// Uniform on the unit sphere.
static inline Vec3 random_direction(u64 *state)
{
    const f64 z = random_in(state, -1, 1), angle = random_in(state, 0, 6.283185307179586);
    const f64 rho = sqrt(1 - z * z);
    return (Vec3){rho * cos(angle), rho * sin(angle), z};
}

// Uniform in a cube about the origin.
static inline Vec3 random_point(u64 *state, f64 half_side)
{
    const f64 x = random_in(state, -half_side, half_side), y = random_in(state, -half_side, half_side);
    return (Vec3){x, y, random_in(state, -half_side, half_side)};
}

#endif
