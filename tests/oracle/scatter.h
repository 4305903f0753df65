/* Ways to choose directions at a spot, each good where others are not, with their densities. An integral
 * takes directions of all of them, each value over the sum of all densities. */
#ifndef ORACLE_SCATTER_H
#define ORACLE_SCATTER_H

#include "quadrature.h"
#include "spot.h"

/* A light's index added to WAY_LIGHTS: towards that light. */
enum { WAY_COSINE, WAY_MAP, WAY_LOBE, WAY_LIGHTS };

/* Whether the spot has this way: a map needs an environment, a lobe a glossy part that is no mirror, a light
 * an area. */
bool scatter_has(const Spot *spot, int way);
/* A unit direction, or 0 where this point of the square gives none. */
Vec scatter_choose(const Spot *spot, int way, Square s);
/* Its density by solid angle, for directions that the spot sees; of a way that the spot has. */
real scatter_density(const Spot *spot, int way, Vec l);

#endif
