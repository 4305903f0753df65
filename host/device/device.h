// Device: one opened OpenCL device with its in-order queue. Knows bytes only: nothing here knows what they
// mean or what is drawn. One thread at a time may use a device and what was made from it.
#ifndef CLRT_DEVICE_DEVICE_H
#define CLRT_DEVICE_DEVICE_H

#include "base/error.h"
#include "base/types.h"
#include "device/list.h"

typedef struct Device Device;

typedef struct DeviceOptions {
    u32 threads; // bound of the threads of a CPU device, 0: all; means nothing to other devices
} DeviceOptions;

// Opens the device that info describes; what is needed of *info is copied. Returns NULL and sets *error
// (ERROR_DEVICE, ERROR_MEMORY). Buffers, programs and kernels must be destroyed before the device.
Device *device_open(const DeviceInfo *info, const DeviceOptions *options, Error *error);
void device_close(Device *device);

// As in the list, but with the compute units that `threads` leaves.
const DeviceInfo *device_info(const Device *device);

// Waits until everything that was launched is done; reports what failed meanwhile.
bool device_finish(Device *device, Error *error);

// Bytes in buffers of the device now, and the most there have been.
u64 device_bytes(const Device *device);
u64 device_bytes_peak(const Device *device);

#endif
