#include "picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "assets/assets.h"
#include "assets/fingerprint.h"
#include "base/clock.h"
#include "budget/budget.h"
#include "cli/devices.h"
#include "cli/identity.h"
#include "cli/progress.h"
#include "cli/stats.h"
#include "device/device.h"
#include "layout/layout.h"
#include "output/output.h"
#include "render/render.h"
#include "scene/effect.h"
#include "scene/parse.h"
#include "selftest/trust.h"

// What lives as long as the run.
typedef struct Picture {
    const Options *options;
    Interrupt *interrupt;
    u32 left, top, width, height; // the crop
    Arena *arena;
    Diagnostics *diagnostics;
    DeviceList *devices;
    u32 device_index; // the chosen one of them
    Scene *scene;
    Layout *layout;
    Device *device;
    Output *output;
    f64 start; // seconds of a monotonic clock
    Identity identity;
    SceneBounds bounds;
    BudgetPool pool;
    ErrorBudget budget;
    RunStats stats;
} Picture;

static bool choose_device(Picture *picture, Error *error)
{
    const f64 start = clock_seconds();
    picture->devices = device_list_create(error);
    picture->stats.device_seconds = clock_seconds() - start;
    return picture->devices &&
           devices_choose(picture->devices, picture->options->device, &picture->device_index, error) &&
           math_mode_check(picture->options->math, &picture->devices->devices[picture->device_index], error);
}

// Prints what there is to say about the scene; false where that is an error.
static bool judge_scene(const Picture *picture, Error *error)
{
    const u32 errors = diagnostics_error_count(picture->diagnostics);
    if (errors > 0 || !picture->options->quiet)
        diagnostics_print(picture->diagnostics, stderr);
    if (errors > 0)
        return error_set(error, ERROR_SCENE, "%s: %u error%s", picture->options->scene, errors,
                         errors > 1 ? "s" : "");
    return true;
}

// Reads what the scene names, unless it has errors already.
static bool load_assets(Picture *picture, Error *error)
{
    const f64 start = clock_seconds();
    const bool ok = diagnostics_error_count(picture->diagnostics) > 0 ||
                    assets_load(picture->scene, picture->arena, picture->diagnostics, error);
    picture->stats.load_seconds = clock_seconds() - start;
    return ok;
}

static bool load_scene(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    const f64 start = clock_seconds();
    picture->arena = arena_create();
    picture->diagnostics = diagnostics_create();
    if (!picture->arena || !picture->diagnostics)
        return error_set(error, ERROR_MEMORY, "no memory for the scene");
    picture->scene = scene_parse_file(options->scene, picture->arena, picture->diagnostics, error);
    if (!picture->scene)
        return false;
    const bool sound = diagnostics_error_count(picture->diagnostics) == 0;
    if (sound && !options_override(options, picture->scene, error))
        return false;
    if (sound)
        scene_check_effect(picture->scene, picture->diagnostics);
    picture->stats.parse_seconds = clock_seconds() - start;
    return load_assets(picture, error) && judge_scene(picture, error);
}

static bool lay_out(Picture *picture, Error *error)
{
    const f64 start = clock_seconds();
    picture->layout = layout_create(picture->scene, error);
    if (picture->layout)
        picture->bounds = scene_bounds(picture->scene, picture->layout);
    assets_release(picture->scene); // the layout has what it needs of the meshes
    picture->stats.layout_seconds = clock_seconds() - start;
    return picture->layout != NULL;
}

// The first time that a device is used it is asked for known answers.
static bool try_device(Picture *picture, Error *error)
{
    const f64 start = clock_seconds();
    bool asked;
    const bool ok = trust_device(picture->device, &asked, error);
    const f64 seconds = clock_seconds() - start;
    picture->stats.device_seconds += seconds;
    if (ok && asked && picture->options->verbose)
        fprintf(stderr, "clrt: first use of this device, known answers in %.2f s\n", seconds);
    return ok;
}

static bool open_device(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    const f64 start = clock_seconds();
    const DeviceOptions how = {.threads = options->threads};
    picture->device = device_open(&picture->devices->devices[picture->device_index], &how, error);
    picture->stats.device_seconds += clock_seconds() - start;
    if (picture->device && options->verbose)
        fprintf(stderr, "clrt: device %s\n", device_info(picture->device)->name);
    return picture->device && (options->force_device || try_device(picture, error));
}

// What is written of the image beside its pixels. The fingerprint takes a while where meshes are large.
static bool identify(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    picture->identity = (Identity){
        .scene_name = identity_base_name(options->scene),
        .scene = picture->scene,
        .device = &picture->devices->devices[picture->device_index],
        .math = math_mode_name(options->math),
        .bits = options->bits,
        .clamp = options->clamp,
        .cropped = options->crop_given,
        .left = picture->left,
        .top = picture->top,
        .width = picture->width,
        .height = picture->height,
    };
    const bool wanted = options->stats || output_takes_texts(options->out);
    return !wanted || scene_fingerprint(picture->scene, &picture->identity.scene_hash, error);
}

static bool open_output(Picture *picture, Error *error)
{
    const Options *options = picture->options;
    const ImageSettings *image = &picture->scene->image;
    const OutputSettings *settings = &picture->scene->output;
    picture->left = options->crop_given ? options->crop_x : 0;
    picture->top = options->crop_given ? options->crop_y : 0;
    picture->width = options->crop_given ? options->crop_width : image->width;
    picture->height = options->crop_given ? options->crop_height : image->height;
    if (!options->quiet && output_ignores_display_settings(options->out) &&
        (settings->exposure_given || settings->tone_map_given || options->bits_given))
        fprintf(stderr, "clrt: %s takes the radiance alone; exposure, tone map and bits have no effect\n",
                options->out);
    if (!identify(picture, error))
        return false;
    IdentityTexts texts;
    identity_texts(&picture->identity, &texts);
    const OutputOptions format = {
        .settings = *settings, .bits = options->bits, .texts = texts.texts, .text_count = texts.count};
    picture->output = output_open(options->out, &format, picture->width, picture->height, error);
    if (picture->output)
        interrupt_set_temporary(picture->interrupt, output_temporary_path(picture->output));
    return picture->output != NULL;
}

static u64 ray_count(const RenderStats *stats)
{
    return stats->rays[0] + stats->rays[1] + stats->rays[2] + stats->rays[3];
}

static bool take_rows(Picture *picture, const RenderRows *rows, Error *error)
{
    const size_t width = picture->width;
    for (u32 y = 0; y < rows->count; y++) {
        budget_pool_add_row(&picture->pool, rows->rgb + 3 * width * y, rows->m2 ? rows->m2 + width * y : NULL,
                            picture->width);
        budget_pool_add_clamped(&picture->pool, rows->clamped ? rows->clamped + 4 * width * y : NULL,
                                picture->width);
    }
    return rows->count == 0 || output_write_rows(picture->output, rows->rgb, rows->count, error);
}

static bool write_rows(Picture *picture, Render *render, Error *error)
{
    Progress progress = progress_start(stderr, picture->options->quiet);
    bool ok = true;
    while (ok && !render_finished(render)) {
        RenderRows rows;
        ok = render_step(render, &rows, error) && take_rows(picture, &rows, error);
        if (ok && interrupt_requested(picture->interrupt))
            ok = error_set(error, ERROR_INTERRUPTED, "interrupted");
        progress_update(&progress, render_progress(render), ray_count(render_stats(render)));
    }
    progress_end(&progress);
    return ok;
}

static bool state_error(Picture *picture, const Render *render, Error *error)
{
    const bool floats = output_ignores_display_settings(picture->options->out);
    picture->budget = budget_make(picture->scene, &picture->bounds, &picture->pool, picture->options->clamp,
                                  floats ? 0 : picture->options->bits, NAN);
    IdentityTexts texts;
    const RenderStats *stats = render_stats(render);
    identity_closing_texts(stats->features, stats->program_hash, &picture->budget, &texts);
    return output_add_texts(picture->output, texts.texts, texts.count, error);
}

static bool close_output(Picture *picture, Error *error)
{
    Output *output = picture->output;
    picture->output = NULL;
    const bool ok = output_commit(output, error);
    interrupt_set_temporary(picture->interrupt, NULL);
    return ok;
}

static bool report(Picture *picture, const Render *render, Error *error)
{
    RunStats *stats = &picture->stats;
    if (!picture->options->stats)
        return true;
    stats->total_seconds = clock_seconds() - picture->start;
    stats->width = picture->width;
    stats->height = picture->height;
    stats->device_name = device_info(picture->device)->name;
    stats->device_bytes_peak = device_bytes_peak(picture->device);
    stats->render = render_stats(render);
    stats->identity = &picture->identity;
    stats->budget = &picture->budget;
    if (picture->options->stats_file)
        return stats_write_json(stats, picture->options->stats_file, error);
    stats_print(stats, stderr);
    return true;
}

static RenderJob render_job(const Picture *picture)
{
    return (RenderJob){
        .layout = picture->layout,
        .device = picture->device,
        .left = picture->left,
        .top = picture->top,
        .width = picture->width,
        .height = picture->height,
        .memory_limit = picture->options->memory,
        .math = picture->options->math,
        .clamp = picture->options->clamp,
    };
}

static bool render_picture(Picture *picture, Error *error)
{
    const RenderJob job = render_job(picture);
    Render *render = render_create(&job, error);
    const bool ok = render && write_rows(picture, render, error) && state_error(picture, render, error) &&
                    close_output(picture, error) && report(picture, render, error);
    render_destroy(render);
    return ok;
}

// Positions leave render space, whose origin is the camera.
static void place_rows(const Picture *picture, f32 *rgb, u64 pixels)
{
    const Vec3 origin = picture->scene->camera.position;
    for (u64 i = 0; i < pixels; i++) {
        rgb[3 * i] = (f32)(rgb[3 * i] + origin.x);
        rgb[3 * i + 1] = (f32)(rgb[3 * i + 1] + origin.y);
        rgb[3 * i + 2] = (f32)(rgb[3 * i + 2] + origin.z);
    }
}

// OUT without its suffix, then the name of the property.
static bool aov_path(const Picture *picture, u32 aov, char *path, size_t size, Error *error)
{
    const char *out = picture->options->out, *folder = strrchr(out, '/'), *suffix = strrchr(out, '.');
    const bool named = suffix && suffix > (folder ? folder + 1 : out);
    const int length = snprintf(path, size, "%.*s.%s.pfm", named ? (int)(suffix - out) : (int)strlen(out), out,
                                aov_name(aov));
    return (length >= 0 && (size_t)length < size) || error_set(error, ERROR_IO, "%s: the name is too long", out);
}

static bool render_aov(Picture *picture, u32 aov, Error *error)
{
    char path[4096];
    const OutputOptions format = {.settings = picture->scene->output, .bits = picture->options->bits};
    if (!aov_path(picture, aov, path, sizeof path, error))
        return false;
    picture->output = output_open(path, &format, picture->width, picture->height, error);
    if (!picture->output)
        return false;
    interrupt_set_temporary(picture->interrupt, output_temporary_path(picture->output));
    RenderJob job = render_job(picture);
    job.aov = aov;
    Render *render = render_create(&job, error);
    bool ok = render != NULL;
    while (ok && !render_finished(render)) {
        RenderRows rows;
        ok = render_step(render, &rows, error);
        if (ok && aov == AOV_POSITION)
            place_rows(picture, rows.rgb, (u64)rows.count * picture->width);
        ok = ok && (rows.count == 0 || output_write_rows(picture->output, rows.rgb, rows.count, error));
        if (ok && interrupt_requested(picture->interrupt))
            ok = error_set(error, ERROR_INTERRUPTED, "interrupted");
    }
    render_destroy(render);
    return ok && close_output(picture, error);
}

static bool render_aovs(Picture *picture, Error *error)
{
    bool ok = true;
    for (u32 aov = AOV_NONE + 1; ok && aov < AOV_COUNT; aov++)
        if (picture->options->aovs >> aov & 1)
            ok = render_aov(picture, aov, error);
    return ok;
}

bool picture_make(const Options *options, Interrupt *interrupt, Error *error)
{
    Picture picture = {.options = options, .interrupt = interrupt, .start = clock_seconds()};
    const bool check = options->action == ACTION_CHECK;
    bool ok = (check || choose_device(&picture, error)) && load_scene(&picture, error);
    if (ok && !check)
        ok = open_output(&picture, error) && lay_out(&picture, error) && open_device(&picture, error) &&
             render_picture(&picture, error) && render_aovs(&picture, error);
    output_abort(picture.output);
    interrupt_set_temporary(interrupt, NULL);
    device_close(picture.device);
    layout_destroy(picture.layout);
    assets_release(picture.scene);
    device_list_destroy(picture.devices);
    diagnostics_destroy(picture.diagnostics);
    arena_destroy(picture.arena);
    return ok;
}
