/* What a material is at one point, its textures looked up, and how it scatters light there (sections 4 and
 * 5). Knows nothing of lights and rays. */
#ifndef ORACLE_LOOK_H
#define ORACLE_LOOK_H

#include "hit.h"

typedef struct Look {
    const Material *material;
    Vec emission, ambient; /* ambient: k_a, of pbr base_color occlusion */
    Vec diffuse;           /* phong, blinn_phong */
    Vec base, f0;          /* pbr and what follows */
    real metallic, roughness;
    real m; /* transmit (1 - metallic) */
} Look;

Look look_at_hit(const Scene *scene, const Hit *hit);
/* Roughness below which pbr is a mirror. */
#define MIRROR_ROUGHNESS 0.02L

/* Specular term S of section 4 for unit vectors. */
real specular_term(bool blinn, real shininess, Vec n, Vec to_light, Vec to_eye);
/* D of section 5; a is the squared roughness. */
real ggx_density(real a, real n_h);
/* Vis of section 5. */
real ggx_visibility(real a, real n_l, real n_v);
/* brdf of section 5; of a mirror its diffuse part. */
Vec pbr_brdf(const Look *look, Vec n, Vec to_light, Vec to_eye);

/* The brdf of section 6, without mirrors and smooth transmission. N.L > 0. */
Vec look_brdf(const Look *look, Vec n, Vec to_light, Vec to_eye);

/* Whether that brdf can be more than 0. */
bool look_scatters(const Look *look);

/* What is reflected of a punctual light of intensity 1, or of an irradiance of 1: phong and blinn_phong take
 * I / attenuation or E / pi for it, pbr I / attenuation or E. N.L > 0. */
Vec look_reflected(const Look *look, Vec n, Vec to_light, Vec to_eye);

#endif
