// What --self-test prints: a line a case, as text or as JSON. Knows nothing of how cases are run.
#ifndef CLRT_CLI_SELFTEST_REPORT_H
#define CLRT_CLI_SELFTEST_REPORT_H

#include <stdio.h>

#include "base/error.h"
#include "device/list.h"
#include "selftest/selftest.h"

// A heading with the device, a table of the cases, a line that sums it up. failed_only: the lines of cases
// that did not pass and nothing else.
void selftest_print(const SelfTestReport *report, const DeviceInfo *device, bool failed_only, FILE *stream);

// The same into a file as a JSON object, schema "clrt-self-test/1". Fails with ERROR_IO or ERROR_MEMORY.
bool selftest_write_json(const SelfTestReport *report, const DeviceInfo *device, const char *path,
                         Error *error);

#endif
