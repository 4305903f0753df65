// Vectors of three vf, with stated rounding: every sum and product is written out, fma only where named.
#ifndef CLRT_KERNELS_BASE_VEC_H
#define CLRT_KERNELS_BASE_VEC_H

#include "base/lanes.h"

typedef struct { vf x, y, z; } v3;

static inline v3 v3_make(vf x, vf y, vf z) { v3 r; r.x = x; r.y = y; r.z = z; return r; }
static inline v3 v3_splat(real s) { return v3_make((vf)(s), (vf)(s), (vf)(s)); }
static inline v3 v3_from(float4 s) { return v3_make((vf)(s.x), (vf)(s.y), (vf)(s.z)); }
static inline v3 v3_add(v3 a, v3 b) { return v3_make(a.x + b.x, a.y + b.y, a.z + b.z); }
static inline v3 v3_sub(v3 a, v3 b) { return v3_make(a.x - b.x, a.y - b.y, a.z - b.z); }
static inline v3 v3_mul(v3 a, v3 b) { return v3_make(a.x * b.x, a.y * b.y, a.z * b.z); }
static inline v3 v3_scale(v3 a, vf s) { return v3_make(a.x * s, a.y * s, a.z * s); }
static inline v3 v3_neg(v3 a) { return v3_make(-a.x, -a.y, -a.z); }
static inline v3 v3_abs(v3 a) { return v3_make(fabs(a.x), fabs(a.y), fabs(a.z)); }
static inline v3 v3_select(vm m, v3 a, v3 b)
{
    return v3_make(m ? a.x : b.x, m ? a.y : b.y, m ? a.z : b.z);
}

// a + s b, one rounding a component.
static inline v3 v3_fma(v3 b, vf s, v3 a)
{
    return v3_make(fma(b.x, s, a.x), fma(b.y, s, a.y), fma(b.z, s, a.z));
}

// Error at most 3 rounding units of the sum of |a_i b_i|.
static inline vf v3_dot(v3 a, v3 b) { return fma(a.z, b.z, fma(a.y, b.y, a.x * b.x)); }

// a b - c d with an error below 1.5 ulp of the result, whatever cancels (Kahan; Jeannerod, Louvet and
// Muller, "Further analysis of Kahan's algorithm for the accurate computation of 2 x 2 determinants", 2013).
static inline vf difference_of_products(vf a, vf b, vf c, vf d)
{
    const vf cd = c * d;
    const vf error = fma(c, d, -cd);
    return fma(a, b, -cd) - error;
}

// Zero or non-finite vectors give NaN; length within 3 rounding units of 1 otherwise (squares must not
// overflow or underflow).
static inline v3 v3_normalize(v3 a)
{
#if MATH_FAST
    return v3_scale(a, native_rsqrt(v3_dot(a, a)));
#else
    const vf inverse = (vf)(1.0f) / sqrt(v3_dot(a, a));
    return v3_scale(a, inverse);
#endif
}

#endif
