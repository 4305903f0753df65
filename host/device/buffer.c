#include "device/buffer.h"

#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "device/internal.h"

static const f64 MIB = 1024.0 * 1024.0;
// Drivers that allocate late would accept what they can never hold, and the system would end the program.
static bool fits(const Device *device, const char *name, u64 bytes, Error *error)
{
    const DeviceInfo *info = &device->info;
    if (bytes > info->allocation_max)
        return error_set(error, ERROR_MEMORY, "buffer '%s' of %.1f MiB: %s allows %.1f MiB a buffer", name,
                         (f64)bytes / MIB, info->name, (f64)info->allocation_max / MIB);
    if (bytes > info->memory - (device->bytes < info->memory ? device->bytes : info->memory))
        return error_set(error, ERROR_MEMORY,
                         "buffer '%s' of %.1f MiB: %.1f MiB of the %.1f MiB of %s are in use", name,
                         (f64)bytes / MIB, (f64)device->bytes / MIB, (f64)info->memory / MIB, info->name);
    return true;
}

// The device's side of a buffer whose other members are set.
static bool open_memory(Buffer *buffer, cl_mem_flags flags, Error *error)
{
    cl_int status;
    buffer->mem = clCreateBuffer(buffer->device->context, flags | (buffer->memory ? CL_MEM_USE_HOST_PTR : 0),
                                 buffer->bytes, buffer->memory, &status);
    if (status == CL_INVALID_BUFFER_SIZE || status == CL_OUT_OF_RESOURCES)
        status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateBuffer", "buffer '%s' of %.1f MiB on %s", buffer->name,
                            (f64)buffer->bytes / MIB, buffer->device->info.name);
    return true;
}

// A buffer that the device has room for, without memory.
static Buffer *buffer_make(Device *device, const char *name, u64 bytes, Error *error)
{
    if (!fits(device, name, bytes, error))
        return NULL;
    Buffer *buffer = calloc(1, sizeof *buffer);
    if (!buffer) {
        error_set(error, ERROR_MEMORY, "no memory for buffer '%s'", name);
        return NULL;
    }
    buffer->device = device;
    buffer->bytes = bytes;
    snprintf(buffer->name, sizeof buffer->name, "%s", name);
    device->bytes += bytes;
    if (device->bytes > device->bytes_peak)
        device->bytes_peak = device->bytes;
    return buffer;
}

// The buffer if all went well with it.
static Buffer *buffer_if(bool ok, Buffer *buffer)
{
    if (ok)
        return buffer;
    buffer_destroy(buffer);
    return NULL;
}

Buffer *buffer_create(Device *device, const char *name, u64 bytes, Error *error)
{
    if (bytes == 0)
        bytes = 16; // OpenCL has no empty buffers, and kernels want a pointer all the same
    Buffer *buffer = buffer_make(device, name, bytes, error);
    if (!buffer)
        return NULL;
    if (device->info.type == DEVICE_CPU) {
        buffer->memory = page_alloc(bytes);
        buffer->owns_memory = true;
        if (!buffer->memory) {
            error_set(error, ERROR_MEMORY, "buffer '%s' of %.1f MiB: the system has no memory left", name,
                      (f64)bytes / MIB);
            return buffer_if(false, buffer);
        }
    }
    return buffer_if(open_memory(buffer, CL_MEM_READ_WRITE, error), buffer);
}

Buffer *buffer_wrap(Device *device, const char *name, const void *memory, u64 bytes, Error *error)
{
    if (bytes == 0 || device->info.type != DEVICE_CPU) {
        Buffer *copy = buffer_create(device, name, bytes, error);
        return copy ? buffer_if(buffer_upload(copy, 0, memory, bytes, error), copy) : NULL;
    }
    Buffer *buffer = buffer_make(device, name, bytes, error);
    if (!buffer)
        return NULL;
    buffer->memory = (void *)(uintptr_t)memory; // OpenCL's signature knows no const; the flag does
    return buffer_if(open_memory(buffer, CL_MEM_READ_ONLY, error), buffer);
}

void buffer_destroy(Buffer *buffer)
{
    if (!buffer)
        return;
    if (buffer->mem) {
        // Memory of the host must not go while a launch still uses it.
        if (buffer->memory)
            clFinish(buffer->device->queue);
        clReleaseMemObject(buffer->mem);
    }
    if (buffer->owns_memory)
        page_free(buffer->memory, buffer->bytes);
    buffer->device->bytes -= buffer->bytes;
    free(buffer);
}

static bool in_range(const Buffer *buffer, u64 offset, u64 bytes, const char *what, Error *error)
{
    if (offset <= buffer->bytes && bytes <= buffer->bytes - offset)
        return true;
    return error_set(error, ERROR_DEVICE, "buffer '%s': %s of %llu bytes at %llu is beyond its %llu bytes",
                     buffer->name, what, (unsigned long long)bytes, (unsigned long long)offset,
                     (unsigned long long)buffer->bytes);
}

bool buffer_upload(Buffer *buffer, u64 offset, const void *from, u64 bytes, Error *error)
{
    if (!in_range(buffer, offset, bytes, "an upload", error))
        return false;
    if (bytes == 0)
        return true;
    const cl_int status =
        clEnqueueWriteBuffer(buffer->device->queue, buffer->mem, CL_TRUE, offset, bytes, from, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clEnqueueWriteBuffer", "buffer '%s' of %.1f MiB", buffer->name,
                            (f64)buffer->bytes / MIB);
    return true;
}

bool buffer_download(Buffer *buffer, u64 offset, void *to, u64 bytes, Error *error)
{
    if (!in_range(buffer, offset, bytes, "a download", error))
        return false;
    if (bytes == 0)
        return true;
    const cl_int status =
        clEnqueueReadBuffer(buffer->device->queue, buffer->mem, CL_TRUE, offset, bytes, to, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clEnqueueReadBuffer", "buffer '%s' of %.1f MiB", buffer->name,
                            (f64)buffer->bytes / MIB);
    return true;
}
