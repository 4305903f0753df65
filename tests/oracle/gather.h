/* The light that falls on a hit: from lights and the environment, and the unoccluded share of the ambient. */
#ifndef ORACLE_GATHER_H
#define ORACLE_GATHER_H

#include "spot.h"

Vec gather_lights(const Spot *spot);
/* Only pbr takes it. */
Vec gather_environment(const Spot *spot);
/* AO of section 4, 1 where the scene does not ask for it. */
real gather_openness(const Spot *spot);

#endif
