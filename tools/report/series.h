// Series: the runs of one mode with one number of samples, and what they say together.
#ifndef CLRT_REPORT_SERIES_H
#define CLRT_REPORT_SERIES_H

#include <jansson.h>

#include "arguments.h"
#include "base/arena.h"
#include "errors.h"
#include "reference.h"
#include "row.h"

typedef struct Series {
    u32 samples, count, capacity;
    f64 *stages[ROW_STAGE_COUNT]; // seconds of each run, in the order of ROW_STAGES
    f64 *mse, *level;             // of each picture; level: mean of its values
    Distance first;               // of the first picture to the reference, where there is one
    f64 rays;                     // of the first run
} Series;

// Arrays for `capacity` runs in the arena; false when memory is exhausted.
bool series_create(Series *series, u32 samples, u32 capacity, Arena *arena);

// Adds the times of one more run.
void series_add(Series *series, const json_t *stats, f64 wall);

// Median and MAD of the stages: the object of time.cold and time.warm.
json_t *series_times(const Series *series);

// Kernel seconds of `series` over those of `base`, run by run, which took turns: median and MAD.
json_t *series_ratio(const Series *series, const Series *base);

// A point of the convergence; without a reference that is good enough its errors are null and reason says
// why.
json_t *series_point(const Series *series, const Reference *reference);

// error.rinf of a row from a point of its convergence; `reference` as of reference_to_json, which is
// borrowed.
void series_set_rinf(json_t *row, const json_t *point, json_t *reference);

// efficiency of a row: the point of its own samples, and lines through all runs of `count` series, of which
// those count whose point has an error.
void series_set_efficiency(json_t *row, const json_t *point, const Series *series, u32 count, Arena *arena);

#endif
