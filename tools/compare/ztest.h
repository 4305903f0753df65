// Z-test: do two noisy pictures show the same expected values, given the variance of each of their values?
// The rule is that of Mitsuba's tests of renders: two-sided p-values, a threshold after Sidak, "Rectangular
// Confidence Regions for the Means of Multivariate Normal Distributions", J. Am. Stat. Assoc. 62, 1967, and a
// share of the pixels that has to pass. README.md says where it differs.
#ifndef CLRT_COMPARE_ZTEST_H
#define CLRT_COMPARE_ZTEST_H

#include "pictures.h"

typedef struct ZLimits {
    f64 significance;   // in (0, 1): the chance that any value fails where nothing differs but noise
    f64 pass_percent;   // of the pixels
    f64 variance_floor; // smaller variances count as this one
} ZLimits;

// Alpha is not tested.
typedef struct ZTest {
    u64 pixels, passed_pixels; // a pixel passes if all of its values do
    f64 threshold;             // a value passes if its p-value is above this
    f64 p_min;                 // of the values; 0 where one is a NaN
    u32 x, y, channel;         // of the first value with p_min, in the files
    f64 z_rms;                 // 1 is expected; NaN with a NaN, infinite with a difference without variance
    f64 bias;                  // mean of b - a ...
    f64 bias_error;            // ... and its standard error, if no two values' noise is correlated
    bool passed;
} ZTest;

// The pictures have variances. z, where not NULL, gets each pixel's largest |z| over its colours: NaN with a
// NaN, infinite for a difference without variance, 0 for pixels that are left out.
ZTest ztest_compute(const Pictures *pictures, const ZLimits *limits, f32 *z);

#endif
