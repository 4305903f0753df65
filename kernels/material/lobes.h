// Specular highlights, and what a smooth boundary reflects and transmits.
#ifndef CLRT_KERNELS_MATERIAL_LOBES_H
#define CLRT_KERNELS_MATERIAL_LOBES_H

#include "base/vec.h"
#if HAS_SPECULAR
#include "base/exp_log.h"
#if HAS_PATH
#include "base/frame.h"
#endif
#endif

#if HAS_PHONG || HAS_REFLECT || (HAS_PATH && HAS_SPECULAR)
// Reflected direction, D - 2 (D.N) N.
static inline v3 reflect_about(v3 dir, v3 normal)
{
    return v3_fma(normal, -2.0f * v3_dot(dir, normal), dir);
}
#endif

#if HAS_SPECULAR
// cos^exponent from versine = 1 - cos >= 0; 0 where cos <= 0, but 0^0 = 1. What 1 - versine loses by rounding
// is put back by the series of (1 + low / high)^exponent, so that highlights stay smooth up to exponents of
// 1e6, where a rounded cosine has steps of 6 percent.
static inline vf lobe_power(vf versine, vf exponent)
{
    const vf high = vf_max((vf)(1.0f) - versine, (vf)(0.0f));
    const vf low = (1.0f - high) - versine;
    const vf z = high > (vf)(0.5f) ? exponent * low / high : (vf)(0.0f);
    const vf cubic = fma(z, (vf)(1.0f / 6.0f), (vf)(0.5f));
    return vf_pow(high, exponent) * fma(z, fma(z, cubic, (vf)(1.0f)), (vf)(1.0f));
}

// 1 - cos of the angle between two unit vectors: half the square of their difference.
static inline vf versine_between(v3 a, v3 b)
{
    const v3 d = v3_sub(a, b);
    return 0.5f * v3_dot(d, d);
}

#if HAS_PHONG
// max(0, R.V)^n with R the mirrored light direction.
static inline vf lobe_phong(v3 normal, v3 to_light, v3 to_eye, vf exponent)
{
    const v3 mirrored = v3_neg(reflect_about(to_light, normal));
    return lobe_power(versine_between(mirrored, to_eye), exponent);
}
#endif

#if HAS_BLINN
// max(0, N.H)^n with H half-way between light and eye.
static inline vf lobe_blinn(v3 normal, v3 to_light, v3 to_eye, vf exponent)
{
    const v3 sum = v3_add(to_light, to_eye);
    const vf squared = v3_dot(sum, sum);
    const vf inverse = (vf)(1.0f) / sqrt(squared > (vf)(0.0f) ? squared : (vf)(1.0f));
    return lobe_power(versine_between(v3_scale(sum, inverse), normal), exponent);
}
#endif
#endif

#if HAS_SPECULAR && HAS_PATH
// A direction about the unit axis with density (exponent + 1) / (2 pi) cos^exponent over solid angle. 1 - cos is
// 1 - u^(1 / (exponent + 1)), by its series where that is small.
static inline v3 lobe_direction(v3 axis, vf exponent, vf u, vf turn)
{
    const vf x = -vf_log(vf_max(u, (vf)(0x1p-25f))) / (exponent + 1.0f);
    const vf series = x * fma(x, fma(x, (vf)(1.0f / 6.0f), (vf)(-0.5f)), (vf)(1.0f));
    const vf versine = x < (vf)(0.01f) ? series : 1.0f - vf_exp(-x);
    const Frame frame = frame_about(axis);
    return frame_direction(&frame, sqrt(versine * (2.0f - versine)), 1.0f - versine, turn);
}
#endif

#if HAS_TRANSMIT || HAS_FRESNEL
// Snell's law at one boundary. eta: index before over index behind; rest = 1 - eta^2 rounded once, so that
// the verdict on total reflection near the critical angle is that of exact arithmetic within an ulp.
typedef struct {
    vf cos_in, cos_out;
    vm total; // total internal reflection; cos_out is 0
} Refraction;

static inline Refraction refract_cosines(vf cos_in, vf eta, vf rest)
{
    Refraction r;
    const vf scaled = eta * cos_in;
    const vf squared = fma(scaled, scaled, rest);
    r.cos_in = cos_in;
    r.total = squared < (vf)(0.0f);
    r.cos_out = sqrt(vf_max(squared, (vf)(0.0f)));
    return r;
}

// Reflectance of a dielectric for unpolarised light (Fresnel; Born and Wolf, Principles of Optics, 1.5.2).
static inline vf fresnel_dielectric(const Refraction *r, vf eta)
{
    const vf s_in = eta * r->cos_in, p_out = eta * r->cos_out;
    const vf s = (s_in - r->cos_out) / (s_in + r->cos_out);
    const vf p = (p_out - r->cos_in) / (p_out + r->cos_in);
    return r->total ? (vf)(1.0f) : 0.5f * fma(s, s, p * p);
}
#endif

#endif
