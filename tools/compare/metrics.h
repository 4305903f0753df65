// Metrics: how far two pictures are from each other, and whether that is within limits.
#ifndef CLRT_COMPARE_METRICS_H
#define CLRT_COMPARE_METRICS_H

#include "pictures.h"
#include "ztest.h"

// In levels of a PNG, in the values of a PFM.
typedef struct Limits {
    f64 fail;         // a value fails if it is farther away than this ...
    u32 fail_ulp;     // ... and, in a PFM, by more units in the last place than this
    f64 fail_percent; // this share of the values may fail
    f64 hard_fail;    // none may be farther away than this
    ZLimits ztest;    // for pictures with variances
} Limits;

// Added to the squared reference in relMSE, so that black pixels do not decide it.
static const f64 RELATIVE_EPSILON = 0.01;

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
    f64 max_abs, mean_abs, mse, rmse;
    f64 psnr;      // dB, white as the peak; infinity where nothing differs
    f64 relmse;    // of the colours' light, white as 1: mean of (a - b)^2 / (a^2 + RELATIVE_EPSILON)
    u32 max_ulp;   // PFM; of the values without NaN
    f64 flip_mean; // NaN where there is a NaN
    f64 ssim_mean; // NaN where there is a NaN, or no window fits
    Worst worst;   // first of the values that are farthest away; NaN is farther than all
    bool tested;   // there were variances, and so:
    ZTest ztest;
    bool same;                // within the limits, without NaN, and the Z-test, if any, passed
    f32 *flip, *ssim, *score; // of each pixel: flip.h, ssim.h, ztest.h; NULL where there is none
} Metrics;

// False with ERROR_MEMORY; else the caller destroys *metrics.
bool metrics_compute(const Pictures *pictures, const Limits *limits, Metrics *metrics, Error *error);

void metrics_destroy(Metrics *metrics);

// Steps from float to float between a and b, neither a NaN; 0 between the two zeros.
u32 metrics_ulps(f32 a, f32 b);

#endif
