// What --list-devices prints of a made-up list: devices that cannot be used, platforms without any, and names
// that are no UTF-8.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>
#include <jansson.h>

#include "cli/devices.h"

static DeviceInfo DEVICES[] = {
    {.index = 0,
     .platform = 0,
     .device = 0,
     .name = "Fast Card",
     .platform_name = "Some Maker",
     .driver = "12.3",
     .type = DEVICE_GPU,
     .memory = (u64)24 << 30,
     .allocation_max = (u64)6 << 30,
     .compute_units = 80,
     .float_width = 1,
     .fp64 = true,
     .exact_divide = true},
    {.index = 1,
     .platform = 0,
     .device = 1,
     .name = "Old \xFF Card",
     .platform_name = "Some Maker",
     .driver = "1.0",
     .type = DEVICE_OTHER,
     .memory = 512u << 20,
     .allocation_max = 128u << 20,
     .compute_units = 2,
     .float_width = 4,
     .unusable = "its driver has no compiler"},
};

static PlatformInfo PLATFORMS[] = {
    {.name = "Some Maker", .version = "OpenCL 3.0", .device_count = 2},
    {.name = "Empty", .version = "OpenCL 1.2", .problem = "no devices"},
};

static const DeviceList LIST = {DEVICES, 2, PLATFORMS, 2};

static void prints_a_line_a_device(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    devices_print(&LIST, stream);
    fclose(stream);
    assert_string_equal(text,
                        "0  0:0  GPU  Fast Card\n"
                        "     Some Maker, driver 12.3\n"
                        "     80 compute units, 24576 MiB of memory, at most 6144 MiB a buffer, "
                        "exact divide, fp64\n"
                        "1  0:1  other  Old \xFF Card\n"
                        "     Some Maker, driver 1.0\n"
                        "     2 compute units, 512 MiB of memory, at most 128 MiB a buffer, inexact divide\n"
                        "     cannot be used: its driver has no compiler\n"
                        "platform 1, Empty: no devices\n");
    free(text);
}

static const char *text_member(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    assert_non_null(text);
    return text;
}

static json_int_t number_member(const json_t *object, const char *key)
{
    const json_t *number = json_object_get(object, key);
    assert_true(json_is_integer(number));
    return json_integer_value(number);
}

static void prints_json_that_can_be_read(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    Error error;
    assert_true(devices_print_json(&LIST, stream, &error));
    fclose(stream);
    json_error_t reason;
    json_t *all = json_loads(text, 0, &reason);
    if (!all)
        fail_msg("%s in %s", reason.text, text);
    const json_t *devices = json_object_get(all, "devices"), *platforms = json_object_get(all, "platforms");
    assert_int_equal(json_array_size(devices), 2);
    assert_int_equal(json_array_size(platforms), 2);

    const json_t *fast = json_array_get(devices, 0), *old = json_array_get(devices, 1);
    assert_int_equal(number_member(fast, "index"), 0);
    assert_string_equal(text_member(fast, "name"), "Fast Card");
    assert_string_equal(text_member(fast, "type"), "GPU");
    assert_true(number_member(fast, "memory_bytes") == (json_int_t)24 << 30);
    assert_true(number_member(fast, "allocation_max_bytes") == (json_int_t)6 << 30);
    assert_true(json_is_true(json_object_get(fast, "exact_divide")));
    assert_true(json_is_null(json_object_get(fast, "unusable")));
    assert_string_equal(text_member(old, "name"), "?"); // is no UTF-8
    assert_int_equal(number_member(old, "device"), 1);
    assert_true(json_is_false(json_object_get(old, "fp64")));
    assert_string_equal(text_member(old, "unusable"), "its driver has no compiler");
    assert_true(json_is_null(json_object_get(json_array_get(platforms, 0), "problem")));
    assert_string_equal(text_member(json_array_get(platforms, 1), "problem"), "no devices");
    json_decref(all);
    free(text);
}

// A full disk is no lack of memory.
static void says_what_could_not_be_written(void **state)
{
    (void)state;
    FILE *full = fopen("/dev/full", "w");
    if (!full)
        skip();
    setvbuf(full, NULL, _IONBF, 0);
    Error error;
    assert_false(devices_print_json(&LIST, full, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_non_null(strstr(error.text, "No space left on device"));
    fclose(full);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(prints_a_line_a_device),
        cmocka_unit_test(prints_json_that_can_be_read),
        cmocka_unit_test(says_what_could_not_be_written),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
