// Program and Kernel: OpenCL C source to launches, with arguments bound by the names they have in the source.
#ifndef CLRT_DEVICE_PROGRAM_H
#define CLRT_DEVICE_PROGRAM_H

#include "device/buffer.h"
#include "device/device.h"

typedef struct Program Program;
typedef struct Kernel Kernel;

// Builds length bytes of OpenCL C 1.2 with options (of clBuildProgram; -cl-std=CL1.2 and
// -cl-kernel-arg-info are added). source must outlive the program. Returns NULL and sets *error:
// ERROR_DEVICE with the build log, from its first error on where it is long, where the build fails.
Program *program_create(Device *device, const char *source, size_t length, const char *options, Error *error);
void program_destroy(Program *program);

// Returns NULL and sets *error where the program has no such kernel.
Kernel *kernel_create(Program *program, const char *name, Error *error);
void kernel_destroy(Kernel *kernel);

// Bind the argument called name for the launches to come. Fail with ERROR_DEVICE, naming the arguments there
// are, where the kernel has no such argument or where it is of another size.
bool kernel_set_buffer(Kernel *kernel, const char *name, const Buffer *buffer, Error *error);
bool kernel_set_u32(Kernel *kernel, const char *name, u32 value, Error *error);
bool kernel_set_f32(Kernel *kernel, const char *name, f32 value, Error *error);
// Local memory of `bytes` bytes for each work-group.
bool kernel_set_local(Kernel *kernel, const char *name, size_t bytes, Error *error);

// True where the kernel has an argument of that name: features leave arguments out.
bool kernel_has(const Kernel *kernel, const char *name);

// Puts global work-items in groups of local (0: the driver's choice) into the queue and returns at once.
// global is rounded up to a multiple of local, so a kernel compares its index with its count; global 0
// launches nothing. Fails with ERROR_DEVICE where an argument was never set, naming it.
bool kernel_launch(Kernel *kernel, u64 global, u64 local, Error *error);

#endif
