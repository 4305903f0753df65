// The table of all options: from it come the parsing, the usage text and the suggestions. Private to cli.
#ifndef CLRT_CLI_TABLE_H
#define CLRT_CLI_TABLE_H

#include "cli/options.h"

typedef enum OptionValue { VALUE_NONE, VALUE_REQUIRED, VALUE_OPTIONAL } OptionValue;

typedef enum OptionGroup { GROUP_DEVICE, GROUP_IMAGE, GROUP_OUTPUT, GROUP_RUN, GROUP_LATER } OptionGroup;

typedef struct Option {
    char letter; // 0: none
    const char *name;
    OptionValue value;
    const char *value_name;
    OptionGroup group; // GROUP_LATER: reported as not supported yet, and not in the usage text
    const char *help;
    // Takes the value (NULL where there is none). Returns NULL, or what the value should have been.
    const char *(*take)(Options *options, const char *value);
} Option;

extern const Option OPTIONS[];
extern const size_t OPTION_COUNT;

#endif
