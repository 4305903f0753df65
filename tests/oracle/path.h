/* Section 6: the path integrator, as a mean over random paths. */
#ifndef ORACLE_PATH_H
#define ORACLE_PATH_H

#include "quadrature.h"
#include "spot.h"

/* Radiance along a camera ray by one random path: its expected value is the contract's. */
Vec path_radiance(const Scene *scene, const Ray *ray, Chance *chance);

#endif
