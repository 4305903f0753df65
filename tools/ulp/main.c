// clrt-ulp: how far the distances of hits are off, shape by shape, in ulp and in what an ulp of the inputs makes.
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "measure.h"
#include "options.h"
#include "report.h"

static Device *open_device(const UlpOptions *options, Error *error)
{
    const char *spec = options->device ? options->device : getenv("CLRT_DEVICE");
    DeviceList *list = device_list_create(error);
    u32 index;
    Device *device = NULL;
    if (list && device_choose(list, spec, &index, error))
        device = device_open(&list->devices[index], &(DeviceOptions){.threads = 0}, error);
    device_list_destroy(list);
    return device;
}

static bool known_shape(const char *name, Error *error)
{
    char names[512] = "";
    for (u32 k = 0; k < SUBJECT_COUNT; k++) {
        const char *one = subject_at(k).name;
        const size_t used = strlen(names);
        if (!name || strcmp(name, one) == 0)
            return true;
        snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", one);
    }
    return error_set(error, ERROR_USAGE, "--shape: there is no \"%s\"; there are %s", name, names);
}

static bool measure_all(Probe *probe, const UlpOptions *options, UlpResult *results, u32 *count, Error *error)
{
    for (u32 k = 0; k < SUBJECT_COUNT; k++) {
        const Subject subject = subject_at(k);
        if (options->shape && strcmp(options->shape, subject.name) != 0)
            continue;
        UlpResult *result = &results[*count];
        result->name = subject.name;
        if (!measure_subject(probe, &subject, options->rays, &result->tally, error))
            return false;
        ulp_report_row(result);
        ++*count;
    }
    return true;
}

static bool run(const UlpOptions *options, Error *error)
{
    if (!known_shape(options->shape, error))
        return false;
    static UlpResult results[SUBJECT_COUNT];
    u32 count = 0;
    Device *device = open_device(options, error);
    Probe *probe = device ? probe_create(device, PROBE_ALL, error) : NULL;
    bool ok = probe != NULL;
    if (ok) {
        ulp_report_heading(device_info(device));
        ok = measure_all(probe, options, results, &count, error);
    }
    if (ok) {
        ulp_report_histogram(results, count);
        ok = (!options->json || ulp_report_json(results, count, device_info(device), options->json, error)) &&
             ulp_verdict(results, count, error);
    }
    probe_destroy(probe);
    device_close(device);
    return ok;
}

int main(int argc, char **argv)
{
    UlpOptions options;
    Error error = {.code = ERROR_NONE};
    bool ok = ulp_options_parse(argc, argv, &options, &error);
    if (ok && options.action == ULP_HELP)
        fputs(ulp_options_usage(), stdout);
    else if (ok && options.action == ULP_VERSION)
        puts("clrt-ulp " CLRT_VERSION);
    else if (ok)
        ok = run(&options, &error);
    if (fflush(stdout) != 0 || ferror(stdout))
        ok = ok && error_set(&error, ERROR_IO, "standard output: %s", strerror(errno));
    if (ok)
        return 0;
    fprintf(stderr, "clrt-ulp: %s\n", error.text);
    if (error.code == ERROR_USAGE)
        fputs("clrt-ulp --help shows the options\n", stderr);
    return (int)error.code;
}
