// SceneBounds: what can be said of every ray of a scene before one is traced: how bright it can be, and how
// much the limits of depth and weight leave out. Upper bounds, per channel where that matters; conservative:
// what a rule here does not know has no bound.
#ifndef CLRT_BUDGET_BOUNDS_H
#define CLRT_BUDGET_BOUNDS_H

#include "layout/layout.h"
#include "scene/scene.h"

typedef struct SceneBounds {
    // No sample of a pixel is brighter; INFINITY in a channel without bound. None is below 0.
    f64 radiance[3];
    const char *unbounded; // why there is no bound, NULL where there is one
    f64 depth;      // radiance that rays beyond max_depth would add to a pixel: at most; INFINITY: no bound
    f64 min_weight; // the same of rays that min_weight cuts off, of those within max_depth
} SceneBounds;

// Whitted's integrator. With w the greatest total weight of the rays that follow a hit and L the greatest
// radiance: L(d) = max(background, direct + w L(d - 1)); depth: w^(max_depth + 1) L(infinity), where w < 1.
// Paths: a sample may weigh any amount. With w the greatest albedo, highlights, mirrors and transmission included, and
// S the brightest that shines or that lights without size make of a surface: depth: w^(max_depth + 1) S / (1 - w),
// where w < 1, which pbr never states. min_weight cuts off nothing.
// Materials count where the layout, of the same scene, uses them. Textures must still have their bitmaps.
SceneBounds scene_bounds(const Scene *scene, const Layout *layout);

#endif
