/* Lights of section 2 as seen from a point. Knows nothing of what stands between. */
#ifndef ORACLE_LIGHT_H
#define ORACLE_LIGHT_H

#include "scene.h"

typedef struct Arrival {
    Vec direction;  /* unit, to the light */
    real distance;  /* infinite for directional lights */
    Vec intensity;  /* attenuated */
} Arrival;

/* False where the light gives nothing at p. */
bool light_arrives(const Light *light, Vec p, Arrival *arrival);

#endif
