// Options: what the command line asks for. Knows the words and ranges, not what they do.
#ifndef CLRT_CLI_OPTIONS_H
#define CLRT_CLI_OPTIONS_H

#include <stdio.h>

#include "base/error.h"
#include "base/types.h"
#include "render/math_mode.h"
#include "scene/scene.h"

typedef enum Action {
    ACTION_RENDER,
    ACTION_CHECK,
    ACTION_LIST_DEVICES,
    ACTION_SELF_TEST,
    ACTION_HELP,
    ACTION_VERSION
} Action;

typedef struct Options {
    Action action;
    const char *scene; // "-": standard input
    const char *out;   // "-": standard output; NULL with ACTION_CHECK where it is not given
    const char *device; // as written, NULL: not given
    bool json;
    bool quiet;
    u32 verbose; // how often -v is given
    // Overrides of the scene; each has effect where it is given.
    bool size_given, samples_given, seed_given, depth_given, crop_given, exposure_given, tone_map_given;
    u32 width, height; // 1..65536
    u32 samples;       // 1..1048576
    u32 seed;
    u32 depth;                        // 0..64
    bool environment_lighting_given;
    EnvironmentLighting environment_lighting;
    bool integrator_given;
    Integrator integrator;
    LightSampling light_sampling;     // LIGHT_SAMPLING_BOTH: also where it is not given
    f32 clamp;                        // radiance, above 0; 0: not given
    u32 crop_x, crop_y;               // 0..65535
    u32 crop_width, crop_height;      // 1..65536
    f64 exposure;                     // stops
    ToneMap tone_map;
    f64 white;                        // with TONE_MAP_REINHARD_EXTENDED
    u32 bits;                         // 8 or 16
    bool bits_given;
    u32 aovs;   // bit AOV_X for each that is asked for
    MathMode math;
    u64 memory; // bytes, 0: not given
    u32 threads; // 0: not given
    bool stats;
    const char *stats_file; // NULL: on standard error, as text
    bool force_device; // whatever known answers it gives
    const char *self_test_file; // NULL: on standard output, as text
} Options;

// Reads the arguments. Fails with ERROR_USAGE and a line for each mistake. Texts in *options are those of
// argv. --help and --version go before every other mistake that follows them.
bool options_parse(int argc, char **argv, Options *options, Error *error);

// Puts the overrides into the scene; fails with ERROR_USAGE where the crop is not within the image.
bool options_override(const Options *options, Scene *scene, Error *error);

// What --help says.
void options_print_usage(FILE *stream);

#endif
