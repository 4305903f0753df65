// Options: the command line of clrt-ulp.
#ifndef CLRT_ULP_OPTIONS_H
#define CLRT_ULP_OPTIONS_H

#include "base/error.h"
#include "base/types.h"

typedef enum UlpAction { ULP_MEASURE, ULP_HELP, ULP_VERSION } UlpAction;

typedef struct UlpOptions {
    UlpAction action;
    u64 rays;           // a shape; at least 1
    const char *device; // NULL: not named
    const char *shape;  // NULL: all
    const char *json;   // path; NULL: none
} UlpOptions;

// False with ERROR_USAGE. Strings are those of argv.
bool ulp_options_parse(int argc, char **argv, UlpOptions *options, Error *error);

const char *ulp_options_usage(void);

#endif
