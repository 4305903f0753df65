#include "metrics.h"

#include "flip.h"
#include "ssim.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// Whole numbers in the order of the floats.
static i64 float_order(f32 value)
{
    u32 bits;
    memcpy(&bits, &value, sizeof bits);
    return bits & 0x80000000u ? -(i64)(bits & 0x7FFFFFFF) : (i64)bits;
}

u32 metrics_ulps(f32 a, f32 b)
{
    const i64 steps = float_order(a) - float_order(b);
    return (u32)(steps < 0 ? -steps : steps);
}

static f64 distance(f32 a, f32 b)
{
    return a == b ? 0 : fabs((f64)a - (f64)b);
}

static bool is_farther(f64 d, f64 than)
{
    return isnan(d) ? !isnan(than) : d > than;
}

typedef struct Sums {
    f64 absolute, squared, relative;
} Sums;

// relMSE's term of a colour.
static f64 relative_square(ValueScale scale, f32 a, f32 b)
{
    if (a == b)
        return 0;
    const f64 reference = value_light(scale, a), difference = value_light(scale, b) - reference;
    return difference * difference / (reference * reference + RELATIVE_EPSILON);
}

static void add_value(const Pictures *pictures, const Limits *limits, f32 a, f32 b, Metrics *m, Sums *sums)
{
    const f64 d = distance(a, b);
    m->values++;
    sums->absolute += d;
    sums->squared += d * d;
    // Comparisons that a NaN fails count it.
    bool close = d <= limits->fail;
    m->hard_failed_values += !(d <= limits->hard_fail);
    m->different_values += !(d == 0);
    m->nan_values += isnan(d) != 0;
    if (pictures->format == FORMAT_PFM && !isnan(d)) {
        const u32 ulps = metrics_ulps(a, b);
        m->max_ulp = ulps > m->max_ulp ? ulps : m->max_ulp;
        close = close || ulps <= limits->fail_ulp;
    }
    m->failed_values += !close;
}

static void add_pixel(const Pictures *pictures, const Limits *limits, u32 x, u32 y, Metrics *m, Sums *sums)
{
    const u32 channels = pictures->images[0]->channels, colors = channels >= 3 ? 3 : 1;
    const ValueScale scale = pictures_scale(pictures);
    const f32 *a = image_row(pictures->images[0], y) + (size_t)x * channels;
    const f32 *b = image_row(pictures->images[1], y) + (size_t)x * channels;
    const u64 before = m->different_values;
    for (u32 c = 0; c < channels; c++) {
        add_value(pictures, limits, a[c], b[c], m, sums);
        if (c < colors)
            sums->relative += relative_square(scale, a[c], b[c]);
        const f64 d = distance(a[c], b[c]);
        if (is_farther(d, m->max_abs)) {
            m->max_abs = d;
            m->worst = (Worst){true, pictures->region.x + x, pictures->region.y + y, c, a[c], b[c]};
        }
    }
    m->pixels++;
    m->different_pixels += m->different_values > before;
}

// Also in pixels that are left out: the filters of FLIP would carry one far.
static bool has_nan(const Image *image)
{
    const size_t count = (size_t)image->width * image->height * image->channels;
    for (size_t i = 0; i < count; i++) {
        if (isnan(image->values[i]))
            return true;
    }
    return false;
}

// The mean of those that are numbers, in pixels that are compared; NaN if there are none.
static f64 mean_of(const Pictures *pictures, const f32 *values)
{
    const size_t count = (size_t)pictures->region.width * pictures->region.height;
    f64 sum = 0;
    size_t numbers = 0;
    for (size_t i = 0; i < count; i++) {
        if (isnan(values[i]) || (pictures->left_out && pictures->left_out[i]))
            continue;
        sum += (f64)values[i];
        numbers++;
    }
    return numbers > 0 ? sum / (f64)numbers : NAN;
}

static bool make_plane(const Pictures *pictures, f32 **plane, Error *error)
{
    *plane = calloc((size_t)pictures->region.width * pictures->region.height, sizeof **plane);
    return *plane || error_set(error, ERROR_MEMORY, "no memory for what is computed of each pixel");
}

static bool add_perceived(const Pictures *pictures, Metrics *m, Error *error)
{
    Image *const *images = pictures->images;
    m->flip_mean = m->ssim_mean = NAN;
    if (has_nan(images[0]) || has_nan(images[1]))
        return true;
    if (!make_plane(pictures, &m->flip, error) || !make_plane(pictures, &m->ssim, error))
        return false;
    const ValueScale scale = pictures_scale(pictures);
    const size_t values = (size_t)images[0]->width * images[0]->height * images[0]->channels;
    // A plane of zeros is FLIP's answer to the same picture.
    if (memcmp(images[0]->values, images[1]->values, values * sizeof(f32)) != 0 &&
        !flip_compare(images[0], images[1], scale, m->flip, error))
        return false;
    if (!ssim_compare(images[0], images[1], scale, m->ssim, error))
        return false;
    m->flip_mean = mean_of(pictures, m->flip);
    m->ssim_mean = mean_of(pictures, m->ssim);
    return true;
}

static bool add_ztest(const Pictures *pictures, const ZLimits *limits, Metrics *m, Error *error)
{
    m->tested = pictures->variances[0] || pictures->variances[1];
    if (!m->tested)
        return true;
    if (!make_plane(pictures, &m->score, error))
        return false;
    m->ztest = ztest_compute(pictures, limits, m->score);
    return true;
}

static void add_pixels(const Pictures *pictures, const Limits *limits, Metrics *m)
{
    Sums sums = {0, 0, 0};
    for (u32 y = 0; y < pictures->region.height; y++) {
        for (u32 x = 0; x < pictures->region.width; x++) {
            if (pictures->left_out && pictures->left_out[(size_t)y * pictures->region.width + x])
                m->left_out_pixels++;
            else
                add_pixel(pictures, limits, x, y, m, &sums);
        }
    }
    const u32 colors = pictures->images[0]->channels >= 3 ? 3 : 1;
    m->mean_abs = sums.absolute / (f64)m->values;
    m->mse = sums.squared / (f64)m->values;
    m->rmse = sqrt(m->mse);
    m->psnr = 20 * log10(pictures_peak(pictures) / m->rmse);
    m->relmse = sums.relative / ((f64)m->pixels * colors);
}

bool metrics_compute(const Pictures *pictures, const Limits *limits, Metrics *metrics, Error *error)
{
    Metrics m = {.pixels = 0};
    add_pixels(pictures, limits, &m);
    if (!add_perceived(pictures, &m, error) || !add_ztest(pictures, &limits->ztest, &m, error)) {
        metrics_destroy(&m);
        return false;
    }
    m.same = (f64)m.failed_values * 100 <= limits->fail_percent * (f64)m.values &&
             m.hard_failed_values == 0 && m.nan_values == 0 && (!m.tested || m.ztest.passed);
    *metrics = m;
    return true;
}

void metrics_destroy(Metrics *metrics)
{
    free(metrics->flip);
    free(metrics->ssim);
    free(metrics->score);
    metrics->flip = metrics->ssim = metrics->score = NULL;
}
