// What the files of this module know of each other's structs. Private to this module.
#ifndef CLRT_DEVICE_INTERNAL_H
#define CLRT_DEVICE_INTERNAL_H

#include <CL/cl.h>

#include "device/buffer.h"
#include "device/program.h"
#include "device/status.h"

enum { PENDING_MAX = 256 };

// A launch whose time has not been read yet.
typedef struct Pending {
    cl_event event;
    Kernel *kernel;
} Pending;

struct Device {
    DeviceInfo info;
    cl_device_id id; // info.device_id, or a part of it
    bool is_part;
    bool profiling;
    cl_context context;
    cl_command_queue queue;
    Buffer *buffers; // newest first
    u64 bytes, bytes_peak;
    Pending pending[PENDING_MAX]; // used where profiling
    u32 pending_count;
};

struct Buffer {
    Device *device;
    Buffer *next, *previous;
    cl_mem mem;
    u64 bytes;
    void *memory; // of device_memory_alloc, the buffer's own; NULL where there is none
    u64 memory_bytes;
    char name[64];
};

struct Program {
    Device *device;
    cl_program program;
    const char *source; // the caller's
    size_t length;
    f64 build_seconds;
};

// Waits for the launches whose time has not been read, and adds it to their kernels.
void device_collect_times(Device *device);

// Puts the names of the arguments of `kernel void kernel_name(...)`, as they stand in source, into names,
// each cut to name_size - 1 characters. Comments and lines of the preprocessor are passed over. Returns how
// many arguments there are (names beyond name_max are counted only); -1 where there is no such kernel.
i32 source_argument_names(const char *source, size_t length, const char *kernel_name, char *names,
                          size_t name_size, u32 name_max);

#endif
