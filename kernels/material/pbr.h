// The metallic-roughness material (scene language, section 5): its brdf, and directions drawn by it.
//
// The brdf is one of a pair of unit vectors to light and eye. All of it is written in terms of their sum, whose
// angle to the normal and whose length have no cancellation where the lobe is narrow.
#ifndef CLRT_KERNELS_MATERIAL_PBR_H
#define CLRT_KERNELS_MATERIAL_PBR_H

#include "base/frame.h"

// Below this roughness a surface mirrors and has no lobe.
#define PBR_MIRROR 0.02f
#define PBR_GRAZING 1e-4f // least N.V of the masking term

typedef struct {
    v3 base_color;
    vf metallic, roughness;
    vf transmit; // as written: metals let nothing through
    vf f;        // base reflectance of a dielectric of that ior
} PbrLanes;

// Share of light that goes through rather than being scattered: the m of the scene language.
static inline vf pbr_through(const PbrLanes *m) { return m->transmit * (1.0f - m->metallic); }

static inline v3 pbr_f0(const PbrLanes *m)
{
    return v3_make(fma(m->metallic, m->base_color.x - m->f, m->f), fma(m->metallic, m->base_color.y - m->f, m->f),
                   fma(m->metallic, m->base_color.z - m->f, m->f));
}

// F0 + (1 - F0) (1 - cosine)^5, from versine = 1 - cosine (Schlick, "An Inexpensive BRDF Model", 1994).
static inline v3 pbr_schlick(v3 f0, vf versine)
{
    const vf v = vf_clamp(versine, 0.0f, 1.0f), square = v * v, power = square * square * v;
    return v3_make(fma(power, 1.0f - f0.x, f0.x), fma(power, 1.0f - f0.y, f0.y), fma(power, 1.0f - f0.z, f0.z));
}

// The lobe's share of the brdf's geometry at one pair of directions.
typedef struct {
    vf nl, nv;  // cosines to the light and, as the masking term takes it, to the eye
    vf versine; // 1 - V.H
    vf d;       // normal distribution at H
    vf a2;      // of its width, squared
} PbrGeometry;

// D = a^2 / (pi t^2) with t = (N.H)^2 (a^2 - 1) + 1 = sin^2 + a^2 cos^2 of the angle to H: the sine is the
// length of a cross product (Lagrange's identity), so that nothing cancels near the mirror direction.
// Walter et al., "Microfacet Models for Refraction through Rough Surfaces", 2007, eq. 33.
static inline PbrGeometry pbr_geometry(const PbrLanes *m, v3 n, v3 to_eye, v3 to_light)
{
    PbrGeometry g;
    const v3 h = v3_add(to_light, to_eye);
    const vf square = v3_dot(h, h), length = sqrt(square);
    const v3 across = v3_make(difference_of_products(n.y, h.z, n.z, h.y), difference_of_products(n.z, h.x, n.x, h.z),
                              difference_of_products(n.x, h.y, n.y, h.x));
    const vf safe = square > (vf)(0.0f) ? square : (vf)(1.0f);
    const vf sine2 = vf_min(v3_dot(across, across) / safe, (vf)(1.0f));
    const vf a = m->roughness * m->roughness;
    g.a2 = a * a;
    const vf t = fma(g.a2, 1.0f - sine2, sine2);
    g.d = g.a2 * INVERSE_PI / (t * t);
    g.versine = fma(length, (vf)(-0.5f), (vf)(1.0f)); // |L + V| = 2 V.H for unit vectors
    g.nl = v3_dot(n, to_light);
    g.nv = vf_max(v3_dot(n, to_eye), (vf)(PBR_GRAZING));
    return g;
}

// Smith's masking and shadowing, height-correlated, over 4 N.L N.V (Heitz, "Understanding the
// Masking-Shadowing Function in Microfacet-Based BRDFs", JCGT 2014, eq. 99).
static inline vf pbr_visibility(const PbrGeometry *g)
{
    const vf rest = 1.0f - g->a2;
    const vf eye = g->nl * sqrt(fma(rest, g->nv * g->nv, g->a2));
    const vf light = g->nv * sqrt(fma(rest, g->nl * g->nl, g->a2));
    return (vf)(0.5f) / (eye + light);
}

// The brdf, without the cosine; for N.L > 0.
OUTLINE v3 pbr_brdf(const PbrLanes *m, v3 n, v3 to_eye, v3 to_light)
{
    const PbrGeometry g = pbr_geometry(m, n, to_eye, to_light);
    const v3 fresnel = pbr_schlick(pbr_f0(m), g.versine);
    const vf body = (1.0f - m->metallic) * (1.0f - m->transmit) * INVERSE_PI;
    const vf rough = (1.0f - pbr_through(m)) * g.d * pbr_visibility(&g);
    const vf lobe = m->roughness >= (vf)(PBR_MIRROR) ? rough : (vf)(0.0f);
    const v3 scattered = v3_make((1.0f - fresnel.x) * m->base_color.x, (1.0f - fresnel.y) * m->base_color.y,
                                 (1.0f - fresnel.z) * m->base_color.z);
    return v3_fma(fresnel, lobe, v3_scale(scattered, body));
}

#if HAS_ENVIRONMENT_LIGHT || HAS_PATH
#include "material/brightness.h"

#if !HAS_PATH
// Probability with which the lobe rather than the cosine draws a direction: about its share of what is
// reflected. Never 0 for a rough surface that the eye sees from above, and never 1 where the body scatters.
static inline vf pbr_lobe_share(const PbrLanes *m, v3 n, v3 to_eye)
{
    const vf nv = v3_dot(n, to_eye);
    const v3 fresnel = pbr_schlick(pbr_f0(m), 1.0f - nv);
    const vf lobe = (1.0f - pbr_through(m)) * brightness(fresnel);
    const vf body = (1.0f - m->metallic) * (1.0f - m->transmit) * brightness(m->base_color);
    const vf share = vf_clamp(lobe / vf_max(lobe + body, (vf)(1e-6f)), 0.1f, 0.9f);
    const vf either = body > (vf)(0.0f) ? share : (vf)(1.0f);
    const vm rough = (m->roughness >= (vf)(PBR_MIRROR)) & (nv > (vf)(PBR_GRAZING));
    return rough ? either : (vf)(0.0f);
}

#endif

// A visible normal of the distribution for an eye at `eye` above the surface z = 0, in that frame: the cap of the
// sphere that the eye sees, after squashing (Dupuy and Benyoub, "Sampling Visible GGX Normals with Spherical
// Caps", 2023).
static inline v3 visible_normal(v3 eye, vf a, vf u, vf v)
{
    const v3 wide = v3_normalize(v3_make(eye.x * a, eye.y * a, eye.z));
    const SineCosine turn = vf_sincos(v * TWO_PI);
    const vf z = fma(1.0f - u, 1.0f + wide.z, -wide.z);
    const vf sine = sqrt(vf_clamp(fma(-z, z, (vf)(1.0f)), 0.0f, 1.0f));
    const v3 cap = v3_add(v3_make(sine * turn.cosine, sine * turn.sine, z), wide);
    return v3_normalize(v3_make(cap.x * a, cap.y * a, vf_max(cap.z, (vf)(0.0f))));
}

#if HAS_PATH
// The mirror of the eye in a visible normal; it may lie below the surface, where nothing is reflected.
static inline v3 pbr_lobe_direction(const PbrLanes *m, v3 n, v3 to_eye, vf u, vf v)
{
    const Frame frame = frame_about(n);
    const v3 eye = v3_make(v3_dot(frame.x, to_eye), v3_dot(frame.y, to_eye), v3_dot(n, to_eye));
    const v3 local_h = visible_normal(eye, m->roughness * m->roughness, u, v);
    const v3 h = v3_fma(n, local_h.z, v3_fma(frame.y, local_h.y, v3_scale(frame.x, local_h.x)));
    return v3_normalize(v3_fma(h, 2.0f * v3_dot(eye, local_h), v3_neg(to_eye)));
}

// Its density over solid angle, for N.L > 0.
static inline vf pbr_lobe_density(const PbrGeometry *g)
{
    return g->d * 0.5f / (g->nv + sqrt(fma(1.0f - g->a2, g->nv * g->nv, g->a2)));
}
#else
// A direction for the point (u, v); `choice`, uniform in [0, 1), takes the lobe or the body. It may lie below
// the surface, where nothing is reflected.
OUTLINE v3 pbr_sample(const PbrLanes *m, v3 n, v3 to_eye, vf u, vf v, vf choice)
{
    const Frame frame = frame_about(n);
    const v3 eye = v3_make(v3_dot(frame.x, to_eye), v3_dot(frame.y, to_eye), v3_dot(n, to_eye));
    const v3 local_h = visible_normal(eye, m->roughness * m->roughness, u, v);
    const v3 h = v3_fma(n, local_h.z, v3_fma(frame.y, local_h.y, v3_scale(frame.x, local_h.x)));
    const v3 mirrored = v3_normalize(v3_fma(h, 2.0f * v3_dot(eye, local_h), v3_neg(to_eye)));
    return v3_select(choice < pbr_lobe_share(m, n, to_eye), mirrored, cosine_direction(n, u, v));
}

// Density of pbr_sample's directions over solid angle, for N.L > 0.
OUTLINE vf pbr_pdf(const PbrLanes *m, v3 n, v3 to_eye, v3 to_light)
{
    const PbrGeometry g = pbr_geometry(m, n, to_eye, to_light);
    const vf share = pbr_lobe_share(m, n, to_eye);
    const vf visible = g.d * 0.5f / (g.nv + sqrt(fma(1.0f - g.a2, g.nv * g.nv, g.a2)));
    const vf lobe = share > (vf)(0.0f) ? share * visible : (vf)(0.0f);
    return fma(1.0f - share, g.nl * INVERSE_PI, lobe);
}
#endif
#endif

#endif
