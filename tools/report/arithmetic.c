#include "arithmetic.h"

#include <math.h>
#include <string.h>

#include "doc.h"
#include "errors.h"
#include "folder.h"
#include "image/pfm.h"

// Renders and reads; NULL where clrt cannot, with its words in reason.
static Image *render_image(Job *job, const Shot *shot, const char **reason, Error *error)
{
    Shown shown;
    *reason = NULL;
    if (!runner_try(&job->campaign->runner, shot, &shown, error))
        return NULL;
    if (shown.status != 0) {
        *reason = arena_copy_text(job->campaign->arena, shown.talk, strlen(shown.talk));
        return NULL;
    }
    json_decref(shown.stats);
    return pfm_image_read(shot->image, error);
}

// The identities of first hits. clrt writes those of OUT.pfm into OUT.id.pfm.
static Image *render_ids(Job *job, Shot shot, const char **reason, Error *error)
{
    shot.aov = "id";
    shot.samples = 1;
    Image *image = render_image(job, &shot, reason, error);
    if (!image)
        return NULL;
    image_destroy(image);
    const char *path = job_temporary(job, "shot.id.pfm");
    return path ? pfm_image_read(path, error) : NULL;
}

static void set_distance(json_t *into, u32 samples, const Distance *d)
{
    doc_set(into, "spp", doc_whole(samples));
    doc_set(into, "max_ulp", doc_whole(d->max_ulp));
    doc_set(into, "max_abs", doc_real(d->max_abs));
    doc_set(into, "p99_abs", doc_real(d->p99_abs));
    doc_set(into, "rmse", doc_real(d->rmse));
    doc_set(into, "different_values", doc_whole(d->different_values));
    doc_set(into, "values", doc_whole(d->values));
}

// Pixels that show another object, as one sample at their centre tells.
static bool count_other(Job *job, const Candidate *candidate, Error *error)
{
    Shot shot = job_shot(job, candidate, 1);
    const char *reason;
    error->code = ERROR_NONE;
    Image *test = render_ids(job, shot, &reason, error);
    shot.math = "double";
    Image *right = test ? render_ids(job, shot, &reason, error) : NULL;
    u64 pixels = 0;
    const bool ok = right ? errors_count_other(right, test, &pixels, error) : reason != NULL;
    if (right && ok) {
        doc_set(candidate->row, "error.r64.other_object_pixels", doc_whole(pixels));
        doc_set(candidate->row, "error.r64_one_sample.other_object_pixels", doc_whole(pixels));
    }
    image_destroy(right);
    image_destroy(test);
    return ok;
}

// The candidate against the same samples in double.
static bool compare_arithmetic(Job *job, Candidate *candidate, u32 samples, const char *group,
                               const char *map, Error *error)
{
    json_t *into = doc_at(candidate->row, group);
    Shot shot = job_shot(job, candidate, samples);
    const char *reason;
    Image *test = render_image(job, &shot, &reason, error);
    shot.math = "double";
    Image *right = test ? render_image(job, &shot, &reason, error) : NULL;
    Distance distance;
    bool ok = right != NULL;
    if (reason) {
        doc_set(into, "reason", doc_string(reason));
        ok = true;
    } else if (ok) {
        ok = errors_compare(right, test, false, &distance, error) &&
             (!map || errors_draw(right, test, map, error));
        if (ok)
            set_distance(into, samples, &distance);
    }
    image_destroy(right);
    image_destroy(test);
    return ok;
}

bool arithmetic_measure(Job *job, Candidate *candidate, Error *error)
{
    Arena *arena = job->campaign->arena;
    if (!job_find(job, "double") || strcmp(candidate->mode->math, "double") == 0) {
        const char *reason =
            job_find(job, "double") ? "this is double itself" : "there is no mode double to compare with";
        doc_set(candidate->row, "error.r64.reason", doc_string(reason));
        doc_set(candidate->row, "error.r64_one_sample.reason", doc_string(reason));
        return true;
    }
    const char *place = text_format(arena, "%s/%s_r64.png", job->name, candidate->mode->name);
    const char *map = text_format(arena, "%s/%s_r64.png", job->folder, candidate->mode->name);
    if (!place || !map)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!compare_arithmetic(job, candidate, job->counts[job->own], "error.r64", map, error) ||
        !compare_arithmetic(job, candidate, 1, "error.r64_one_sample", NULL, error))
        return false;
    if (isfinite(doc_number(candidate->row, "error.r64.rmse")))
        doc_set(candidate->row, "files.map_r64", doc_string(place));
    return count_other(job, candidate, error);
}
