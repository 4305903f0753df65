// Aov: properties of a first hit that a render can give in place of radiance, three numbers a pixel.
#ifndef CLRT_SHARED_AOV_H
#define CLRT_SHARED_AOV_H

#include "shared/types.h"

#define AOV_NONE 0     // radiance
#define AOV_DEPTH 1    // distance from the ray's origin, three times; infinite where nothing is hit
#define AOV_NORMAL 2   // unit shading normal, on the side of the ray; 0 where nothing is hit
#define AOV_POSITION 3 // hit point in render space; infinite where nothing is hit
#define AOV_ALBEDO 4   // diffuse color, texture included; 0 where nothing is hit
#define AOV_ID 5       // place in the order of definition, low 24 bits and the rest; material; -1 -1 -1: nothing
#define AOV_COUNT 6

#endif
