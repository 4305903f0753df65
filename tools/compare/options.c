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
           "      --fail L          a value fails if it is more than L levels away (PFM: by L); default 0,\n"
           "                        with variances no such limit\n"
           "      --fail-ulp N      PFM: nor does it fail within N units in the last place; default 0\n"
           "      --fail-percent P  up to P percent of the values may fail; default 0\n"
           "      --hard-fail H     no value may be more than H levels away (PFM: by H)\n"
           "      --mask MASK.png   leave out the pixels where MASK is not black\n"
           "      --crop X,Y,W,H    compare this rectangle only\n"
           "      --map OUT.png     draw the differences; --flip-map and --ssim-map: FLIP and 1 - SSIM\n"
           "      --json            report as JSON\n"
           "      --quiet           no report, exit status only\n"
           "  -h, --help            this text\n"
           "      --version         the version\n"
           "\n"
           "Z-test of noisy PFMs, with one or both of:\n"
           "      --variance-a VARIANCE.pfm, --variance-b VARIANCE.pfm\n"
           "                        the variance of each value of A, of B; without one its picture is exact\n"
           "      --significance S  the chance that any value fails without a cause; default 0.01\n"
           "      --pass-percent P  the share of the pixels that has to pass; default 99.75\n"
           "      --variance-floor V\n"
           "                        smaller variances, of A and B together, count as V; default 0\n"
           "      --z-map OUT.png   draw how many standard deviations apart\n"
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
    OPTION_MAP, // and in the order of MapKind
    OPTION_FLIP_MAP,
    OPTION_SSIM_MAP,
    OPTION_Z_MAP,
    OPTION_VARIANCE_A,
    OPTION_VARIANCE_B,
    OPTION_SIGNIFICANCE,
    OPTION_PASS_PERCENT,
    OPTION_VARIANCE_FLOOR,
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
    {"flip-map", required_argument, NULL, OPTION_FLIP_MAP},
    {"ssim-map", required_argument, NULL, OPTION_SSIM_MAP},
    {"z-map", required_argument, NULL, OPTION_Z_MAP},
    {"variance-a", required_argument, NULL, OPTION_VARIANCE_A},
    {"variance-b", required_argument, NULL, OPTION_VARIANCE_B},
    {"significance", required_argument, NULL, OPTION_SIGNIFICANCE},
    {"pass-percent", required_argument, NULL, OPTION_PASS_PERCENT},
    {"variance-floor", required_argument, NULL, OPTION_VARIANCE_FLOOR},
    {"json", no_argument, NULL, OPTION_JSON},
    {"quiet", no_argument, NULL, OPTION_QUIET},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

// A number between 0 and 1, neither of them.
static bool parse_significance(const char *text, f64 *value, Error *error)
{
    if (!parse_number("significance", text, value, error))
        return false;
    return (*value > 0 && *value < 1) ||
           error_set(error, ERROR_USAGE, "--significance: \"%s\" is not between 0 and 1", text);
}

static bool take_test_option(int option, const char *argument, Options *options, Error *error)
{
    ZLimits *limits = &options->limits.ztest;
    switch (option) {
    case OPTION_SIGNIFICANCE:
        return parse_significance(argument, &limits->significance, error);
    case OPTION_PASS_PERCENT:
        return parse_number("pass-percent", argument, &limits->pass_percent, error);
    case OPTION_VARIANCE_FLOOR:
        return parse_number("variance-floor", argument, &limits->variance_floor, error);
    default:
        options->sources.variances[option - OPTION_VARIANCE_A] = argument;
        return true;
    }
}

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
        options->sources.crop = &options->crop;
        return parse_crop(argument, &options->crop, error);
    case OPTION_MASK:
        options->sources.mask = argument;
        return true;
    case OPTION_MAP:
    case OPTION_FLIP_MAP:
    case OPTION_SSIM_MAP:
    case OPTION_Z_MAP:
        options->maps[option - OPTION_MAP] = argument;
        return true;
    case OPTION_VARIANCE_A:
    case OPTION_VARIANCE_B:
    case OPTION_SIGNIFICANCE:
    case OPTION_PASS_PERCENT:
    case OPTION_VARIANCE_FLOOR:
        return take_test_option(option, argument, options, error);
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

// What depends on there being variances.
static bool finish_test(const bool asked[], Options *options, Error *error)
{
    static const int NEEDY[] = {OPTION_SIGNIFICANCE, OPTION_PASS_PERCENT, OPTION_VARIANCE_FLOOR,
                                OPTION_Z_MAP};
    const bool test = options->sources.variances[0] || options->sources.variances[1];
    for (size_t i = 0; i < sizeof NEEDY / sizeof NEEDY[0] && !test; i++) {
        const struct option *named = LONG_OPTIONS;
        while (named->val != NEEDY[i])
            named++;
        if (asked[NEEDY[i]])
            return error_set(error, ERROR_USAGE, "--%s needs --variance-a or --variance-b", named->name);
    }
    // Two noisy pictures have no equal values; the test decides.
    if (test && !asked[OPTION_FAIL])
        options->limits.fail = INFINITY;
    return true;
}

bool options_parse(int argc, char **argv, Options *options, Error *error)
{
    bool asked[OPTION_VERSION + 1] = {false};
    *options = (Options){.limits.hard_fail = INFINITY,
                         .limits.ztest.significance = 0.01,
                         .limits.ztest.pass_percent = 99.75};
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
        asked[option] = true;
        if (!take_option(option, optarg, options, error))
            return false;
        if (options->action != ACTION_COMPARE)
            return true;
    }
    if (argc - optind != 2)
        return error_set(error, ERROR_USAGE, "two pictures are needed, not %d", argc - optind);
    options->sources.paths[0] = argv[optind];
    options->sources.paths[1] = argv[optind + 1];
    return finish_test(asked, options, error);
}
