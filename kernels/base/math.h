// The elementary functions of the kernels; the built-in ones differ from device to device.
#ifndef CLRT_KERNELS_BASE_MATH_H
#define CLRT_KERNELS_BASE_MATH_H

#include "base/exp_log.h"
#include "base/trig.h"

#endif
