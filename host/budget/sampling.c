#include "budget/sampling.h"

#include <math.h>

#include "budget/quantile.h"

// The figures of an image. Variances are of one sample, summed over the channels.
typedef struct Figures {
    f64 pixels, samples;
    f64 variance;         // mean over pixels
    f64 variance_squared; // mean over pixels of the square
    f64 variance_max;
    f64 mean;
} Figures;

// What a sample can be: diameter of the box of all colors, its greatest side, the range of a color's mean.
typedef struct Range {
    f64 diagonal, side, mean;
} Range;

static Figures figures_of(const BudgetPool *pool, u32 samples)
{
    const f64 pixels = (f64)pool->pixels, free_samples = samples - 1.0;
    return (Figures){
        .pixels = pixels,
        .samples = samples,
        .variance = pool->m2 / free_samples / pixels,
        .variance_squared = pool->m2_squared / (free_samples * free_samples) / pixels,
        .variance_max = pool->m2_max / free_samples,
        .mean = pool->radiance / (3 * pixels),
    };
}

static Range range_of(const f64 radiance[3])
{
    const f64 r = radiance[0], g = radiance[1], b = radiance[2];
    return (Range){sqrt(r * r + g * g + b * b), fmax(r, fmax(g, b)), (r + g + b) / 3};
}

// The standard deviation is at most this but with the probability exp(-log_odds), from its estimate over
// `freedom` degrees of freedom. Maurer and Pontil, Theorem 10: n V_n is self-bounding; so is the sum of such
// terms of several pixels, and the distance of vectors serves as that of numbers does.
static f64 deviation_bound(f64 estimate, f64 freedom, f64 log_odds, const Range *range)
{
    return fmin(estimate + range->diagonal * sqrt(2 * log_odds / freedom), range->diagonal / 2);
}

// A mean of `count` independent values with this standard deviation and range is at most so far off, but with
// the probability exp(-log_odds) to either side: the smaller of Bernstein's and Hoeffding's bounds. Which is
// smaller for the true deviation does not depend on the samples, so choosing costs no confidence.
static f64 mean_bound(f64 deviation, f64 range, f64 count, f64 log_odds)
{
    const f64 bernstein = deviation * sqrt(2 * log_odds / count) + range * log_odds / (3 * count);
    return fmin(bernstein, range * sqrt(log_odds / (2 * count)));
}

// No pixel and channel is off by more. A quarter of alpha for the deviations, half of it for the errors.
static f64 largest_bound(const Figures *f, const Range *range, f64 alpha)
{
    const f64 deviation =
        deviation_bound(sqrt(f->variance_max), f->samples - 1, log(4 * f->pixels / alpha), range);
    const f64 of_channel = fmin(deviation, range->side / 2);
    return fmin(mean_bound(of_channel, range->side, f->samples, log(12 * f->pixels / alpha)), range->side);
}

// The square error of an image, summed over channels, mean over pixels. Its expectation is m = variance / n,
// its variance in a pixel at most m (range^2 / n^2 + 2 m), the fourth moment of a mean; so says Bernstein.
// The distance of the image from the truth is also a convex function of the samples that none of them can
// change by more than range / n: its fluctuation has no share of the number of pixels (Boucheron, Lugosi and
// Massart, Concentration Inequalities, 2013, Theorems 6.2 and 6.10).
static f64 square_error_bound(const Figures *f, const Range *range, f64 deviation, f64 log_odds)
{
    const f64 n = f->samples, most = range->diagonal * range->diagonal;
    const f64 expected = deviation * deviation / n;
    const f64 spread = expected * most * (1 / (n * n) + 1 / (2 * n));
    const f64 odds = log_odds / f->pixels;
    const f64 bernstein = expected + sqrt(2 * spread * odds) + most * odds / 3;
    const f64 swing = range->diagonal * sqrt(2 * log_odds / n) * fmin(1, sqrt(f->pixels) / 2);
    const f64 distance = sqrt(expected) + swing / sqrt(f->pixels);
    return fmin(fmin(bernstein, distance * distance), most);
}

static SamplingBudget bounded(const Figures *f, const f64 radiance[3], f64 alpha)
{
    const Range range = range_of(radiance);
    const f64 freedom = f->pixels * (f->samples - 1), estimate = sqrt(f->variance);
    const f64 of_image = deviation_bound(estimate, freedom, log(4 / alpha), &range);
    const f64 of_mean = deviation_bound(estimate, freedom, log(2 / alpha), &range);
    const f64 square = square_error_bound(f, &range, of_image, log(2 / alpha));
    const f64 off = mean_bound(fmin(of_mean / sqrt(3), range.mean / 2), range.mean, f->pixels * f->samples,
                               log(4 / alpha));
    SamplingBudget budget = {.assumption = SAMPLING_BOUNDED, .largest = largest_bound(f, &range, alpha)};
    budget.rmse = fmin(sqrt(square / 3), budget.largest);
    budget.mean_low = fmax(f->mean - off, 0);
    budget.mean_high = fmin(f->mean + off, range.mean);
    return budget;
}

// Pixels differ in variance: mean and sum of squares tell how many equal ones say as much (Welch and
// Satterthwaite). Channels count as one, as if they always erred together.
static SamplingBudget normal(const Figures *f, f64 alpha)
{
    SamplingBudget budget = {.assumption = SAMPLING_NORMAL};
    const f64 alike = f->variance > 0 ? f->variance * f->variance / f->variance_squared : 1;
    const f64 pixels = fmax(f->pixels * alike, 1), freedom = pixels * (f->samples - 1);
    const f64 square = f->variance / f->samples / 3; // of a pixel's channel
    budget.rmse = sqrt(square * quantile_f(alpha, pixels, freedom));
    const f64 off = sqrt(square / f->pixels * quantile_f(alpha, 1, freedom));
    budget.mean_low = f->mean - off;
    budget.mean_high = f->mean + off;
    budget.largest = sqrt(f->variance_max / f->samples *
                          quantile_f(alpha / (3 * f->pixels), 1, f->samples - 1));
    return budget;
}

SamplingBudget sampling_budget(const BudgetPool *pool, u32 samples, const f64 radiance[3], f64 confidence)
{
    const bool finite = pool->nan == 0 && pool->infinite == 0 && isfinite(pool->m2_squared);
    if (samples < 2 || pool->pixels == 0 || !finite)
        return (SamplingBudget){SAMPLING_NONE, NAN, NAN, NAN, NAN, NAN, NAN};
    const Figures f = figures_of(pool, samples);
    const bool has_bound = isfinite(radiance[0]) && isfinite(radiance[1]) && isfinite(radiance[2]);
    SamplingBudget budget = has_bound ? bounded(&f, radiance, 1 - confidence) : normal(&f, 1 - confidence);
    budget.standard_error = sqrt(f.variance / f.samples / 3);
    budget.mean = f.mean;
    return budget;
}
