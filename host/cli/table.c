#include "cli/table.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/text.h"
#include "render/aov.h"

enum {
    SIZE_MAX_PIXELS = 65536,
    SAMPLES_MAX = 1048576,
    DEPTH_MAX = 64,
    MEMORY_MAX_MIB = 1 << 24,
    THREADS_MAX = 65536
};

// Reads count whole numbers with the separator between them, and nothing else.
static bool read_wholes(const char *text, char separator, u32 *numbers, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        text = text_read_whole(text, &numbers[i]);
        if (!text || *text != (i + 1 < count ? separator : '\0'))
            return false;
        text++;
    }
    return true;
}

static bool read_within(const char *text, u32 low, u32 high, u32 *number)
{
    return read_wholes(text, '\0', number, 1) && *number >= low && *number <= high;
}

static bool read_real(const char *text, f64 *number)
{
    return text_parse_decimal(text, strlen(text), number) && fabs(*number) <= FLT_MAX;
}

static const char *take_device(Options *options, const char *value)
{
    options->device = value;
    return NULL;
}

static const char *take_list_devices(Options *options, const char *value)
{
    (void)value;
    options->action = ACTION_LIST_DEVICES;
    return NULL;
}

static const char *take_json(Options *options, const char *value)
{
    (void)value;
    options->json = true;
    return NULL;
}

static const char *take_math(Options *options, const char *value)
{
    options->math = math_mode_find(value);
    return options->math < MATH_MODES ? NULL : "exact, fast or double";
}

static const char *take_memory(Options *options, const char *value)
{
    u32 mib;
    if (!read_within(value, 1, MEMORY_MAX_MIB, &mib))
        return "a whole number of MiB from 1 to 16777216";
    options->memory = (u64)mib << 20;
    return NULL;
}

static const char *take_threads(Options *options, const char *value)
{
    return read_within(value, 1, THREADS_MAX, &options->threads) ? NULL : "a whole number from 1 to 65536";
}

static const char *take_size(Options *options, const char *value)
{
    u32 size[2];
    if (!read_wholes(value, 'x', size, 2) || !size[0] || !size[1] || size[0] > SIZE_MAX_PIXELS ||
        size[1] > SIZE_MAX_PIXELS)
        return "WxH, each from 1 to 65536";
    options->size_given = true;
    options->width = size[0];
    options->height = size[1];
    return NULL;
}

static const char *take_samples(Options *options, const char *value)
{
    options->samples_given = true;
    return read_within(value, 1, SAMPLES_MAX, &options->samples) ? NULL : "a whole number from 1 to 1048576";
}

static const char *take_seed(Options *options, const char *value)
{
    options->seed_given = true;
    return read_within(value, 0, UINT32_MAX, &options->seed) ? NULL : "a whole number from 0 to 4294967295";
}

static const char *take_depth(Options *options, const char *value)
{
    options->depth_given = true;
    return read_within(value, 0, DEPTH_MAX, &options->depth) ? NULL : "a whole number from 0 to 64";
}

static const char *take_environment_lighting(Options *options, const char *value)
{
    const bool prefiltered = strcmp(value, "prefiltered") == 0;
    if (!prefiltered && strcmp(value, "sampled") != 0)
        return "sampled or prefiltered";
    options->environment_lighting_given = true;
    options->environment_lighting = prefiltered ? ENVIRONMENT_PREFILTERED : ENVIRONMENT_SAMPLED;
    return NULL;
}

static const char *take_integrator(Options *options, const char *value)
{
    const bool path = strcmp(value, "path") == 0;
    if (!path && strcmp(value, "whitted") != 0)
        return "whitted or path";
    options->integrator_given = true;
    options->integrator = path ? INTEGRATOR_PATH : INTEGRATOR_WHITTED;
    return NULL;
}

static const char *take_sampling(Options *options, const char *value)
{
    static const char *const NAMES[] = {
        [LIGHT_SAMPLING_BOTH] = "both",
        [LIGHT_SAMPLING_LIGHTS] = "lights",
        [LIGHT_SAMPLING_SURFACES] = "surfaces",
    };
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++)
        if (strcmp(value, NAMES[i]) == 0) {
            options->light_sampling = (LightSampling)i;
            return NULL;
        }
    return "both, lights or surfaces";
}

static const char *take_clamp(Options *options, const char *value)
{
    f64 limit;
    if (!read_real(value, &limit) || !(limit >= (f64)FLT_MIN))
        return "a radiance above 0";
    options->clamp = (f32)limit;
    return NULL;
}

static const char *take_crop(Options *options, const char *value)
{
    u32 crop[4];
    if (!read_wholes(value, ',', crop, 4) || crop[0] >= SIZE_MAX_PIXELS || crop[1] >= SIZE_MAX_PIXELS ||
        !crop[2] || !crop[3] || crop[2] > SIZE_MAX_PIXELS || crop[3] > SIZE_MAX_PIXELS)
        return "X,Y,W,H in pixels, W and H from 1 to 65536";
    options->crop_given = true;
    options->crop_x = crop[0];
    options->crop_y = crop[1];
    options->crop_width = crop[2];
    options->crop_height = crop[3];
    return NULL;
}

static const char *take_bits(Options *options, const char *value)
{
    options->bits_given = true;
    const bool read = read_within(value, 8, 16, &options->bits);
    return read && (options->bits == 8 || options->bits == 16) ? NULL : "8 or 16";
}

static const char *take_exposure(Options *options, const char *value)
{
    options->exposure_given = true;
    return read_real(value, &options->exposure) ? NULL : "a number of stops";
}

static const char *take_tone_map(Options *options, const char *value)
{
    static const char *const NAMES[] = {
        [TONE_MAP_NONE] = "none",
        [TONE_MAP_REINHARD] = "reinhard",
        [TONE_MAP_ACES] = "aces",
        [TONE_MAP_HABLE] = "hable",
    };
    static const char WITH_WHITE[] = "reinhard_extended,";
    const size_t length = strlen(WITH_WHITE);
    options->tone_map_given = true;
    for (size_t i = 0; i < sizeof NAMES / sizeof NAMES[0]; i++)
        if (NAMES[i] && strcmp(value, NAMES[i]) == 0) {
            options->tone_map = (ToneMap)i;
            return NULL;
        }
    if (strncmp(value, WITH_WHITE, length) == 0 && read_real(value + length, &options->white) &&
        options->white > 0) {
        options->tone_map = TONE_MAP_REINHARD_EXTENDED;
        return NULL;
    }
    return "none, reinhard, reinhard_extended,WHITE (above 0), aces or hable";
}

static const char *take_aov(Options *options, const char *value)
{
    for (const char *name = value;; name++) {
        const size_t length = strcspn(name, ",");
        const u32 aov = aov_find(name, length);
        if (aov == AOV_NONE)
            return "a list of depth, normal, position, albedo, id, with commas between";
        options->aovs |= 1u << aov;
        name += length;
        if (!*name)
            return NULL;
    }
}

static const char *take_check(Options *options, const char *value)
{
    (void)value;
    options->action = ACTION_CHECK;
    return NULL;
}

static const char *take_stats(Options *options, const char *value)
{
    options->stats = true;
    options->stats_file = value;
    return value && !*value ? "a file's name" : NULL;
}

static const char *take_force_device(Options *options, const char *value)
{
    (void)value;
    options->force_device = true;
    return NULL;
}

static const char *take_self_test(Options *options, const char *value)
{
    options->action = ACTION_SELF_TEST;
    options->self_test_file = value;
    return value && !*value ? "a file's name" : NULL;
}

static const char *take_quiet(Options *options, const char *value)
{
    (void)value;
    options->quiet = true;
    return NULL;
}

static const char *take_verbose(Options *options, const char *value)
{
    (void)value;
    options->verbose++;
    return NULL;
}

static const char *take_help(Options *options, const char *value)
{
    (void)value;
    options->action = ACTION_HELP;
    return NULL;
}

static const char *take_version(Options *options, const char *value)
{
    (void)value;
    options->action = ACTION_VERSION;
    return NULL;
}

const Option OPTIONS[] = {
    {'d', "device", VALUE_REQUIRED, "SPEC", GROUP_DEVICE,
     "cpu, gpu, N or P:D of the list, or part of a name [$CLRT_DEVICE, else a GPU, else a CPU]", take_device},
    {'l', "list-devices", VALUE_NONE, NULL, GROUP_DEVICE, "list the OpenCL devices", take_list_devices},
    {0, "json", VALUE_NONE, NULL, GROUP_DEVICE, "with --list-devices: as JSON", take_json},
    {0, "self-test", VALUE_OPTIONAL, "FILE.json", GROUP_DEVICE,
     "numerical hard cases on the device: a table, or into the file", take_self_test},
    {0, "force-device", VALUE_NONE, NULL, GROUP_DEVICE, "render also on a device that gives wrong answers",
     take_force_device},
    {0, "math", VALUE_REQUIRED, "NAME", GROUP_DEVICE,
     "exact: the same bytes on every device; fast: the device's own functions; double [exact]", take_math},
    {0, "memory", VALUE_REQUIRED, "MIB", GROUP_DEVICE, "bound of device memory in MiB [the device's]",
     take_memory},
    {0, "threads", VALUE_REQUIRED, "N", GROUP_DEVICE,
     "bound of the threads of a CPU device and of the host [all]", take_threads},
    {'s', "size", VALUE_REQUIRED, "WxH", GROUP_IMAGE, "width and height in pixels", take_size},
    {'n', "samples", VALUE_REQUIRED, "N", GROUP_IMAGE, "samples a pixel, 1 to 1048576", take_samples},
    {0, "seed", VALUE_REQUIRED, "N", GROUP_IMAGE, "seed of all random choices", take_seed},
    {0, "depth", VALUE_REQUIRED, "N", GROUP_IMAGE, "largest depth of a ray, 0 to 64", take_depth},
    {0, "environment-lighting", VALUE_REQUIRED, "HOW", GROUP_IMAGE,
     "light of the environment on pbr materials: sampled or prefiltered", take_environment_lighting},
    {0, "integrator", VALUE_REQUIRED, "NAME", GROUP_IMAGE, "whitted or path", take_integrator},
    {0, "sampling", VALUE_REQUIRED, "HOW", GROUP_IMAGE,
     "where paths look for area lights and the sky: both, lights or surfaces [both]", take_sampling},
    {0, "clamp", VALUE_REQUIRED, "X", GROUP_IMAGE,
     "limit of the brightest channel of each sample: fewer fireflies, biased [none]", take_clamp},
    {0, "crop", VALUE_REQUIRED, "X,Y,W,H", GROUP_IMAGE, "only these pixels, as an image of W x H [all]",
     take_crop},
    {0, "bits", VALUE_REQUIRED, "8|16", GROUP_OUTPUT, "bits of a channel of a PNG [8]", take_bits},
    {0, "exposure", VALUE_REQUIRED, "EV", GROUP_OUTPUT, "stops [the scene's]", take_exposure},
    {0, "tone-map", VALUE_REQUIRED, "NAME", GROUP_OUTPUT,
     "none, reinhard, reinhard_extended,WHITE, aces, hable [the scene's]", take_tone_map},
    {0, "aov", VALUE_REQUIRED, "LIST", GROUP_OUTPUT,
     "also depth, normal, position, albedo, id of first hits: for OUT x.png in x.NAME.pfm", take_aov},
    {0, "check", VALUE_NONE, NULL, GROUP_RUN, "read and check SCENE and its meshes only; needs no device", take_check},
    {0, "stats", VALUE_OPTIONAL, "FILE.json", GROUP_RUN, "times, rays, memory, features and the error budget: on stderr, or as JSON into the file",
     take_stats},
    {'q', "quiet", VALUE_NONE, NULL, GROUP_RUN, "errors only", take_quiet},
    {'v', "verbose", VALUE_NONE, NULL, GROUP_RUN, "say what is done", take_verbose},
    {'h', "help", VALUE_NONE, NULL, GROUP_RUN, "show this text", take_help},
    {0, "version", VALUE_NONE, NULL, GROUP_RUN, "show the version", take_version},
    {0, "error", VALUE_REQUIRED, NULL, GROUP_LATER, NULL, NULL},
    {0, "confidence", VALUE_REQUIRED, NULL, GROUP_LATER, NULL, NULL},
    {0, "time", VALUE_REQUIRED, NULL, GROUP_LATER, NULL, NULL},
    {0, "part", VALUE_REQUIRED, NULL, GROUP_LATER, NULL, NULL},
    {0, "resume", VALUE_NONE, NULL, GROUP_LATER, NULL, NULL},
};

const size_t OPTION_COUNT = sizeof OPTIONS / sizeof OPTIONS[0];
