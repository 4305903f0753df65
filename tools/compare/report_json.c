#include "report.h"

#include <jansson.h>
#include <math.h>
#include <stdio.h>

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
                     report_channel(pictures, m->worst.channel), "a", sample(m->worst.a),
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
    return json_pack("{s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, "
                     "s:o, s:o}",
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
                     "mse", number(m->mse),
                     "rmse", number(m->rmse),
                     "psnr_db", number(m->psnr),
                     "relmse", number(m->relmse),
                     "relmse_epsilon", number(RELATIVE_EPSILON),
                     "ssim_mean", number(m->ssim_mean),
                     "max_ulp", pfm ? whole(m->max_ulp) : json_null(),
                     "flip_mean", number(m->flip_mean),
                     "worst", worst_object(pictures, m));
}

// Sixteen digits; a number of JSON may be read as a double, which has no 64 bits.
static json_t *hash(u64 value)
{
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)value);
    return json_string(text);
}

// A path that is not UTF-8 has no place in JSON.
static json_t *path(const char *text)
{
    json_t *string = text ? json_string(text) : NULL;
    return string ? string : json_null();
}

static json_t *ztest_object(const Options *options, const Pictures *pictures, const Metrics *m)
{
    if (!m->tested)
        return json_null();
    const ZTest *test = &m->ztest;
    const ZLimits *limits = &options->limits.ztest;
    return json_pack("{s:b, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:{s:o, s:o, s:s}, s:o, s:o, s:o}",
                     "passed", test->passed,
                     "variance_a", path(options->sources.variances[0]),
                     "variance_b", path(options->sources.variances[1]),
                     "variance_floor", number(limits->variance_floor),
                     "significance", number(limits->significance),
                     "pass_percent", number(limits->pass_percent),
                     "pixels", whole(test->pixels),
                     "passed_pixels", whole(test->passed_pixels),
                     "threshold", number(test->threshold),
                     "p_min", number(test->p_min),
                     "p_min_at",
                     "x", whole(test->x),
                     "y", whole(test->y),
                     "channel", report_channel(pictures, test->channel),
                     "z_rms", number(test->z_rms),
                     "bias", number(test->bias),
                     "bias_standard_error", number(test->bias_error));
}

bool report_json(const Options *options, const Pictures *pictures, const Metrics *m, Error *error)
{
    static const char *const FORMATS[] = {"png8", "png16", "pfm"};
    json_t *root =
        json_pack("{s:s, s:b, s:o, s:o, s:s, s:o, s:o, s:o, s:{s:s, s:o, s:o}}",
                  "schema", "clrt-compare/1",
                  "same", m->same,
                  "a", path(options->sources.paths[0]),
                  "b", path(options->sources.paths[1]),
                  "format", FORMATS[pictures->format],
                  "channels", whole(pictures->images[0]->channels),
                  "region", region_object(pictures->region),
                  "limits", limits_object(options, pictures),
                  "pixel_hash",
                  "algorithm", "fnv1a-64",
                  "a", hash(pictures->hashes[0]),
                  "b", hash(pictures->hashes[1]));
    json_t *metrics = metrics_object(pictures, m);
    json_t *ztest = ztest_object(options, pictures, m);
    const bool made = root && metrics && json_object_update(root, metrics) == 0 &&
                      json_object_set(root, "ztest", ztest) == 0;
    const bool written = made && json_dumpf(root, stdout, JSON_INDENT(2) | JSON_REAL_PRECISION(17)) == 0;
    json_decref(metrics);
    json_decref(ztest);
    json_decref(root);
    if (!made)
        return error_set(error, ERROR_MEMORY, "no memory for the report");
    if (written)
        printf("\n");
    return report_finish(error);
}
