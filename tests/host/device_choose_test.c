// device_choose on a list of made-up devices.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "device/list.h"

static DeviceInfo DEVICES[] = {
    {.index = 0, .platform = 0, .device = 0, .name = "pthread-EPYC 7763",
     .platform_name = "Portable Language"},
    {.index = 1, .platform = 1, .device = 0, .name = "Arc A770", .platform_name = "Intel OpenCL",
     .type = DEVICE_GPU, .unusable = "its driver has no compiler"},
    {.index = 2, .platform = 1, .device = 1, .name = "Arc A770M", .platform_name = "Intel OpenCL",
     .type = DEVICE_GPU},
    {.index = 3, .platform = 2, .device = 0, .name = "RTX 4090", .platform_name = "NVIDIA CUDA",
     .type = DEVICE_GPU},
    {.index = 4, .platform = 2, .device = 1, .name = "RTX 4090", .platform_name = "NVIDIA CUDA",
     .type = DEVICE_GPU},
    {.index = 5, .platform = 3, .device = 0, .name = "FPGA", .platform_name = "Boards", .type = DEVICE_OTHER},
};

static DeviceList list_of(u32 first, u32 count)
{
    return (DeviceList){.devices = DEVICES + first, .count = count};
}

static void chooses(const char *spec, u32 expected)
{
    const DeviceList list = list_of(0, 6);
    u32 index = 99;
    Error error = {0};
    if (!device_choose(&list, spec, &index, &error))
        fail_msg("%s: %s", spec ? spec : "default", error.text);
    assert_int_equal(index, expected);
}

static void refuses(const char *spec, ErrorCode code, const char *part, const char *other_part)
{
    const DeviceList list = list_of(0, 6);
    u32 index = 99;
    Error error = {0};
    assert_false(device_choose(&list, spec, &index, &error));
    assert_int_equal(error.code, code);
    assert_int_equal(index, 99);
    if (!strstr(error.text, part) || !strstr(error.text, other_part))
        fail_msg("'%s' and '%s' should stand in: %s", part, other_part, error.text);
}

static void chooses_by_place_type_and_name(void **state)
{
    (void)state;
    chooses(NULL, 2); // the first GPU that works
    chooses("gpu", 2);
    chooses("GPU", 2);
    chooses("cpu", 0);
    chooses("0", 0);
    chooses("4", 4);
    chooses("2:1", 4);
    chooses("1:1", 2);
    chooses("epyc", 0);
    chooses("a770m", 2);
    chooses("Portable", 0);
    chooses("board", 5);
}

static void falls_back_to_a_cpu_only_by_default(void **state)
{
    (void)state;
    const DeviceList list = list_of(0, 2);
    u32 index = 99;
    Error error = {0};
    assert_true(device_choose(&list, NULL, &index, &error));
    assert_int_equal(index, 0);
    assert_false(device_choose(&list, "gpu", &index, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
}

static void refuses_what_is_not_there(void **state)
{
    (void)state;
    refuses("6", ERROR_DEVICE, "no device '6'", "3  2:0  GPU  RTX 4090 (NVIDIA CUDA)");
    refuses("0:1", ERROR_DEVICE, "no device '0:1'", "0  0:0  CPU");
    refuses("7763", ERROR_DEVICE, "no device '7763'", "EPYC 7763"); // digits are an index, never a name
    refuses("99999999999", ERROR_DEVICE, "no device", "RTX");
    refuses("radeon", ERROR_DEVICE, "no device 'radeon'",
            "Arc A770 (Intel OpenCL): its driver has no compiler");
    refuses("1:", ERROR_DEVICE, "no device '1:'", "RTX");
}

static void refuses_what_is_ambiguous(void **state)
{
    (void)state;
    refuses("rtx", ERROR_USAGE, "ambiguous", "4  2:1  GPU");
    refuses("RTX 4090", ERROR_USAGE, "ambiguous", "3  2:0  GPU");
    refuses("nvidia", ERROR_USAGE, "ambiguous", "4  2:1  GPU");
    refuses("all", ERROR_USAGE, "not supported yet", "all");
    refuses("", ERROR_USAGE, "empty", "");
}

static void ambiguity_lists_the_matches_only(void **state)
{
    (void)state;
    const DeviceList list = list_of(0, 6);
    u32 index;
    Error error = {0};
    assert_false(device_choose(&list, "intel", &index, &error));
    assert_non_null(strstr(error.text, "A770M"));
    assert_null(strstr(error.text, "RTX"));
}

static void says_why_a_device_is_unusable(void **state)
{
    (void)state;
    refuses("1", ERROR_DEVICE, "Arc A770", "no compiler");
    refuses("arc a770", ERROR_DEVICE, "Arc A770", "no compiler"); // the whole name goes before a part of one
    const DeviceList list = list_of(1, 1);
    u32 index;
    Error error = {0};
    assert_false(device_choose(&list, NULL, &index, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "no compiler"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(chooses_by_place_type_and_name),
        cmocka_unit_test(falls_back_to_a_cpu_only_by_default),
        cmocka_unit_test(refuses_what_is_not_there),
        cmocka_unit_test(refuses_what_is_ambiguous),
        cmocka_unit_test(ambiguity_lists_the_matches_only),
        cmocka_unit_test(says_why_a_device_is_unusable),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
