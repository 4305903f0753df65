// Options: the command line of clrt-compare.
#ifndef CLRT_COMPARE_OPTIONS_H
#define CLRT_COMPARE_OPTIONS_H

#include "base/error.h"
#include "maps.h"
#include "metrics.h"
#include "pictures.h"

typedef enum Action { ACTION_COMPARE, ACTION_HELP, ACTION_VERSION } Action;

typedef struct Options {
    Action action;
    Sources sources; // its crop is &crop or NULL
    Region crop;
    Limits limits;
    const char *maps[MAP_COUNT]; // NULL: none
    bool json, quiet;
} Options;

// False with ERROR_USAGE. Strings are those of argv, and *options must stay where it is.
bool options_parse(int argc, char **argv, Options *options, Error *error);

const char *options_usage(void);

#endif
