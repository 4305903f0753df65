#include "harness.h"

#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { MAX_ARGS = 16, MAX_DEVICES = 64, MAX_OPTIONS = 4096 };

struct KernelDevice {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    bool cpu;
    bool correctly_rounded; // the device takes the option for correctly rounded divide and square root
    char name[256];
};

struct KernelProgram {
    KernelDevice *device;
    cl_program program;
};

static void check(cl_int status, const char *call)
{
    if (status != CL_SUCCESS)
        fail_msg("%s: OpenCL error %d", call, (int)status);
}

static size_t list_devices(cl_device_id *devices)
{
    cl_platform_id platforms[MAX_DEVICES];
    cl_uint platform_count = 0;
    if (clGetPlatformIDs(MAX_DEVICES, platforms, &platform_count) != CL_SUCCESS)
        return 0;
    size_t count = 0;
    for (cl_uint p = 0; p < platform_count && p < MAX_DEVICES && count < MAX_DEVICES; p++) {
        const cl_uint room = (cl_uint)(MAX_DEVICES - count);
        cl_uint found = 0;
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, room, devices + count, &found) == CL_SUCCESS)
            count += found < room ? found : room;
    }
    return count;
}

KernelDevice *kernel_device_create(void)
{
    cl_device_id devices[MAX_DEVICES];
    const size_t count = list_devices(devices);
    const char *choice = getenv("CLRT_DEVICE");
    char *end = NULL;
    const unsigned long index = choice ? strtoul(choice, &end, 10) : 0;
    if (choice && (end == choice || *end)) {
        printf("skipped: CLRT_DEVICE=%s is no index\n", choice);
        return NULL;
    }
    if (index >= count) {
        printf("skipped: no OpenCL device %lu, there are %zu\n", index, count);
        return NULL;
    }
    KernelDevice *device = calloc(1, sizeof *device);
    if (!device)
        return NULL;
    device->id = devices[index];
    cl_device_fp_config config = 0;
    clGetDeviceInfo(device->id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof config, &config, NULL);
    device->correctly_rounded = (config & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
    cl_device_type type = 0;
    clGetDeviceInfo(device->id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    device->cpu = (type & CL_DEVICE_TYPE_CPU) != 0;
    clGetDeviceInfo(device->id, CL_DEVICE_NAME, sizeof device->name - 1, device->name, NULL);
    cl_int status;
    device->context = clCreateContext(NULL, 1, &device->id, NULL, NULL, &status);
    if (status == CL_SUCCESS)
        device->queue = clCreateCommandQueue(device->context, device->id, 0, &status);
    if (status != CL_SUCCESS) {
        printf("skipped: %s cannot be used, OpenCL error %d\n", device->name, (int)status);
        kernel_device_destroy(device);
        return NULL;
    }
    return device;
}

void kernel_device_destroy(KernelDevice *device)
{
    if (!device)
        return;
    if (device->queue)
        clReleaseCommandQueue(device->queue);
    if (device->context)
        clReleaseContext(device->context);
    free(device);
}

int kernel_run_tests(const struct CMUnitTest *tests, size_t count)
{
    KernelDevice *device = kernel_device_create();
    if (!device)
        return KERNEL_TEST_SKIP;
    printf("device: %s\n", device->name);
    struct CMUnitTest *with_device = calloc(count, sizeof *with_device);
    int failed = (int)count;
    if (with_device) {
        memcpy(with_device, tests, count * sizeof *with_device);
        for (size_t i = 0; i < count; i++)
            with_device[i].initial_state = device;
        failed = _cmocka_run_group_tests("kernel tests", with_device, count, NULL, NULL);
    }
    free(with_device);
    kernel_device_destroy(device);
    return failed;
}

static void print_build_log(const KernelDevice *device, cl_program program)
{
    size_t size = 0;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    char *log = calloc(size + 1, 1);
    if (!log)
        return;
    clGetProgramBuildInfo(program, device->id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    printf("%s\n", log);
    free(log);
}

KernelProgram *kernel_program_create_with(KernelDevice *device, const char *source, int lanes,
                                          const char *options)
{
    char text[MAX_OPTIONS];
    const char *rounding = device->correctly_rounded ? "-cl-fp32-correctly-rounded-divide-sqrt" : "";
    const int length = snprintf(text, sizeof text, "-cl-std=CL1.2 -I . -DLANES=%d %s %s", lanes, rounding,
                                options ? options : "");
    assert_in_range(length, 1, MAX_OPTIONS - 1);
    // Drivers split options at spaces, which the path may have.
    assert_int_equal(chdir(KERNEL_SOURCE_DIR), 0);
    cl_int status;
    cl_program built = clCreateProgramWithSource(device->context, 1, &source, NULL, &status);
    check(status, "clCreateProgramWithSource");
    status = clBuildProgram(built, 1, &device->id, text, NULL, NULL);
    if (status != CL_SUCCESS) {
        print_build_log(device, built);
        clReleaseProgram(built);
    }
    check(status, "clBuildProgram");
    KernelProgram *program = calloc(1, sizeof *program);
    assert_non_null(program);
    program->device = device;
    program->program = built;
    return program;
}

KernelProgram *kernel_program_create(KernelDevice *device, const char *source, int lanes)
{
    return kernel_program_create_with(device, source, lanes, NULL);
}

void kernel_program_destroy(KernelProgram *program)
{
    if (!program)
        return;
    clReleaseProgram(program->program);
    free(program);
}

static cl_mem set_arg(const KernelDevice *device, cl_kernel kernel, cl_uint index, const KernelArg *arg)
{
    if (arg->kind == KERNEL_VALUE) {
        check(clSetKernelArg(kernel, index, arg->bytes, arg->data), "clSetKernelArg");
        return NULL;
    }
    // Outputs start with the caller's bytes too, so that what the kernel leaves alone comes back unchanged.
    cl_int status;
    cl_mem buffer = clCreateBuffer(device->context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, arg->bytes,
                                   arg->data, &status);
    check(status, "clCreateBuffer");
    check(clSetKernelArg(kernel, index, sizeof buffer, &buffer), "clSetKernelArg");
    return buffer;
}

static double now(void)
{
    struct timespec time;
    timespec_get(&time, TIME_UTC);
    return (double)time.tv_sec + 1e-9 * (double)time.tv_nsec;
}

double kernel_run(KernelProgram *program, const char *kernel, size_t items, const KernelArg *args,
                  size_t count)
{
    const KernelDevice *device = program->device;
    assert_in_range(count, 1, MAX_ARGS);
    cl_int status;
    cl_kernel created = clCreateKernel(program->program, kernel, &status);
    check(status, kernel);
    cl_mem buffers[MAX_ARGS] = { NULL };
    for (size_t i = 0; i < count; i++)
        buffers[i] = set_arg(device, created, (cl_uint)i, &args[i]);
    // Groups of one on a CPU: there a driver keeps what all items of a group hold on the stack of a thread.
    const size_t one = 1;
    const double start = now();
    check(clEnqueueNDRangeKernel(device->queue, created, 1, NULL, &items, device->cpu ? &one : NULL, 0, NULL,
                                 NULL),
          kernel);
    check(clFinish(device->queue), "clFinish");
    const double seconds = now() - start;
    for (size_t i = 0; i < count; i++) {
        if (args[i].kind == KERNEL_OUT || args[i].kind == KERNEL_IN_OUT)
            check(clEnqueueReadBuffer(device->queue, buffers[i], CL_TRUE, 0, args[i].bytes, args[i].data, 0,
                                      NULL, NULL), "clEnqueueReadBuffer");
        if (buffers[i])
            clReleaseMemObject(buffers[i]);
    }
    clReleaseKernel(created);
    return seconds;
}
