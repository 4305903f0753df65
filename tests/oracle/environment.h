/* The environment map of section 2: radiance by direction, and directions by radiance. Knows nothing of
 * surfaces. */
#ifndef ORACLE_ENVIRONMENT_H
#define ORACLE_ENVIRONMENT_H

#include "quadrature.h"
#include "scene.h"

/* Sets the environment's turn about y, in degrees. */
void environment_turn(Environment *environment, real degrees);
/* Where a unit direction looks the map up, both in [0, 1]. */
void environment_uv(const Environment *environment, Vec d, real *u, real *v);
/* Inverse of environment_uv. */
Vec environment_direction(const Environment *environment, real u, real v);
Vec environment_radiance(const Environment *environment, Vec d);

/* Makes the tables of importance sampling. */
void environment_prepare(Store *store, Environment *environment);
/* A direction with a density about as the radiance; needs the tables. */
Vec environment_choose(const Environment *environment, Square s);
/* That density, by solid angle. */
real environment_density(const Environment *environment, Vec d);

#endif
