// What --stats tells: where the time of a run went, rays by kind, memory, features, the error budget.
#ifndef CLRT_CLI_STATS_H
#define CLRT_CLI_STATS_H

#include <stdio.h>

#include "base/error.h"
#include "budget/budget.h"
#include "cli/identity.h"
#include "render/render.h"

typedef struct RunStats {
    // Seconds of the wall clock.
    f64 parse_seconds;  // reading the scene
    f64 load_seconds;   // reading the meshes that it names
    f64 layout_seconds; // arrays and hierarchies
    f64 device_seconds; // finding, opening and, the first time, trying the device
    f64 total_seconds;  // from the start of main to the closed file
    u32 width, height;  // of the picture
    const char *device_name;
    u64 device_bytes_peak;
    const RenderStats *render;
    const Identity *identity;
    const ErrorBudget *budget;
} RunStats;

// The largest resident set of this process so far, in bytes.
u64 stats_host_bytes_peak(void);

void stats_print(const RunStats *stats, FILE *stream);

// Writes the same as a JSON object. Fails with ERROR_IO or ERROR_MEMORY.
bool stats_write_json(const RunStats *stats, const char *path, Error *error);

#endif
