// Self-test: the numerical hard cases on a device, each with its right answer and its bar. The kernels are
// those of renders, given rays and numbers whose answers the host knows. Prints nothing.
#ifndef CLRT_SELFTEST_SELFTEST_H
#define CLRT_SELFTEST_SELFTEST_H

#include "base/error.h"
#include "device/device.h"
#include "render/plan.h"
#include "selftest/judge.h"

enum { SELF_TEST_CASES_MAX = 96 };

typedef struct SelfTestReport {
    SelfTestCase cases[SELF_TEST_CASES_MAX];
    u32 count, failed;
    DeviceShape shape;   // that the kernels were built with
    f64 compile_seconds; // the first launches included
    f64 run_seconds;     // everything else
} SelfTestReport;

// Runs all cases. Fails where one cannot be run (ERROR_DEVICE, ERROR_MEMORY); cases that do not pass are no
// such failure.
bool selftest_run(Device *device, SelfTestReport *report, Error *error);

// The few of them that show what a driver does to arithmetic: less than a second to compile, milliseconds to
// run. What the device does not promise, exact division, is not asked.
bool selftest_run_short(Device *device, SelfTestReport *report, Error *error);

// Adds a case to the report.
void selftest_add(SelfTestReport *report, const SelfTestCase *one);

// False with ERROR_SELF_TEST, and a text that names the cases that did not pass, where there are such; also
// where there are no cases at all.
bool selftest_verdict(const SelfTestReport *report, Error *error);

#endif
