#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <stdlib.h>

static const u64 RAYS = 1000000, MOST_RAYS = 1000000000000;

const char *ulp_options_usage(void)
{
    return "usage: clrt-ulp [options]\n"
           "\n"
           "Sends rays at every shape, random ones and such as look for trouble, and holds the distances of\n"
           "their hits against long double.\n"
           "\n"
           "      --rays N      so many a shape; default 1000000\n"
           "      --shape NAME  this shape only\n"
           "  -d, --device SPEC cpu, gpu, P:D, N or part of a name; default CLRT_DEVICE, else the first GPU,\n"
           "                    else the CPU\n"
           "      --json FILE   the report as JSON, too\n"
           "  -h, --help        this text\n"
           "      --version     the version\n"
           "\n"
           "Exit status: 0 every hit is within 8 ulp or within what one ulp of the inputs changes, 5 one is\n"
           "not, else as of clrt.\n";
}

static bool parse_rays(const char *text, u64 *rays, Error *error)
{
    char *end;
    errno = 0;
    const unsigned long long number = strtoull(text, &end, 10);
    if (!isdigit((unsigned char)*text) || errno || *end || number < 1 || number > MOST_RAYS)
        return error_set(error, ERROR_USAGE, "--rays: \"%s\" is not a whole number from 1 to 10^12", text);
    *rays = number;
    return true;
}

enum { OPTION_RAYS = 256, OPTION_SHAPE, OPTION_JSON, OPTION_VERSION };

static const struct option LONG_OPTIONS[] = {
    {"rays", required_argument, NULL, OPTION_RAYS},
    {"shape", required_argument, NULL, OPTION_SHAPE},
    {"device", required_argument, NULL, 'd'},
    {"json", required_argument, NULL, OPTION_JSON},
    {"help", no_argument, NULL, 'h'},
    {"version", no_argument, NULL, OPTION_VERSION},
    {NULL, 0, NULL, 0},
};

static bool take_option(int option, const char *argument, UlpOptions *options, Error *error)
{
    switch (option) {
    case OPTION_RAYS:
        return parse_rays(argument, &options->rays, error);
    case OPTION_SHAPE:
        options->shape = argument;
        return true;
    case OPTION_JSON:
        options->json = argument;
        return true;
    case 'd':
        options->device = argument;
        return true;
    default:
        options->action = option == 'h' ? ULP_HELP : ULP_VERSION;
        return true;
    }
}

bool ulp_options_parse(int argc, char **argv, UlpOptions *options, Error *error)
{
    *options = (UlpOptions){.rays = RAYS};
    opterr = 0;
    for (;;) {
        // The colon tells a missing argument from an unknown option.
        const int option = getopt_long(argc, argv, ":d:h", LONG_OPTIONS, NULL);
        if (option == -1)
            break;
        if (option == ':')
            return error_set(error, ERROR_USAGE, "%s: an argument is missing", argv[optind - 1]);
        if (option == '?')
            return error_set(error, ERROR_USAGE, "%s: not an option of clrt-ulp", argv[optind - 1]);
        if (!take_option(option, optarg, options, error))
            return false;
        if (options->action != ULP_MEASURE)
            return true;
    }
    if (optind != argc)
        return error_set(error, ERROR_USAGE, "%s: not an option of clrt-ulp", argv[optind]);
    return true;
}
