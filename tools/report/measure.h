// Measure: a scene in every mode: times, errors, pictures, as rows of the report.
#ifndef CLRT_REPORT_MEASURE_H
#define CLRT_REPORT_MEASURE_H

#include <jansson.h>

#include "arguments.h"
#include "runner.h"

typedef struct Campaign {
    const Arguments *arguments;
    Runner runner;
    Arena *arena;
    const char *out; // the folder of the report, still under its temporary name
} Campaign;

// Appends a row a mode to rows. `name` is of the scene's folder in the report, which is made. False with
// clrt's own status as the code where it fails in every mode, with ERROR_IO and ERROR_MEMORY.
bool measure_scene(Campaign *campaign, const char *scene, const char *name, json_t *rows, Error *error);

// A line of progress on standard error, unless quiet.
void campaign_say(const Campaign *campaign, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
