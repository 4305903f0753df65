// Render: one image, from a layout to rows of radiance, band by band. Plans slots and bands from the limit of
// memory, builds the program of the scene's features and runs its kernel; knows nothing of files.
#ifndef CLRT_RENDER_RENDER_H
#define CLRT_RENDER_RENDER_H

#include "base/error.h"
#include "device/device.h"
#include "layout/layout.h"
#include "render/math_mode.h"
#include "render/aov.h"

typedef struct RenderJob {
    const Layout *layout;
    Device *device;
    u32 left, top, width, height; // the crop; within the image
    u64 memory_limit;             // bytes on the device, 0: what the device has
    MathMode math;
    u32 aov;                      // AOV_X: what the rows hold
    f32 clamp;                    // no channel of a sample is brighter; 0: no limit. Not for properties
} RenderJob;

typedef struct RenderStats {
    FeatureSet features; // of the program
    u64 program_hash;    // of the program's text and options (base/hash.h)
    f64 compile_seconds; // building the program, and a first launch of nothing, which generates the code
    f64 trace_seconds;   // all launches
    u64 rays[5];         // RAYS_X of shared/state_fields.h; a path that is not transmitted counts as mirrored
    u64 scene_bytes;     // on the device
    u64 state_bytes;
    u64 film_bytes;
    u32 launches;
    u32 band_rows;
    u32 groups; // tiles in flight
} RenderStats;

// Rows that are complete: count rows of 3 linear numbers a pixel, top first. They stay valid until the next
// step.
typedef struct RenderRows {
    f32 *rgb;
    // One number a pixel: the sum over samples and channels of the squared distance of each sample from their
    // mean. NULL where there is one sample.
    const f32 *m2;
    // Four numbers a pixel: the sums over samples of what each channel lost to RenderJob.clamp, weighted as
    // the samples are, and how many samples lost anything. NULL where there is no limit.
    const f32 *clamped;
    u32 count;
} RenderRows;

typedef struct Render Render;

// The layout must outlive the render. Fails with ERROR_DEVICE (the build log in the message) or
// ERROR_MEMORY (the limit is below what one band needs, or the device refuses).
Render *render_create(const RenderJob *job, Error *error);
void render_destroy(Render *render);

// Renders for a fraction of a second and reports rows that became complete; most steps of an image with many
// samples complete none.
bool render_step(Render *render, RenderRows *rows, Error *error);

bool render_finished(const Render *render);
// From the start again with another seed, at the cost of its samples alone. Statistics go on.
bool render_restart(Render *render, u32 seed, Error *error);
// Share of the samples that are done, 0..1.
f64 render_progress(const Render *render);
const RenderStats *render_stats(const Render *render);

// Compiler options of the program for these features and this arithmetic on a device with this vector width;
// the number of characters that a large enough text would have.
size_t render_program_options(FeatureSet features, const DeviceInfo *info, MathMode math, char *text,
                              size_t size);

#endif
