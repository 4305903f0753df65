// Plan: how an image is cut into bands and how many tiles are in flight, from the device and the memory it
// may use. Nothing here changes a bit of the picture.
#ifndef CLRT_RENDER_PLAN_H
#define CLRT_RENDER_PLAN_H

#include "base/error.h"
#include "device/list.h"
#include "layout/layout.h"
#include "render/math_mode.h"
#include "shared/state_fields.h"

// How the kernels are compiled for a kind of device.
typedef struct DeviceShape {
    u32 lanes; // rays that one operation works on
    u32 batch; // rays that share a traversal
    u32 group; // work-items that share a tile
} DeviceShape;

typedef struct Plan {
    DeviceShape shape;
    u32 real_bytes;      // of a number of a slot: 8 with MATH_DOUBLE, else 4
    u32 width;           // of the crop
    u32 band_rows;       // multiple of the tile's height, or all rows
    u32 groups;          // tiles in flight
    u32 lights_per_pass; // at most LIGHTS_PER_PASS_MAX
    u32 real_fields, int_fields, pending_reals; // of a slot
    u32 ray_kinds;       // numbers that each work-item counts
    u32 slots_log2;      // of a pixel, see RenderParams
    bool samples;        // more than one
    bool clamp;          // of the samples
} Plan;

// CPUs: vectors as wide as the device's, one work-item a tile. GPUs, and doubles anywhere: a ray after the
// other. The environment variable CLRT_SHAPE=LANES,BATCH,GROUP overrides it, for tests that prove that it
// changes nothing.
DeviceShape plan_device_shape(const DeviceInfo *info, MathMode math);

// Fails with ERROR_MEMORY where scene, one band and one tile do not fit into memory_limit (0: none) bytes.
bool plan_make(Plan *plan, const Layout *layout, const DeviceInfo *info, MathMode math, u32 width, u32 height,
               u64 memory_limit, Error *error);

u32 plan_tiles(const Plan *plan, u32 rows);
// Samples of the first launch, so that it takes a moment only.
u32 plan_first_samples(const Plan *plan);
u64 plan_state_bytes(const Plan *plan, u32 groups);
u64 plan_film_bytes(const Plan *plan, u32 rows);

#endif
