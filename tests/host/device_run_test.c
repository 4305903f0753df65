// Device, Buffer, Program and Kernel on the device that CLRT_DEVICE names; skipped (77) without one.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "base/memory.h"
#include "device/buffer.h"
#include "device/program.h"

enum { SKIPPED = 77, COUNT = 1000 };

static const char SOURCE[] =
    "kernel void scale(global const float *from, global float *to, uint factor, uint count)\n"
    "{ const uint i = get_global_id(0); if (i < count) to[i] = from[i] * factor; }\n"
    "kernel void sum_group(global const uint *from, global uint *sums)\n"
    "{ local uint scratch[16]; const uint l = get_local_id(0); scratch[l] = from[get_global_id(0)];\n"
    "  barrier(CLK_LOCAL_MEM_FENCE);\n"
    "  if (l == 0) { uint s = 0; for (uint i = 0; i < get_local_size(0); i++) s += scratch[i];\n"
    "    sums[get_group_id(0)] = s; } }\n";

typedef struct Fixture {
    DeviceInfo info;
    Device *device;
    Program *program;
} Fixture;

static void check(bool ok, const Error *error)
{
    if (!ok)
        fail_msg("%s", error->text);
}

static int setup(void **state)
{
    static Error error;
    Fixture *fixture = *state;
    const DeviceOptions options = {.threads = 0};
    fixture->device = device_open(&fixture->info, &options, &error);
    check(fixture->device, &error);
    fixture->program = program_create(fixture->device, SOURCE, strlen(SOURCE), "", &error);
    check(fixture->program, &error);
    return 0;
}

static int teardown(void **state)
{
    Fixture *fixture = *state;
    program_destroy(fixture->program);
    assert_int_equal(device_bytes(fixture->device), 0);
    device_close(fixture->device);
    return 0;
}

static void runs_a_kernel_by_names(void **state)
{
    Fixture *fixture = *state;
    Error error;
    f32 from[COUNT], to[COUNT];
    for (u32 i = 0; i < COUNT; i++)
        from[i] = (f32)i;
    Buffer *in = buffer_create(fixture->device, "in", sizeof from, &error);
    Buffer *out = buffer_create(fixture->device, "out", sizeof to, &error);
    Kernel *kernel = kernel_create(fixture->program, "scale", &error);
    assert_true(in && out && kernel);
    check(buffer_upload(in, 0, from, sizeof from, &error), &error);
    check(kernel_set_u32(kernel, "count", COUNT, &error), &error);
    check(kernel_set_buffer(kernel, "to", out, &error), &error);
    check(kernel_set_buffer(kernel, "from", in, &error), &error);
    check(kernel_set_u32(kernel, "factor", 3, &error), &error);
    check(kernel_launch(kernel, COUNT, 64, &error), &error); // 1024 work-items, the last 24 idle
    check(buffer_download(out, 0, to, sizeof to, &error), &error);
    for (u32 i = 0; i < COUNT; i++)
        assert_true(to[i] == 3.0f * (f32)i);
    check(kernel_launch(kernel, 0, 0, &error), &error);
    check(device_finish(fixture->device, &error), &error);
    kernel_destroy(kernel);
    buffer_destroy(out);
    buffer_destroy(in);
}

static void runs_groups(void **state)
{
    Fixture *fixture = *state;
    Error error;
    const u32 numbers[8] = {1, 2, 3, 4, 5, 6, 7, 8};
    u32 sums[2];
    Buffer *in = buffer_create(fixture->device, "in", sizeof numbers, &error);
    Buffer *out = buffer_create(fixture->device, "out", sizeof sums, &error);
    Kernel *kernel = kernel_create(fixture->program, "sum_group", &error);
    assert_true(in && out && kernel);
    check(buffer_upload(in, 0, numbers, sizeof numbers, &error), &error);
    check(kernel_set_buffer(kernel, "from", in, &error), &error);
    check(kernel_set_buffer(kernel, "sums", out, &error), &error);
    check(kernel_launch(kernel, 8, 4, &error), &error);
    check(buffer_download(out, 0, sums, sizeof sums, &error), &error);
    assert_int_equal(sums[0], 10);
    assert_int_equal(sums[1], 26);
    kernel_destroy(kernel);
    buffer_destroy(out);
    buffer_destroy(in);
}

static void refuses_wrong_arguments(void **state)
{
    Fixture *fixture = *state;
    Error error;
    Kernel *kernel = kernel_create(fixture->program, "scale", &error);
    assert_non_null(kernel);
    assert_false(kernel_set_u32(kernel, "cuont", 1, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "'cuont'; it has: from, to, factor, count"));
    assert_true(kernel_has(kernel, "to"));
    assert_false(kernel_has(kernel, "t"));
    assert_false(kernel_set_u32(kernel, "from", 1, &error));
    assert_non_null(strstr(error.text, "clSetKernelArg: CL_INVALID_"));
    assert_non_null(strstr(error.text, "argument 'from' of 4 bytes"));
    check(kernel_set_u32(kernel, "count", 1, &error), &error);
    assert_false(kernel_launch(kernel, 1, 0, &error));
    assert_non_null(strstr(error.text, "kernel 'scale': argument 'from' has not been set"));
    kernel_destroy(kernel);
    assert_null(kernel_create(fixture->program, "scael", &error));
    assert_non_null(strstr(error.text, "'scael'"));
    assert_non_null(strstr(error.text, "CL_INVALID_KERNEL_NAME"));
}

static void reports_a_failed_build(void **state)
{
    Fixture *fixture = *state;
    static const char BROKEN[] = "#line 41 \"kernels/stages/broken.cl\"\n"
                                 "kernel void f(global float *x)\n{ x[0] = not_declared; }\n";
    Error error;
    assert_null(program_create(fixture->device, BROKEN, strlen(BROKEN), "-DHAS_X=1", &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "CL_BUILD_PROGRAM_FAILURE"));
    assert_non_null(strstr(error.text, "-DHAS_X=1"));
    assert_non_null(strstr(error.text, "kernels/stages/broken.cl"));
    assert_non_null(strstr(error.text, "not_declared"));
}

static void keeps_account_of_buffers(void **state)
{
    Fixture *fixture = *state;
    Error error;
    Buffer *a = buffer_create(fixture->device, "a", 4 << 20, &error);
    Buffer *b = buffer_create(fixture->device, "b", 1000, &error);
    Buffer *empty = buffer_create(fixture->device, "empty", 0, &error);
    assert_true(a && b && empty);
    assert_int_equal(device_bytes(fixture->device), (4 << 20) + 1000 + 16);
    buffer_destroy(b);
    assert_int_equal(device_bytes(fixture->device), (4 << 20) + 16);
    buffer_destroy(empty);
    buffer_destroy(a);
    assert_int_equal(device_bytes(fixture->device), 0);
    assert_true(device_bytes_peak(fixture->device) >= (4 << 20) + 1000);
}

static void copies_parts(void **state)
{
    Fixture *fixture = *state;
    Error error;
    u32 values[4] = {7, 8, 7, 7};
    Buffer *buffer = buffer_create(fixture->device, "parts", sizeof values, &error);
    assert_non_null(buffer);
    check(buffer_upload(buffer, 0, values, sizeof values, &error), &error);
    check(buffer_upload(buffer, 8, &(u32){9}, 4, &error), &error);
    check(buffer_download(buffer, 0, values, sizeof values, &error), &error);
    assert_memory_equal(values, ((u32[]){7, 8, 9, 7}), sizeof values);
    check(buffer_download(buffer, 12, values, 4, &error), &error);
    assert_int_equal(values[0], 7);
    assert_false(buffer_upload(buffer, 8, values, 9, &error));
    assert_non_null(strstr(error.text, "'parts'"));
    assert_false(buffer_download(buffer, 17, values, 0, &error));
    assert_false(buffer_upload(buffer, UINT64_MAX - 3, values, 8, &error));
    check(buffer_upload(buffer, 16, NULL, 0, &error) && buffer_download(buffer, 16, NULL, 0, &error), &error);
    buffer_destroy(buffer);
}

// Buffers of whole huge pages and a bit, to their ends: copied, and wrapped around memory of ours.
static void holds_many_pages(void **state)
{
    Fixture *fixture = *state;
    Error error;
    const u64 bytes = (3u << 20) + 12;
    f32 *memory = page_alloc(bytes), *doubled = malloc(bytes);
    assert_true(memory && doubled);
    memory[0] = 5.0f;
    memory[bytes / 4 - 1] = 6.0f;
    for (int wrapped = 0; wrapped < 2; wrapped++) {
        Buffer *in = wrapped ? buffer_wrap(fixture->device, "in", memory, bytes, &error)
                             : buffer_create(fixture->device, "in", bytes, &error);
        Buffer *out = buffer_create(fixture->device, "out", bytes, &error);
        Kernel *kernel = kernel_create(fixture->program, "scale", &error);
        assert_true(in && out && kernel);
        assert_int_equal(device_bytes(fixture->device), 2 * bytes);
        check(wrapped || buffer_upload(in, 0, memory, bytes, &error), &error);
        check(kernel_set_buffer(kernel, "from", in, &error), &error);
        check(kernel_set_buffer(kernel, "to", out, &error), &error);
        check(kernel_set_u32(kernel, "factor", 2, &error), &error);
        check(kernel_set_u32(kernel, "count", (u32)(bytes / 4), &error), &error);
        check(kernel_launch(kernel, bytes / 4, 0, &error), &error);
        check(buffer_download(out, 0, doubled, bytes, &error), &error);
        assert_true(doubled[0] == 10.0f && doubled[1] == 0.0f && doubled[bytes / 4 - 1] == 12.0f);
        kernel_destroy(kernel);
        buffer_destroy(out);
        buffer_destroy(in);
    }
    assert_true(memory[0] == 5.0f && memory[bytes / 4 - 1] == 6.0f); // still ours
    page_free(memory, bytes);
    free(doubled);
    Buffer *empty = buffer_wrap(fixture->device, "empty", NULL, 0, &error);
    check(empty, &error);
    buffer_destroy(empty);
}

static void refuses_what_does_not_fit(void **state)
{
    Fixture *fixture = *state;
    Error error;
    const u64 bytes[] = {fixture->info.allocation_max + 1, UINT64_MAX};
    for (size_t i = 0; i < 2; i++) {
        assert_null(buffer_create(fixture->device, "the film", bytes[i], &error));
        assert_null(buffer_wrap(fixture->device, "the film", &error, bytes[i], &error));
        assert_int_equal(error.code, ERROR_MEMORY);
        assert_non_null(strstr(error.text, "'the film'"));
        assert_non_null(strstr(error.text, "MiB"));
        assert_int_equal(device_bytes(fixture->device), 0);
    }
}

// A device of the same driver with less memory than it has.
static void counts_what_is_in_use(void **state)
{
    const Fixture *fixture = *state;
    Error error;
    DeviceInfo small = fixture->info;
    small.memory = small.allocation_max = 1 << 20;
    const DeviceOptions options = {.threads = 0};
    Device *device = device_open(&small, &options, &error);
    check(device, &error);
    assert_null(buffer_create(device, "the film", (1 << 20) + 1, &error));
    assert_non_null(strstr(error.text, "'the film' of 1.0 MiB"));
    assert_non_null(strstr(error.text, "allows 1.0 MiB a buffer"));
    Buffer *most = buffer_create(device, "nodes", 768 << 10, &error);
    check(most, &error);
    assert_null(buffer_create(device, "the film", 512 << 10, &error));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_non_null(strstr(error.text, "'the film' of 0.5 MiB: 0.8 MiB of the 1.0 MiB"));
    assert_int_equal(device_bytes(device), 768 << 10);
    buffer_destroy(most);
    Buffer *now = buffer_create(device, "the film", 512 << 10, &error);
    check(now, &error);
    buffer_destroy(now);
    device_close(device);
}

static void refuses_an_unusable_device(void **state)
{
    const Fixture *fixture = *state;
    Error error;
    DeviceInfo broken = fixture->info;
    strcpy(broken.unusable, "its driver has no compiler");
    const DeviceOptions options = {.threads = 0};
    assert_null(device_open(&broken, &options, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "cannot be used: its driver has no compiler"));
}

static void finds_the_error_in_a_long_log(void **state)
{
    Fixture *fixture = *state;
    Error error;
    char source[16384] = "";
    size_t used = 0;
    for (u32 i = 0; i < 150; i++)
        used += (size_t)snprintf(source + used, sizeof source - used,
                                 "#warning number %u, which fills the log without being what is wrong\n", i);
    snprintf(source + used, sizeof source - used,
             "kernel void f(global float *x)\n{ x[0] = not_declared; }\n");
    assert_null(program_create(fixture->device, source, strlen(source), "", &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "not_declared"));
}

// Each launch sees what the one before it wrote.
static void runs_launches_in_order(void **state)
{
    enum { LAUNCHES = 300 };
    Fixture *fixture = *state;
    Error error;
    f32 values[64];
    for (u32 i = 0; i < 64; i++)
        values[i] = ldexpf((f32)(i + 1), -LAUNCHES / 4);
    Buffer *buffer = buffer_create(fixture->device, "numbers", sizeof values, &error);
    Kernel *kernel = kernel_create(fixture->program, "scale", &error);
    assert_true(buffer && kernel);
    check(buffer_upload(buffer, 0, values, sizeof values, &error), &error);
    check(kernel_set_buffer(kernel, "from", buffer, &error), &error);
    check(kernel_set_buffer(kernel, "to", buffer, &error), &error);
    check(kernel_set_u32(kernel, "count", 64, &error), &error);
    for (u32 i = 0; i < LAUNCHES; i++) {
        check(kernel_set_u32(kernel, "factor", i % 4 ? 1 : 2, &error), &error);
        check(kernel_launch(kernel, 64, 0, &error), &error);
    }
    check(buffer_download(buffer, 0, values, sizeof values, &error), &error);
    for (u32 i = 0; i < 64; i++)
        assert_true(values[i] == (f32)(i + 1));
    kernel_destroy(kernel);
    buffer_destroy(buffer);
}

static void refuses_groups_too_large(void **state)
{
    Fixture *fixture = *state;
    Error error;
    Buffer *buffer = buffer_create(fixture->device, "numbers", 256, &error);
    Kernel *kernel = kernel_create(fixture->program, "scale", &error);
    assert_true(buffer && kernel);
    check(kernel_set_buffer(kernel, "from", buffer, &error), &error);
    check(kernel_set_buffer(kernel, "to", buffer, &error), &error);
    check(kernel_set_u32(kernel, "factor", 1, &error), &error);
    check(kernel_set_u32(kernel, "count", 64, &error), &error);
    assert_false(kernel_launch(kernel, 1 << 24, 1 << 24, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "kernel 'scale', 16777216 work-items in groups of 16777216"));
    kernel_destroy(kernel);
    buffer_destroy(buffer);
}

static void bounds_the_threads_of_a_cpu(void **state)
{
    const Fixture *fixture = *state;
    Error error;
    const DeviceOptions one = {.threads = 1};
    Device *device = device_open(&fixture->info, &one, &error);
    check(device, &error);
    if (fixture->info.type == DEVICE_CPU)
        assert_int_equal(device_info(device)->compute_units, 1);
    Program *program = program_create(device, SOURCE, strlen(SOURCE), "", &error);
    check(program, &error);
    Kernel *kernel = kernel_create(program, "sum_group", &error);
    check(kernel, &error);
    Buffer *buffer = buffer_create(device, "both", 64, &error);
    check(buffer, &error);
    const u32 threes[16] = {3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3, 3};
    check(buffer_upload(buffer, 0, threes, sizeof threes, &error), &error);
    check(kernel_set_buffer(kernel, "from", buffer, &error), &error);
    check(kernel_set_buffer(kernel, "sums", buffer, &error), &error);
    check(kernel_launch(kernel, 16, 16, &error), &error);
    u32 sum;
    check(buffer_download(buffer, 0, &sum, 4, &error), &error);
    assert_int_equal(sum, 48);
    buffer_destroy(buffer);
    kernel_destroy(kernel);
    program_destroy(program);
    device_close(device);
}

int main(void)
{
    Error error;
    u32 index;
    Fixture fixture = {.device = NULL};
    DeviceList *list = device_list_create(&error);
    if (!list || !device_choose(list, getenv("CLRT_DEVICE"), &index, &error)) {
        printf("skipped: %s\n", error.text);
        device_list_destroy(list);
        return SKIPPED;
    }
    fixture.info = list->devices[index];
    device_list_destroy(list);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate_setup_teardown(runs_a_kernel_by_names, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(runs_groups, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(refuses_wrong_arguments, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(reports_a_failed_build, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(keeps_account_of_buffers, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(copies_parts, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(holds_many_pages, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(refuses_what_does_not_fit, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(finds_the_error_in_a_long_log, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(runs_launches_in_order, setup, teardown, &fixture),
        cmocka_unit_test_prestate_setup_teardown(refuses_groups_too_large, setup, teardown, &fixture),
        cmocka_unit_test_prestate(counts_what_is_in_use, &fixture),
        cmocka_unit_test_prestate(refuses_an_unusable_device, &fixture),
        cmocka_unit_test_prestate(bounds_the_threads_of_a_cpu, &fixture),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
