#include "checkup.h"

#include <stdio.h>

#include "cli/devices.h"
#include "cli/selftest_report.h"
#include "device/device.h"
#include "selftest/selftest.h"

static bool report(const Options *options, const SelfTestReport *found, const DeviceInfo *info, Error *error)
{
    if (options->self_test_file)
        return selftest_write_json(found, info, options->self_test_file, error);
    selftest_print(found, info, options->quiet, stdout);
    return true;
}

static bool check_device(const Options *options, const DeviceInfo *info, Error *error)
{
    const DeviceOptions how = {.threads = options->threads};
    Device *device = device_open(info, &how, error);
    SelfTestReport found;
    const bool ok = device && selftest_run(device, &found, error) && report(options, &found, info, error) &&
                    selftest_verdict(&found, error);
    device_close(device);
    return ok;
}

bool checkup_make(const Options *options, Error *error)
{
    u32 index;
    DeviceList *devices = device_list_create(error);
    const bool ok = devices && devices_choose(devices, options->device, &index, error) &&
                    check_device(options, &devices->devices[index], error);
    device_list_destroy(devices);
    return ok;
}
