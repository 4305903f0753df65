// Sine, cosine, arc cosine and arc tangent from + - * / fma and sqrt alone, so that every device gives the
// same bits. Branchless.
//
// Coefficients here and in exp_log.h are minimax in relative error: Remez exchange in 140-bit arithmetic,
// then rounded to float one by one from the lowest, the others fitted anew each time; beside them stands the
// largest relative error of the polynomial. Of a function the comment states a bound of its error in ulp of
// the result, and the worst measured against MPFR over 2^25 inputs of each of several ranges.
#ifndef CLRT_KERNELS_BASE_TRIG_H
#define CLRT_KERNELS_BASE_TRIG_H

#include "base/exact.h"

#define VF_PI_2_HIGH 0x1.921fb6p+0f
#define VF_PI_2_MID -0x1.777a5cp-25f
#define VF_PI_2_LOW -0x1.ee59dap-50f
#define VF_PI_HIGH 0x1.921fb6p+1f
// (pi - VF_PI_HIGH) / VF_PI_HIGH, also of pi/2: restores what rounding pi to float lost.
#define VF_PI_REST -0x1.de12cap-26f

typedef struct { vf sine, cosine; } SineCosine;

#if MATH_DOUBLE || MATH_FAST
// What the device has: doubles within its few ulp, or floats as fast as it can.
static inline SineCosine vf_sincos(vf x)
{
    SineCosine result;
#if MATH_DOUBLE
    result.sine = sin(x);
    result.cosine = cos(x);
#else
    result.sine = native_sin(x);
    result.cosine = native_cos(x);
#endif
    return result;
}
#else
// Within 1.55 ulp (1.54 measured) for |x| <= 2^17 radians; of -0 the sine is 0. Beyond, where the floats are
// too far apart to tell a direction, the sine is 0 and the cosine 1; infinities and NaN give NaN.
// Reduction by multiples of pi/2 in three parts: Cody and Waite, "Software Manual for the Elementary
// Functions", 1980, with fma as in Muller et al., "Handbook of Floating-Point Arithmetic", 2018, 11.2.
static inline SineCosine vf_sincos(vf x)
{
    const vf inside = fabs(x) <= (vf)(0x1p+17f) ? x : x * 0.0f;
    const vf magic = fma(inside, (vf)(0x1.45f306p-1f), (vf)(VF_ROUND_MAGIC));
    const vf n = magic - VF_ROUND_MAGIC;
    // The first step is exact: both sides are multiples of 2^-24 and nearly equal.
    vf r = fma(n, (vf)(-VF_PI_2_HIGH), inside);
    r = fma(n, (vf)(-VF_PI_2_MID), r);
    r = fma(n, (vf)(-VF_PI_2_LOW), r);
    const vf z = r * r;

    vf s = fma(z, (vf)(-0x1.991c26p-13f), (vf)(0x1.1106c6p-7f)); // 2^-27.8
    s = fma(s, z, (vf)(-0x1.555544p-3f));
    s = fma(s, r * z, r);
    vf c = fma(z, (vf)(0x1.99e146p-16f), (vf)(-0x1.6c0c1ap-10f)); // 2^-32.8
    c = fma(c, z, (vf)(0x1.55554ap-5f));
    c = fma(c, z, (vf)(-0.5f));
    c = fma(c, z, (vf)(1.0f));

    const vu quadrant = VF_AS_VU(magic);
    const vm odd = VI_FROM_VU(quadrant & (vu)(1u)) != (vi)(0);
    const vu sine_sign = (quadrant & (vu)(2u)) << 30;
    const vu cosine_sign = ((quadrant + (vu)(1u)) & (vu)(2u)) << 30;
    SineCosine result;
    result.sine = VU_AS_VF(VF_AS_VU(odd ? c : s) ^ sine_sign);
    result.cosine = VU_AS_VF(VF_AS_VU(odd ? s : c) ^ cosine_sign);
    return result;
}
#endif

static inline vf vf_sin(vf x) { return vf_sincos(x).sine; }
static inline vf vf_cos(vf x) { return vf_sincos(x).cosine; }

#if MATH_DOUBLE
static inline vf vf_acos(vf x) { return acos(vf_min(vf_max(x, (vf)(-1.0f)), (vf)(1.0f))); }
static inline vf vf_atan2(vf y, vf x) { return atan2(y, x); }
#else
// Within 1.25 ulp (1.13) on [-1, 1]; beyond, as at the end of the interval, so that a cosine with a rounding
// error is an angle. NaN gives NaN.
static inline vf vf_acos(vf x)
{
    const vf magnitude = fabs(x);
    // acos(x) = pi/2 - asin(x), and from 1/2 on acos(x) = 2 asin(sqrt((1 - x) / 2)).
    const vm large = magnitude > (vf)(0.5f);
    const vf half_versine = vf_max((vf)(0.0f), fma(magnitude, (vf)(-0.5f), (vf)(0.5f)));
    const vf z = large ? half_versine : x * x;
    const vf s = large ? sqrt(half_versine) : magnitude;
    vf p = fma(z, (vf)(0x1.595c92p-5f), (vf)(0x1.8c3e28p-6f)); // 2^-27.6
    p = fma(p, z, (vf)(0x1.747bbap-5f));
    p = fma(p, z, (vf)(0x1.330204p-4f));
    p = fma(p, z, (vf)(0x1.5555c8p-3f));
    const vf correction = s * z * p;

    const vi sign = VF_AS_VI(x) & (vi)((int)0x80000000u);
    const vf factor = VI_AS_VF(VF_AS_VI(large ? (vf)(2.0f) : (vf)(-1.0f)) ^ sign);
    const vf end = sign != (vi)(0) ? (vf)(VF_PI_HIGH) : (vf)(0.0f);
    const vf base = large ? end : (vf)(VF_PI_2_HIGH);
    return base + fma(factor, s, fma(factor, correction, base * VF_PI_REST));
}

// The angle of (x, y) in [-pi, pi], within 1.6 ulp (1.51); zeros and infinities of either sign as in C.
// Coordinates below 2^-126 count as 0, and so do angles below that.
static inline vf vf_atan2(vf y, vf x)
{
    const vf ax = fabs(x);
    const vf ay = fabs(y);
    const vm steep = ay > ax;
    const vf high = steep ? ay : ax;
    const vf low = steep ? ax : ay;
    const vf num = low < (vf)(VF_SMALLEST_NORMAL) ? (vf)(0.0f) : low;
    const vf den = high < (vf)(VF_SMALLEST_NORMAL) ? (vf)(1.0f) : high;
    const vf quotient = num == den ? (vf)(1.0f) : num / den;
    const vf t = quotient < (vf)(VF_SMALLEST_NORMAL) ? (vf)(0.0f) : quotient;
    const vf z = t * t;
    vf p = fma(z, (vf)(-0x1.d33746p-10f), (vf)(0x1.641994p-7f)); // 2^-28.4
    p = fma(p, z, (vf)(-0x1.fd7936p-6f));
    p = fma(p, z, (vf)(0x1.da2958p-5f));
    p = fma(p, z, (vf)(-0x1.58091ep-4f));
    p = fma(p, z, (vf)(0x1.c08c50p-4f));
    p = fma(p, z, (vf)(-0x1.242086p-3f));
    p = fma(p, z, (vf)(0x1.9991e4p-3f));
    p = fma(p, z, (vf)(-0x1.55553ep-2f));

    // The angle is 0, pi/2 or pi, plus or minus atan(t).
    const vi sign_bit = (vi)((int)0x80000000u);
    const vi x_sign = VF_AS_VI(x) & sign_bit;
    const vf axis = x_sign != (vi)(0) ? (vf)(VF_PI_HIGH) : (vf)(0.0f);
    const vf base = steep ? (vf)(VF_PI_2_HIGH) : axis;
    const vi turn = x_sign ^ (steep ? sign_bit : (vi)(0));
    const vf signed_t = VI_AS_VF(VF_AS_VI(t) ^ turn);
    const vf rest = fma(base, (vf)(VF_PI_REST), signed_t * z * p);
    const vf angle = base + (signed_t + rest);
    return VI_AS_VF(VF_AS_VI(angle) ^ (VF_AS_VI(y) & sign_bit));
}
#endif

#endif
