#include "errors.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "heatmap.h"
#include "metrics.h"

enum { MAP_WIDTH = 380 }; // at least: the legend's

static size_t value_count(const Image *image)
{
    return (size_t)image->width * image->height * image->channels;
}

static bool alike(const Image *a, const Image *b, Error *error)
{
    if (a->width == b->width && a->height == b->height && a->channels == b->channels)
        return true;
    return error_set(error, ERROR_IO, "pictures of %ux%ux%u and %ux%ux%u cannot be compared", a->width,
                     a->height, a->channels, b->width, b->height, b->channels);
}

static int compare_floats(const void *a, const void *b)
{
    const f32 x = *(const f32 *)a, y = *(const f32 *)b;
    return (x > y) - (x < y);
}

// The value that 99 of 100 distances do not exceed, and their mean with sign; NaN with a NaN.
static bool add_spread(const Image *reference, const Image *test, Distance *distance, Error *error)
{
    const size_t count = value_count(reference);
    f32 *apart = malloc(count * sizeof *apart);
    if (!apart)
        return error_set(error, ERROR_MEMORY, "no memory to compare pictures");
    f64 sum = 0;
    for (size_t i = 0; i < count; i++) {
        const f64 d = (f64)test->values[i] - (f64)reference->values[i];
        sum += d;
        apart[i] = (f32)fabs(d);
    }
    distance->mean = sum / (f64)count;
    distance->p99_abs = (f64)NAN;
    if (!isnan(sum)) {
        qsort(apart, count, sizeof *apart, compare_floats);
        distance->p99_abs = (f64)apart[(count * 99 + 99) / 100 - 1];
    }
    free(apart);
    return true;
}

// What clrt-compare says of the two.
static bool add_metrics(const Image *reference, const Image *test, Distance *distance, Error *error)
{
    // The library changes no image that it is given.
    Pictures pictures = {.images = {(Image *)(uintptr_t)reference, (Image *)(uintptr_t)test},
                         .format = FORMAT_PFM,
                         .linear = true,
                         .region = {0, 0, reference->width, reference->height}};
    Metrics metrics;
    if (!metrics_compute(&pictures, &(Limits){.fail = 0}, &metrics, error))
        return false;
    distance->flip_mean = metrics.flip_mean;
    distance->ssim_mean = metrics.ssim_mean;
    metrics_destroy(&metrics);
    return true;
}

static void add_values(const Image *reference, const Image *test, Distance *distance)
{
    f64 squares = 0, relative = 0;
    distance->values = value_count(reference);
    for (size_t i = 0; i < distance->values; i++) {
        const f32 a = reference->values[i], b = test->values[i];
        const f64 d = a == b ? 0 : fabs((f64)a - (f64)b);
        squares += d * d;
        relative += d * d / ((f64)a * (f64)a + RELATIVE_EPSILON);
        distance->different_values += !(d == 0);
        distance->max_abs = d > distance->max_abs || isnan(d) ? d : distance->max_abs;
        if (!isnan(a) && !isnan(b)) {
            const u32 ulps = metrics_ulps(a, b);
            distance->max_ulp = ulps > distance->max_ulp ? ulps : distance->max_ulp;
        }
    }
    distance->mse = squares / (f64)distance->values;
    distance->rmse = sqrt(distance->mse);
    distance->relmse = relative / (f64)distance->values;
    distance->psnr_db = -20 * log10(distance->rmse);
}

bool errors_compare(const Image *reference, const Image *test, bool perceived, Distance *distance,
                    Error *error)
{
    *distance = (Distance){.flip_mean = (f64)NAN, .ssim_mean = (f64)NAN};
    if (!alike(reference, test, error))
        return false;
    add_values(reference, test, distance);
    return add_spread(reference, test, distance, error) &&
           (!perceived || add_metrics(reference, test, distance, error));
}

bool errors_count_other(const Image *reference, const Image *test, u64 *pixels, Error *error)
{
    if (!alike(reference, test, error))
        return false;
    *pixels = 0;
    const u32 channels = reference->channels;
    for (size_t i = 0; i < value_count(reference); i += channels) {
        bool other = false;
        for (u32 c = 0; c < channels; c++)
            other = other || !(reference->values[i + c] == test->values[i + c]);
        *pixels += other;
    }
    return true;
}

f64 errors_level(const Image *image)
{
    f64 sum = 0;
    for (size_t i = 0; i < value_count(image); i++)
        sum += (f64)image->values[i];
    return sum / (f64)value_count(image);
}

Oddities errors_oddities(const Image *image)
{
    Oddities odd = {0, 0, 0};
    for (size_t i = 0; i < value_count(image); i++) {
        odd.nan += isnan(image->values[i]) != 0;
        odd.inf += isinf(image->values[i]) != 0;
        odd.negative += image->values[i] < 0;
    }
    return odd;
}

// Small pictures with pixels as blocks, so that the legend is not wider than the map.
static bool write_enlarged(const HeatMap *map, const char *path, Error *error)
{
    const u32 factor = (MAP_WIDTH + map->width - 1) / map->width;
    const size_t width = (size_t)map->width * factor, height = (size_t)map->height * factor;
    f32 *values = factor > 1 ? malloc(width * height * sizeof *values) : NULL;
    if (factor > 1 && !values)
        return error_set(error, ERROR_MEMORY, "no memory for a map");
    HeatMap larger = *map;
    for (size_t y = 0; values && y < height; y++)
        for (size_t x = 0; x < width; x++)
            values[y * width + x] = map->values[y / factor * map->width + x / factor];
    if (values)
        larger = (HeatMap){(u32)width, (u32)height, values, map->scale, map->caption};
    const bool drawn = heatmap_write(&larger, path, error);
    free(values);
    return drawn;
}

bool errors_draw(const Image *reference, const Image *test, const char *path, Error *error)
{
    if (!alike(reference, test, error))
        return false;
    const size_t count = (size_t)reference->width * reference->height;
    const u32 channels = reference->channels;
    f32 *largest = calloc(count, sizeof *largest);
    if (!largest)
        return error_set(error, ERROR_MEMORY, "no memory for a map");
    f64 most = 0;
    for (size_t i = 0; i < count; i++) {
        for (u32 c = 0; c < channels; c++) {
            const f64 d =
                fabs((f64)reference->values[i * channels + c] - (f64)test->values[i * channels + c]);
            if (isnan(d) || d > (f64)largest[i])
                largest[i] = isnan(d) ? NAN : (f32)fmin(d, 1e30);
        }
        most = fmax(most, (f64)largest[i]);
    }
    char caption[64];
    snprintf(caption, sizeof caption, "ERROR OF RADIANCE, AT MOST %.3G", most);
    const HeatMap map = {reference->width,
                         reference->height,
                         largest,
                         {1e-8, 1, true, {"1E-8", "1E-6", "1E-4", "1E-2", "1"}},
                         caption};
    const bool drawn = write_enlarged(&map, path, error);
    free(largest);
    return drawn;
}
