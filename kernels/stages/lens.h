// Where a sample lies: its point in the pixel's filter, drawn by filter importance sampling, and on the lens.
#ifndef CLRT_KERNELS_STAGES_LENS_H
#define CLRT_KERNELS_STAGES_LENS_H

#include "stages/state.h"
#if HAS_SAMPLES || HAS_APERTURE
#include "base/sampling.h"
#endif
#if HAS_APERTURE
#include "base/trig.h"
#endif

// Pairs of dimensions of a pixel's sequence.
#define PAIR_PIXEL 0u
#define PAIR_LENS 1u

#if HAS_SAMPLES
// u in [0, 1) to an offset from the pixel's centre with the density of the filter's absolute value.
static inline vf filter_offset(vf u, global const f32 *quantiles)
{
#if HAS_FILTER_TENT
    // Distances from the near end of the tent, so that nothing cancels there.
    const vm left = u < (vf)(0.5f);
    const vf root = sqrt(2.0f * (left ? u : (1.0f - u)));
    return left ? root - 1.0f : 1.0f - root;
#elif HAS_FILTER_TABLE
    // Quantiles of the half with positive offsets, linear in between: a density that is even within a step.
    const vf centered = fma(u, (vf)(2.0f), (vf)(-1.0f));
    const vf place = fabs(centered) * (real)FILTER_STEPS;
    const vi step = VI_FROM_VF(vf_min(floor(place), (vf)(FILTER_STEPS - 1)));
    const vf low = vf_gather(quantiles, step), high = vf_gather(quantiles, step + 1);
    const vf offset = fma(place - VF_FROM_VI(step), high - low, low);
    return centered < (vf)(0.0f) ? -offset : offset;
#else
    return u - 0.5f;
#endif
}

#if HAS_FILTER_LOBES
// The sign of mitchell's filter, which is negative from 8/7 of a pixel on.
static inline vf filter_sign(vf offset)
{
    return fabs(offset) > (vf)(8.0f / 7.0f) ? (vf)(-1.0f) : (vf)(1.0f);
}
#endif
#endif

#if HAS_APERTURE
// A point of the unit disk with even density (Shirley and Chiu, "A Low Distortion Map Between Disk and Square",
// 1997).
static inline SamplePoint disk_point(SamplePoint square)
{
    const vf a = fma(square.x, (vf)(2.0f), (vf)(-1.0f)), b = fma(square.y, (vf)(2.0f), (vf)(-1.0f));
    const vm wide = fabs(a) > fabs(b);
    const vf radius = wide ? a : b, other = wide ? b : a;
    const vf quotient = other / (radius != (vf)(0.0f) ? radius : (vf)(1.0f));
    const SineCosine turn = vf_sincos(quotient * REAL(0.78539816f, 0.78539816339744830962));
    SamplePoint point;
    point.x = radius * (wide ? turn.cosine : turn.sine);
    point.y = radius * (wide ? turn.sine : turn.cosine);
    return point;
}
#endif

#endif
