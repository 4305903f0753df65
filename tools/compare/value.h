// Values: what a value of a picture means, as light and on a display. It knows nothing of files.
#ifndef CLRT_COMPARE_VALUE_H
#define CLRT_COMPARE_VALUE_H

#include "base/types.h"

typedef struct ValueScale {
    f32 peak;  // the value of white, at most 65535
    bool srgb; // values are sRGB-encoded whole numbers up to peak, else proportional to light
} ValueScale;

// 1 is white; values that are proportional to light may be beyond it, and below 0.
f64 value_light(ValueScale scale, f32 value);

// What a display is sent: sRGB-encoded, clamped to [0, 1]. The value is no NaN.
f64 value_display(ValueScale scale, f32 value);

#endif
