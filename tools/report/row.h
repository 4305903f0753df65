// Row: what is measured of a scene in one mode on one device, schema clrt-report/1. Every key is there from
// the beginning, null until it is measured.
#ifndef CLRT_REPORT_ROW_H
#define CLRT_REPORT_ROW_H

#include <jansson.h>

#include "arguments.h"
#include "statistics.h"

#define ROW_SCHEMA "clrt-report/1"

json_t *row_create(const char *scene, const Mode *mode);

// Takes over what clrt's statistics say of identity, rays, memory and health.
void row_take_stats(json_t *row, const json_t *stats);

// The same of the budget, which goes with the kind of file: one of 8 bits has an error that floats have not.
void row_take_budget(json_t *row, const json_t *stats);

// The stages that a run's seconds are told in, in their order; NULL ends them. Those that clrt does not tell
// apart are null: the hierarchy is part of layout_s, upload of device_s and kernel_s, download of kernel_s.
typedef struct Stage {
    const char *key;   // in the report
    const char *stats; // in clrt's statistics, NULL: not told; "" : computed here
} Stage;

extern const Stage ROW_STAGES[];
enum { ROW_STAGE_COUNT = 13 };

// Seconds of a stage in one run; NaN where not told.
f64 row_stage_seconds(const json_t *stats, f64 wall, const char *key);

// Rays of a run in all, and seconds in which they were traced.
f64 row_rays(const json_t *stats);

#endif
