#include "ztest.h"

#include <math.h>

typedef struct Sums {
    f64 squared_z, difference, variance;
} Sums;

// Two-sided: of a difference as far from 0, in standard deviations, or farther.
static f64 p_value(f64 z)
{
    return isnan(z) ? 0 : erfc(z * sqrt(0.5));
}

// |a - b| in standard deviations; NaN with a NaN.
static f64 score(f32 a, f32 b, f64 variance)
{
    return a == b ? 0 : fabs((f64)a - (f64)b) / sqrt(variance);
}

// The pixel's largest |z|; NaN is larger than all.
static f64 test_pixel(const Pictures *pictures, const ZLimits *limits, u32 x, u32 y, ZTest *test, Sums *sums)
{
    const u32 channels = pictures->images[0]->channels, colors = channels >= 3 ? 3 : 1;
    const f32 *a = image_row(pictures->images[0], y) + (size_t)x * channels;
    const f32 *b = image_row(pictures->images[1], y) + (size_t)x * channels;
    f64 largest = 0;
    bool passed = true;
    for (u32 c = 0; c < colors; c++) {
        const f64 variance =
            fmax(pictures_variance(pictures, 0, x, y, c) + pictures_variance(pictures, 1, x, y, c),
                 limits->variance_floor);
        const f64 z = score(a[c], b[c], variance);
        const f64 p = p_value(z);
        passed = passed && p > test->threshold;
        if (p < test->p_min) {
            test->p_min = p;
            test->x = pictures->region.x + x;
            test->y = pictures->region.y + y;
            test->channel = c;
        }
        largest = isnan(largest) || z <= largest ? largest : z;
        sums->squared_z += z * z;
        sums->difference += a[c] == b[c] ? 0 : (f64)b[c] - (f64)a[c];
        sums->variance += variance;
    }
    test->pixels++;
    test->passed_pixels += passed;
    return largest;
}

static u64 count_pixels(const Pictures *pictures)
{
    const size_t all = (size_t)pictures->region.width * pictures->region.height;
    u64 count = 0;
    for (size_t i = 0; i < all; i++)
        count += !pictures->left_out || !pictures->left_out[i];
    return count;
}

ZTest ztest_compute(const Pictures *pictures, const ZLimits *limits, f32 *z)
{
    const f64 values = (f64)count_pixels(pictures) * (pictures->images[0]->channels >= 3 ? 3 : 1);
    // 1 - (1 - significance)^(1 / values), without the rounding of that.
    ZTest test = {.threshold = -expm1(log1p(-limits->significance) / values), .p_min = 2};
    Sums sums = {0, 0, 0};
    size_t i = 0;
    for (u32 y = 0; y < pictures->region.height; y++) {
        for (u32 x = 0; x < pictures->region.width; x++, i++) {
            const bool out = pictures->left_out && pictures->left_out[i];
            const f64 largest = out ? 0 : test_pixel(pictures, limits, x, y, &test, &sums);
            if (z)
                z[i] = (f32)largest;
        }
    }
    test.z_rms = sqrt(sums.squared_z / values);
    test.bias = sums.difference / values;
    test.bias_error = sqrt(sums.variance) / values;
    test.passed = (f64)test.passed_pixels * 100 >= limits->pass_percent * (f64)test.pixels;
    return test;
}
