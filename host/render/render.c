#include "render/render.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "base/hash.h"
#include "bundle/bundle.h"
#include "device/buffer.h"
#include "device/program.h"
#include "render/plan.h"

struct Render {
    RenderJob job;
    Layout layout; // the job's, with the features and samples that are asked for; owns nothing
    Plan plan;
    RenderParams params;
    Program *program;
    Kernel *kernel;
    Buffer *scene[LAYOUT_ARRAYS]; // those that the program does not need are NULL
    Buffer *params_buffer, *state_reals, *state_ints, *film, *film_low, *film_m2, *film_clamped,
        *ray_counts;
    f32 *rows;
    f32 *m2; // NULL where there is one sample
    f32 *clamped; // NULL without a limit
    u32 *counts;
    u32 band_top;         // rows of the crop that are complete
    u32 samples_done;     // of the band in hand
    u32 samples_a_launch; // adapted to the time that launches take
    RenderStats stats;
};

size_t render_program_options(FeatureSet features, const DeviceInfo *info, MathMode math, char *text,
                              size_t size)
{
    const DeviceShape shape = plan_device_shape(info, math);
    const bool exact_divide = info->exact_divide && math != MATH_FAST;
    const int head =
        snprintf(text, size, "%s-w -DLANES=%u -DBATCH=%u -DGROUP=%u -DMATH_FAST=%d -DMATH_DOUBLE=%d",
                 exact_divide ? "-cl-fp32-correctly-rounded-divide-sqrt " : "", shape.lanes, shape.batch,
                 shape.group, math == MATH_FAST, math == MATH_DOUBLE);
    const size_t used = (size_t)head;
    return used + features_options(features, used < size ? text + used : NULL, used < size ? size - used : 0);
}

// A buffer of the render itself, bound to the argument of the same name where the kernel has one.
static bool add_buffer(Render *render, Buffer **buffer, const char *name, u64 bytes, Error *error)
{
    if (!kernel_has(render->kernel, name))
        return true;
    *buffer = buffer_create(render->job.device, name, bytes, error);
    return *buffer && kernel_set_buffer(render->kernel, name, *buffer, error);
}

// Puts the arrays of the scene that the kernel wants on the device and binds them.
static bool add_scene(Render *render, Error *error)
{
    Device *device = render->job.device;
    LayoutArray arrays[LAYOUT_ARRAYS];
    layout_arrays(&render->layout, arrays);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++) {
        const LayoutArray *array = &arrays[i];
        if (!kernel_has(render->kernel, array->name))
            continue;
        render->scene[i] = buffer_wrap(device, array->name, array->data, array->bytes, error);
        if (!render->scene[i] || !kernel_set_buffer(render->kernel, array->name, render->scene[i], error))
            return false;
        render->stats.scene_bytes += array->bytes;
    }
    render->stats.scene_bytes += sizeof render->params;
    return add_buffer(render, &render->params_buffer, "params", sizeof render->params, error) &&
           (!render->params_buffer ||
            buffer_upload(render->params_buffer, 0, &render->params, sizeof render->params, error));
}

static bool add_path(Render *render, Error *error)
{
    const PathLayout *path = &render->layout.path;
    return !features_have(render->layout.features, FEATURE_PATH) ||
           (kernel_set_u32(render->kernel, "path_techniques", path->techniques, error) &&
            kernel_set_u32(render->kernel, "path_light_choices", path->light_choices, error) &&
            kernel_set_u32(render->kernel, "path_area_materials", path->area_materials, error) &&
            (!features_have(render->layout.features, FEATURE_ENVIRONMENT_LIGHT) ||
             kernel_set_f32(render->kernel, "environment_floor", path->sky_floor, error)));
}

static bool add_work_buffers(Render *render, Error *error)
{
    const Plan *plan = &render->plan;
    const u64 items = (u64)plan->groups * plan->shape.group;
    render->stats.state_bytes = plan_state_bytes(plan, plan->groups);
    render->stats.film_bytes = plan_film_bytes(plan, plan->band_rows);
    render->stats.band_rows = plan->band_rows;
    render->stats.groups = plan->groups;
    const u64 film = (u64)plan->band_rows * plan->width * 3 * sizeof(f32);
    const u64 m2 = plan->samples ? (u64)plan->band_rows * plan->width * sizeof(f32) : 0;
    const u64 clamped = plan->clamp ? (u64)plan->band_rows * plan->width * 4 * sizeof(f32) : 0;
    const u64 field = TILE_SLOTS * 4;
    render->rows = malloc(film);
    render->m2 = m2 ? malloc(m2) : NULL;
    render->clamped = clamped ? malloc(clamped) : NULL;
    render->counts = malloc(items * plan->ray_kinds * sizeof *render->counts);
    if (!render->rows || !render->counts || (m2 && !render->m2) || (clamped && !render->clamped))
        return error_set(error, ERROR_MEMORY, "no memory for %u rows", plan->band_rows);
    Kernel *kernel = render->kernel;
    const u64 reals = (u64)plan->groups * plan->real_fields * TILE_SLOTS * plan->real_bytes;
    return add_buffer(render, &render->state_reals, "state_reals", reals, error) &&
           add_buffer(render, &render->state_ints, "state_ints", plan->groups * plan->int_fields * field,
                      error) &&
           add_buffer(render, &render->film, "film", film, error) &&
           add_buffer(render, &render->film_low, "film_low", film, error) &&
           add_buffer(render, &render->film_m2, "film_m2", m2, error) &&
           add_buffer(render, &render->film_clamped, "film_clamped", clamped, error) &&
           (!plan->clamp || kernel_set_f32(kernel, "clamp_limit", render->job.clamp, error)) &&
           add_buffer(render, &render->ray_counts, "ray_counts",
                      items * plan->ray_kinds * sizeof *render->counts, error) &&
           add_path(render, error) &&
           kernel_set_u32(kernel, "state_real_fields", plan->real_fields, error) &&
           kernel_set_u32(kernel, "state_int_fields", plan->int_fields, error) &&
           kernel_set_u32(kernel, "pending_reals", plan->pending_reals, error) &&
           kernel_set_local(kernel, "scratch", plan->shape.group * sizeof(u32), error);
}

static void set_params(Render *render)
{
    const RenderJob *job = &render->job;
    render->params = render->layout.params;
    render->params.left = job->left;
    render->params.top = job->top;
    render->params.crop_width = job->width;
    render->params.crop_height = job->height;
    render->params.lights_per_pass = render->plan.lights_per_pass;
    render->params.slots_log2 = render->plan.slots_log2;
    render->params.aov = job->aov;
}

static u64 program_hash(const char *options)
{
    Hash hash = hash_start();
    hash_add(&hash, clrt_kernel_source, clrt_kernel_source_size);
    hash_add(&hash, options, strlen(options));
    return hash_value(&hash);
}

static bool build(Render *render, Error *error)
{
    const RenderJob *job = &render->job;
    static const char only_aov[] = " -DAOV=1";
    char options[2048];
    const size_t length =
        render_program_options(render->layout.features, device_info(job->device), job->math, options,
                               sizeof options);
    if (length + sizeof only_aov > sizeof options)
        return error_set(error, ERROR_DEVICE, "the options of the program are too long");
    if (job->aov != AOV_NONE)
        memcpy(options + length, only_aov, sizeof only_aov);
    render->stats.features = render->layout.features;
    render->stats.program_hash = program_hash(options);
    const f64 start = clock_seconds();
    render->program =
        program_create(job->device, clrt_kernel_source, clrt_kernel_source_size, options, error);
    render->kernel = render->program ? kernel_create(render->program, "render_tiles", error) : NULL;
    render->stats.compile_seconds = clock_seconds() - start;
    return render->kernel != NULL;
}

// Renders samples up to sample_end - 1 of `rows` rows from band_top on. No rows launch an idle group, so that
// the driver generates the code.
static bool launch(Render *render, u32 rows, u32 sample_end, Error *error)
{
    const Plan *plan = &render->plan;
    const u32 tiles = plan_tiles(plan, rows);
    const u32 groups = tiles < 1 ? 1 : tiles < plan->groups ? tiles : plan->groups;
    const u64 items = (u64)groups * plan->shape.group, counts = items * plan->ray_kinds;
    Kernel *kernel = render->kernel;
    if (!kernel_set_u32(kernel, "band_top", render->band_top, error) ||
        !kernel_set_u32(kernel, "band_rows", rows, error) ||
        !kernel_set_u32(kernel, "sample_begin", render->samples_done, error) ||
        !kernel_set_u32(kernel, "sample_end", sample_end, error) ||
        !kernel_launch(kernel, items, plan->shape.group, error) ||
        !buffer_download(render->ray_counts, 0, render->counts, counts * sizeof *render->counts, error))
        return false;
    for (u64 i = 0; i < counts; i++)
        render->stats.rays[i % plan->ray_kinds] += render->counts[i];
    return true;
}

Render *render_create(const RenderJob *job, Error *error)
{
    Render *render = calloc(1, sizeof *render);
    if (!render) {
        error_set(error, ERROR_MEMORY, "no memory for the render");
        return NULL;
    }
    render->job = *job;
    render->layout = *job->layout;
    if (job->clamp > 0)
        render->layout.features |= feature_bit(FEATURE_CLAMP);
    if (job->aov != AOV_NONE)
        aov_reduce(&render->layout, job->aov);
    bool ok = math_mode_check(job->math, device_info(job->device), error) &&
              plan_make(&render->plan, &render->layout, device_info(job->device), job->math, job->width,
                        job->height, job->memory_limit, error);
    if (ok) {
        set_params(render);
        render->samples_a_launch = plan_first_samples(&render->plan); // whole rounds of the slots
        ok = build(render, error) && add_scene(render, error) && add_work_buffers(render, error);
    }
    if (ok) {
        const f64 start = clock_seconds();
        ok = launch(render, 0, 0, error);
        render->stats.compile_seconds += clock_seconds() - start;
    }
    if (!ok) {
        render_destroy(render);
        return NULL;
    }
    return render;
}

void render_destroy(Render *render)
{
    if (!render)
        return;
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        buffer_destroy(render->scene[i]);
    buffer_destroy(render->params_buffer);
    buffer_destroy(render->state_reals);
    buffer_destroy(render->state_ints);
    buffer_destroy(render->film);
    buffer_destroy(render->film_low);
    buffer_destroy(render->film_m2);
    buffer_destroy(render->film_clamped);
    buffer_destroy(render->ray_counts);
    kernel_destroy(render->kernel);
    program_destroy(render->program);
    free(render->rows);
    free(render->m2);
    free(render->clamped);
    free(render->counts);
    free(render);
}

static u32 band_rows_now(const Render *render)
{
    const u32 left = render->job.height - render->band_top;
    return left < render->plan.band_rows ? left : render->plan.band_rows;
}

// Aims at launches of a fifth of a second: short enough to stop between them, long enough to fill the device.
static void adapt_launch(Render *render, u32 samples, f64 seconds)
{
    const f64 wanted = 0.2 * samples / (seconds > 1e-6 ? seconds : 1e-6);
    const f64 most = 4.0 * samples;
    const f64 next = wanted < most ? wanted : most;
    const u32 round = 1u << render->plan.slots_log2;
    render->samples_a_launch = next < round ? round : next > 1e6 ? 1 << 20 : (u32)next / round * round;
}

bool render_step(Render *render, RenderRows *rows, Error *error)
{
    const u32 band = band_rows_now(render), samples = render->params.samples;
    const u32 left = samples - render->samples_done;
    const u32 now = left < render->samples_a_launch ? left : render->samples_a_launch;
    *rows = (RenderRows){ NULL, NULL, NULL, 0 };
    if (render_finished(render))
        return true;
    const f64 start = clock_seconds();
    if (!launch(render, band, render->samples_done + now, error))
        return false;
    const f64 seconds = clock_seconds() - start;
    render->stats.launches++;
    render->stats.trace_seconds += seconds;
    adapt_launch(render, now, seconds);
    render->samples_done += now;
    if (render->samples_done < samples)
        return true;
    if (!buffer_download(render->film, 0, render->rows, (u64)band * render->plan.width * 3 * sizeof(f32),
                         error))
        return false;
    if (render->film_m2 && !buffer_download(render->film_m2, 0, render->m2,
                                            (u64)band * render->plan.width * sizeof(f32), error))
        return false;
    if (render->film_clamped && !buffer_download(render->film_clamped, 0, render->clamped,
                                                 (u64)band * render->plan.width * 4 * sizeof(f32), error))
        return false;
    *rows = (RenderRows){ render->rows, render->m2, render->clamped, band };
    render->band_top += band;
    render->samples_done = 0;
    return true;
}

bool render_restart(Render *render, u32 seed, Error *error)
{
    render->params.seed = seed;
    render->band_top = 0;
    render->samples_done = 0;
    return !render->params_buffer ||
           buffer_upload(render->params_buffer, 0, &render->params, sizeof render->params, error);
}

bool render_finished(const Render *render)
{
    return render->band_top >= render->job.height;
}

f64 render_progress(const Render *render)
{
    const f64 band = render_finished(render) ? 0 : band_rows_now(render);
    const f64 share = (f64)render->samples_done / render->params.samples;
    return (render->band_top + band * share) / render->job.height;
}

const RenderStats *render_stats(const Render *render)
{
    return &render->stats;
}
