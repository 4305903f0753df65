#include "feature_costs.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "doc.h"
#include "feature_scenes.h"
#include "folder.h"
#include "row.h"
#include "statistics.h"

// Large enough that tracing takes a tenth of a second.
enum { WIDTH = 1280, HEIGHT = 960, QUICK_WIDTH = 640, QUICK_HEIGHT = 480, ROUNDS_MIN = 3 };

// A median farther from 0 than this many deviations, by MAD, is more than noise.
static const f64 NOISE_DEVIATIONS = 3, DEVIATION_OF_MAD = 1.4826;

// One scene through all rounds.
typedef struct Trial {
    const char *path; // NULL: there is no such scene
    f64 *ns;          // a ray, of each round
    json_t *stats;    // of the last round
} Trial;

typedef struct Subject {
    size_t feature;
    Trial base, used, unused, unused_base; // without unused_base the base serves
} Subject;

typedef struct Bench {
    Campaign *campaign;
    const char *folder;
    u32 rounds, count;
    Subject *subjects;
} Bench;

static bool write_text(const char *path, const char *text, Error *error)
{
    FILE *file = fopen(path, "wb");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    const bool ok = fputs(text, file) >= 0;
    return (fclose(file) == 0 && ok) || error_set(error, ERROR_IO, "%s: cannot be written", path);
}

// Leaves the trial empty where the feature has no such text.
static bool prepare(const Bench *bench, Trial *trial, size_t feature, FeatureText kind, Error *error)
{
    static const char *const SUFFIXES[] = {"base", "used", "unused", "unused_base"};
    Arena *arena = bench->campaign->arena;
    const char *text = feature_scene_text(feature, kind, arena);
    if (!text)
        return true;
    char *path =
        text_format(arena, "%s/%s_%s.txt", bench->folder, feature_scene_name(feature), SUFFIXES[kind]);
    trial->ns = arena_alloc(arena, bench->rounds, sizeof *trial->ns);
    if (!path || !trial->ns)
        return error_set(error, ERROR_MEMORY, "no memory for scenes of features");
    for (char *c = path + strlen(bench->folder); *c; c++)
        *c = *c == ' ' ? '_' : *c;
    trial->path = path;
    return write_text(path, text, error);
}

// Whether list, of names with commas between them, NULL for all, has the feature; the control always is.
static bool is_wanted(const char *list, size_t feature)
{
    const char *name = feature_scene_name(feature);
    if (!list || feature == 0)
        return true;
    for (const char *at = list; *at; at += strcspn(at, ",") + (at[strcspn(at, ",")] != 0)) {
        const size_t length = strcspn(at, ",");
        if (length == strlen(name) && strncmp(at, name, length) == 0)
            return true;
    }
    return false;
}

static bool names_are_known(const char *list, Error *error)
{
    for (const char *at = list; at && *at; at += strcspn(at, ",") + (at[strcspn(at, ",")] != 0)) {
        const int length = (int)strcspn(at, ",");
        bool known = false;
        for (size_t i = 0; i < FEATURE_SCENE_COUNT; i++)
            known = known || ((size_t)length == strlen(feature_scene_name(i)) &&
                              strncmp(at, feature_scene_name(i), (size_t)length) == 0);
        if (!known)
            return error_set(error, ERROR_USAGE, "--features: there is no feature '%.*s'", length, at);
    }
    return true;
}

static bool prepare_all(Bench *bench, Error *error)
{
    const char *list = bench->campaign->arguments->feature_list;
    Arena *arena = bench->campaign->arena;
    const char *mesh = feature_scene_mesh(arena);
    const char *path = text_format(arena, "%s/%s", bench->folder, FEATURE_MESH_NAME);
    bench->subjects = arena_alloc(arena, FEATURE_SCENE_COUNT, sizeof *bench->subjects);
    if (!mesh || !path || !bench->subjects)
        return error_set(error, ERROR_MEMORY, "no memory for scenes of features");
    bool ok = names_are_known(list, error) && write_text(path, mesh, error);
    for (size_t i = 0; i < FEATURE_SCENE_COUNT && ok; i++) {
        if (!is_wanted(list, i))
            continue;
        Subject *subject = &bench->subjects[bench->count++];
        subject->feature = i;
        ok = prepare(bench, &subject->base, i, FEATURE_BASE, error) &&
             prepare(bench, &subject->used, i, FEATURE_USED, error) &&
             prepare(bench, &subject->unused, i, FEATURE_UNUSED, error) &&
             prepare(bench, &subject->unused_base, i, FEATURE_UNUSED_BASE, error);
    }
    return ok;
}

// round: -1 fills the kernel caches.
static bool run_trial(const Bench *bench, Trial *trial, int round, Error *error)
{
    if (!trial->path)
        return true;
    const bool quick = bench->campaign->arguments->quick;
    const Shot shot = {.scene = trial->path,
                       .width = quick ? QUICK_WIDTH : WIDTH,
                       .height = quick ? QUICK_HEIGHT : HEIGHT,
                       .image = text_format(bench->campaign->arena, "%s/shot.pfm", bench->folder)};
    Shown shown;
    if (!shot.image)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!runner_render(&bench->campaign->runner, &shot, &shown, error))
        return false;
    if (round >= 0)
        trial->ns[round] = doc_number(shown.stats, "seconds.trace") / row_rays(shown.stats) * 1e9;
    json_decref(trial->stats);
    trial->stats = shown.stats;
    return true;
}

static bool run_rounds(Bench *bench, Error *error)
{
    bool ok = true;
    for (int round = -1; round < (int)bench->rounds && ok; round++) {
        campaign_say(bench->campaign, "features: %s %d of %u", round < 0 ? "compile" : "round", round + 1,
                    bench->rounds);
        for (u32 i = 0; i < bench->count && ok; i++) {
            Subject *subject = &bench->subjects[i];
            // The base just before: on a machine with other work the next second is another time.
            ok = run_trial(bench, &subject->base, round, error) &&
                 run_trial(bench, &subject->used, round, error) &&
                 run_trial(bench, &subject->unused_base, round, error) &&
                 run_trial(bench, &subject->unused, round, error);
        }
    }
    return ok;
}

// ---- what came of it ------------------------------------------------------------------------

static json_t *or_null(const json_t *value)
{
    return value ? json_incref((json_t *)(uintptr_t)value) : json_null();
}

static json_t *kernel_hash(const json_t *stats)
{
    return doc_at(stats, "run.kernel_hash");
}

static json_t *trial_to_json(const Trial *trial, const Trial *base, u32 rounds)
{
    f64 added[1000];
    for (u32 i = 0; i < rounds; i++)
        added[i] = trial->ns[i] - base->ns[i];
    return json_pack("{s:o, s:o, s:o, s:o, s:o}", "ns_per_ray", doc_spread(trial->ns, rounds),
                     "added_ns_per_ray", doc_spread(added, rounds), "rays", doc_real(row_rays(trial->stats)),
                     "features", or_null(json_object_get(trial->stats, "features")), "kernel_hash",
                     or_null(kernel_hash(trial->stats)));
}

static json_t *equality(const json_t *a, const json_t *b)
{
    return a && b ? json_boolean(json_equal((json_t *)(uintptr_t)a, (json_t *)(uintptr_t)b)) : json_null();
}

// control: MAD of the differences between two runs of the same scene.
static json_t *unused_to_json(const Trial *trial, const Trial *base, u32 rounds, f64 control)
{
    json_t *object = trial_to_json(trial, base, rounds);
    const f64 added = doc_number(object, "added_ns_per_ray.median"),
              mad = doc_number(object, "added_ns_per_ray.mad");
    const f64 noise = NOISE_DEVIATIONS * DEVIATION_OF_MAD * fmax(mad, control);
    doc_set(object, "within_noise", json_boolean(fabs(added) <= noise));
    doc_set(object, "noise_ns_per_ray", doc_real(noise));
    doc_set(object, "same_features",
            equality(json_object_get(trial->stats, "features"), json_object_get(base->stats, "features")));
    doc_set(object, "same_kernels", equality(kernel_hash(trial->stats), kernel_hash(base->stats)));
    return object;
}

static void append_results(const Bench *bench, json_t *features)
{
    f64 control = 0;
    for (u32 i = 0; i < bench->count; i++) {
        const Subject *subject = &bench->subjects[i];
        const Trial *base = subject->unused_base.path ? &subject->unused_base : &subject->base;
        json_t *used = trial_to_json(&subject->used, &subject->base, bench->rounds);
        if (subject->feature == 0)
            control = doc_number(used, "added_ns_per_ray.mad");
        json_t *unused = subject->unused.path ? unused_to_json(&subject->unused, base, bench->rounds, control)
                                              : json_null();
        json_array_append_new(features, json_pack("{s:s, s:s, s:i, s:o, s:o}", "feature",
                                                  feature_scene_name(subject->feature), "what",
                                                  feature_scene_what(subject->feature), "rounds",
                                                  (int)bench->rounds, "used", used, "unused", unused));
    }
}

bool feature_costs_measure(Campaign *campaign, json_t *features, Error *error)
{
    const u32 runs = campaign->arguments->runs;
    Bench bench = {.campaign = campaign, .rounds = runs < ROUNDS_MIN ? ROUNDS_MIN : runs};
    bench.folder = text_format(campaign->arena, "%s/features", campaign->runner.folder);
    if (!bench.folder)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    const bool ok =
        folder_make(bench.folder, error) && prepare_all(&bench, error) && run_rounds(&bench, error);
    if (ok)
        append_results(&bench, features);
    for (u32 i = 0; i < bench.count; i++) {
        json_decref(bench.subjects[i].base.stats);
        json_decref(bench.subjects[i].used.stats);
        json_decref(bench.subjects[i].unused.stats);
        json_decref(bench.subjects[i].unused_base.stats);
    }
    return ok;
}
