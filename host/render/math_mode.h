// MathMode: the arithmetic that kernels are compiled with. What each promises stands in kernels/README.md.
#ifndef CLRT_RENDER_MATH_MODE_H
#define CLRT_RENDER_MATH_MODE_H

#include "base/error.h"
#include "device/list.h"

typedef enum MathMode {
    MATH_EXACT,  // floats, rounded as they are written: the same bytes on every device
    MATH_FAST,   // floats, with the device's own functions, divide and contraction
    MATH_DOUBLE, // doubles: the reference for the error of the others
    MATH_MODES
} MathMode;

// "exact", "fast" or "double".
const char *math_mode_name(MathMode math);
// MATH_MODES where there is none of that name.
MathMode math_mode_find(const char *name);

// Fails with ERROR_DEVICE where the device cannot do it.
bool math_mode_check(MathMode math, const DeviceInfo *info, Error *error);

#endif
