#include "cli/stats.h"

#include <jansson.h>
#include <math.h>
#include <string.h>
#include <sys/resource.h>

#include "cli/identity_json.h"
#include "cli/json_file.h"
#include "shared/state_fields.h"

static const f64 MIB = 1024.0 * 1024.0;

// In the order of RenderStats.rays. Paths go where mirrors, highlights and matte surfaces send them alike.
enum { RAY_KIND_COUNT = RAYS_KINDS };
static const char *const RAY_KINDS[RAY_KIND_COUNT] = {"camera", "shadow", "mirrored", "transmitted"};
static const char *const PATH_RAY_KINDS[RAY_KIND_COUNT] = {"camera", "shadow", "scattered", "transmitted"};

static const char *const *ray_kinds(const RenderStats *render)
{
    return features_have(render->features, FEATURE_PATH) ? PATH_RAY_KINDS : RAY_KINDS;
}

u64 stats_host_bytes_peak(void)
{
    struct rusage usage;
    return getrusage(RUSAGE_SELF, &usage) == 0 ? (u64)usage.ru_maxrss * 1024 : 0;
}

static u64 ray_count(const RenderStats *render)
{
    u64 count = 0;
    for (u32 i = 0; i < RAY_KIND_COUNT; i++)
        count += render->rays[i];
    return count;
}

// Share of the lanes of waves that had no path; NAN where there are no waves.
static f64 idle_lanes(const RenderStats *render)
{
    const u64 paths = ray_count(render) - render->rays[RAYS_SHADOW];
    return render->rays[RAYS_LANES] > 0 ? 1 - (f64)paths / (f64)render->rays[RAYS_LANES] : NAN;
}

static f64 rays_a_second(const RenderStats *render)
{
    return render->trace_seconds > 0 ? (f64)ray_count(render) / render->trace_seconds : 0;
}

void stats_print(const RunStats *stats, FILE *stream)
{
    const RenderStats *render = stats->render;
    fprintf(stream, "picture   %u x %u on %s\n", stats->width, stats->height, stats->device_name);
    fprintf(stream,
            "time      %.3f s: device %.3f, scene %.3f, meshes %.3f, layout %.3f, compile %.3f, trace %.3f\n",
            stats->total_seconds, stats->device_seconds, stats->parse_seconds, stats->load_seconds,
            stats->layout_seconds, render->compile_seconds, render->trace_seconds);
    fprintf(stream, "rays      %llu, %.2f M/s:", (unsigned long long)ray_count(render),
            rays_a_second(render) * 1e-6);
    for (u32 i = 0; i < RAY_KIND_COUNT; i++)
        fprintf(stream, "%s %s %llu", i ? "," : "", ray_kinds(render)[i], (unsigned long long)render->rays[i]);
    if (render->rays[RAYS_LANES] > 0)
        fprintf(stream, "; idle lanes %.2f %%", 100 * idle_lanes(render));
    fprintf(stream, "\nmemory    device %.1f MiB: scene %.1f, state %.1f, film %.1f; host %.1f MiB\n",
            (f64)stats->device_bytes_peak / MIB, (f64)render->scene_bytes / MIB,
            (f64)render->state_bytes / MIB, (f64)render->film_bytes / MIB,
            (f64)stats_host_bytes_peak() / MIB);
    fprintf(stream, "launches  %u, %u rows a band, %u tiles in flight\nfeatures ", render->launches,
            render->band_rows, render->groups);
    for (u32 i = 0; i < FEATURE_COUNT; i++)
        if (features_have(render->features, (Feature)i))
            fprintf(stream, " %s", feature_name((Feature)i));
    fputs("\nerror budget\n", stream);
    budget_print(stats->budget, "  ", stream);
}

static json_t *rays_to_json(const RenderStats *render)
{
    json_t *rays = json_object();
    for (u32 i = 0; i < RAY_KIND_COUNT; i++)
        json_object_set_new(rays, ray_kinds(render)[i], json_integer((json_int_t)render->rays[i]));
    return rays;
}

static json_t *features_to_json(FeatureSet features)
{
    json_t *names = json_array();
    for (u32 i = 0; i < FEATURE_COUNT; i++)
        if (features_have(features, (Feature)i))
            json_array_append_new(names, json_string(feature_name((Feature)i)));
    return names;
}

static json_t *seconds_to_json(const RunStats *stats)
{
    return json_pack("{s:f, s:f, s:f, s:f, s:f, s:f, s:f}", "total", stats->total_seconds, "device",
                     stats->device_seconds, "scene", stats->parse_seconds, "meshes", stats->load_seconds,
                     "layout", stats->layout_seconds, "compile", stats->render->compile_seconds, "trace",
                     stats->render->trace_seconds);
}

static json_t *bytes_to_json(const RunStats *stats)
{
    const RenderStats *render = stats->render;
    return json_pack("{s:I, s:I, s:I, s:I, s:I}", "device_peak", (json_int_t)stats->device_bytes_peak,
                     "scene", (json_int_t)render->scene_bytes, "state", (json_int_t)render->state_bytes,
                     "film", (json_int_t)render->film_bytes, "host_peak",
                     (json_int_t)stats_host_bytes_peak());
}

static json_t *to_json(const RunStats *stats)
{
    const RenderStats *render = stats->render;
    json_t *name = json_string(stats->device_name); // NULL where it is no UTF-8
    const f64 idle = idle_lanes(render);
    return json_pack("{s:i, s:i, s:o?, s:o, s:o, s:o, s:f, s:o, s:i, s:i, s:i, s:o, s:o, s:o, s:o}", "width",
                     (int)stats->width, "height", (int)stats->height, "device", name, "seconds",
                     seconds_to_json(stats), "bytes", bytes_to_json(stats), "rays", rays_to_json(render),
                     "rays_per_second", rays_a_second(render), "idle_lanes",
                     isnan(idle) ? json_null() : json_real(idle), "launches", (int)render->launches, "band_rows",
                     (int)render->band_rows, "tiles_in_flight", (int)render->groups, "features",
                     features_to_json(render->features), "run",
                     identity_json(stats->identity, render->program_hash), "budget",
                     budget_json(stats->budget), "health", health_json(stats->budget));
}

bool stats_write_json(const RunStats *stats, const char *path, Error *error)
{
    return json_file_write(to_json(stats), path, "the statistics", error);
}
