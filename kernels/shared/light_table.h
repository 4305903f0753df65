// LightTable: lights drawn in proportion to their power by one number (the alias method; Walker, "An Efficient
// Method for Generating Discrete Random Variables with General Distributions", 1977).
#ifndef CLRT_SHARED_LIGHT_TABLE_H
#define CLRT_SHARED_LIGHT_TABLE_H

#include "shared/types.h"

// Lights that a path looks at for each shadow ray: all where there are not more, else so many of the table.
#define LIGHT_CHOICES 8

// How light of area lights and of the environment is looked for.
#define LIGHTS_BY_LIGHTS 1
#define LIGHTS_BY_SURFACES 2

// Entry k stands for light k and its alias: of numbers that fall on it, those below `keep` are light k.
typedef struct LightTableEntry {
    f32 keep;  // in [0, 1]
    u32 alias;
    f32 share; // probability of light k in all
    u32 padding;
} LightTableEntry;
LAYOUT_SIZE(LightTableEntry, 16);

#endif
