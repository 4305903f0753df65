#include "value.h"

#include "image/color.h"

#include <math.h>

f64 value_light(ValueScale scale, f32 value)
{
    const f64 part = (f64)value / (f64)scale.peak;
    return scale.srgb ? srgb_decode(part) : part;
}

f64 value_display(ValueScale scale, f32 value)
{
    const f64 part = fmin(fmax((f64)value / (f64)scale.peak, 0), 1);
    return scale.srgb ? part : srgb_encode(part);
}
