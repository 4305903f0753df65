// What the files of this module know of each other's structs. Private to this module.
#ifndef CLRT_DEVICE_INTERNAL_H
#define CLRT_DEVICE_INTERNAL_H

#include <CL/cl.h>

#include "device/buffer.h"
#include "device/program.h"
#include "device/status.h"

struct Device {
    DeviceInfo info;
    cl_device_id id; // info.device_id, or a part of it
    bool is_part;
    cl_context context;
    cl_command_queue queue;
    u64 bytes, bytes_peak;
};

struct Buffer {
    Device *device;
    cl_mem mem;
    u64 bytes;
    void *memory; // that a CPU device uses in place; NULL on other devices
    bool owns_memory;
    char name[64];
};

struct Program {
    Device *device;
    cl_program program;
    const char *source; // the caller's
    size_t length;
    char *options; // all that it was built with
};

// Puts the names of the arguments of `kernel void kernel_name(...)`, as they stand in source, into names,
// each cut to name_size - 1 characters. Arguments that `#if` leaves out with these options of the build
// (conditions.h) are passed over, as are comments; conditions around the whole kernel are not looked at.
// Returns how many arguments there are (names beyond name_max are counted only); -1 where there is no such
// kernel or a condition is not understood.
i32 source_argument_names(const char *source, size_t length, const char *options, const char *kernel_name,
                          char *names, size_t name_size, u32 name_max);

#endif
