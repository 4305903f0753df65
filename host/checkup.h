// Checkup: --self-test, from the choice of a device to the verdict on it. Beside main.c because it is a whole
// run; it does not end the program.
#ifndef CLRT_CHECKUP_H
#define CLRT_CHECKUP_H

#include "base/error.h"
#include "cli/options.h"

// Runs the self-test on the device that the options choose and prints or writes its report. Fails with
// ERROR_SELF_TEST where a case does not pass.
bool checkup_make(const Options *options, Error *error);

#endif
