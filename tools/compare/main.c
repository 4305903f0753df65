// clrt-compare: how two pictures differ. Exit status as of diff: 0 same, 1 different, 2 cannot compare.
#include "maps.h"
#include "metrics.h"
#include "options.h"
#include "pictures.h"
#include "report.h"

#include <stdio.h>

enum { EXIT_SAME = 0, EXIT_DIFFERENT = 1, EXIT_TROUBLE = 2 };

static bool report(const Options *options, const Pictures *pictures, const Metrics *metrics, Error *error)
{
    if (options->quiet)
        return true;
    return options->json ? report_json(options, pictures, metrics, error)
                         : report_text(options, pictures, metrics, error);
}

static int compare(const Options *options)
{
    Error error;
    Pictures pictures;
    Metrics metrics;
    bool done = pictures_read(&options->sources, &pictures, &error);
    if (done) {
        done = metrics_compute(&pictures, &options->limits, &metrics, &error);
        if (done) {
            done = maps_write(&pictures, &metrics, options->maps, &error) &&
                   report(options, &pictures, &metrics, &error);
            metrics_destroy(&metrics);
        }
        pictures_destroy(&pictures);
    }
    if (!done) {
        fprintf(stderr, "clrt-compare: %s\n", error.text);
        return EXIT_TROUBLE;
    }
    return metrics.same ? EXIT_SAME : EXIT_DIFFERENT;
}

int main(int argc, char **argv)
{
    Options options;
    Error error;
    if (!options_parse(argc, argv, &options, &error)) {
        fprintf(stderr, "clrt-compare: %s\nTry clrt-compare --help.\n", error.text);
        return EXIT_TROUBLE;
    }
    if (options.action == ACTION_COMPARE)
        return compare(&options);
    if (options.action == ACTION_HELP)
        fputs(options_usage(), stdout);
    else
        puts("clrt-compare " CLRT_VERSION);
    return fflush(stdout) == 0 ? EXIT_SAME : EXIT_TROUBLE;
}
