// Pixel filters as the device samples them: quantiles of their absolute value, and what the image is scaled with.
#ifndef CLRT_LAYOUT_FILTER_H
#define CLRT_LAYOUT_FILTER_H

#include "base/types.h"
#include "scene/scene.h"
#include "shared/params.h"

// The filter of one axis at x pixels from the centre; 0 beyond its radius. Mitchell and Netravali,
// "Reconstruction Filters in Computer Graphics", 1988, with B = C = 1/3; gaussian and radii as the scene language
// has them.
f64 filter_value(Filter filter, f64 x);

// quantiles[k]: the offset, from 0 to the radius, below which the share k / FILTER_STEPS of the integral of
// |f| over positive offsets lies. Errors below 1e-7 of the radius.
void filter_quantiles(Filter filter, f32 quantiles[FILTER_STEPS + 1]);

// The integral of |f| over that of f, over the plane.
f64 filter_ratio(Filter filter);

#endif
