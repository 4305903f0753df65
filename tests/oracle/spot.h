/* A hit as shading sees it: its normals by the side that the ray came from, and the rays of mirrors and
 * smooth transmission (sections 3, 4 and 5). Knows nothing of lights. */
#ifndef ORACLE_SPOT_H
#define ORACLE_SPOT_H

#include "look.h"

/* A hit with its normals turned to the ray's origin. */
typedef struct Spot {
    const Scene *scene;
    const Hit *hit;
    Look look;
    Vec d;         /* of the ray that came */
    Vec geometric, normal;
    Vec mirror;    /* the normal of reflection, refraction and fresnel */
    bool entering;
} Spot;

/* The reflected and the transmitted ray; a weight is 0 where there is none. */
typedef struct Split {
    Vec reflect, transmit; /* weights */
    Vec mirrored, through; /* directions */
} Split;

/* `hit` must outlive the spot. */
Spot spot_at(const Scene *scene, const Ray *ray, const Hit *hit);
/* Whether light of that direction arrives: above the surface by both normals. */
bool spot_sees(const Spot *spot, Vec direction);
Ray spot_ray(const Spot *spot, Vec direction);
Split spot_split(const Spot *spot);

/* Exact unpolarised reflectance of a dielectric; `cosine` of the incoming angle >= 0, `eta` the ratio of the
 * indices before and behind. 1 on total internal reflection. */
real fresnel_reflectance(real cosine, real eta);

#endif
