#include "image/color.h"

#include <math.h>

// From here on every curve's clamped value is 1 in double, and the products below cannot overflow.
static const f64 BRIGHTEST = 1e30;

// The clamp of the result; a NaN gives 0.
static f64 clamp01(f64 x)
{
    return x >= 1 ? 1 : x > 0 ? x : 0;
}

f64 tone_map_none(f64 c)
{
    return clamp01(c);
}

f64 tone_map_reinhard(f64 c)
{
    if (!(c > 0))
        return 0;
    return c >= BRIGHTEST ? 1 : c / (1 + c);
}

f64 tone_map_reinhard_extended(f64 c, f64 white)
{
    if (!(c > 0))
        return 0;
    if (c >= BRIGHTEST)
        return 1;
    // Two divisions: the square of a tiny white would be 0, of a huge one infinite.
    return clamp01(c * (1 + c / white / white) / (1 + c));
}

f64 tone_map_aces(f64 c)
{
    if (!(c > 0))
        return 0;
    return c >= BRIGHTEST ? 1 : clamp01(c * (2.51 * c + 0.03) / (c * (2.43 * c + 0.59) + 0.14));
}

static f64 hable_curve(f64 x)
{
    return (x * (0.15 * x + 0.05) + 0.004) / (x * (0.15 * x + 0.5) + 0.06) - 0.02 / 0.3;
}

f64 tone_map_hable(f64 c)
{
    if (!(c > 0))
        return 0;
    return c >= BRIGHTEST ? 1 : clamp01(hable_curve(2 * c) / hable_curve(11.2));
}

f64 srgb_encode(f64 linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

f64 srgb_decode(f64 encoded)
{
    return encoded <= 0.04045 ? encoded / 12.92 : pow((encoded + 0.055) / 1.055, 2.4);
}
