/* Lights of section 2 as seen from a point. Knows nothing of what stands between. */
#ifndef ORACLE_LIGHT_H
#define ORACLE_LIGHT_H

#include "quadrature.h"
#include "scene.h"

typedef struct Arrival {
    Vec direction;  /* unit, to the light */
    real distance;  /* infinite for directional lights */
    Vec intensity;  /* attenuated; of an area light its irradiance E, as if all of it stood at this point */
} Arrival;

bool light_is_area(const Light *light);
/* False where the light gives nothing at p. `s` is the place on an area light: the mean over the square
 * counts. */
bool light_arrives(const Light *light, Vec p, Square s, Arrival *arrival);
/* Density by solid angle at p of the directions of light_arrives, for a uniform place on an area light: 0
 * where direction l does not lead to its bright side. */
real light_density(const Light *light, Vec p, Vec l);
/* Radiance of an area light's surface towards where a ray of direction d comes from; normal is the outward
 * one. */
Vec light_seen(const Light *light, Vec d, Vec normal);

#endif
