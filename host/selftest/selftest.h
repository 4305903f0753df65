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

// Adds a case to the report.
void selftest_add(SelfTestReport *report, const SelfTestCase *one);

// False with ERROR_SELF_TEST, and a text that names the cases, where any did not pass or there are none.
bool selftest_verdict(const SelfTestReport *report, Error *error);

#endif
