// Status codes of OpenCL as words, and as errors with the exit status that they mean.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "device/status.h"

static void names_codes(void **state)
{
    (void)state;
    assert_string_equal(status_name(CL_SUCCESS), "CL_SUCCESS");
    assert_string_equal(status_name(CL_DEVICE_NOT_FOUND), "CL_DEVICE_NOT_FOUND");
    assert_string_equal(status_name(CL_BUILD_PROGRAM_FAILURE), "CL_BUILD_PROGRAM_FAILURE");
    assert_string_equal(status_name(CL_INVALID_VALUE), "CL_INVALID_VALUE");
    assert_string_equal(status_name(CL_INVALID_WORK_GROUP_SIZE), "CL_INVALID_WORK_GROUP_SIZE");
    assert_string_equal(status_name(-12345), "unknown OpenCL error");
    assert_string_equal(status_name(1), "unknown OpenCL error");
}

static void tells_memory_from_the_rest(void **state)
{
    (void)state;
    Error error;
    assert_false(status_error(&error, CL_MEM_OBJECT_ALLOCATION_FAILURE, "clCreateBuffer", "'%s'", "film"));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_string_equal(error.text, "clCreateBuffer: CL_MEM_OBJECT_ALLOCATION_FAILURE (-4): 'film'");
    assert_false(status_error(&error, CL_OUT_OF_HOST_MEMORY, "clFinish", "x"));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_false(status_error(&error, CL_INVALID_KERNEL_NAME, "clCreateKernel", "%d of %d", 1, 2));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_string_equal(error.text, "clCreateKernel: CL_INVALID_KERNEL_NAME (-46): 1 of 2");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_codes),
        cmocka_unit_test(tells_memory_from_the_rest),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
