#include "cli/identity.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

static const char *const SAMPLINGS[] = {"both", "lights", "surfaces"};
static const char *const TONE_MAPS[] = {"none", "reinhard", "reinhard_extended", "aces", "hable"};

const char *identity_base_name(const char *path)
{
    const char *slash = strrchr(path, '/');
    return slash ? slash + 1 : path;
}

// printf to the end of the text under way.
static void write_text(IdentityTexts *texts, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

static void write_text(IdentityTexts *texts, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    const size_t room = sizeof texts->room - texts->used;
    const int length = vsnprintf(texts->room + texts->used, room, format, arguments);
    va_end(arguments);
    texts->used += length < 0 ? 0 : (size_t)length < room ? (size_t)length : room - 1;
}

static void start_text(IdentityTexts *texts, const char *key)
{
    if (texts->count > 0 && texts->used + 1 < sizeof texts->room)
        texts->used++; // past the end of the text before
    texts->room[texts->used] = '\0';
    texts->texts[texts->count++] = (OutputText){key, texts->room + texts->used};
}

static void add_text(IdentityTexts *texts, const char *key, const char *text)
{
    start_text(texts, key);
    write_text(texts, "%s", text);
}

static void add_hash(IdentityTexts *texts, const char *key, u64 hash)
{
    start_text(texts, key);
    write_text(texts, "%016llx", (unsigned long long)hash);
}

// As on the command line: `clrt OPTIONS Source OUT` makes the same pixels.
static void add_options(IdentityTexts *texts, const Identity *identity)
{
    const Scene *scene = identity->scene;
    start_text(texts, "clrt:options");
    write_text(texts, "--size %ux%u --samples %u --seed %u --depth %u", scene->image.width,
               scene->image.height, scene->image.samples, scene->image.seed, scene->render.max_depth);
    if (scene->environment.present)
        write_text(texts, " --environment-lighting %s",
                   scene->render.environment_lighting == ENVIRONMENT_PREFILTERED ? "prefiltered" : "sampled");
    const bool path = scene->render.integrator == INTEGRATOR_PATH;
    write_text(texts, " --integrator %s", path ? "path" : "whitted");
    if (path)
        write_text(texts, " --sampling %s", SAMPLINGS[scene->render.light_sampling]);
    if (identity->clamp > 0)
        write_text(texts, " --clamp %.9g", (f64)identity->clamp);
    if (identity->cropped)
        write_text(texts, " --crop %u,%u,%u,%u", identity->left, identity->top, identity->width,
                   identity->height);
    write_text(texts, " --exposure %.17g --tone-map %s", scene->output.exposure,
               TONE_MAPS[scene->output.tone_map]);
    if (scene->output.tone_map == TONE_MAP_REINHARD_EXTENDED)
        write_text(texts, ",%.17g", scene->output.white);
    write_text(texts, " --bits %u --math %s", identity->bits, identity->math);
}

void identity_texts(const Identity *identity, IdentityTexts *texts)
{
    texts->count = texts->used = 0;
    add_text(texts, "Software", "clrt " CLRT_VERSION);
    add_text(texts, "Source", identity->scene_name);
    add_hash(texts, "clrt:scene-hash", identity->scene_hash);
    add_options(texts, identity);
    add_text(texts, "clrt:device", identity->device->name);
    add_text(texts, "clrt:platform", identity->device->platform_name);
    add_text(texts, "clrt:driver", identity->device->driver);
}

void identity_closing_texts(FeatureSet features, u64 program_hash, const ErrorBudget *budget,
                            IdentityTexts *texts)
{
    texts->count = texts->used = 0;
    start_text(texts, "clrt:features");
    const char *between = "";
    for (u32 i = 0; i < FEATURE_COUNT; i++)
        if (features_have(features, (Feature)i)) {
            write_text(texts, "%s%s", between, feature_name((Feature)i));
            between = " ";
        }
    add_hash(texts, "clrt:program-hash", program_hash);
    char summary[1024];
    budget_summary(budget, summary, sizeof summary);
    add_text(texts, "clrt:error-budget", summary);
}
