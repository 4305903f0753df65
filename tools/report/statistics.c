#include "statistics.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static int compare_values(const void *a, const void *b)
{
    const f64 x = *(const f64 *)a, y = *(const f64 *)b;
    return (x > y) - (x < y);
}

// Sorts values, which are the caller's to spoil.
static f64 middle(f64 *values, size_t count)
{
    if (count == 0)
        return NAN;
    qsort(values, count, sizeof *values, compare_values);
    return count % 2 ? values[count / 2] : (values[count / 2 - 1] + values[count / 2]) / 2;
}

f64 statistics_median(const f64 *values, size_t count)
{
    f64 *copy = count > 0 ? malloc(count * sizeof *copy) : NULL;
    if (!copy)
        return NAN;
    memcpy(copy, values, count * sizeof *copy);
    const f64 median = middle(copy, count);
    free(copy);
    return median;
}

f64 statistics_mad(const f64 *values, size_t count)
{
    f64 *distances = count > 0 ? malloc(count * sizeof *distances) : NULL;
    if (!distances)
        return NAN;
    const f64 median = statistics_median(values, count);
    for (size_t i = 0; i < count; i++)
        distances[i] = fabs(values[i] - median);
    const f64 mad = middle(distances, count);
    free(distances);
    return mad;
}

Mean statistics_mean(const f64 *values, size_t count)
{
    Mean mean = {NAN, NAN, count};
    if (count == 0)
        return mean;
    f64 sum = 0, squares = 0;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    mean.value = sum / (f64)count;
    for (size_t i = 0; i < count; i++)
        squares += (values[i] - mean.value) * (values[i] - mean.value);
    if (count > 1)
        mean.standard_error = sqrt(squares / (f64)(count - 1) / (f64)count);
    return mean;
}

// ---- Student's distribution -----------------------------------------------------------------

// The continued fraction of the incomplete beta function (DLMF 8.17.22) by Lentz's method; converges quickly
// for x < (a + 1) / (a + b + 2).
static f64 beta_fraction(f64 x, f64 a, f64 b)
{
    const f64 tiny = 1e-300;
    f64 c = 1, d = 1 / fmax(1 - (a + b) * x / (a + 1), tiny), value = d;
    for (int m = 1; m < 500; m++) {
        const f64 even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
        const f64 odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
        d = 1 / (1 + even * d);
        c = 1 + even / c;
        value *= c * d;
        d = 1 / (1 + odd * d);
        c = 1 + odd / c;
        value *= c * d;
        if (fabs(c * d - 1) < 1e-15)
            break;
    }
    return value;
}

// The regularised incomplete beta function, x in (0, 1).
static f64 beta_share(f64 x, f64 a, f64 b)
{
    const f64 front = exp(lgamma(a + b) - lgamma(a) - lgamma(b) + a * log(x) + b * log1p(-x));
    if (x < (a + 1) / (a + b + 2))
        return front * beta_fraction(x, a, b) / a;
    return 1 - front * beta_fraction(1 - x, b, a) / b;
}

// The probability to be farther from 0 than t > 0, on both sides.
static f64 student_tails(f64 t, f64 freedom)
{
    return beta_share(freedom / (freedom + t * t), freedom / 2, 0.5);
}

f64 statistics_student(f64 confidence, f64 freedom)
{
    f64 low = 0, high = 1;
    while (high < 1e12 && student_tails(high, freedom) > 1 - confidence)
        high *= 2;
    for (int i = 0; i < 200 && high - low > 1e-14 * high; i++) {
        const f64 t = (low + high) / 2;
        if (student_tails(t, freedom) > 1 - confidence)
            low = t;
        else
            high = t;
    }
    return (low + high) / 2;
}

static Estimate around(f64 value, f64 standard_error, f64 freedom)
{
    if (standard_error == 0)
        return (Estimate){value, value, value};
    if (!(standard_error > 0) || !(freedom > 0))
        return (Estimate){value, NAN, NAN};
    const f64 half = statistics_student(STATISTICS_CONFIDENCE, freedom) * standard_error;
    return (Estimate){value, value - half, value + half};
}

// ---- intervals ------------------------------------------------------------------------------

Estimate statistics_batches(const f64 *values, size_t count)
{
    const Mean mean = statistics_mean(values, count);
    return around(mean.value, mean.standard_error, (f64)count - 1);
}

Estimate statistics_difference(Mean a, Mean b)
{
    const f64 va = a.standard_error * a.standard_error, vb = b.standard_error * b.standard_error;
    const f64 variance = va + vb;
    // Welch and Satterthwaite. What has no spread adds nothing, whatever its count.
    const f64 spread =
        (va > 0 ? va * va / ((f64)a.count - 1) : 0) + (vb > 0 ? vb * vb / ((f64)b.count - 1) : 0);
    return around(a.value - b.value, sqrt(variance), variance * variance / spread);
}

bool statistics_log_line(const f64 *x, const f64 *y, size_t count, Line *line)
{
    f64 mean_x = 0, mean_y = 0, xx = 0, xy = 0, residuals = 0;
    for (size_t i = 0; i < count; i++) {
        mean_x += log(x[i]) / (f64)count;
        mean_y += log(y[i]) / (f64)count;
    }
    for (size_t i = 0; i < count; i++) {
        xx += (log(x[i]) - mean_x) * (log(x[i]) - mean_x);
        xy += (log(x[i]) - mean_x) * (log(y[i]) - mean_y);
    }
    if (count < 2 || !(xx > 0))
        return false;
    const f64 slope = xy / xx;
    line->intercept = mean_y - slope * mean_x;
    for (size_t i = 0; i < count; i++) {
        const f64 off = log(y[i]) - line->intercept - slope * log(x[i]);
        residuals += off * off;
    }
    line->slope = count > 2 ? around(slope, sqrt(residuals / (f64)(count - 2) / xx), (f64)count - 2)
                            : (Estimate){slope, NAN, NAN};
    return true;
}
