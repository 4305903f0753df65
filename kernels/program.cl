// The whole program: host code defines HAS_X for every feature of shared/features.def, LANES, BATCH,
// GROUP, MATH_FAST and MATH_DOUBLE.
#include "base/features.h"

#include "stages/render.cl"
