// Arithmetic whose rounding error is known: sums and products with their errors, and two-float numbers.
// Exact as long as nothing overflows and no error term falls below 2^-126.
#ifndef CLRT_KERNELS_BASE_EXACT_H
#define CLRT_KERNELS_BASE_EXACT_H

#include "base/lanes.h"

#define VF_SMALLEST_NORMAL REAL(0x1p-126f, 0x1p-1022)
// Of floats. Added to |x| < 2^22 and taken away again it rounds x to an integer, which the low bits of the
// sum hold.
#define VF_ROUND_MAGIC 0x1.8p+23f

// The number after x, away from zero, where `outward`; else the one before. x: normal or infinite, not 0.
static inline vf vf_neighbour(vf x, vm outward)
{
#if MATH_DOUBLE
    return as_double(outward ? as_long(x) + 1 : as_long(x) - 1);
#else
    const vi bits = VF_AS_VI(x);
    return VI_AS_VF(outward ? bits + 1 : bits - 1);
#endif
}

// The same for one number, towards zero.
static inline real real_before(real x)
{
#if MATH_DOUBLE
    return as_double(as_long(x) - 1);
#else
    return as_float(as_int(x) - 1);
#endif
}

// hi + lo, where hi is that sum rounded to nearest: about 48 bits of floats.
typedef struct { vf hi, lo; } vf2;

static inline vf2 vf2_make(vf hi, vf lo) { vf2 r; r.hi = hi; r.lo = lo; return r; }

// a + b exactly, for |a| >= |b| or a = 0 (Dekker, "A Floating-Point Technique for Extending the Available
// Precision", 1971).
static inline vf2 fast_two_sum(vf a, vf b)
{
    const vf sum = a + b;
    return vf2_make(sum, b - (sum - a));
}

// a + b exactly (Knuth, "The Art of Computer Programming" 2, 4.2.2).
static inline vf2 two_sum(vf a, vf b)
{
    const vf sum = a + b;
    const vf b_part = sum - a;
    return vf2_make(sum, (a - (sum - b_part)) + (b - b_part));
}

// a b exactly.
static inline vf2 two_product(vf a, vf b)
{
    const vf product = a * b;
    return vf2_make(product, fma(a, b, -product));
}

// The bounds below, in u (2^-24 of floats), are those of Joldes, Muller and Popescu, "Tight and Rigorous Error Bounds
// for Basic Building Blocks of Double-Word Arithmetic", 2017: their algorithms 4, 6, 9 and 12.

// Relative error at most 2 u^2.
static inline vf2 vf2_add_vf(vf2 a, vf b)
{
    const vf2 sum = two_sum(a.hi, b);
    return fast_two_sum(sum.hi, a.lo + sum.lo);
}

// Relative error at most about 3 u^2, whatever cancels.
static inline vf2 vf2_add(vf2 a, vf2 b)
{
    const vf2 high = two_sum(a.hi, b.hi);
    const vf2 low = two_sum(a.lo, b.lo);
    const vf2 sum = fast_two_sum(high.hi, high.lo + low.hi);
    return fast_two_sum(sum.hi, low.lo + sum.lo);
}

// Relative error at most 2 u^2.
static inline vf2 vf2_mul_vf(vf2 a, vf b)
{
    const vf2 product = two_product(a.hi, b);
    return fast_two_sum(product.hi, fma(a.lo, b, product.lo));
}

// Relative error at most 5 u^2.
static inline vf2 vf2_mul(vf2 a, vf2 b)
{
    const vf2 product = two_product(a.hi, b.hi);
    const vf cross = fma(a.hi, b.lo, fma(a.lo, b.hi, a.lo * b.lo));
    return fast_two_sum(product.hi, product.lo + cross);
}

#endif
