#define _DEFAULT_SOURCE // MAP_ANONYMOUS, madvise

#include "device/buffer.h"

#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "device/internal.h"

static const f64 MIB = 1024.0 * 1024.0;
static const u64 HUGE_PAGE = 2u << 20;

// Memory that a CPU device can use in place: what fills a huge page begins with one and is in huge pages
// where the system grants them; address space beyond the alignment is given back. NULL where there is none.
static void *memory_alloc(u64 bytes)
{
    if (bytes > SIZE_MAX - 2 * HUGE_PAGE)
        return NULL;
    const bool huge = bytes >= HUGE_PAGE;
    const size_t spare = huge ? HUGE_PAGE : 0;
    unsigned char *base =
        mmap(NULL, bytes + spare, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (base == MAP_FAILED)
        return NULL;
    if (!huge)
        return base;
    // What is kept ends with a page, as munmap wants addresses of pages.
    const size_t page = (size_t)sysconf(_SC_PAGESIZE);
    const size_t kept = (bytes + page - 1) / page * page;
    const size_t before = (size_t)(-(uintptr_t)base & (HUGE_PAGE - 1));
    const size_t whole = (bytes + spare + page - 1) / page * page;
    if (before > 0)
        munmap(base, before);
    if (whole > before + kept)
        munmap(base + before + kept, whole - before - kept);
    madvise(base + before, kept, MADV_HUGEPAGE); // a wish; slower without, not wrong
    return base + before;
}

static void memory_free(void *memory, u64 bytes)
{
    if (memory)
        munmap(memory, bytes);
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

// The memory of a buffer whose other members are set.
static bool allocate(Buffer *buffer, Error *error)
{
    const Device *device = buffer->device;
    if (device->info.type == DEVICE_CPU) {
        buffer->memory = memory_alloc(buffer->bytes);
        if (!buffer->memory)
            return error_set(error, ERROR_MEMORY, "buffer '%s' of %.1f MiB: the system has no memory left",
                             buffer->name, (f64)buffer->bytes / MIB);
    }
    const cl_mem_flags flags = CL_MEM_READ_WRITE | (buffer->memory ? CL_MEM_USE_HOST_PTR : 0);
    cl_int status;
    buffer->mem = clCreateBuffer(device->context, flags, buffer->bytes, buffer->memory, &status);
    if (status == CL_INVALID_BUFFER_SIZE || status == CL_OUT_OF_RESOURCES)
        status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateBuffer", "buffer '%s' of %.1f MiB on %s", buffer->name,
                            (f64)buffer->bytes / MIB, device->info.name);
    return true;
}

Buffer *buffer_create(Device *device, const char *name, u64 bytes, Error *error)
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
    device->bytes += bytes;
    if (device->bytes > device->bytes_peak)
        device->bytes_peak = device->bytes;
    if (!allocate(buffer, error)) {
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
    memory_free(buffer->memory, buffer->bytes);
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
