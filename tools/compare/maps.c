#include "maps.h"

#include "heatmap.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const f32 NOT_THERE = -1; // to a heat map

static HeatScale difference_scale(Format format)
{
    switch (format) {
    case FORMAT_PNG8:
        return (HeatScale){1, 255, true, {"1", "10", "100"}};
    case FORMAT_PNG16:
        return (HeatScale){1, 65535, true, {"1", "10", "100", "1000", "10000"}};
    case FORMAT_PFM:
        break;
    }
    return (HeatScale){1e-7, 10, true, {"1E-7", "1E-5", "1E-3", "0.1", "10"}};
}

static HeatScale scale_of(MapKind kind, Format format)
{
    switch (kind) {
    case MAP_FLIP:
    case MAP_SSIM:
        return (HeatScale){0, 1, false, {"0.25", "0.5", "0.75", "1"}};
    case MAP_Z:
        return (HeatScale){0, 8, false, {"2", "4", "6", "8"}};
    case MAP_DIFFERENCE:
    case MAP_COUNT:
        break;
    }
    return difference_scale(format);
}

// %G, since the font has capital letters alone.
static void write_caption(MapKind kind, Format format, const Metrics *m, char *text, size_t bytes)
{
    switch (kind) {
    case MAP_DIFFERENCE:
        snprintf(text, bytes, "%s APART, AT MOST %.4G", format == FORMAT_PFM ? "VALUES" : "LEVELS",
                 m->max_abs);
        break;
    case MAP_FLIP:
        snprintf(text, bytes, "FLIP, MEAN %.4G", m->flip_mean);
        break;
    case MAP_SSIM:
        snprintf(text, bytes, "1 - SSIM, MEAN %.4G", 1 - m->ssim_mean);
        break;
    case MAP_Z:
        snprintf(text, bytes, "|Z|, %.6G %% OF PIXELS PASS",
                 100 * (f64)m->ztest.passed_pixels / (f64)m->ztest.pixels);
        break;
    case MAP_COUNT:
        break;
    }
}

static f32 largest_difference(const Pictures *pictures, size_t pixel)
{
    const u32 channels = pictures->images[0]->channels;
    const f32 *a = pictures->images[0]->values + pixel * channels;
    const f32 *b = pictures->images[1]->values + pixel * channels;
    f64 most = 0;
    for (u32 c = 0; c < channels; c++) {
        if (isnan(a[c]) || isnan(b[c]))
            return NAN;
        if (a[c] != b[c])
            most = fmax(most, fabs((f64)a[c] - (f64)b[c]));
    }
    // The scales' ends are far within what a float holds; a tiny difference must not become none.
    return (f32)fmin(fmax(most, most > 0 ? 1e-30 : 0), 1e30);
}

static f32 value_at(const Pictures *pictures, const Metrics *m, MapKind kind, size_t pixel)
{
    if (pictures->left_out && pictures->left_out[pixel])
        return NOT_THERE;
    switch (kind) {
    case MAP_FLIP:
        return m->flip ? m->flip[pixel] : NAN;
    case MAP_SSIM:
        if (!m->ssim)
            return NAN;
        return isnan(m->ssim[pixel]) ? NOT_THERE : fmaxf(1 - m->ssim[pixel], 0);
    case MAP_Z:
        return m->score[pixel];
    case MAP_DIFFERENCE:
    case MAP_COUNT:
        break;
    }
    return largest_difference(pictures, pixel);
}

bool maps_write(const Pictures *pictures, const Metrics *metrics, const char *const paths[MAP_COUNT],
                Error *error)
{
    const Region r = pictures->region;
    const size_t count = (size_t)r.width * r.height;
    f32 *values = malloc(count * sizeof *values);
    if (!values)
        return error_set(error, ERROR_MEMORY, "no memory for the maps");
    bool done = true;
    for (MapKind kind = MAP_DIFFERENCE; kind < MAP_COUNT && done; kind++) {
        if (!paths[kind])
            continue;
        for (size_t i = 0; i < count; i++)
            values[i] = value_at(pictures, metrics, kind, i);
        char caption[64];
        write_caption(kind, pictures->format, metrics, caption, sizeof caption);
        const HeatMap map = {r.width, r.height, values, scale_of(kind, pictures->format), caption};
        done = heatmap_write(&map, paths[kind], error);
    }
    free(values);
    return done;
}
