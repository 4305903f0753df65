// Runs kernel code on a device for tests: a source string in, arrays in and out. Knows nothing of what is
// tested and uses plain OpenCL, so that it can judge the product's own use of it.
//
//   int main(void)
//   {
//       const struct CMUnitTest tests[] = { cmocka_unit_test(my_test) };
//       return kernel_run_tests(tests, sizeof tests / sizeof *tests);
//   }
//   static void my_test(void **state)
//   {
//       KernelProgram *program = kernel_program_create(*state, "#include \"base/math.h\"\n"
//           "kernel void f(global const float *x, global float *y)\n"
//           "{ size_t i = get_global_id(0) * LANES; VF_STORE(vf_exp(VF_LOAD(x + i)), y + i); }", 8);
//       const KernelArg args[] = { kernel_in(x, sizeof x), kernel_out(y, sizeof y) };
//       kernel_run(program, "f", count / 8, args, 2);
//       kernel_program_destroy(program);
//   }
#ifndef CLRT_TESTS_KERNEL_HARNESS_H
#define CLRT_TESTS_KERNEL_HARNESS_H

#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <cmocka.h>

enum { KERNEL_TEST_SKIP = 77 };

typedef struct KernelDevice KernelDevice;
typedef struct KernelProgram KernelProgram;

typedef struct {
    void *data;
    size_t bytes;
    enum { KERNEL_VALUE, KERNEL_IN, KERNEL_OUT, KERNEL_IN_OUT } kind;
} KernelArg;

static inline KernelArg kernel_in(const void *data, size_t bytes)
{
    return (KernelArg){ (void *)(uintptr_t)data, bytes, KERNEL_IN };
}
static inline KernelArg kernel_out(void *data, size_t bytes)
{
    return (KernelArg){ data, bytes, KERNEL_OUT };
}
static inline KernelArg kernel_in_out(void *data, size_t bytes)
{
    return (KernelArg){ data, bytes, KERNEL_IN_OUT };
}
// An argument that is no buffer: *value must live until kernel_run returns.
static inline KernelArg kernel_value(const void *value, size_t bytes)
{
    return (KernelArg){ (void *)(uintptr_t)value, bytes, KERNEL_VALUE };
}

// The device that CLRT_DEVICE names by its index among all devices, or the first one. NULL, with the reason
// on stdout, where there is none: the test then returns KERNEL_TEST_SKIP.
KernelDevice *kernel_device_create(void);
void kernel_device_destroy(KernelDevice *device);

// Runs count tests, each with such a device as its *state. What main returns: the number of tests that
// failed, or KERNEL_TEST_SKIP.
int kernel_run_tests(const struct CMUnitTest *tests, size_t count);

// Builds source with -DLANES=lanes and kernels/ as the include folder, with the product's options.
// A failed build prints the log and fails the running test. Further options may be NULL.
KernelProgram *kernel_program_create_with(KernelDevice *device, const char *source, int lanes,
                                          const char *options);
KernelProgram *kernel_program_create(KernelDevice *device, const char *source, int lanes);
void kernel_program_destroy(KernelProgram *program);

// Runs the kernel of that name with items work-items and copies outputs back. Gives the seconds that the
// launch took, without the copies. Any OpenCL error fails the running test.
double kernel_run(KernelProgram *program, const char *kernel, size_t items, const KernelArg *args,
                  size_t count);

#endif
