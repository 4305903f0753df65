#include "measure.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "arithmetic.h"
#include "doc.h"
#include "errors.h"
#include "folder.h"
#include "hash.h"
#include "image/pfm.h"
#include "job.h"
#include "row.h"

enum { FIRST_SEED = 1, REFERENCE_SAMPLES_MIN = 128, REFERENCE_FACTOR = 32 };

void campaign_say(const Campaign *campaign, const char *format, ...)
{
    if (campaign->arguments->quiet)
        return;
    va_list list;
    va_start(list, format);
    fputs("clrt-report: ", stderr);
    vfprintf(stderr, format, list);
    fputc('\n', stderr);
    va_end(list);
}

// ---- what there is to measure ---------------------------------------------------------------

static void fit_size(Job *job, const json_t *stats, u64 pixels_max)
{
    job->width = (u32)doc_number(stats, "width");
    job->height = (u32)doc_number(stats, "height");
    const f64 pixels = (f64)job->width * job->height;
    if (pixels_max == 0 || pixels <= (f64)pixels_max)
        return;
    const f64 factor = sqrt((f64)pixels_max / pixels);
    job->width = (u32)fmax(job->width * factor, 1);
    job->height = (u32)fmax(job->height * factor, 1);
}

// Adds the scene's own samples to those that are asked for, unless they are more.
static void fit_samples(Job *job, u32 own)
{
    const Arguments *arguments = job->campaign->arguments;
    bool placed = false;
    for (u32 i = 0; i < arguments->sample_count; i++) {
        const u32 samples = arguments->samples[i];
        if (!placed && own <= samples) {
            job->own = job->count;
            placed = true;
            if (own < samples)
                job->counts[job->count++] = own;
        }
        job->counts[job->count++] = samples;
    }
    if (!placed)
        job->own = job->count - 1;
}

// Size and samples of the scene. clrt's own words on standard error where it cannot render it at all.
static bool look(Job *job, Error *error)
{
    const Arguments *arguments = job->campaign->arguments;
    Shown shown;
    Shot shot = {.scene = job->scene,
                 .width = arguments->width,
                 .height = arguments->height,
                 .samples = 1,
                 .image = job_temporary(job, "shot.pfm")};
    if (!runner_render(&job->campaign->runner, &shot, &shown, error))
        return false;
    fit_size(job, shown.stats, arguments->pixels_max);
    json_decref(shown.stats);
    shot.samples = 0;
    shot.crop = "0,0,1,1";
    if (!runner_render(&job->campaign->runner, &shot, &shown, error))
        return false;
    const f64 own = doc_number(shown.stats, "rays.camera");
    json_decref(shown.stats);
    fit_samples(job, own >= 1 ? (u32)own : 1);
    return true;
}

// Whether clrt can render in this mode; with that its kernels are in the caches.
static bool try_candidate(Job *job, Candidate *candidate, Error *error)
{
    for (u32 i = 0; i < 2; i++) {
        const Shot shot = job_shot(job, candidate, i ? job->counts[job->own] : 1);
        Shown shown;
        if (!runner_try(&job->campaign->runner, &shot, &shown, error))
            return false;
        candidate->available = shown.status == 0;
        if (!candidate->available) {
            doc_set(candidate->row, "run.unavailable",
                    doc_string(*shown.talk ? shown.talk : "clrt ended in error"));
            campaign_say(job->campaign, "%s: no %s: %s", job->name, candidate->mode->name, shown.talk);
            return shown.status != ERROR_INTERRUPTED || error_set(error, ERROR_INTERRUPTED, "interrupted");
        }
        if (i == 0)
            candidate->seconds_a_sample = doc_number(shown.stats, "seconds.trace");
        json_decref(shown.stats);
    }
    return true;
}

static bool make_candidates(Job *job, json_t *rows, Error *error)
{
    const Arguments *arguments = job->campaign->arguments;
    bool ok = true;
    for (u32 i = 0; i < arguments->mode_count && ok; i++) {
        Candidate *candidate = &job->candidates[job->candidate_count++];
        *candidate = (Candidate){.mode = &arguments->modes[i]};
        candidate->row = row_create(job->name, candidate->mode);
        if (json_array_append_new(rows, candidate->row) != 0)
            return error_set(error, ERROR_MEMORY, "no memory for a row");
        doc_set(candidate->row, "run.file", doc_string(job->scene));
        ok = try_candidate(job, candidate, error) &&
             (series_create(&candidate->cold, job->counts[job->own], arguments->cold_runs,
                            job->campaign->arena) ||
              error_set(error, ERROR_MEMORY, "no memory for a series"));
        for (u32 k = 0; k < job->count && ok; k++)
            ok = series_create(&candidate->warm[k], job->counts[k], arguments->runs, job->campaign->arena) ||
                 error_set(error, ERROR_MEMORY, "no memory for a series");
    }
    return ok;
}

// ---- the converged reference ----------------------------------------------------------------

static u32 reference_samples(const Job *job)
{
    const u32 asked = job->campaign->arguments->reference_samples;
    const u32 most = job->counts[job->count - 1];
    const u64 total = asked ? asked : (u64)most * REFERENCE_FACTOR;
    const u64 enough = asked || total > REFERENCE_SAMPLES_MIN ? total : REFERENCE_SAMPLES_MIN;
    return (u32)((enough + REFERENCE_PARTS - 1) / REFERENCE_PARTS);
}

static bool make_reference(Job *job, Error *error)
{
    const Arguments *arguments = job->campaign->arguments;
    const u32 samples = reference_samples(job);
    const Candidate *most_exact = job_find(job, "double");
    const f64 seconds = most_exact ? most_exact->seconds_a_sample * samples * REFERENCE_PARTS : 0;
    const char *math = most_exact && seconds <= arguments->reference_seconds ? "double" : "exact";
    Shot shot = job_shot(job, NULL, 0);
    shot.math = math;
    shot.scene = arguments->against ? arguments->against : job->scene;
    campaign_say(job->campaign, "%s: reference of %u samples in %s arithmetic", job->name,
                samples * REFERENCE_PARTS, math);
    if (!reference_make(&job->campaign->runner, &shot, samples, &job->reference, error))
        return false;
    job->reference_json = reference_to_json(&job->reference, math, samples);
    const char *mean = text_format(job->campaign->arena, "%s/reference.pfm", job->folder);
    const char *variance = text_format(job->campaign->arena, "%s/reference_variance.pfm", job->folder);
    doc_set(job->reference_json, "scene", doc_string(shot.scene));
    return (mean && variance) ? reference_write(&job->reference, mean, variance, error)
                              : error_set(error, ERROR_MEMORY, "no memory for a name");
}

// ---- times and sampling ---------------------------------------------------------------------

static bool measure_cold(Job *job, Candidate *candidate, Error *error)
{
    Shot shot = job_shot(job, candidate, job->counts[job->own]);
    shot.cold = true;
    Shown shown;
    if (!runner_render(&job->campaign->runner, &shot, &shown, error))
        return false;
    series_add(&candidate->cold, shown.stats, shown.wall_seconds);
    json_decref(shown.stats);
    return true;
}

// The first picture of a row's own samples: its health, its map.
static bool keep_first(Job *job, Candidate *candidate, const Image *image, const json_t *stats, Error *error)
{
    char hash[17];
    snprintf(hash, sizeof hash, "%016llx", (unsigned long long)hash_image(image, 4));
    const Oddities odd = errors_oddities(image);
    row_take_stats(candidate->row, stats);
    doc_set(candidate->row, "health.image_hash", doc_string(hash));
    doc_set(candidate->row, "health.nan_values", doc_whole(odd.nan));
    doc_set(candidate->row, "health.inf_values", doc_whole(odd.inf));
    doc_set(candidate->row, "health.negative_values", doc_whole(odd.negative));
    if (!job->reference.mean)
        return true;
    const char *map = text_format(job->campaign->arena, "%s/%s_rinf.png", job->folder, candidate->mode->name);
    const char *place = text_format(job->campaign->arena, "%s/%s_rinf.png", job->name, candidate->mode->name);
    if (!map || !place)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    doc_set(candidate->row, "files.map_rinf", doc_string(place));
    return errors_draw(job->reference.mean, image, map, error);
}

static bool judge(Job *job, Candidate *candidate, u32 k, const Image *image, Error *error)
{
    Series *series = &candidate->warm[k];
    const u32 run = series->count - 1;
    series->level[run] = errors_level(image);
    if (!job->reference.mean)
        return true;
    Distance distance;
    if (!errors_compare(job->reference.mean, image, run == 0, &distance, error))
        return false;
    series->mse[run] = distance.mse;
    if (run == 0)
        series->first = distance;
    return true;
}

static bool measure_warm(Job *job, Candidate *candidate, u32 k, u32 run, Error *error)
{
    Shot shot = job_shot(job, candidate, job->counts[k]);
    shot.seed_given = true;
    shot.seed = FIRST_SEED + run;
    Shown shown;
    if (!runner_render(&job->campaign->runner, &shot, &shown, error))
        return false;
    series_add(&candidate->warm[k], shown.stats, shown.wall_seconds);
    Image *image = pfm_image_read(shot.image, error);
    const bool ok = image && judge(job, candidate, k, image, error) &&
                    (run > 0 || k != job->own || keep_first(job, candidate, image, shown.stats, error));
    image_destroy(image);
    json_decref(shown.stats);
    return ok;
}

// Modes and samples take turns, so that what else happens on the machine falls on all of them.
static bool measure_runs(Job *job, Error *error)
{
    const Arguments *arguments = job->campaign->arguments;
    bool ok = true;
    for (u32 run = 0; run < arguments->cold_runs && ok; run++) {
        campaign_say(job->campaign, "%s: cold run %u of %u", job->name, run + 1, arguments->cold_runs);
        for (u32 i = 0; i < job->candidate_count && ok; i++)
            ok = !job->candidates[i].available || measure_cold(job, &job->candidates[i], error);
    }
    for (u32 run = 0; run < arguments->runs && ok; run++) {
        campaign_say(job->campaign, "%s: warm run %u of %u", job->name, run + 1, arguments->runs);
        for (u32 k = 0; k < job->count && ok; k++)
            for (u32 i = 0; i < job->candidate_count && ok; i++)
                ok = !job->candidates[i].available || measure_warm(job, &job->candidates[i], k, run, error);
    }
    return ok;
}

// ---- the row --------------------------------------------------------------------------------

static void set_spp(json_t *row, u32 samples)
{
    doc_set(row, "run.spp.min", doc_whole(samples));
    doc_set(row, "run.spp.mean", doc_whole(samples));
    doc_set(row, "run.spp.max", doc_whole(samples));
}

static void finish_row(Job *job, const Candidate *candidate)
{
    json_t *row = candidate->row;
    doc_set(row, "time.cold_runs", doc_whole(candidate->cold.count));
    doc_set(row, "time.warm_runs", doc_whole(candidate->warm[job->own].count));
    doc_set(row, "time.cold", series_times(&candidate->cold));
    doc_set(row, "time.warm", series_times(&candidate->warm[job->own]));
    set_spp(row, job->counts[job->own]);
    for (u32 k = 0; k < job->count; k++)
        json_array_append_new(json_object_get(row, "convergence"),
                              series_point(&candidate->warm[k], &job->reference));
    const json_t *own = json_array_get(json_object_get(row, "convergence"), job->own);
    series_set_rinf(row, own, job->reference_json);
    series_set_efficiency(row, own, candidate->warm, job->count, job->campaign->arena);
    if (json_is_null(doc_at(row, "budget.e_arith")))
        doc_set(row, "budget.e_arith", doc_real(doc_number(row, "error.r64.max_abs")));
    const Candidate *exact = job_find(job, "exact");
    if (exact) {
        doc_set(row, "time.kernel_to_exact",
                series_ratio(&candidate->warm[job->count - 1], &exact->warm[job->count - 1]));
        doc_set(row, "time.kernel_to_exact_spp", doc_whole(job->counts[job->count - 1]));
    }
    const f64 rays = doc_number(row, "rays.total"), seconds = doc_number(row, "time.warm.kernel_s.median");
    doc_set(row, "rays.mrays_per_s", doc_real(rays / seconds * 1e-6));
    doc_set(row, "rays.ns_per_ray", doc_real(seconds / rays * 1e9));
}

// As a display shows it, by the scene's own exposure and tone map.
static bool draw_picture(Job *job, Candidate *candidate, Error *error)
{
    Shot shot = job_shot(job, candidate, job->counts[job->own]);
    shot.image = text_format(job->campaign->arena, "%s/%s.png", job->folder, candidate->mode->name);
    const char *place = text_format(job->campaign->arena, "%s/%s.png", job->name, candidate->mode->name);
    if (!shot.image || !place)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    Shown shown;
    if (!runner_render(&job->campaign->runner, &shot, &shown, error))
        return false;
    row_take_budget(candidate->row, shown.stats);
    json_decref(shown.stats);
    doc_set(candidate->row, "files.picture", doc_string(place));
    return true;
}

static bool measure_all(Job *job, json_t *rows, Error *error)
{
    campaign_say(job->campaign, "%s: first look", job->name);
    if (!look(job, error) || !make_candidates(job, rows, error) || !make_reference(job, error))
        return false;
    for (u32 i = 0; i < job->candidate_count; i++) {
        Candidate *candidate = &job->candidates[i];
        if (candidate->available &&
            (!draw_picture(job, candidate, error) || !arithmetic_measure(job, candidate, error)))
            return false;
    }
    if (!measure_runs(job, error))
        return false;
    for (u32 i = 0; i < job->candidate_count; i++)
        if (job->candidates[i].available)
            finish_row(job, &job->candidates[i]);
    return true;
}

bool measure_scene(Campaign *campaign, const char *scene, const char *name, json_t *rows, Error *error)
{
    Job job = {.campaign = campaign, .scene = scene, .name = name};
    job.folder = text_format(campaign->arena, "%s/%s", campaign->out, name);
    if (!job.folder || !job_temporary(&job, "shot.pfm"))
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    const bool ok = folder_make(job.folder, error) && measure_all(&job, rows, error);
    reference_destroy(&job.reference);
    json_decref(job.reference_json);
    return ok;
}
