/* Section 3: what a ray meets. Brute force over all primitives. Knows nothing of lights or shading. */
#ifndef ORACLE_HIT_H
#define ORACLE_HIT_H

#include "shape.h"

/* d is a unit vector. Where the ray starts on a surface, `from` is its primitive and `patch` its patch, so
 * that the surface is not met again at its own point. */
typedef struct Ray {
    Vec o, d;
    const Primitive *from;
    int patch;
} Ray;

typedef struct Hit {
    const Primitive *primitive;
    int patch;
    real t;
    Vec point;       /* world */
    Vec local;       /* the same in the shape's space */
    Surface surface; /* in the shape's space */
    Vec normal;      /* world, geometric, outward, unit */
    Vec shading;     /* world, unit, interpolated or mapped, on the side of `normal` */
} Hit;

bool hit_closest(const Scene *scene, const Ray *ray, Hit *hit);
/* Product of k_t over every surface within the distance, but for the area light that the ray goes to: its
 * index, or -1. */
Vec hit_transmittance(const Scene *scene, const Ray *ray, real distance, int light);
/* Whether any surface, also one that transmits, is within the distance. */
bool hit_any(const Scene *scene, const Ray *ray, real distance);

#endif
