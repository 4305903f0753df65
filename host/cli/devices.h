// Devices as the command line speaks of them: what --list-devices prints, and which one is meant. Knows
// nothing of OpenCL but the list.
#ifndef CLRT_CLI_DEVICES_H
#define CLRT_CLI_DEVICES_H

#include <stdio.h>

#include "base/error.h"
#include "device/list.h"

// A line a device, each with what --device takes for it, and a line for each platform without devices.
void devices_print(const DeviceList *list, FILE *stream);

// The same as a JSON object with the arrays "devices" and "platforms". Fails with ERROR_MEMORY.
bool devices_print_json(const DeviceList *list, FILE *stream, Error *error);

// The index of the device that is meant: by --device (spec; NULL where it is not given), else by CLRT_DEVICE
// in the environment, else the default. Errors are those of device_choose.
bool devices_choose(const DeviceList *list, const char *spec, u32 *index, Error *error);

#endif
