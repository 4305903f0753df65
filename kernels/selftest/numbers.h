// The functions of base/ on columns of numbers.
#ifndef CLRT_KERNELS_SELFTEST_NUMBERS_H
#define CLRT_KERNELS_SELFTEST_NUMBERS_H

#include "base/math.h"
#include "base/offset.h"
#include "base/random.h"
#include "base/vec.h"
#include "shared/self_test.h"

static inline v3 column3(global const f32 *p, uint stride)
{
    return v3_make(VF_LOAD(p), VF_LOAD(p + stride), VF_LOAD(p + 2 * stride));
}

static inline void store_column3(v3 a, global f32 *p, uint stride)
{
    VF_STORE(a.x, p);
    VF_STORE(a.y, p + stride);
    VF_STORE(a.z, p + 2 * stride);
}

// in: of the first of LANES places.
static inline v3 apply_function(uint function, global const f32 *in, uint stride)
{
    const vf a = VF_LOAD(in), b = VF_LOAD(in + stride);
    const vf c = VF_LOAD(in + 2 * stride), d = VF_LOAD(in + 3 * stride);
    v3 r = v3_splat(0.0f);
    switch (function) {
    case FUNCTION_SIN: r.x = vf_sin(a); break;
    case FUNCTION_COS: r.x = vf_cos(a); break;
    case FUNCTION_ACOS: r.x = vf_acos(a); break;
    case FUNCTION_ATAN2: r.x = vf_atan2(b, a); break;
    case FUNCTION_EXP: r.x = vf_exp(a); break;
    case FUNCTION_EXP2: r.x = vf_exp2(a); break;
    case FUNCTION_LOG: r.x = vf_log(a); break;
    case FUNCTION_LOG2: r.x = vf_log2(a); break;
    case FUNCTION_POW: r.x = vf_pow(a, b); break;
    case FUNCTION_DIVIDE: r.x = a / b; break;
    case FUNCTION_SQRT: r.x = sqrt(a); break;
    case FUNCTION_EXPRESSION: r.x = a * b - c * d; break;
    case FUNCTION_PRODUCTS: r.x = difference_of_products(a, b, c, d); break;
    case FUNCTION_NORMALIZE: r = v3_normalize(v3_make(a, b, c)); break;
    case FUNCTION_UNIT: r.x = random_unit(VU_LOAD((global const uint *)in)); break;
    case FUNCTION_LEAVE:
        r = offset_origin(column3(in, stride), column3(in + 3 * stride, stride),
                          column3(in + 6 * stride, stride), column3(in + 9 * stride, stride));
        break;
    }
    return r;
}

#endif
