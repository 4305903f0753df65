// How bright a color is, for choosing what to draw: never 0 where a channel is not.
#ifndef CLRT_KERNELS_MATERIAL_BRIGHTNESS_H
#define CLRT_KERNELS_MATERIAL_BRIGHTNESS_H

#include "base/vec.h"

static inline vf brightness(v3 color) { return fma(color.z, (vf)(0.25f), fma(color.y, (vf)(0.5f), color.x * 0.25f)); }

#endif
