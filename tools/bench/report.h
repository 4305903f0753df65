// Report: results as tables, CSV and JSON.
#ifndef CLRT_BENCH_REPORT_H
#define CLRT_BENCH_REPORT_H

#include "measure.h"

// What the figures were measured on.
typedef struct Setting {
    const char *device, *driver;
    u32 threads;
} Setting;

// Tables of all scenes, on stdout.
void report_text(const SceneResult *scenes, u32 count, const BenchOptions *options, const Setting *setting);
// A line for each size, with a line of names first, on stdout.
void report_scaling(const SceneResult *scenes, u32 count);
// Fails with ERROR_IO or ERROR_MEMORY.
bool report_json(const SceneResult *scenes, u32 count, const BenchOptions *options, const Setting *setting,
                 Error *error);

#endif
