#include "row.h"

#include <math.h>
#include <string.h>

#include "doc.h"

const Stage ROW_STAGES[] = {
    {"wall_s", ""},         {"total_s", "total"},   {"device_s", "device"},     {"parse_s", "scene"},
    {"load_s", "meshes"},   {"bvh_s", "hierarchy"}, {"layout_s", "layout"},     {"compile_s", "compile"},
    {"upload_s", "upload"}, {"kernel_s", "trace"},  {"download_s", "download"}, {"encode_s", "encode"},
    {"other_s", ""},        {NULL, NULL},
};

static json_t *null_object(const char *const *keys)
{
    json_t *object = json_object();
    for (; *keys; keys++)
        json_object_set_new(object, *keys, json_null());
    return object;
}

static json_t *stages_object(void)
{
    json_t *object = json_object();
    for (const Stage *stage = ROW_STAGES; stage->key; stage++)
        json_object_set_new(object, stage->key, json_pack("{s:n, s:n}", "median", "mad"));
    return object;
}

static json_t *run_object(const char *scene, const Mode *mode)
{
    static const char *const KEYS[] = {"scene_hash",  "clrt_version", "platform", "device", "driver",
                                       "kernel_hash", "features",     "width",    "height", "depth",
                                       "seed",        "unavailable",  NULL};
    json_t *run = null_object(KEYS);
    json_object_set_new(run, "scene", doc_string(scene));
    json_object_set_new(run, "mode", doc_string(mode->name));
    json_object_set_new(run, "math", doc_string(mode->math));
    json_object_set_new(run, "options", doc_string(mode->text));
    json_object_set_new(run, "spp", json_pack("{s:n, s:n, s:n}", "min", "mean", "max"));
    return run;
}

static json_t *error_object(void)
{
    static const char *const R64[] = {"spp",     "max_ulp",
                                      "max_abs", "p99_abs",
                                      "rmse",    "different_values",
                                      "values",  "other_object_pixels",
                                      "reason",  NULL};
    static const char *const RINF[] = {"reference", "spp",       "mse",       "mse_low",  "mse_high",
                                       "rmse",      "rmse_low",  "rmse_high", "relmse",   "psnr_db",
                                       "flip_mean", "ssim_mean", "bias",      "bias_low", "bias_high",
                                       "reason",    NULL};
    return json_pack("{s:o, s:o, s:o}", "r64", null_object(R64), "r64_one_sample", null_object(R64), "rinf",
                     null_object(RINF));
}

json_t *row_create(const char *scene, const Mode *mode)
{
    static const char *const RAYS[] = {"camera",      "shadow",     "reflect",        "refract", "total",
                                       "mrays_per_s", "ns_per_ray", "visits_per_ray", "idle_lanes", NULL};
    static const char *const MEMORY[] = {"device_peak_bytes",
                                         "host_peak_bytes",
                                         "largest_buffer_bytes",
                                         "scene_bytes",
                                         "state_bytes",
                                         "film_bytes",
                                         NULL};
    static const char *const EFFICIENCY[] = {"per_mse_wall",
                                             "per_mse_kernel",
                                             "seconds_to_rmse_0_01",
                                             "seconds_extrapolated",
                                             "slope_wall",
                                             "slope_wall_low",
                                             "slope_wall_high",
                                             "slope_kernel",
                                             "slope_kernel_low",
                                             "slope_kernel_high",
                                             NULL};
    static const char *const BUDGET[] = {"e_sampling", "e_depth", "e_min_weight", "e_arith", "e_quant",
                                         "e_total",    NULL};
    static const char *const HEALTH[] = {"nan_values", "inf_values", "negative_values", "clamped_samples",
                                         "leaks",      "image_hash", "self_test",       NULL};
    static const char *const FILES[] = {"picture", "map_r64", "map_rinf", NULL};
    json_t *row =
        json_pack("{s:s, s:o, s:{s:i, s:i, s:o, s:o, s:{s:n, s:n}, s:n}, s:o, s:o, s:o, s:o, s:[]}", "schema",
                  ROW_SCHEMA, "run", run_object(scene, mode), "time", "cold_runs", 0, "warm_runs", 0, "cold",
                  stages_object(), "warm", stages_object(), "kernel_to_exact", "median", "mad",
                  "kernel_to_exact_spp", "rays", null_object(RAYS), "memory", null_object(MEMORY), "error",
                  error_object(), "efficiency", null_object(EFFICIENCY), "convergence");
    json_object_set_new(row, "budget", null_object(BUDGET));
    json_object_set_new(row, "health", null_object(HEALTH));
    json_object_set_new(row, "files", null_object(FILES));
    return row;
}

// Sets into's key where stats have it; "key" or "key=name in stats".
static void copy(json_t *into, const char *const *keys, const json_t *stats)
{
    for (; *keys; keys++) {
        const char *equals = strchr(*keys, '=');
        char key[64];
        const size_t length = equals ? (size_t)(equals - *keys) : strlen(*keys);
        if (length >= sizeof key)
            continue;
        memcpy(key, *keys, length);
        key[length] = 0;
        const char *name = equals ? equals + 1 : key;
        json_t *value = json_object_get(stats, name);
        if (value)
            json_object_set(into, key, value);
    }
}

void row_take_stats(json_t *row, const json_t *stats)
{
    static const char *const PICTURE[] = {"device", "features", "width", "height", NULL};
    static const char *const RUN[] = {"scene_hash",  "clrt_version", "platform", "device", "driver",
                                      "kernel_hash", "depth",        "seed",     NULL};
    static const char *const RAYS[] = {"camera", "shadow", "reflect=mirrored", "reflect=scattered",
                                       "refract=transmitted", NULL};
    static const char *const WAVES[] = {"idle_lanes", NULL};
    static const char *const MEMORY[] = {"device_peak_bytes=device_peak",
                                         "host_peak_bytes=host_peak",
                                         "largest_buffer_bytes=largest_buffer",
                                         "scene_bytes=scene",
                                         "state_bytes=state",
                                         "film_bytes=film",
                                         NULL};
    static const char *const HEALTH[] = {"clamped_samples", "leaks", NULL};
    copy(json_object_get(row, "run"), PICTURE, stats);
    copy(json_object_get(row, "run"), RUN, json_object_get(stats, "run"));
    copy(json_object_get(row, "rays"), RAYS, json_object_get(stats, "rays"));
    copy(json_object_get(row, "rays"), WAVES, stats);
    copy(json_object_get(row, "memory"), MEMORY, json_object_get(stats, "bytes"));
    copy(json_object_get(row, "health"), HEALTH, json_object_get(stats, "health"));
    const f64 rays = row_rays(stats), seconds = doc_number(stats, "seconds.trace");
    doc_set(row, "rays.total", doc_real(rays));
    doc_set(row, "rays.mrays_per_s", doc_real(rays / seconds * 1e-6));
    doc_set(row, "rays.ns_per_ray", doc_real(seconds / rays * 1e9));
}

void row_take_budget(json_t *row, const json_t *stats)
{
    json_t *budget = json_object_get(stats, "budget");
    if (json_is_object(budget))
        json_object_update(json_object_get(row, "budget"), budget);
}

f64 row_rays(const json_t *stats)
{
    const char *key;
    json_t *count;
    f64 sum = 0;
    json_object_foreach (json_object_get(stats, "rays"), key, count)
        sum += json_number_value(count);
    return sum;
}

// What the stages leave of the wall's seconds: start of the process, file, end of the process.
static f64 other_seconds(const json_t *stats, f64 wall)
{
    for (const Stage *stage = ROW_STAGES; stage->key; stage++) {
        if (!stage->stats || !*stage->stats || strcmp(stage->key, "total_s") == 0)
            continue;
        const json_t *seconds = json_object_get(json_object_get(stats, "seconds"), stage->stats);
        wall -= json_is_number(seconds) ? json_number_value(seconds) : 0;
    }
    return wall;
}

f64 row_stage_seconds(const json_t *stats, f64 wall, const char *key)
{
    if (strcmp(key, "wall_s") == 0)
        return wall;
    if (strcmp(key, "other_s") == 0)
        return other_seconds(stats, wall);
    for (const Stage *stage = ROW_STAGES; stage->key; stage++)
        if (strcmp(stage->key, key) == 0)
            return doc_number(json_object_get(stats, "seconds"), stage->stats);
    return (f64)NAN;
}
