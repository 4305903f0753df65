// Means of pictures whose pixels are independent estimates of one number.
#ifndef CLRT_TESTS_RENDER_ESTIMATE_H
#define CLRT_TESTS_RENDER_ESTIMATE_H

#include "support.h"

#include <math.h>

typedef struct Estimate {
    f64 mean, error; // standard error of the mean
} Estimate;

// Of one channel.
static inline Estimate estimate_of(const Picture *picture, u32 channel)
{
    const u32 n = picture->width * picture->height;
    f64 sum = 0, squares = 0;
    for (u32 i = 0; i < n; i++)
        sum += (f64)picture->rgb[3 * i + channel];
    const f64 mean = sum / n;
    for (u32 i = 0; i < n; i++)
        squares += ((f64)picture->rgb[3 * i + channel] - mean) * ((f64)picture->rgb[3 * i + channel] - mean);
    return (Estimate){mean, sqrt(squares / n / (n - 1))};
}

// Four standard errors; and the rounding of floats, which alone is left where an estimate has no variance.
static inline void expect_estimate(Estimate found, f64 expected, const char *what)
{
    const f64 z = (found.mean - expected) / (found.error + 1e-12 + 2e-6 * fabs(expected) / 4);
    print_message("%-44s %12.6g +- %8.2g, exact %12.6g, z %5.2f\n", what, found.mean, found.error, expected, z);
    if (!(fabs(z) <= 4))
        fail_msg("%s: %.9g is %.1f standard errors from %.9g", what, found.mean, z, expected);
}

#endif
