#include "metrics.h"

#include "flip.h"

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
    f64 absolute, squared;
} Sums;

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
    const u32 channels = pictures->images[0]->channels;
    const f32 *a = image_row(pictures->images[0], y) + (size_t)x * channels;
    const f32 *b = image_row(pictures->images[1], y) + (size_t)x * channels;
    const u64 before = m->different_values;
    for (u32 c = 0; c < channels; c++) {
        add_value(pictures, limits, a[c], b[c], m, sums);
        const f64 d = distance(a[c], b[c]);
        if (is_farther(d, m->max_abs)) {
            m->max_abs = d;
            m->worst = (Worst){true, pictures->region.x + x, pictures->region.y + y, c, a[c], b[c]};
        }
    }
    m->pixels++;
    m->different_pixels += m->different_values > before;
}

static bool add_flip(const Pictures *pictures, Metrics *m, Error *error)
{
    const Image *image = pictures->images[0];
    const size_t count = (size_t)image->width * image->height;
    m->flip_mean = 0;
    if (memcmp(image->values, pictures->images[1]->values, count * image->channels * sizeof(f32)) == 0)
        return true;
    f32 *differences = malloc(count * sizeof *differences);
    if (!differences)
        return error_set(error, ERROR_MEMORY, "no memory to compute FLIP");
    const FlipScale scale = {(f32)pictures_peak(pictures), !pictures->linear};
    const bool done = flip_compare(pictures->images[0], pictures->images[1], scale, differences, error);
    f64 sum = 0;
    for (size_t i = 0; i < count && done; i++) {
        if (!pictures->left_out || !pictures->left_out[i])
            sum += (f64)differences[i];
    }
    m->flip_mean = sum / (f64)m->pixels;
    free(differences);
    return done;
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

bool metrics_compute(const Pictures *pictures, const Limits *limits, Metrics *metrics, Error *error)
{
    Metrics m = {.pixels = 0};
    Sums sums = {0, 0};
    for (u32 y = 0; y < pictures->region.height; y++) {
        for (u32 x = 0; x < pictures->region.width; x++) {
            if (pictures->left_out && pictures->left_out[(size_t)y * pictures->region.width + x])
                m.left_out_pixels++;
            else
                add_pixel(pictures, limits, x, y, &m, &sums);
        }
    }
    m.mean_abs = sums.absolute / (f64)m.values;
    m.rmse = sqrt(sums.squared / (f64)m.values);
    m.psnr = 20 * log10(pictures_peak(pictures) / m.rmse);
    m.flip_mean = NAN;
    if (!has_nan(pictures->images[0]) && !has_nan(pictures->images[1]) && !add_flip(pictures, &m, error))
        return false;
    m.same = (f64)m.failed_values * 100 <= limits->fail_percent * (f64)m.values &&
             m.hard_failed_values == 0 && m.nan_values == 0;
    *metrics = m;
    return true;
}
