#include "device/buffer.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/internal.h"

static const f64 MIB = 1024.0 * 1024.0;

static void link_buffer(Buffer *buffer)
{
    Device *device = buffer->device;
    buffer->next = device->buffers;
    if (buffer->next)
        buffer->next->previous = buffer;
    device->buffers = buffer;
    device->bytes += buffer->bytes;
    if (device->bytes > device->bytes_peak)
        device->bytes_peak = device->bytes;
}

static void unlink_buffer(Buffer *buffer)
{
    Device *device = buffer->device;
    if (buffer->next)
        buffer->next->previous = buffer->previous;
    if (buffer->previous)
        buffer->previous->next = buffer->next;
    else
        device->buffers = buffer->next;
    device->bytes -= buffer->bytes;
}

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

// The cl_mem of a buffer whose other members are set; in_place is memory of the host to use, or NULL.
static bool allocate(Buffer *buffer, void *in_place, Error *error)
{
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (in_place ? CL_MEM_USE_HOST_PTR : 0);
    cl_int status;
    buffer->mem = clCreateBuffer(buffer->device->context, flags, buffer->bytes, in_place, &status);
    if (status == CL_INVALID_BUFFER_SIZE || status == CL_OUT_OF_RESOURCES)
        status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateBuffer", "buffer '%s' of %.1f MiB on %s", buffer->name,
                            (f64)buffer->bytes / MIB, buffer->device->info.name);
    return true;
}

// A buffer without cl_mem, counted among those of the device.
static Buffer *prepare(Device *device, const char *name, u64 bytes, Error *error)
{
    if (bytes == 0)
        bytes = 16; // OpenCL has no empty buffers, and kernels want a pointer all the same
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
    link_buffer(buffer);
    return buffer;
}

Buffer *buffer_create(Device *device, const char *name, u64 bytes, Error *error)
{
    Buffer *buffer = prepare(device, name, bytes, error);
    if (!buffer)
        return NULL;
    if (device->info.type == DEVICE_CPU) {
        buffer->memory_bytes = buffer->bytes;
        buffer->memory = device_memory_alloc(buffer->memory_bytes);
        if (!buffer->memory) {
            error_set(error, ERROR_MEMORY, "buffer '%s' of %.1f MiB: the system has no memory left", name,
                      (f64)buffer->bytes / MIB);
            buffer_destroy(buffer);
            return NULL;
        }
    }
    if (!allocate(buffer, buffer->memory, error)) {
        buffer_destroy(buffer);
        return NULL;
    }
    return buffer;
}

Buffer *buffer_wrap(Device *device, const char *name, void *memory, u64 bytes, Error *error)
{
    Buffer *buffer = prepare(device, name, bytes, error);
    if (!buffer)
        return NULL;
    const u32 align = device->info.address_align;
    const bool in_place =
        device->info.type == DEVICE_CPU && bytes > 0 && align > 0 && (uintptr_t)memory % align == 0;
    if (!allocate(buffer, in_place ? memory : NULL, error) ||
        (!in_place && !buffer_upload(buffer, 0, memory, bytes, error))) {
        buffer_destroy(buffer);
        return NULL;
    }
    return buffer;
}

void buffer_destroy(Buffer *buffer)
{
    if (!buffer)
        return;
    if (buffer->mem) {
        // Memory of ours must not go while a launch still uses it.
        if (buffer->memory)
            clFinish(buffer->device->queue);
        clReleaseMemObject(buffer->mem);
    }
    device_memory_free(buffer->memory, buffer->memory_bytes);
    unlink_buffer(buffer);
    free(buffer);
}

const char *buffer_name(const Buffer *buffer)
{
    return buffer->name;
}

u64 buffer_bytes(const Buffer *buffer)
{
    return buffer->bytes;
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

bool buffer_fill_u32(Buffer *buffer, u64 offset, u32 value, u64 bytes, Error *error)
{
    if (!in_range(buffer, offset, bytes, "a fill", error))
        return false;
    if (bytes == 0)
        return true;
    const cl_int status = clEnqueueFillBuffer(buffer->device->queue, buffer->mem, &value, sizeof value,
                                              offset, bytes, 0, NULL, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clEnqueueFillBuffer", "buffer '%s' of %.1f MiB", buffer->name,
                            (f64)buffer->bytes / MIB);
    return true;
}

const Buffer *device_buffers(const Device *device)
{
    return device->buffers;
}

const Buffer *buffer_next(const Buffer *buffer)
{
    return buffer->next;
}
