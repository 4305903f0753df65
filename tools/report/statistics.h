// Statistics: what repeated measurements say, and how sure that is. It knows nothing of what is measured.
#ifndef CLRT_REPORT_STATISTICS_H
#define CLRT_REPORT_STATISTICS_H

#include "base/types.h"

// The share of intervals of all the functions below that hold the truth.
static const f64 STATISTICS_CONFIDENCE = 0.95;

// The middle value, the mean of the two middle ones of an even count; NaN of none. Values are no NaN.
f64 statistics_median(const f64 *values, size_t count);

// Median of the distances to the median, not scaled to a standard deviation; NaN of none.
f64 statistics_mad(const f64 *values, size_t count);

typedef struct Mean {
    f64 value;          // NaN of no values
    f64 standard_error; // of the value: the deviation of the values over the root of their count; NaN below
                        // two
    size_t count;
} Mean;

Mean statistics_mean(const f64 *values, size_t count);

typedef struct Estimate {
    f64 value, low, high; // the interval is NaN where nothing can be said of it
} Estimate;

// The mean of independent batches with its interval by Student's t.
Estimate statistics_batches(const f64 *values, size_t count);

// a - b of two independent means with its interval by Welch's t. A mean without spread counts as exact.
Estimate statistics_difference(Mean a, Mean b);

// The t that a variable of Student's distribution with `freedom` > 0 degrees stays within, on both sides,
// with the probability `confidence`, in (0, 1).
f64 statistics_student(f64 confidence, f64 freedom);

typedef struct Line {
    Estimate slope;
    f64 intercept; // natural logarithm of y where x is 1
} Line;

// Least squares of log y on log x, all above 0. False, and nothing in *line, for fewer than two different x;
// with two points the slope has no interval.
bool statistics_log_line(const f64 *x, const f64 *y, size_t count, Line *line);

#endif
