// Options: the command line of clrt-compare.
#ifndef CLRT_COMPARE_OPTIONS_H
#define CLRT_COMPARE_OPTIONS_H

#include "base/error.h"
#include "metrics.h"
#include "pictures.h"

typedef enum Action { ACTION_COMPARE, ACTION_HELP, ACTION_VERSION } Action;

typedef struct Options {
    Action action;
    const char *paths[2];
    Limits limits;
    const char *mask, *map; // NULL: none
    bool has_crop;
    Region crop;
    bool json, quiet;
} Options;

// False with ERROR_USAGE. Strings are those of argv.
bool options_parse(int argc, char **argv, Options *options, Error *error);

const char *options_usage(void);

#endif
