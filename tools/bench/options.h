// The command line of clrt-bench.
#ifndef CLRT_BENCH_OPTIONS_H
#define CLRT_BENCH_OPTIONS_H

#include "base/error.h"
#include "embree.h"
#include "rays.h"

enum { SCENES_MAX = 16, ROUNDS_MAX = 64 };

typedef enum Action { ACTION_MEASURE, ACTION_SCALING, ACTION_HELP, ACTION_VERSION } Action;

typedef struct BenchOptions {
    Action action;
    const char *scenes[SCENES_MAX];
    u32 scene_count;
    u32 triangles;        // 0: what each scene has
    bool rays[RAY_KINDS]; // the sets asked for
    u32 size;             // pixels of a side of the image
    u32 rounds;           // 1 .. ROUNDS_MAX
    f64 turn_seconds;     // least length of a contender's turn
    u32 builds;           // of which the median counts
    const char *device;   // as clrt --device; NULL: CLRT_DEVICE, else the default
    u32 threads;          // 0: all
    bool embree, modes[EMBREE_MODES];
    bool robust, fast;    // which scenes of Embree
    bool high;            // RTC_BUILD_QUALITY_HIGH
    bool visits;          // count them, in a second program
    bool check;           // against all primitives
    bool markdown;
    const char *json;     // path, or NULL
    char *scene_list;     // text that scenes point into
} BenchOptions;

// Fails with ERROR_USAGE or ERROR_MEMORY. *options is the caller's to destroy either way.
bool options_parse(int argc, char **argv, BenchOptions *options, Error *error);
void options_destroy(BenchOptions *options);

void options_print_usage(void);

#endif
