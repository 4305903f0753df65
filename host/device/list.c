#include "device/list.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "device/status.h"

static const cl_int PLATFORM_NOT_FOUND = -1001; // CL_PLATFORM_NOT_FOUND_KHR of cl_khr_icd

#define ADVICE \
    "install the driver of a GPU, or PoCL for the CPU:\n" \
    "  Debian, Ubuntu: apt install pocl-opencl-icd     Fedora: dnf install pocl\n" \
    "  Arch: pacman -S pocl                            openSUSE: zypper install pocl"

// Texts of drivers may be longer than ours and have blanks around them.
static void copy_trimmed(char *to, size_t size, const char *from)
{
    from += strspn(from, " \t");
    size_t length = strlen(from);
    while (length > 0 && (from[length - 1] == ' ' || from[length - 1] == '\t'))
        length--;
    if (length >= size)
        length = size - 1;
    memcpy(to, from, length);
    to[length] = '\0';
}

static void platform_text(cl_platform_id id, cl_platform_info what, char *to, size_t size)
{
    char text[4096] = "";
    if (clGetPlatformInfo(id, what, sizeof text, text, NULL) != CL_SUCCESS)
        copy_trimmed(text, sizeof text, "?");
    copy_trimmed(to, size, text);
}

static void device_text(cl_device_id id, cl_device_info what, char *to, size_t size)
{
    char text[4096] = "";
    if (clGetDeviceInfo(id, what, sizeof text, text, NULL) != CL_SUCCESS)
        copy_trimmed(text, sizeof text, "?");
    copy_trimmed(to, size, text);
}

// A number of a device, of whatever integer type; 0 where the driver does not tell.
static u64 device_number(cl_device_id id, cl_device_info what)
{
    union {
        u32 small;
        u64 large;
    } value = {.large = 0};
    size_t size = 0;
    if (clGetDeviceInfo(id, what, sizeof value, &value, &size) != CL_SUCCESS)
        return 0;
    return size == sizeof value.small ? value.small : value.large;
}

static void read_device(DeviceInfo *info, cl_platform_id platform, cl_device_id id)
{
    info->platform_id = platform;
    info->device_id = id;
    device_text(id, CL_DEVICE_NAME, info->name, sizeof info->name);
    platform_text(platform, CL_PLATFORM_NAME, info->platform_name, sizeof info->platform_name);
    device_text(id, CL_DRIVER_VERSION, info->driver, sizeof info->driver);
    const cl_device_type type = device_number(id, CL_DEVICE_TYPE);
    info->type = type & CL_DEVICE_TYPE_GPU   ? DEVICE_GPU
                 : type & CL_DEVICE_TYPE_CPU ? DEVICE_CPU
                                             : DEVICE_OTHER;
    info->memory = device_number(id, CL_DEVICE_GLOBAL_MEM_SIZE);
    info->allocation_max = device_number(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE);
    info->compute_units = (u32)device_number(id, CL_DEVICE_MAX_COMPUTE_UNITS);
    info->float_width = (u32)device_number(id, CL_DEVICE_PREFERRED_VECTOR_WIDTH_FLOAT);
    info->fp64 = device_number(id, CL_DEVICE_DOUBLE_FP_CONFIG) != 0;
    const cl_device_fp_config single = device_number(id, CL_DEVICE_SINGLE_FP_CONFIG);
    info->exact_divide = (single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    char version[128];
    device_text(id, CL_DEVICE_VERSION, version, sizeof version);
    unsigned major = 0, minor = 0;
    const bool known = sscanf(version, "OpenCL %u.%u", &major, &minor) == 2;
    const char *reason = "";
    if (!device_number(id, CL_DEVICE_AVAILABLE))
        reason = "the driver says that it is not available";
    else if (!device_number(id, CL_DEVICE_COMPILER_AVAILABLE))
        reason = "its driver has no compiler";
    else if (!device_number(id, CL_DEVICE_ENDIAN_LITTLE))
        reason = "it is big-endian";
    else if (!known || major < 1 || (major == 1 && minor < 2))
        reason = "its driver is older than OpenCL 1.2";
    copy_trimmed(info->unusable, sizeof info->unusable, reason);
}

// Appends the devices of a platform to the list; false where memory is exhausted. A platform that has none
// or fails to tell is described and passed over: another one may do.
static bool read_platform(DeviceList *list, PlatformInfo *platform, u32 number, cl_platform_id id)
{
    platform_text(id, CL_PLATFORM_NAME, platform->name, sizeof platform->name);
    platform_text(id, CL_PLATFORM_VERSION, platform->version, sizeof platform->version);
    cl_uint count = 0;
    cl_int status = clGetDeviceIDs(id, CL_DEVICE_TYPE_ALL, 0, NULL, &count);
    if (status != CL_SUCCESS || count == 0) {
        if (status == CL_DEVICE_NOT_FOUND || status == CL_SUCCESS)
            snprintf(platform->problem, sizeof platform->problem, "no devices");
        else
            snprintf(platform->problem, sizeof platform->problem, "clGetDeviceIDs: %s", status_name(status));
        return true;
    }
    cl_device_id *ids = calloc(count, sizeof *ids);
    DeviceInfo *grown = realloc(list->devices, (list->count + count) * sizeof *grown);
    if (grown)
        list->devices = grown;
    if (!ids || !grown) {
        free(ids);
        return false;
    }
    status = clGetDeviceIDs(id, CL_DEVICE_TYPE_ALL, count, ids, NULL);
    if (status != CL_SUCCESS) {
        snprintf(platform->problem, sizeof platform->problem, "clGetDeviceIDs: %s", status_name(status));
        count = 0;
    }
    for (u32 i = 0; i < count; i++) {
        DeviceInfo *info = &list->devices[list->count];
        memset(info, 0, sizeof *info);
        info->index = list->count++;
        info->platform = number;
        info->device = i;
        read_device(info, id, ids[i]);
    }
    platform->device_count = count;
    free(ids);
    return true;
}

static bool read_platforms(DeviceList *list, Error *error)
{
    cl_uint count = 0;
    cl_int status = clGetPlatformIDs(0, NULL, &count);
    if (status == PLATFORM_NOT_FOUND || (status == CL_SUCCESS && count == 0))
        return error_set(error, ERROR_DEVICE, "no OpenCL platform found; " ADVICE);
    if (status != CL_SUCCESS)
        return status_error(error, status, "clGetPlatformIDs", ADVICE);
    cl_platform_id *ids = calloc(count, sizeof *ids);
    list->platforms = calloc(count, sizeof *list->platforms);
    bool memory = ids && list->platforms;
    if (memory)
        status = clGetPlatformIDs(count, ids, NULL);
    for (; memory && status == CL_SUCCESS && list->platform_count < count; list->platform_count++) {
        const u32 number = list->platform_count;
        memory = read_platform(list, &list->platforms[number], number, ids[number]);
    }
    free(ids);
    if (!memory)
        return error_set(error, ERROR_MEMORY, "no memory for the list of devices");
    if (status != CL_SUCCESS)
        return status_error(error, status, "clGetPlatformIDs", ADVICE);
    if (list->count > 0)
        return true;
    const PlatformInfo *first = &list->platforms[0];
    return error_set(error, ERROR_DEVICE, "no OpenCL device found: platform '%s': %s%s; " ADVICE, first->name,
                     first->problem, list->platform_count > 1 ? ", nor has any other platform devices" : "");
}

DeviceList *device_list_create(Error *error)
{
    DeviceList *list = calloc(1, sizeof *list);
    if (!list) {
        error_set(error, ERROR_MEMORY, "no memory for the list of devices");
        return NULL;
    }
    if (!read_platforms(list, error)) {
        device_list_destroy(list);
        return NULL;
    }
    return list;
}

void device_list_destroy(DeviceList *list)
{
    if (!list)
        return;
    free(list->devices);
    free(list->platforms);
    free(list);
}

const char *device_type_name(DeviceType type)
{
    return type == DEVICE_CPU ? "CPU" : type == DEVICE_GPU ? "GPU" : "other";
}
