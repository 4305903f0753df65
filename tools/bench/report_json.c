#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <string.h>

#include "report.h"

static json_t *whole(u64 value)
{
    return json_integer((json_int_t)value);
}

static json_t *rates_array(const f64 *rates, u32 count)
{
    json_t *array = json_array();
    for (u32 i = 0; i < count; i++)
        json_array_append_new(array, json_real(rates[i]));
    return array;
}

static json_t *contender_object(const Contender *c, u32 rounds)
{
    json_t *object = json_pack(
        "{s:s, s:s, s:b, s:o, s:f, s:f, s:o, s:o}", "tracer", c->embree ? "embree" : "clrt", "mode",
        c->embree ? embree_mode_name(c->mode) : "batch", "robust", c->robust, "repeats", whole(c->repeats),
        "rays_per_second_cpu", c->medians[METRIC_CPU], "rays_per_second_wall", c->medians[METRIC_WALL],
        "rounds_cpu", rates_array(c->rates[METRIC_CPU], rounds), "rounds_wall",
        rates_array(c->rates[METRIC_WALL], rounds));
    if (object && c->embree)
        json_object_set_new(object, "mismatch",
                            json_pack("{s:o, s:o, s:f, s:o, s:o}", "hit_miss", whole(c->mismatch.hit_miss),
                                      "other", whole(c->mismatch.other), "t_error", c->mismatch.t_error,
                                      "arbitrated", whole(c->arbitration.checked), "clrt_wrong",
                                      whole(c->arbitration.wrong)));
    return object;
}

static json_t *versus_object(const SetResult *set, bool robust, Metric metric)
{
    const Versus versus = versus_embree(set, robust, metric);
    if (versus.best == 0)
        return json_null();
    return json_pack("{s:s, s:f, s:f}", "mode", embree_mode_name(set->contenders[versus.best].mode), "ratio",
                     versus.ratio, "ratio_of_rounds", versus.of_rounds);
}

static json_t *set_object(const SetResult *set, const BenchOptions *options)
{
    json_t *contenders = json_array();
    for (u32 k = 0; set->rays > 0 && k < set->contender_count; k++)
        json_array_append_new(contenders, contender_object(&set->contenders[k], set->rounds));
    json_t *object = json_pack(
        "{s:s, s:o, s:b, s:o, s:o, s:o, s:o, s:o}", "set", ray_kind_name(set->kind), "rays", whole(set->rays),
        "few", set->rays < RAYS_FEW, "contenders", contenders, "robust_cpu",
        versus_object(set, true, METRIC_CPU), "robust_wall", versus_object(set, true, METRIC_WALL),
        "fast_cpu", versus_object(set, false, METRIC_CPU), "fast_wall",
        versus_object(set, false, METRIC_WALL));
    if (object && options->visits)
        json_object_set_new(object, "visits",
                            json_pack("{s:f, s:f}", "nodes", set->nodes, "leaves", set->leaves));
    if (object && options->check)
        json_object_set_new(object, "check",
                            json_pack("{s:o, s:o}", "checked", whole(set->verdict.checked), "wrong",
                                      whole(set->verdict.wrong)));
    return object;
}

static json_t *embree_object(const SceneResult *s, int k)
{
    if (!(s->embree_seconds[k] > 0))
        return json_null();
    return json_pack("{s:f, s:o, s:o}", "build_seconds", s->embree_seconds[k], "bytes",
                     whole((u64)s->embree_bytes[k]), "bytes_peak", whole((u64)s->embree_peak[k]));
}

static json_t *scene_object(const SceneResult *s, const BenchOptions *options)
{
    json_t *sets = json_array();
    for (u32 k = 0; k < s->set_count; k++)
        json_array_append_new(sets, set_object(&s->sets[k], options));
    return json_pack("{s:s, s:o, s:o, s:o, s:o, s:o, s:f, s:f, s:f, s:o, s:o, s:o}", "scene", s->name,
                     "primitives", whole(s->primitives), "instances", whole(s->instances), "nodes",
                     whole(s->nodes), "blocks", whole(s->blocks), "bytes", whole(s->bytes), "build_seconds",
                     s->build_seconds, "layout_seconds", s->layout_seconds, "compile_seconds",
                     s->compile_seconds, "embree_robust", embree_object(s, 0), "embree_fast",
                     embree_object(s, 1), "sets", sets);
}

bool report_json(const SceneResult *scenes, u32 count, const BenchOptions *options, const Setting *setting,
                 Error *error)
{
    json_t *list = json_array();
    for (u32 i = 0; i < count; i++)
        json_array_append_new(list, scene_object(&scenes[i], options));
    json_t *root = json_pack(
        "{s:s, s:s, s:s, s:o, s:o, s:o, s:o}", "schema", "clrt-bench/1", "device", setting->device, "driver",
        setting->driver, "threads", whole(setting->threads), "image_side", whole(options->size), "embree",
        options->embree ? json_string(embree_version()) : json_null(), "scenes", list);
    if (!root)
        return error_set(error, ERROR_MEMORY, "no memory for the report");
    FILE *out = fopen(options->json, "w");
    const bool dumped = out && json_dumpf(root, out, JSON_INDENT(1) | JSON_REAL_PRECISION(9)) == 0;
    json_decref(root);
    const bool closed = out && fclose(out) == 0;
    if (!dumped || !closed)
        return error_set(error, ERROR_IO, "%s: %s", options->json, strerror(errno));
    return true;
}
