// Arguments: the command line of clrt-report.
#ifndef CLRT_REPORT_ARGUMENTS_H
#define CLRT_REPORT_ARGUMENTS_H

#include "base/arena.h"
#include "base/error.h"
#include "base/types.h"

// A way to render that is measured: --math, or a variant.
typedef struct Mode {
    const char *name;
    const char *math;         // "exact", "fast", "double"
    const char *text;         // the options of a variant as given, "" for none
    const char *const *words; // the same as arguments
    u32 word_count;
} Mode;

enum { MODES_MAX = 16, SAMPLE_COUNTS_MAX = 16 };

typedef enum Errand { ERRAND_REPORT, ERRAND_HELP, ERRAND_VERSION } Errand;

typedef struct Arguments {
    Errand errand;
    const char *const *scenes; // of argv
    u32 scene_count;
    const char *clrt;                                 // NULL: beside this program
    const char *out, *device, *against, *ulp, *peers; // all but out NULL where not given
    u32 width, height;                                // 0: the scene's
    u64 pixels_max;                                   // larger pictures are made smaller; 0: no bound
    Mode modes[MODES_MAX];
    u32 mode_count;
    u32 samples[SAMPLE_COUNTS_MAX]; // rising
    u32 sample_count;
    u32 runs, cold_runs;
    u32 reference_samples; // 0: 32 times the most samples, at least 128
    f64 reference_seconds; // a double reference may take about as long as this
    bool features;
    const char *feature_list; // NULL: all
    bool self_test, quick, quiet;
} Arguments;

// Fails with ERROR_USAGE or ERROR_MEMORY. Texts are those of argv or in the arena.
bool arguments_parse(int argc, char **argv, Arena *arena, Arguments *arguments, Error *error);

const char *arguments_usage(void);

#endif
