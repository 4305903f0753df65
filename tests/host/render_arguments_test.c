// The arguments of the render kernel, as they are read from the source where a driver tells no names, are
// those that a driver tells: for programs of all features, of none, and of scenes that differ in what the
// kernel takes. On the device that CLRT_DEVICE names; skipped (77) without one.
#include "layout_fixture.h"

#include "bundle/bundle.h"
#include "device/internal.h"
#include "layout_feature_scenes.h"
#include "render/render.h"

enum { SKIPPED = 77, NAMES = 64, NAME = 64 };

static void compare(Device *device, FeatureSet features)
{
    Error error = {0};
    char options[4096];
    const size_t length =
        render_program_options(features, device_info(device), MATH_EXACT, options, sizeof options);
    assert_true(length < sizeof options);
    Program *program = program_create(device, clrt_kernel_source, clrt_kernel_source_size, options, &error);
    if (!program)
        fail_msg("%s", error.text);
    cl_int status;
    cl_kernel kernel = clCreateKernel(program->program, "render_tiles", &status);
    assert_int_equal(status, CL_SUCCESS);
    cl_uint count = 0;
    assert_int_equal(clGetKernelInfo(kernel, CL_KERNEL_NUM_ARGS, sizeof count, &count, NULL), CL_SUCCESS);
    assert_in_range(count, 1, NAMES);
    char found[NAMES][NAME];
    const i32 in_source = source_argument_names(clrt_kernel_source, clrt_kernel_source_size, program->options,
                                                "render_tiles", found[0], NAME, NAMES);
    if (in_source != (i32)count)
        fail_msg("%d arguments in the source, %u in the kernel, with %s", in_source, count, options);
    for (cl_uint i = 0; i < count; i++) {
        char told[NAME] = "";
        if (clGetKernelArgInfo(kernel, i, CL_KERNEL_ARG_NAME, sizeof told, told, NULL) == CL_SUCCESS)
            assert_string_equal(found[i], told);
    }
    clReleaseKernel(kernel);
    program_destroy(program);
}

static void programs_of_scenes(void **state)
{
    static const Feature features[] = {FEATURE_PLANE,          FEATURE_CHECKER, FEATURE_CHECKER3D,
                                       FEATURE_TRIANGLE_EXTRA, FEATURE_LIGHTS,  FEATURE_SAMPLES,
                                       FEATURE_PATH};
    for (size_t i = 0; i < sizeof features / sizeof *features; i++)
        for (size_t k = 0; k < FEATURE_SCENE_COUNT; k++)
            if (feature_scenes[k].feature == features[i])
                compare(*state, features_of(feature_scenes[k].with));
    compare(*state, features_of("plane { point 0 -1 0 normal 0 1 0 }\n")); // no hierarchy
}

static void least_and_largest_program(void **state)
{
    const FeatureSet all = feature_bit(FEATURE_COUNT) - 1;
    const FeatureSet of_paths = feature_bit(FEATURE_PATH) | feature_bit(FEATURE_MANY_LIGHTS);
    const FeatureSet of_others = feature_bit(FEATURE_BRANCHING) | feature_bit(FEATURE_PREFILTERED);
    compare(*state, 0);
    compare(*state, all & ~of_paths);
    compare(*state, all & ~of_others);
}

int main(void)
{
    Error error;
    u32 index;
    DeviceList *list = device_list_create(&error);
    Device *device = NULL;
    if (list && device_choose(list, getenv("CLRT_DEVICE"), &index, &error))
        device = device_open(&list->devices[index], &(DeviceOptions){.threads = 0}, &error);
    device_list_destroy(list);
    if (!device) {
        printf("skipped: %s\n", error.text);
        return SKIPPED;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(least_and_largest_program, device),
        cmocka_unit_test_prestate(programs_of_scenes, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
