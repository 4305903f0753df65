// Curves between radiance and what a display is sent: tone maps and the sRGB transfer functions, per
// channel, in double. They are the definition of a pixel; the fast tables are made from them.
#ifndef CLRT_IMAGE_COLOR_H
#define CLRT_IMAGE_COLOR_H

#include "base/types.h"

// Tone maps with the clamp to [0, 1] that follows them: any c gives a number in [0, 1], also infinity
// and DBL_MAX (1). NaN gives 0, and so does any c below 0: the curves are meant for radiance, and some
// have poles or rise again on the negative side, where a filter with negative lobes may lead.
// All are monotone in c.
f64 tone_map_none(f64 c);
f64 tone_map_reinhard(f64 c);
// white > 0 is the radiance that becomes 1.
f64 tone_map_reinhard_extended(f64 c, f64 white);
// The fit of Narkowicz, "ACES Filmic Tone Mapping Curve", 2015.
f64 tone_map_aces(f64 c);
// Hable's curve of "Filmic Tonemapping with Piecewise Power Curves", first form, white at 11.2.
f64 tone_map_hable(f64 c);

// IEC 61966-2-1, [0, 1] to [0, 1]. Monotone but at the joint of its pieces, where the standard's own numbers
// make the code values step down by 2.9e-8 (0.002 levels of 16 bits, far from the middle of two levels).
f64 srgb_encode(f64 linear);
f64 srgb_decode(f64 encoded);

#endif
