// Metrics: how far two pictures are from each other, and whether that is within limits.
#ifndef CLRT_COMPARE_METRICS_H
#define CLRT_COMPARE_METRICS_H

#include "pictures.h"

// In levels of a PNG, in the values of a PFM.
typedef struct Limits {
    f64 fail;         // a value fails if it is farther away than this ...
    u32 fail_ulp;     // ... and, in a PFM, by more units in the last place than this
    f64 fail_percent; // this share of the values may fail
    f64 hard_fail;    // none may be farther away than this
} Limits;

typedef struct Worst {
    bool present; // false: no value differs
    u32 x, y;     // in the files
    u32 channel;
    f32 a, b;
} Worst;

// Of the pixels that are compared. A NaN differs from everything, itself included, by NaN, and so mean, RMSE
// and the like are NaN where there is one; equal infinities do not differ.
typedef struct Metrics {
    u64 pixels, left_out_pixels, values;
    u64 different_pixels, different_values; // by anything
    u64 failed_values, hard_failed_values, nan_values;
    f64 max_abs, mean_abs, rmse;
    f64 psnr;      // dB, white as the peak; infinity where nothing differs
    u32 max_ulp;   // PFM; of the values without NaN
    f64 flip_mean; // NaN where there is a NaN
    Worst worst;   // first of the values that are farthest away; NaN is farther than all
    bool same;     // within the limits, and without NaN
} Metrics;

// False with ERROR_MEMORY.
bool metrics_compute(const Pictures *pictures, const Limits *limits, Metrics *metrics, Error *error);

// Steps from float to float between a and b, neither a NaN; 0 between the two zeros.
u32 metrics_ulps(f32 a, f32 b);

#endif
