// Errors: how far pictures of radiance are from what is right. It knows nothing of how they were made.
#ifndef CLRT_REPORT_ERRORS_H
#define CLRT_REPORT_ERRORS_H

#include "base/error.h"
#include "image/image.h"

// Of two pictures of one size and the same channels. A NaN makes the means NaN.
typedef struct Distance {
    u32 max_ulp; // of the values that are no NaN
    f64 max_abs, p99_abs;
    f64 mse, rmse, relmse, psnr_db; // PSNR: radiance 1 as the peak
    f64 flip_mean, ssim_mean;       // NaN where not asked for, or with a NaN
    f64 mean;                       // of test - reference over all values: the picture's bias
    u64 values, different_values;
} Distance;

// perceived: FLIP and SSIM, too, which take longer. False with ERROR_MEMORY, and ERROR_IO for two sizes.
bool errors_compare(const Image *reference, const Image *test, bool perceived, Distance *distance,
                    Error *error);

// Pixels whose identities, as of --aov id, differ.
bool errors_count_other(const Image *reference, const Image *test, u64 *pixels, Error *error);

// The mean of all values.
f64 errors_level(const Image *image);

typedef struct Oddities {
    u64 nan, inf, negative; // values
} Oddities;

Oddities errors_oddities(const Image *image);

// A heat map of each pixel's largest distance, on the scale that all maps of reports have, as a PNG. False
// with ERROR_IO or ERROR_MEMORY.
bool errors_draw(const Image *reference, const Image *test, const char *path, Error *error);

#endif
