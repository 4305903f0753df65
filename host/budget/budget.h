// ErrorBudget: what the error of an image is made of, each part by itself, with what it holds for. It knows
// the scene, its bounds and the pooled figures of the image; not how that was rendered.
#ifndef CLRT_BUDGET_BUDGET_H
#define CLRT_BUDGET_BUDGET_H

#include <stdio.h>

#include "budget/bounds.h"
#include "budget/sampling.h"

#define BUDGET_CONFIDENCE 0.95

// What a limit of the brightness of samples took from an image: against that of the same samples without it.
// Measured, no bound: of brightness that no sample has met nothing is known. Zeros without a limit.
typedef struct ClampBudget {
    f64 limit;   // of the channels of a sample
    f64 removed; // from the mean of the image, which is biased by so much
    f64 share;   // of the mean without the limit
    f64 rmse;    // root of the mean square of what pixels and channels lost
    u64 clamped, samples; // of the image
} ClampBudget;

// Errors are of linear radiance but for the quantisation. NAN: not known, or not there to be known; INFINITY:
// without bound.
typedef struct ErrorBudget {
    f64 confidence;
    const char *estimator; // what a pixel is an estimate of, and by what
    SamplingBudget sampling;
    SceneBounds bounds;    // radiance; depth and min_weight: of any pixel and channel
    ClampBudget clamp;
    f64 arithmetic;        // greatest error of any value; NAN: not measured
    f64 quantisation;      // greatest rounding of an encoded value, of its range 0..1; 0: floats
    f64 total;             // of the root mean square error over the parts that are known
    bool covers_sampling, covers_arithmetic; // whether total has them
    u64 nan, infinite, negative; // values of the image
} ErrorBudget;

// clamp: limit of the channels of a sample (RenderJob.clamp), 0: none. bits: levels of the file, 2^bits; 0:
// floats. arithmetic: NAN where it was not measured.
ErrorBudget budget_make(const Scene *scene, const SceneBounds *bounds, const BudgetPool *pool, f32 clamp,
                        u32 bits, f64 arithmetic);

// "bounded", "normal", or NULL where nothing is said.
const char *budget_assumption(const ErrorBudget *budget);

// In lines of at most 110 characters, each beginning with `indent`; for people.
void budget_print(const ErrorBudget *budget, const char *indent, FILE *stream);

// In one line, for the metadata of files; cut where size is too small.
void budget_summary(const ErrorBudget *budget, char *text, size_t size);

#endif
