// What the finite number of samples leaves uncertain in an image, from the pooled variance of its samples.
//
// Each statement holds with the probability `confidence` on its own. Where radiance has a bound they hold for
// any distribution of the samples that are independent: Maurer and Pontil, "Empirical Bernstein Bounds and
// Sample Variance Penalization", 2009, for what the variance can be; Bernstein's and Hoeffding's inequalities
// for the errors, given that variance. Without a bound they take errors for normal. host/README.md has the
// derivation, and what is known of the samples of a scrambled net, which are not independent.
#ifndef CLRT_BUDGET_SAMPLING_H
#define CLRT_BUDGET_SAMPLING_H

#include "budget/pool.h"

typedef enum SamplingAssumption {
    SAMPLING_NONE,    // nothing is said
    SAMPLING_BOUNDED, // radiance within its bound
    SAMPLING_NORMAL   // normally distributed means
} SamplingAssumption;

// Radiance, linear. NAN in all numbers with SAMPLING_NONE.
typedef struct SamplingBudget {
    SamplingAssumption assumption;
    f64 rmse;            // the root of the mean square error over pixels and channels is at most this
    f64 standard_error;  // its estimate: half of all images are about as far away, no confidence
    f64 mean;            // of the image
    f64 mean_low, mean_high; // the mean of the image with infinitely many samples lies within
    f64 largest;         // no pixel is farther off in any channel
} SamplingBudget;

// samples: of a pixel. radiance: bound of each channel, INFINITY: none. 0 < confidence < 1. Nothing is said
// where samples is 1, the pool is empty, or it holds values that are not finite.
SamplingBudget sampling_budget(const BudgetPool *pool, u32 samples, const f64 radiance[3], f64 confidence);

#endif
