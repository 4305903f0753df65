// Runner: clrt as a child, once for each picture. It knows clrt's options and the file of its statistics, not
// what is made of them.
#ifndef CLRT_REPORT_RUNNER_H
#define CLRT_REPORT_RUNNER_H

#include <jansson.h>

#include "arguments.h"
#include "base/arena.h"
#include "base/error.h"

typedef struct Runner {
    const char *clrt;
    const char *device; // NULL: clrt's own choice
    const char *folder; // for its files
    Arena *arena;
    u32 cold_count; // of empty caches so far
} Runner;

typedef struct Shot {
    const char *scene;
    const Mode *mode;  // NULL: exact, without further options
    const char *math;  // in place of the mode's; NULL: the mode's
    u32 width, height; // 0: the scene's
    u32 samples;       // 0: the scene's
    bool seed_given;
    u32 seed;
    const char *crop;  // NULL: all
    const char *aov;   // NULL: none
    bool cold;         // kernel caches are empty
    const char *image; // to be written: .pfm or .png
} Shot;

typedef struct Shown {
    f64 wall_seconds; // from process start to its end
    json_t *stats;    // of clrt, the caller's to give up; NULL where it ended with a status other than 0
    int status;
    char talk[1024]; // on standard error
} Shown;

// Renders. False with ERROR_IO where clrt cannot be run or left no statistics, ERROR_MEMORY,
// ERROR_INTERRUPTED; *shown has nothing to give up then.
bool runner_try(Runner *runner, const Shot *shot, Shown *shown, Error *error);

// The same, where a clrt that ends with a status other than 0 is a failure, with that status as its code.
bool runner_render(Runner *runner, const Shot *shot, Shown *shown, Error *error);

// clrt --check; fails as clrt does.
bool runner_check(Runner *runner, const char *scene, Error *error);

// clrt --self-test; its JSON, NULL with an error where there is none.
json_t *runner_self_test(Runner *runner, Error *error);

#endif
