// RenderParams: the numbers of one image and one launch. Render space has its origin at the camera.
#ifndef CLRT_SHARED_PARAMS_H
#define CLRT_SHARED_PARAMS_H

#include "shared/types.h"

// A work-group renders one tile at a time with this many slots. A tile is a square of TILE_SIDE pixels with
// one slot each or, where there are samples enough, of half or a quarter of that with 4 or 16 slots a pixel,
// one for each of as many consecutive samples: rays of one pixel stay together longest.
#define TILE_SIDE 16
#define TILE_SLOTS (TILE_SIDE * TILE_SIDE)

// The table of a filter has FILTER_STEPS + 1 quantiles of the half with positive offsets.
#define FILTER_STEPS 2048

typedef struct RenderParams {
    f32x4 camera_right; // u, v, w of the scene language
    f32x4 camera_up;
    f32x4 camera_back;
    f32x4 background;
    f32 pixel_scale; // k / H: half the view's height (at distance 1, or in units) over half the rows
    f32 min_weight;
    u32 width, height; // of the whole image
    u32 left, top;     // first pixel of the crop
    u32 crop_width, crop_height;
    u32 samples;       // of a pixel in all
    u32 seed;
    u32 max_depth;
    u32 light_count;
    u32 lights_per_pass; // lights whose shadow rays are queued at once
    u32 plane_count;     // the first primitives are the infinite planes
    u32 root;            // node of the top-level hierarchy; NO_INDEX: none
    u32 slots_log2;      // of a pixel: 0, 2 or 4
    u32 mesh_run_count;
    u32 aov; // AOV_X
    f32 aperture;       // radius of the lens in scene units
    f32 focus_distance; // to the plane in focus
    f32 filter_ratio;   // integral of the filter's absolute value over that of the filter
    u32 padding[3];
} RenderParams;
LAYOUT_SIZE(RenderParams, 160);
LAYOUT_OFFSET(RenderParams, pixel_scale, 64);

#endif
