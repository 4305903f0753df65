// Exponential, logarithm and power from + - * / fma and bit operations alone, so that every device gives the
// same bits. Branchless. On coefficients and errors see trig.h.
//
// Values below 2^-126 count as 0, as argument and as result: devices differ on them.
#ifndef CLRT_KERNELS_BASE_EXP_LOG_H
#define CLRT_KERNELS_BASE_EXP_LOG_H

#include "base/exact.h"

#if MATH_DOUBLE || MATH_FAST
// What the device has: doubles within its few ulp, or floats as fast as it can.
#if MATH_DOUBLE
#define BUILT_IN(name) name
#else
#define BUILT_IN(name) native_##name
#endif

static inline vf vf_exp2(vf x) { return BUILT_IN(exp2)(x); }
static inline vf vf_exp(vf x) { return BUILT_IN(exp)(x); }
static inline vf vf_log(vf x) { return BUILT_IN(log)(x); }
static inline vf vf_log2(vf x) { return BUILT_IN(log2)(x); }

static inline vf vf_pow(vf x, vf y)
{
#if MATH_DOUBLE
    const vf inside = pow(x, y);
#else
    const vf inside = native_exp2(y * native_log2(x));
#endif
    const vf outside = x < (vf)(VF_SMALLEST_NORMAL) ? (vf)(0.0f) : x;
    const vm normal = (x >= (vf)(VF_SMALLEST_NORMAL)) & (x < (vf)(INFINITY));
    const vf result = normal ? inside : outside;
    return y == (vf)(0.0f) ? (vf)(1.0f) : result;
}
#else
// 2^(whole + r), where magic = whole + VF_ROUND_MAGIC. The result is normal: whole >= -126 with r >= 0 there,
// and whole <= 128 with r < 0 there; otherwise it is garbage.
static inline vf vf_exp2_parts(vf magic, vf r)
{
    vf p = fma(r, (vf)(0x1.416b1cp-13f), (vf)(0x1.5f0832p-10f)); // |r| <= 1/2: 2^-28.3
    p = fma(p, r, (vf)(0x1.3b2de0p-7f));
    p = fma(p, r, (vf)(0x1.c6af7cp-5f));
    p = fma(p, r, (vf)(0x1.ebfbdcp-3f));
    p = fma(p, r, (vf)(0x1.62e430p-1f));
    p = fma(p, r, (vf)(1.0f));
    return VU_AS_VF(VF_AS_VU(p) + (VF_AS_VU(magic) << 23));
}

// Within 1 ulp (0.79 measured).
static inline vf vf_exp2(vf x)
{
    const vf magic = x + VF_ROUND_MAGIC;
    const vf power = vf_exp2_parts(magic, x - (magic - VF_ROUND_MAGIC));
    const vf bounded = x < (vf)(128.0f) ? power : x * INFINITY;
    return x < (vf)(-126.0f) ? (vf)(0.0f) : bounded;
}

// Within 1 ulp (0.89).
static inline vf vf_exp(vf x)
{
    const vf magic = fma(x, (vf)(0x1.715476p+0f), (vf)(VF_ROUND_MAGIC));
    const vf n = magic - VF_ROUND_MAGIC;
    const vf r = fma(n, (vf)(0x1.05c610p-29f), fma(n, (vf)(-0x1.62e430p-1f), x));
    vf p = fma(r, (vf)(0x1.6a520cp-10f), (vf)(0x1.123988p-7f)); // |r| <= log(2)/2: 2^-28.2
    p = fma(p, r, (vf)(0x1.5558acp-5f));
    p = fma(p, r, (vf)(0x1.555492p-3f));
    p = fma(p, r, (vf)(0x1.fffffcp-2f));
    p = fma(p, r, (vf)(1.0f));
    p = fma(p, r, (vf)(1.0f));
    const vf power = VU_AS_VF(VF_AS_VU(p) + (VF_AS_VU(magic) << 23));
    // log(2^128) rounded down, log(2^-126) rounded up
    const vf bounded = x <= (vf)(0x1.62e42ep+6f) ? power : x * INFINITY;
    return x < (vf)(-0x1.5d589ep+6f) ? (vf)(0.0f) : bounded;
}

// The k for which x 2^-k lies in [low, 2 low), for normal x > 0; low, from 1/2 to 1, is given by its bits.
static inline vi vf_exponent(vf x, uint low)
{
    return VI_FROM_VU(VF_AS_VU(x) - (vu)(low)) >> 23;
}

// x 2^-k, where that is normal.
static inline vf vf_mantissa(vf x, vi k)
{
    return VU_AS_VF(VF_AS_VU(x) - (VU_FROM_VI(k) << 23));
}

// What logarithms give at the ends of their domain: -inf at 0, NaN below, inf and NaN as they come.
static inline vf vf_log_ends(vf x, vf inside)
{
    const vf bottom = x <= (vf)(-VF_SMALLEST_NORMAL) ? (vf)(NAN) : (vf)(-INFINITY);
    const vf upper = x < (vf)(INFINITY) ? inside : x;
    return x < (vf)(VF_SMALLEST_NORMAL) ? bottom : upper;
}

// Within 1 ulp (0.88).
static inline vf vf_log(vf x)
{
    // x = 2^k (1 + f) with 1 + f in [sqrt(1/2), sqrt(2))
    const vi k = vf_exponent(x, 0x3f3504f3u);
    const vf f = vf_mantissa(x, k) - 1.0f;
    const vf n = VF_FROM_VI(k);
    vf p = fma(f, (vf)(-0x1.3903dep-4f), (vf)(0x1.0573a0p-3f)); // 2^-27.3
    p = fma(p, f, (vf)(-0x1.0d81dep-3f));
    p = fma(p, f, (vf)(0x1.22d648p-3f));
    p = fma(p, f, (vf)(-0x1.54722cp-3f));
    p = fma(p, f, (vf)(0x1.99a034p-3f));
    p = fma(p, f, (vf)(-0x1.000228p-2f));
    p = fma(p, f, (vf)(0x1.555554p-2f));
    p = fma(p, f, (vf)(-0.5f));
    const vf rest = fma(p, f * f, n * -0x1.05c610p-29f);
    return vf_log_ends(x, fma(n, (vf)(0x1.62e430p-1f), f + rest));
}

// Within 1 ulp (0.96).
static inline vf vf_log2(vf x)
{
    const vi k = vf_exponent(x, 0x3f3504f3u);
    const vf f = vf_mantissa(x, k) - 1.0f;
    vf p = fma(f, (vf)(-0x1.c3bc66p-4f), (vf)(0x1.7f3192p-3f)); // 2^-27.7
    p = fma(p, f, (vf)(-0x1.87f664p-3f));
    p = fma(p, f, (vf)(0x1.a2c888p-3f));
    p = fma(p, f, (vf)(-0x1.eaa250p-3f));
    p = fma(p, f, (vf)(0x1.277f4ap-2f));
    p = fma(p, f, (vf)(-0x1.715afep-2f));
    p = fma(p, f, (vf)(0x1.ec7094p-2f));
    p = fma(p, f, (vf)(-0x1.715470p-1f));
    p = fma(p, f, (vf)(0x1.4ae0c0p-26f)); // 1 / log(2), less the float of it that follows
    return vf_log_ends(x, VF_FROM_VI(k) + fma(f, (vf)(0x1.715476p+0f), p * f));
}

// log2(x) as two floats with a relative error below 2^-32, for normal finite x > 0.
// x = 2^k m, and log2(m) = log2(c) + 2 atanh((m - c) / (m + c)) / log(2) with the c of two that is nearer to
// m. The second c is a float whose logarithm lies within 2^-35 of one with 17 fractional bits, so that
// k + log2(c) is exact: the accurate tables of Gal and Bachelis, "An Accurate Elementary Mathematical
// Library for the IEEE Floating Point Standard", 1991.
static inline vf2 vf_log2_exact(vf x)
{
    const vi k = vf_exponent(x, 0x3f5744fdu); // m in [2^-1/4, 2^3/4)
    const vf m = vf_mantissa(x, k);
    const vm upper = m > (vf)(0x1.306fe0p+0f);
    const vf c = upper ? (vf)(0x1.6a13b4p+0f) : (vf)(1.0f);
    const vf base = VF_FROM_VI(k) + (upper ? (vf)(0x1.0014p-1f) : (vf)(0.0f));

    // s + s_low is the quotient: m - c is exact, m + c has its rounding error in den.lo.
    const vf num = m - c;
    const vf2 den = fast_two_sum(c, m);
    const vf inverse = (vf)(1.0f) / den.hi;
    const vf s = num * inverse;
    const vf s_low = inverse * fma(-s, den.lo, fma(-s, den.hi, num));
    const vf z = s * s;
    vf p = fma(z, (vf)(0x1.aa9040p-2f), (vf)(0x1.2774c4p-1f)); // 2^-36.8
    p = fma(p, z, (vf)(0x1.ec709ep-1f));

    const vf scale = (vf)(0x1.715476p+1f); // 2 / log(2), its rest in the last step
    const vf2 lead = two_product(scale, s);
    const vf slope = fma(z, s_low, s_low); // the derivative of atanh is 1 + s^2 + ...
    const vf rest = fma(scale, slope, fma(s, (vf)(0x1.4ae0c0p-25f), s * z * p));
    const vf2 sum = fast_two_sum(base, lead.hi);
    return fast_two_sum(sum.hi, sum.lo + (lead.lo + rest));
}

// x to the power y for finite y >= 0, within 1.5 ulp (1.28). pow(x, 0) = 1 for every x; otherwise negative x
// counts as 0 and NaN gives NaN. Results below 2^-126 (1 + 2^-17) may be 0, those above 2^128 (1 - 2^-17)
// infinite.
static inline vf vf_pow(vf x, vf y)
{
    const vf2 logarithm = vf_log2_exact(x);
    const vf exponent = y * logarithm.hi;
    const vf rest = fma(y, logarithm.lo, fma(y, logarithm.hi, -exponent));
    const vf magic = exponent + VF_ROUND_MAGIC;
    const vf power = vf_exp2_parts(magic, (exponent - (magic - VF_ROUND_MAGIC)) + rest);
    const vf bounded = exponent < (vf)(128.0f) ? power : (vf)(INFINITY);
    const vf inside = exponent > (vf)(-126.0f) ? bounded : (vf)(0.0f);
    const vf outside = x < (vf)(VF_SMALLEST_NORMAL) ? (vf)(0.0f) : x;
    const vm normal = (x >= (vf)(VF_SMALLEST_NORMAL)) & (x < (vf)(INFINITY));
    const vf result = normal ? inside : outside;
    return y == (vf)(0.0f) ? (vf)(1.0f) : result;
}
#endif

#endif
