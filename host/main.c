// clrt: argv to exit status. Results on standard output, talk on standard error.
#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "checkup.h"
#include "cli/devices.h"
#include "cli/options.h"
#include "interrupt.h"
#include "picture.h"

static bool check_stdout(Error *error)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return true;
    return error_set(error, ERROR_IO, "standard output: %s", strerror(errno));
}

static bool list_devices(bool json, Error *error)
{
    DeviceList *devices = device_list_create(error);
    if (!devices)
        return false;
    bool ok = true;
    if (json)
        ok = devices_print_json(devices, stdout, error);
    else
        devices_print(devices, stdout);
    device_list_destroy(devices);
    return ok && check_stdout(error);
}

static bool perform(const Options *options, Interrupt *interrupt, Error *error)
{
#ifdef _OPENMP
    if (options->threads)
        omp_set_num_threads((int)options->threads);
#endif
    switch (options->action) {
    case ACTION_HELP:
        options_print_usage(stdout);
        return check_stdout(error);
    case ACTION_VERSION:
        puts("clrt " CLRT_VERSION);
        return check_stdout(error);
    case ACTION_LIST_DEVICES:
        return list_devices(options->json, error);
    case ACTION_SELF_TEST:
        return checkup_make(options, error) && check_stdout(error);
    case ACTION_CHECK:
    case ACTION_RENDER:
        break;
    }
    return picture_make(options, interrupt, error);
}

int main(int argc, char **argv)
{
    // What cannot be written is reported like any other failure, with its status.
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN);
    Interrupt *interrupt = interrupt_start();
    Options options;
    Error error = {.code = ERROR_NONE};
    const bool ok = options_parse(argc, argv, &options, &error) && perform(&options, interrupt, &error);
    interrupt_stop(interrupt);
    if (ok)
        return 0;
    fprintf(stderr, "clrt: %s\n", error.text);
    if (error.code == ERROR_USAGE)
        fputs("clrt --help shows the options\n", stderr);
    return (int)error.code;
}
