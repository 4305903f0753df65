// The whole program: host code defines HAS_X for every feature of shared/features.def, LANES, BATCH and GROUP.
#include "base/features.h"

#include "stages/render.cl"
