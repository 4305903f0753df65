#include "cli/identity_json.h"

#include <math.h>
#include <stdio.h>

// null for what is not finite.
static json_t *number(f64 value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *hash_text(u64 hash)
{
    char text[17];
    snprintf(text, sizeof text, "%016llx", (unsigned long long)hash);
    return json_string(text);
}

static json_t *text_or_null(const char *text)
{
    json_t *string = text ? json_string(text) : NULL; // NULL where it is no UTF-8
    return string ? string : json_null();
}

json_t *identity_json(const Identity *identity, u64 program_hash)
{
    const Scene *scene = identity->scene;
    const DeviceInfo *device = identity->device;
    return json_pack("{s:o, s:o, s:s, s:o, s:o, s:o, s:s, s:o, s:i, s:i, s:I, s:i, s:I, s:[iiii]}", "scene",
                     text_or_null(identity->scene_name), "scene_hash", hash_text(identity->scene_hash),
                     "clrt_version", CLRT_VERSION, "platform", text_or_null(device->platform_name), "device",
                     text_or_null(device->name), "driver", text_or_null(device->driver), "math", identity->math,
                     "kernel_hash", hash_text(program_hash), "width", (int)scene->image.width, "height",
                     (int)scene->image.height, "spp", (json_int_t)scene->image.samples, "depth",
                     (int)scene->render.max_depth, "seed", (json_int_t)scene->image.seed, "crop",
                     (int)identity->left, (int)identity->top, (int)identity->width, (int)identity->height);
}

// null without a limit.
static json_t *clamp_json(const ClampBudget *clamp)
{
    if (!(clamp->limit > 0))
        return json_null();
    return json_pack("{s:f, s:o, s:o, s:o, s:I, s:I}", "limit", clamp->limit, "bias_of_mean",
                     number(-clamp->removed), "share", number(clamp->share), "e_clamp", number(clamp->rmse),
                     "clamped_samples", (json_int_t)clamp->clamped, "samples", (json_int_t)clamp->samples);
}

json_t *budget_json(const ErrorBudget *budget)
{
    const SamplingBudget *sampling = &budget->sampling;
    const f64 *radiance = budget->bounds.radiance;
    return json_pack(
        "{s:f, s:s, s:o, s:[ooo], s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:o, s:b, s:b}",
        "confidence", budget->confidence, "estimator", budget->estimator, "assumption",
        text_or_null(budget_assumption(budget)), "radiance_bound", number(radiance[0]), number(radiance[1]),
        number(radiance[2]), "unbounded_by", text_or_null(budget->bounds.unbounded), "e_sampling",
        number(sampling->rmse), "e_sampling_largest", number(sampling->largest), "standard_error",
        number(sampling->standard_error), "mean", number(sampling->mean), "mean_low",
        number(sampling->mean_low), "mean_high", number(sampling->mean_high), "e_depth",
        number(budget->bounds.depth), "e_min_weight", number(budget->bounds.min_weight), "clamp",
        clamp_json(&budget->clamp), "e_arith",
        number(budget->arithmetic), "e_quant", number(budget->quantisation), "e_total", number(budget->total),
        "total_has_sampling", budget->covers_sampling, "total_has_arith", budget->covers_arithmetic);
}

json_t *health_json(const ErrorBudget *budget)
{
    return json_pack("{s:I, s:I, s:I}", "nan", (json_int_t)budget->nan, "infinite",
                     (json_int_t)budget->infinite, "negative", (json_int_t)budget->negative);
}
