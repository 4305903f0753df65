// Lanes: one source for every SIMD width. A kernel function works on LANES rays at once; LANES is 1 on
// GPUs (where the hardware vectorises) and the width of a vector register on CPUs (4, 8 or 16).
// Every operation is lane-wise and correctly rounded, so LANES never changes a bit of the result.
//
//   real  one number             vf  LANES reals      vi, vu  LANES 32-bit integers
//   vm    LANES truth values: what comparing vf gives; combine with & | !, choose with m ? a : b
//         (a and b both of vector type: write (vf)(0.0f)). Never ~m, never m == -1.
#ifndef CLRT_KERNELS_BASE_LANES_H
#define CLRT_KERNELS_BASE_LANES_H

#include "shared/types.h"

#if MATH_FAST
#pragma OPENCL FP_CONTRACT ON
#else
#pragma OPENCL FP_CONTRACT OFF
#endif

// For functions with much code that are called from several places or once a LANES rays: a call costs nothing
// there, and one copy of the code keeps the time of compiling down (a third of it for the reference scene).
#define OUTLINE static __attribute__((noinline))

// Numbers of the scene and of the film are floats in memory (f32), whatever a real is. REAL chooses between
// the two roundings of a constant.
#if MATH_DOUBLE
#if LANES != 1
#error "doubles are for LANES 1"
#endif
#pragma OPENCL EXTENSION cl_khr_fp64 : enable
typedef double real;
#define REAL(as_float, as_double) (as_double)
#else
typedef float real;
#define REAL(as_float, as_double) (as_float)
#endif

#if LANES == 1
typedef real vf;
typedef int vi;
typedef uint vu;
typedef int vm;
#define LANE_IOTA 0
#define VF_LOAD(p) (*(p))
#define VF_STORE(v, p) (*(p) = (v))
#define VI_LOAD(p) (*(p))
#define VI_STORE(v, p) (*(p) = (v))
#define VU_LOAD(p) (*(p))
#define VU_STORE(v, p) (*(p) = (v))
#if !MATH_DOUBLE
#define VI_AS_VF(v) as_float(v)
#define VF_AS_VI(v) as_int(v)
#define VF_AS_VU(v) as_uint(v)
#define VU_AS_VF(v) as_float(v)
#endif
#define VI_FROM_VF(v) convert_int(v)
#define VU_FROM_VI(v) ((uint)(v))
#define VI_FROM_VU(v) ((int)(v))
#define VF_FROM_VI(v) ((vf)(v))
#define VF_FROM_VU(v) ((vf)(v))
#elif LANES == 4
#define LANE_SUFFIX(name) name##4
#define LANE_IOTA (int4)(0, 1, 2, 3)
#elif LANES == 8
#define LANE_SUFFIX(name) name##8
#define LANE_IOTA (int8)(0, 1, 2, 3, 4, 5, 6, 7)
#elif LANES == 16
#define LANE_SUFFIX(name) name##16
#define LANE_IOTA (int16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15)
#else
#error "LANES must be 1, 4, 8 or 16"
#endif

#if LANES > 1
typedef LANE_SUFFIX(float) vf;
typedef LANE_SUFFIX(int) vi;
typedef LANE_SUFFIX(uint) vu;
typedef LANE_SUFFIX(int) vm;
// p points to 4-byte numbers in any address space and needs their alignment only.
#define VF_LOAD(p) LANE_SUFFIX(vload)(0, p)
#define VF_STORE(v, p) LANE_SUFFIX(vstore)(v, 0, p)
#define VI_LOAD(p) LANE_SUFFIX(vload)(0, p)
#define VI_STORE(v, p) LANE_SUFFIX(vstore)(v, 0, p)
#define VU_LOAD(p) LANE_SUFFIX(vload)(0, p)
#define VU_STORE(v, p) LANE_SUFFIX(vstore)(v, 0, p)
#define VI_AS_VF(v) LANE_SUFFIX(as_float)(v)
#define VF_AS_VI(v) LANE_SUFFIX(as_int)(v)
#define VF_AS_VU(v) LANE_SUFFIX(as_uint)(v)
#define VU_AS_VF(v) LANE_SUFFIX(as_float)(v)
// Towards zero; the caller keeps v within the range of int.
#define VI_FROM_VF(v) LANE_SUFFIX(convert_int)(v)
#define VU_FROM_VI(v) LANE_SUFFIX(as_uint)(v)
#define VI_FROM_VU(v) LANE_SUFFIX(as_int)(v)
#define VF_FROM_VI(v) LANE_SUFFIX(convert_float)(v)
#define VF_FROM_VU(v) LANE_SUFFIX(convert_float)(v)
#endif

typedef union { vf v; real s[LANES]; } LanesF;
typedef union { vi v; int s[LANES]; } LanesI;

// Bit k is set where lane k is true.
static inline uint vm_bits(vm m)
{
#if LANES == 1
    return m ? 1u : 0u;
#elif LANES == 8 && defined(__has_builtin) && defined(__AVX__)
    return (uint)__builtin_ia32_movmskps256(as_float8(m));
#elif LANES == 4 && defined(__has_builtin) && defined(__SSE__)
    return (uint)__builtin_ia32_movmskps(as_float4(m));
#else
    LanesI lanes;
    lanes.v = m;
    uint bits = 0;
    for (int k = 0; k < LANES; k++)
        bits |= (lanes.s[k] ? 1u : 0u) << k;
    return bits;
#endif
}

static inline vm vm_from_bits(uint bits)
{
#if LANES == 1
    return (int)(bits & 1u);
#else
    return (((vi)((int)bits) >> LANE_IOTA) & (vi)(1)) != (vi)(0);
#endif
}

static inline bool vm_any(vm m) { return vm_bits(m) != 0; }
static inline bool vm_all(vm m) { return vm_bits(m) == (1u << LANES) - 1u; }

// min and max that give b where either is NaN.
static inline vf vf_min(vf a, vf b) { return a < b ? a : b; }
static inline vf vf_max(vf a, vf b) { return a > b ? a : b; }
static inline vf vf_clamp(vf x, real low, real high) { return vf_min(vf_max(x, (vf)(low)), (vf)(high)); }

// p[index] for each lane; every index must be valid, also those of lanes that do not matter.
OUTLINE vf vf_gather(global const f32 *p, vi index)
{
    LanesI i;
    LanesF r;
    i.v = index;
    for (int k = 0; k < LANES; k++)
        r.s[k] = p[i.s[k]];
    return r.v;
}

#if MATH_DOUBLE
static inline vf real_gather(global const real *p, vi index) { return p[index]; }
#else
#define real_gather vf_gather
#endif

OUTLINE vi vi_gather(global const int *p, vi index)
{
    LanesI i, r;
    i.v = index;
    for (int k = 0; k < LANES; k++)
        r.s[k] = p[i.s[k]];
    return r.v;
}

// p[index] = value in the lanes of m.
OUTLINE void vf_scatter(global real *p, vi index, vf value, vm m)
{
    LanesI i, on;
    LanesF x;
    i.v = index;
    on.v = m;
    x.v = value;
    for (int k = 0; k < LANES; k++)
        if (on.s[k])
            p[i.s[k]] = x.s[k];
}

OUTLINE void vi_scatter(global int *p, vi index, vi value, vm m)
{
    LanesI i, on, x;
    i.v = index;
    on.v = m;
    x.v = value;
    for (int k = 0; k < LANES; k++)
        if (on.s[k])
            p[i.s[k]] = x.s[k];
}

#endif
