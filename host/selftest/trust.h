// Trust: whether a device may render. One that this user has not rendered with before is asked for known
// answers; that it gave them is remembered in the user's cache, a line a device, driver and version of clrt.
#ifndef CLRT_SELFTEST_TRUST_H
#define CLRT_SELFTEST_TRUST_H

#include "base/error.h"
#include "device/device.h"

// Returns at once for a device that is remembered. Fails with ERROR_SELF_TEST where it gives wrong answers,
// and as selftest_run does where it cannot be asked. asked: whether it had to be, may be NULL. That nothing
// can be remembered is no error.
bool trust_device(Device *device, bool *asked, Error *error);

// The parts of it. folder: of the cache, NULL for the user's ($XDG_CACHE_HOME, else $HOME/.cache); the file
// is clrt/devices in it.
bool trust_remembers(const char *folder, const DeviceInfo *info);
// Replaces the file by one that has the device too, the newest of a bounded number. False where that failed.
bool trust_remember(const char *folder, const DeviceInfo *info);

#endif
