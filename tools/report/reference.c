#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "doc.h"
#include "errors.h"
#include "folder.h"
#include "hash.h"
#include "image/pfm.h"
#include "output/output.h"

typedef struct Sums {
    f64 *value, *square; // of each value; squares of distances to the mean so far (Welford)
    size_t count;        // of values
} Sums;

static bool start(Reference *reference, Sums *sums, const Image *like, Error *error)
{
    reference->mean = image_create(like->width, like->height, like->channels, error);
    reference->variance =
        reference->mean ? image_create(like->width, like->height, like->channels, error) : NULL;
    if (!reference->variance)
        return false;
    sums->count = (size_t)like->width * like->height * like->channels;
    sums->value = calloc(sums->count, sizeof *sums->value);
    sums->square = calloc(sums->count, sizeof *sums->square);
    return (sums->value && sums->square) || error_set(error, ERROR_MEMORY, "no memory for a reference");
}

// part: counted from 0.
static void take_in(Sums *sums, const Image *image, u32 part)
{
    for (size_t i = 0; i < sums->count; i++) {
        const f64 before = (f64)image->values[i] - sums->value[i];
        sums->value[i] += before / (part + 1);
        sums->square[i] += before * ((f64)image->values[i] - sums->value[i]);
    }
}

static void finish(Reference *reference, const Sums *sums, const f64 *levels)
{
    f64 total = 0;
    for (size_t i = 0; i < sums->count; i++) {
        const f64 variance = sums->square[i] / (REFERENCE_PARTS - 1) / REFERENCE_PARTS;
        total += variance;
        reference->mean->values[i] = (f32)sums->value[i];
        reference->variance->values[i] = (f32)variance;
    }
    reference->standard_error = sqrt(total / (f64)sums->count);
    reference->level = statistics_mean(levels, REFERENCE_PARTS);
}

static bool add_part(Runner *runner, const Shot *shot, u32 part, Reference *reference, Sums *sums, f64 *level,
                     Error *error)
{
    Shown shown;
    if (!runner_render(runner, shot, &shown, error))
        return false;
    json_decref(shown.stats);
    reference->seconds += shown.wall_seconds;
    Image *image = pfm_image_read(shot->image, error);
    if (!image)
        return false;
    const bool ok = part > 0 || start(reference, sums, image, error);
    if (ok)
        take_in(sums, image, part);
    *level = errors_level(image);
    image_destroy(image);
    return ok;
}

bool reference_make(Runner *runner, const Shot *shot, u32 samples, Reference *reference, Error *error)
{
    *reference = (Reference){.standard_error = (f64)NAN};
    Sums sums = {NULL, NULL, 0};
    f64 levels[REFERENCE_PARTS];
    Shot part = *shot;
    part.samples = samples;
    part.seed_given = true;
    part.image = text_format(runner->arena, "%s/reference.pfm", runner->folder);
    bool ok = part.image || error_set(error, ERROR_MEMORY, "no memory for a name");
    for (u32 i = 0; ok && i < REFERENCE_PARTS; i++) {
        part.seed = REFERENCE_SEED + i;
        ok = add_part(runner, &part, i, reference, &sums, &levels[i], error);
    }
    if (ok)
        finish(reference, &sums, levels);
    else
        reference_destroy(reference);
    free(sums.value);
    free(sums.square);
    return ok;
}

bool image_write(const Image *image, const char *path, Error *error)
{
    const OutputOptions options = {.settings.encoding = ENCODING_SRGB, .bits = 8};
    Output *output = output_open(path, &options, image->width, image->height, error);
    if (!output)
        return false;
    if (output_write_rows(output, image->values, image->height, error))
        return output_commit(output, error);
    output_abort(output);
    return false;
}

bool reference_write(const Reference *reference, const char *mean_path, const char *variance_path,
                     Error *error)
{
    return image_write(reference->mean, mean_path, error) &&
           image_write(reference->variance, variance_path, error);
}

json_t *reference_to_json(const Reference *reference, const char *math, u32 samples)
{
    char hash[17] = "";
    if (reference->mean)
        snprintf(hash, sizeof hash, "%016llx", (unsigned long long)hash_image(reference->mean, 4));
    return json_pack("{s:s, s:i, s:i, s:i, s:o, s:o, s:o, s:o}", "math", math, "spp",
                     (int)samples * REFERENCE_PARTS, "parts", REFERENCE_PARTS, "first_seed", REFERENCE_SEED,
                     "standard_error", doc_real(reference->standard_error), "level_standard_error",
                     doc_real(reference->level.standard_error), "seconds", doc_real(reference->seconds),
                     "hash", doc_string(*hash ? hash : NULL));
}

void reference_destroy(Reference *reference)
{
    image_destroy(reference->mean);
    image_destroy(reference->variance);
    reference->mean = reference->variance = NULL;
}
