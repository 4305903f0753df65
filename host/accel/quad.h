// Quad: four floats in one register. The portable half computes the same bits, for hosts without SSE2 and
// for the test of this one (QUAD_PORTABLE).
#ifndef CLRT_ACCEL_QUAD_H
#define CLRT_ACCEL_QUAD_H

#include "base/types.h"

#if defined __SSE2__ && !defined QUAD_PORTABLE
#include <emmintrin.h>

typedef __m128 Quad;

static inline Quad quad_all(f32 value)
{
    return _mm_set1_ps(value);
}

// four: sixteen bytes, of whatever type.
static inline Quad quad_load(const void *four)
{
    return _mm_loadu_ps(four);
}

static inline void quad_store(void *four, Quad a)
{
    _mm_storeu_ps(four, a);
}

static inline Quad quad_add(Quad a, Quad b)
{
    return _mm_add_ps(a, b);
}

static inline Quad quad_sub(Quad a, Quad b)
{
    return _mm_sub_ps(a, b);
}

static inline Quad quad_mul(Quad a, Quad b)
{
    return _mm_mul_ps(a, b);
}

// a < b ? a : b of each lane, so that b is the result where one is no number.
static inline Quad quad_min(Quad a, Quad b)
{
    return _mm_min_ps(a, b);
}

static inline Quad quad_max(Quad a, Quad b)
{
    return _mm_max_ps(a, b);
}

// Lanes (y, z, x, x) of a.
static inline Quad quad_yzx(Quad a)
{
    return _mm_shuffle_ps(a, a, _MM_SHUFFLE(0, 0, 2, 1));
}

// Truncated; lanes must be in 0 .. 32767. The fourth may be anything.
static inline void quad_to_indices(Quad a, u32 indices[3])
{
    const __m128i whole = _mm_cvttps_epi32(a);
    indices[0] = (u32)_mm_extract_epi16(whole, 0);
    indices[1] = (u32)_mm_extract_epi16(whole, 2);
    indices[2] = (u32)_mm_extract_epi16(whole, 4);
}

#else
#include <string.h>

typedef struct Quad {
    f32 lane[4];
} Quad;

static inline Quad quad_all(f32 value)
{
    return (Quad){ { value, value, value, value } };
}

static inline Quad quad_load(const void *four)
{
    Quad a;
    memcpy(&a, four, sizeof a);
    return a;
}

static inline void quad_store(void *four, Quad a)
{
    memcpy(four, &a, sizeof a);
}

static inline Quad quad_add(Quad a, Quad b)
{
    for (int i = 0; i < 4; i++)
        a.lane[i] += b.lane[i];
    return a;
}

static inline Quad quad_sub(Quad a, Quad b)
{
    for (int i = 0; i < 4; i++)
        a.lane[i] -= b.lane[i];
    return a;
}

static inline Quad quad_mul(Quad a, Quad b)
{
    for (int i = 0; i < 4; i++)
        a.lane[i] *= b.lane[i];
    return a;
}

static inline Quad quad_min(Quad a, Quad b)
{
    for (int i = 0; i < 4; i++)
        a.lane[i] = a.lane[i] < b.lane[i] ? a.lane[i] : b.lane[i];
    return a;
}

static inline Quad quad_max(Quad a, Quad b)
{
    for (int i = 0; i < 4; i++)
        a.lane[i] = a.lane[i] > b.lane[i] ? a.lane[i] : b.lane[i];
    return a;
}

static inline Quad quad_yzx(Quad a)
{
    return (Quad){ { a.lane[1], a.lane[2], a.lane[0], a.lane[0] } };
}

static inline void quad_to_indices(Quad a, u32 indices[3])
{
    for (int i = 0; i < 3; i++)
        indices[i] = (u32)a.lane[i];
}

#endif

#endif
