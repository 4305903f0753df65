#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

const char *options_usage(void)
{
    return "usage: clrt-compare [options] A B\n"
           "\n"
           "Says how the picture B differs from A. Both are PNG of one depth, or both PFM, of one size.\n"
           "Without options they are the same only if every value is.\n"
           "\n"
           "      --fail L          a value fails if it is more than L levels away (PFM: by L); default 0\n"
           "      --fail-ulp N      PFM: nor does it fail within N units in the last place; default 0\n"
           "      --fail-percent P  up to P percent of the values may fail; default 0\n"
           "      --hard-fail H     no value may be more than H levels away (PFM: by H)\n"
           "      --mask MASK.png   leave out the pixels where MASK is not black\n"
           "      --crop X,Y,W,H    compare this rectangle only\n"
           "      --map OUT.png     draw the differences\n"
           "      --json            report as JSON\n"
           "      --quiet           no report, exit status only\n"
           "  -h, --help            this text\n"
           "      --version         the version\n"
           "\n"
           "Exit status: 0 the same within the limits, 1 different, 2 cannot compare.\n";
}

static bool parse_number(const char *name, const char *text, f64 *value, Error *error)
{
    char *end;
    *value = strtod(text, &end);
    if (end == text || *end || isspace((unsigned char)*text) || !(*value >= 0))
        return error_set(error, ERROR_USAGE, "--%s: \"%s\" is not a number of at least 0", name, text);
    return true;
}

// A whole number and the character after it.
static bool parse_whole(const char **text, char after, u32 *value)
{
    if (!isdigit((unsigned char)**text))
        return false;
    char *end;
    errno = 0;
    const unsigned long long number = strtoull(*text, &end, 10);
    if (errno || number > UINT32_MAX || *end != after)
        return false;
    *value = (u32)number;
    *text = end + (after != 0);
    return true;
}

static bool parse_crop(const char *text, Region *crop, Error *error)
{
    const char *at = text;
    if (!parse_whole(&at, ',', &crop->x) || !parse_whole(&at, ',', &crop->y) ||
        !parse_whole(&at, ',', &crop->width) || !parse_whole(&at, 0, &crop->height) || crop->width == 0 ||
        crop->height == 0)
        return error_set(error, ERROR_USAGE, "--crop: \"%s\" is not X,Y,W,H with W and H of at least 1",
                         text);
    return true;
}

static bool parse_ulp(const char *text, Limits *limits, Error *error)
{
    const char *at = text;
    if (!parse_whole(&at, 0, &limits->fail_ulp))
        return error_set(error, ERROR_USAGE, "--fail-ulp: \"%s\" is not a whole number", text);
    return true;
}

enum {
    OPTION_FAIL = 256,
    OPTION_FAIL_ULP,
    OPTION_FAIL_PERCENT,
    OPTION_HARD_FAIL,
    OPTION_MASK,
    OPTION_CROP,
    OPTION_MAP,
    OPTION_JSON,
    OPTION_QUIET,
    OPTION_VERSION
};

static const struct option LONG_OPTIONS[] = {
    {"fail", required_argument, NULL, OPTION_FAIL},
    {"fail-ulp", required_argument, NULL, OPTION_FAIL_ULP},
    {"fail-percent", required_argument, NULL, OPTION_FAIL_PERCENT},
    {"hard-fail", required_argument, NULL, OPTION_HARD_FAIL},
    {"mask", required_argument, NULL, OPTION_MASK},
    {"crop", required_argument, NULL, OPTION_CROP},
    {"map", required_argument, NULL, OPTION_MAP},
    {"json", no_argument, NULL, OPTION_JSON},
    {"quiet", no_argument, NULL, OPTION_QUIET},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

static bool take_option(int option, const char *argument, Options *options, Error *error)
{
    switch (option) {
    case OPTION_FAIL:
        return parse_number("fail", argument, &options->limits.fail, error);
    case OPTION_FAIL_ULP:
        return parse_ulp(argument, &options->limits, error);
    case OPTION_FAIL_PERCENT:
        return parse_number("fail-percent", argument, &options->limits.fail_percent, error);
    case OPTION_HARD_FAIL:
        return parse_number("hard-fail", argument, &options->limits.hard_fail, error);
    case OPTION_CROP:
        options->has_crop = true;
        return parse_crop(argument, &options->crop, error);
    case OPTION_MASK:
        options->mask = argument;
        return true;
    case OPTION_MAP:
        options->map = argument;
        return true;
    case OPTION_JSON:
        options->json = true;
        return true;
    case OPTION_QUIET:
        options->quiet = true;
        return true;
    default:
        options->action = option == 'h' ? ACTION_HELP : ACTION_VERSION;
        return true;
    }
}

bool options_parse(int argc, char **argv, Options *options, Error *error)
{
    *options = (Options){.limits.hard_fail = INFINITY};
    opterr = 0;
    for (;;) {
        // The colon tells a missing argument from an unknown option.
        const int option = getopt_long(argc, argv, ":h", LONG_OPTIONS, NULL);
        if (option == -1)
            break;
        if (option == ':')
            return error_set(error, ERROR_USAGE, "%s: an argument is missing", argv[optind - 1]);
        if (option == '?')
            return error_set(error, ERROR_USAGE, "%s: not an option of clrt-compare", argv[optind - 1]);
        if (!take_option(option, optarg, options, error))
            return false;
        if (options->action != ACTION_COMPARE)
            return true;
    }
    if (argc - optind != 2)
        return error_set(error, ERROR_USAGE, "two pictures are needed, not %d", argc - optind);
    options->paths[0] = argv[optind];
    options->paths[1] = argv[optind + 1];
    return true;
}
