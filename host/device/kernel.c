#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/internal.h"

enum { ARGUMENT_MAX = 64, ARGUMENT_NAME = 64 };

struct Kernel {
    Program *program;
    cl_kernel kernel;
    char name[64];
    u32 argument_count;
    char argument_names[ARGUMENT_MAX][ARGUMENT_NAME];
    bool argument_set[ARGUMENT_MAX];
};

// Names from the driver; false where it does not tell them.
static bool read_names(Kernel *kernel)
{
    for (u32 i = 0; i < kernel->argument_count; i++) {
        char *name = kernel->argument_names[i];
        const cl_int status =
            clGetKernelArgInfo(kernel->kernel, i, CL_KERNEL_ARG_NAME, ARGUMENT_NAME, name, NULL);
        if (status != CL_SUCCESS || !name[0])
            return false;
    }
    return true;
}

static bool open_kernel(Kernel *kernel, Error *error)
{
    const Program *program = kernel->program;
    cl_int status;
    kernel->kernel = clCreateKernel(program->program, kernel->name, &status);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateKernel", "kernel '%s'", kernel->name);
    cl_uint count = 0;
    status = clGetKernelInfo(kernel->kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clGetKernelInfo", "kernel '%s'", kernel->name);
    if (count > ARGUMENT_MAX)
        return error_set(error, ERROR_DEVICE, "kernel '%s' has %u arguments; at most %d are supported",
                         kernel->name, count, (int)ARGUMENT_MAX);
    kernel->argument_count = count;
    if (read_names(kernel))
        return true;
    const i32 found = source_argument_names(program->source, program->length, program->options, kernel->name,
                                            kernel->argument_names[0], ARGUMENT_NAME, ARGUMENT_MAX);
    if (found != (i32)count)
        return error_set(error, ERROR_DEVICE,
                         "kernel '%s': the driver does not tell the names of its %u arguments, and %d are "
                         "found in the source",
                         kernel->name, count, (int)found);
    return true;
}

Kernel *kernel_create(Program *program, const char *name, Error *error)
{
    Kernel *kernel = calloc(1, sizeof *kernel);
    if (!kernel) {
        error_set(error, ERROR_MEMORY, "no memory for kernel '%s'", name);
        return NULL;
    }
    kernel->program = program;
    snprintf(kernel->name, sizeof kernel->name, "%s", name);
    if (!open_kernel(kernel, error)) {
        kernel_destroy(kernel);
        return NULL;
    }
    return kernel;
}

void kernel_destroy(Kernel *kernel)
{
    if (!kernel)
        return;
    if (kernel->kernel)
        clReleaseKernel(kernel->kernel);
    free(kernel);
}

static i32 find_argument(const Kernel *kernel, const char *name)
{
    for (u32 i = 0; i < kernel->argument_count; i++)
        if (strcmp(kernel->argument_names[i], name) == 0)
            return (i32)i;
    return -1;
}

bool kernel_has(const Kernel *kernel, const char *name)
{
    return find_argument(kernel, name) >= 0;
}

static bool no_argument(const Kernel *kernel, const char *name, Error *error)
{
    char names[2048] = "";
    size_t used = 0;
    for (u32 i = 0; i < kernel->argument_count && used < sizeof names; i++)
        used += (size_t)snprintf(names + used, sizeof names - used, "%s%s", i ? ", " : "",
                                 kernel->argument_names[i]);
    return error_set(error, ERROR_DEVICE, "kernel '%s' has no argument '%s'; it has: %s", kernel->name, name,
                     names);
}

// What every kernel_set_X comes to.
static bool set_argument(Kernel *kernel, const char *name, size_t size, const void *bytes, Error *error)
{
    const i32 index = find_argument(kernel, name);
    if (index < 0)
        return no_argument(kernel, name, error);
    const cl_int status = clSetKernelArg(kernel->kernel, (cl_uint)index, size, bytes);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clSetKernelArg", "kernel '%s', argument '%s' of %zu bytes",
                            kernel->name, name, size);
    kernel->argument_set[index] = true;
    return true;
}

bool kernel_set_buffer(Kernel *kernel, const char *name, const Buffer *buffer, Error *error)
{
    return set_argument(kernel, name, sizeof buffer->mem, &buffer->mem, error);
}

bool kernel_set_u32(Kernel *kernel, const char *name, u32 value, Error *error)
{
    return set_argument(kernel, name, sizeof value, &value, error);
}

bool kernel_set_f32(Kernel *kernel, const char *name, f32 value, Error *error)
{
    return set_argument(kernel, name, sizeof value, &value, error);
}

bool kernel_set_local(Kernel *kernel, const char *name, size_t bytes, Error *error)
{
    return set_argument(kernel, name, bytes, NULL, error);
}

bool kernel_launch(Kernel *kernel, u64 global, u64 local, Error *error)
{
    for (u32 i = 0; i < kernel->argument_count; i++)
        if (!kernel->argument_set[i])
            return error_set(error, ERROR_DEVICE, "kernel '%s': argument '%s' has not been set", kernel->name,
                             kernel->argument_names[i]);
    if (global == 0)
        return true;
    const Device *device = kernel->program->device;
    const size_t group = local;
    const size_t items = local > 0 ? (global + local - 1) / local * local : global;
    const cl_int status = clEnqueueNDRangeKernel(device->queue, kernel->kernel, 1, NULL, &items,
                                                 local > 0 ? &group : NULL, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clEnqueueNDRangeKernel",
                            "kernel '%s', %zu work-items in groups of %zu", kernel->name, items, group);
    return true;
}
