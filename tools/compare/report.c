#include "report.h"

#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static const char *channel_name(u32 channels, u32 channel)
{
    static const char *const GREY[] = {"grey", "alpha"};
    static const char *const COLOR[] = {"red", "green", "blue", "alpha"};
    return channels >= 3 ? COLOR[channel] : GREY[channel];
}

static f64 percent(u64 part, u64 whole)
{
    return 100 * (f64)part / (f64)whole;
}

static bool finish(Error *error)
{
    if (fflush(stdout) != 0 || ferror(stdout))
        return error_set(error, ERROR_IO, "standard output: %s", strerror(errno));
    return true;
}

static void print_limits(const Options *options, const Pictures *pictures, const Metrics *m)
{
    const Limits *limits = &options->limits;
    printf("  beyond %.9g", limits->fail);
    if (pictures->format == FORMAT_PFM && limits->fail_ulp > 0)
        printf(" and %u ulp", limits->fail_ulp);
    printf(": %llu values, %.6g %%; allowed %.6g %%\n", (unsigned long long)m->failed_values,
           percent(m->failed_values, m->values), limits->fail_percent);
    if (isfinite(limits->hard_fail))
        printf("  beyond %.9g: %llu values; allowed none\n", limits->hard_fail,
               (unsigned long long)m->hard_failed_values);
    if (m->nan_values > 0)
        printf("  NaN: %llu values; allowed none\n", (unsigned long long)m->nan_values);
}

bool report_text(const Options *options, const Pictures *pictures, const Metrics *m, Error *error)
{
    static const char *const FORMATS[] = {"PNG, 8 bits", "PNG, 16 bits", "PFM"};
    const Region r = pictures->region;
    const u32 channels = pictures->images[0]->channels;
    printf("%s, %s: %s\n", options->paths[0], options->paths[1],
           !m->same                   ? "different"
           : m->different_values == 0 ? "the same"
                                      : "the same within the limits");
    printf("  %u x %u, %u channels, %s", r.width, r.height, channels, FORMATS[pictures->format]);
    if (options->has_crop)
        printf(", from %u, %u", r.x, r.y);
    if (m->left_out_pixels > 0)
        printf(", %llu pixels left out", (unsigned long long)m->left_out_pixels);
    printf("\n  differing: %llu pixels, %.6g %%; %llu values, %.6g %%\n",
           (unsigned long long)m->different_pixels, percent(m->different_pixels, m->pixels),
           (unsigned long long)m->different_values, percent(m->different_values, m->values));
    print_limits(options, pictures, m);
    printf("  mean %.6g, RMSE %.6g, PSNR %.6g dB, FLIP mean %.6g", m->mean_abs, m->rmse, m->psnr,
           m->flip_mean);
    if (pictures->format == FORMAT_PFM)
        printf(", at most %u ulp", m->max_ulp);
    printf("\n");
    if (m->worst.present)
        printf("  worst: pixel %u, %u %s: %.9g and %.9g, %.9g apart\n", m->worst.x, m->worst.y,
               channel_name(channels, m->worst.channel), (f64)m->worst.a, (f64)m->worst.b, m->max_abs);
    return finish(error);
}

// JSON has neither NaN nor infinity; both are null.
static json_t *number(f64 value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *whole(u64 value)
{
    return json_integer((json_int_t)value);
}

// A value of a PFM may be what JSON has no number for, and here null would not do.
static json_t *sample(f32 value)
{
    if (isnan(value))
        return json_string("nan");
    if (isinf(value))
        return json_string(value > 0 ? "inf" : "-inf");
    return json_real((f64)value);
}

static json_t *worst_object(const Pictures *pictures, const Metrics *m)
{
    if (!m->worst.present)
        return json_null();
    return json_pack("{s:o, s:o, s:s, s:o, s:o}", "x", whole(m->worst.x), "y", whole(m->worst.y), "channel",
                     channel_name(pictures->images[0]->channels, m->worst.channel), "a", sample(m->worst.a),
                     "b", sample(m->worst.b));
}

static json_t *limits_object(const Options *options, const Pictures *pictures)
{
    const Limits *limits = &options->limits;
    return json_pack("{s:o, s:o, s:o, s:o}", "fail", number(limits->fail), "fail_ulp",
                     pictures->format == FORMAT_PFM ? whole(limits->fail_ulp) : json_null(), "fail_percent",
                     number(limits->fail_percent), "hard_fail", number(limits->hard_fail));
}

static json_t *region_object(Region r)
{
    return json_pack("{s:o, s:o, s:o, s:o}", "x", whole(r.x), "y", whole(r.y), "width", whole(r.width),
                     "height", whole(r.height));
}

static json_t *metrics_object(const Pictures *pictures, const Metrics *m)
{
    const bool pfm = pictures->format == FORMAT_PFM;
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o}",
                     "pixels", whole(m->pixels),
                     "left_out_pixels", whole(m->left_out_pixels),
                     "values", whole(m->values),
                     "different_pixels", whole(m->different_pixels),
                     "different_values", whole(m->different_values),
                     "failed_values", whole(m->failed_values),
                     "hard_failed_values", whole(m->hard_failed_values),
                     "nan_values", whole(m->nan_values),
                     "max_abs", number(m->max_abs),
                     "mean_abs", number(m->mean_abs),
                     "rmse", number(m->rmse),
                     "psnr_db", number(m->psnr),
                     "max_ulp", pfm ? whole(m->max_ulp) : json_null(),
                     "flip_mean", number(m->flip_mean),
                     "worst", worst_object(pictures, m));
}

bool report_json(const Options *options, const Pictures *pictures, const Metrics *m, Error *error)
{
    static const char *const FORMATS[] = {"png8", "png16", "pfm"};
    // A path that is not UTF-8 has no place in JSON.
    json_t *paths[2];
    for (int i = 0; i < 2; i++) {
        paths[i] = json_string(options->paths[i]);
        if (!paths[i])
            paths[i] = json_null();
    }
    json_t *root =
        json_pack("{s:s, s:b, s:o, s:o, s:s, s:o, s:o, s:o}",
                  "schema", "clrt-compare/1",
                  "same", m->same,
                  "a", paths[0],
                  "b", paths[1],
                  "format", FORMATS[pictures->format],
                  "channels", whole(pictures->images[0]->channels),
                  "region", region_object(pictures->region),
                  "limits", limits_object(options, pictures));
    json_t *metrics = metrics_object(pictures, m);
    const bool made = root && metrics && json_object_update(root, metrics) == 0;
    const bool written = made && json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0;
    json_decref(metrics);
    json_decref(root);
    if (!made)
        return error_set(error, ERROR_MEMORY, "no memory for the report");
    if (written)
        printf("\n");
    return finish(error);
}
