#include "device/device.h"

#include <stdlib.h>

#include "device/internal.h"

// Narrows a CPU device to `threads` of its compute units.
static bool take_part(Device *device, u32 threads, Error *error)
{
    const cl_device_partition_property counts[] = {CL_DEVICE_PARTITION_BY_COUNTS, (intptr_t)threads,
                                                   CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    cl_device_id part;
    const cl_int status = clCreateSubDevices(device->id, counts, 1, &part, NULL);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateSubDevices", "%s cannot be bounded to %u threads",
                            device->info.name, threads);
    device->id = part;
    device->is_part = true;
    device->info.compute_units = threads;
    return true;
}

static bool open_device(Device *device, const DeviceOptions *options, Error *error)
{
    const DeviceInfo *info = &device->info;
    if (info->unusable[0])
        return error_set(error, ERROR_DEVICE, "%s cannot be used: %s", info->name, info->unusable);
    const u32 threads = info->type == DEVICE_CPU ? options->threads : 0;
    if (threads > 0 && threads < info->compute_units && !take_part(device, threads, error))
        return false;
    const cl_context_properties platform = (cl_context_properties)info->platform_id;
    const cl_context_properties properties[] = {CL_CONTEXT_PLATFORM, platform, 0};
    cl_int status;
    device->context = clCreateContext(properties, 1, &device->id, NULL, NULL, &status);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateContext", "%s", info->name);
    device->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clCreateCommandQueue", "%s", info->name);
    return true;
}

Device *device_open(const DeviceInfo *info, const DeviceOptions *options, Error *error)
{
    Device *device = calloc(1, sizeof *device);
    if (!device) {
        error_set(error, ERROR_MEMORY, "no memory for the device");
        return NULL;
    }
    device->info = *info;
    device->id = info->device_id;
    if (!open_device(device, options, error)) {
        device_close(device);
        return NULL;
    }
    return device;
}

void device_close(Device *device)
{
    if (!device)
        return;
    if (device->queue)
        clReleaseCommandQueue(device->queue);
    if (device->context)
        clReleaseContext(device->context);
    if (device->is_part)
        clReleaseDevice(device->id);
    free(device);
}

const DeviceInfo *device_info(const Device *device)
{
    return &device->info;
}

bool device_finish(Device *device, Error *error)
{
    const cl_int status = clFinish(device->queue);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clFinish", "%s", device->info.name);
    return true;
}

u64 device_bytes(const Device *device)
{
    return device->bytes;
}

u64 device_bytes_peak(const Device *device)
{
    return device->bytes_peak;
}
