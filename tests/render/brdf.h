// How much of light 1 from everywhere a material sends to the eye, summed in double from the scene language's
// words.
#ifndef CLRT_TESTS_RENDER_BRDF_H
#define CLRT_TESTS_RENDER_BRDF_H

#include "base/types.h"

// A grey material. cosine: of the angle between normal and eye.
typedef struct Matter {
    const char *kind;                                         // as scene files have it
    f64 diffuse, specular, shininess, reflect, transmit, ior; // base_color is diffuse
    bool fresnel;
    f64 metallic, roughness;
} Matter;

// Directional albedo, with all that mirrors and transmits.
f64 matter_albedo(const Matter *matter, f64 cosine);

// Exact reflectance of a dielectric of index ior, for light from outside.
f64 dielectric_reflectance(f64 cosine, f64 ior);

// "material NAME KIND { ... }\n" of it, appended to *text.
void matter_append(char **text, const char *name, const Matter *matter);

#endif
