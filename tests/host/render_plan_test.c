// Plans: whatever the memory and the device, a plan fits into the limit, covers the image, and is as large as
// it may be; below the least it is refused.
#include "layout_fixture.h"

#include "render/plan.h"
#include "render/render.h"

static const char plain_scene[] = "sphere { center 0 0 -4 radius 1 }\n";
static const char full_scene[] =
    "image { samples 4 }\nrender { max_depth 9 }\nmaterial g phong { transmit 0.5 reflect 0.5 }\n"
    "light point { position 0 4 0 }\nlight point { position 1 4 0 }\nlight point { position 2 4 0 }\n"
    "object o { sphere { center 0 0 0 radius 1 material g } box { min 0 0 0 max 1 1 1 } }\ninstance o { }\n";

static DeviceInfo device_of(DeviceType type, u32 units, u64 memory)
{
    return (DeviceInfo){.type = type, .compute_units = units, .float_width = type == DEVICE_CPU ? 8 : 1,
                        .memory = memory, .allocation_max = memory};
}

static const u64 gib = (u64)1 << 30, mib = 1 << 20;

// Bytes on the device besides the scene's arrays.
static u64 plan_bytes(const Plan *plan)
{
    return plan_state_bytes(plan, plan->groups) + plan_film_bytes(plan, plan->band_rows);
}

static u64 scene_bytes(const Layout *l)
{
    return sizeof(RenderParams) +
           l->primitive_count * (u64)(sizeof(Primitive) + sizeof(PrimitiveInfo) +
                                      (l->frames ? sizeof(ObjectFrame) : 0)) +
           l->node_count * (u64)sizeof(BvhNode) + l->extra_count * (u64)sizeof(TriangleExtra) +
           l->material_count * (u64)sizeof(MaterialRecord) + l->texture_count * (u64)sizeof(TextureRecord) +
           l->light_count * (u64)sizeof(LightRecord);
}

static void check_plan(const Plan *plan, u32 width, u32 height)
{
    assert_int_equal(plan->width, width);
    assert_in_range(plan->band_rows, 1, height);
    assert_true(plan->band_rows == height || plan->band_rows % TILE_SIDE == 0);
    assert_in_range(plan->groups, 1, plan_tiles(plan, plan->band_rows));
    assert_true(plan_tiles(plan, plan->band_rows) >= (u64)width * plan->band_rows / TILE_SLOTS);
}

// The smallest limit that a plan is made for.
static u64 least_memory(const Layout *layout, const DeviceInfo *info, u32 width, u32 height)
{
    u64 low = 1, high = 64 * gib; // 0 is no limit
    Plan plan;
    Error error;
    assert_true(plan_make(&plan, layout, info, MATH_EXACT, width, height, high, &error));
    while (low < high) {
        const u64 middle = (low + high) / 2;
        if (plan_make(&plan, layout, info, MATH_EXACT, width, height, middle, &error)) {
            high = middle;
        } else {
            assert_int_equal(error.code, ERROR_MEMORY);
            low = middle + 1;
        }
    }
    return low;
}

static void test_limits(void **state)
{
    (void)state;
    static const u32 sizes[][2] = {{1, 1}, {800, 600}, {17, 33}, {65536, 1}, {1, 65536}, {65536, 65536}};
    const DeviceInfo devices[] = {device_of(DEVICE_CPU, 2, 64 * gib), device_of(DEVICE_GPU, 80, 64 * gib)};
    for (int scene = 0; scene < 2; scene++) {
        Layout *layout = layout_good(scene ? full_scene : plain_scene);
        for (size_t i = 0; i < 2 * sizeof sizes / sizeof *sizes; i++) {
            const DeviceInfo *info = &devices[i % 2];
            const u32 width = sizes[i / 2][0], height = sizes[i / 2][1];
            const u64 least = least_memory(layout, info, width, height);
            u32 groups = 0, rows = 0;
            for (u64 limit = least; limit <= 64 * gib; limit += limit / 2) {
                Plan plan;
                Error error = {0};
                assert_true(plan_make(&plan, layout, info, MATH_EXACT, width, height, limit, &error));
                check_plan(&plan, width, height);
                assert_true(scene_bytes(layout) + plan_bytes(&plan) <= limit);
                // More memory never makes less of it.
                assert_true(plan.band_rows >= rows);
                assert_true(plan.groups >= groups || plan.groups == plan_tiles(&plan, plan.band_rows));
                groups = plan.groups;
                rows = plan.band_rows;
                if (limit == least) {
                    assert_true(plan.groups == 1);
                    assert_true(plan.band_rows == (height < TILE_SIDE ? height : TILE_SIDE));
                }
            }
        }
        layout_destroy(layout);
    }
}

// The memory of the device is a limit as well, and the message tells both.
static void test_too_small(void **state)
{
    (void)state;
    Layout *layout = layout_good(plain_scene);
    Plan plan;
    Error error = {0};
    const DeviceInfo large = device_of(DEVICE_CPU, 2, gib), tiny = device_of(DEVICE_CPU, 2, mib);
    assert_false(plan_make(&plan, layout, &large, MATH_EXACT, 65536, 16, mib, &error));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_non_null(strstr(error.text, "1 MiB"));
    assert_non_null(strstr(error.text, "13 MiB")); // 12 MiB of film, and the rest
    memset(&error, 0, sizeof error);
    assert_false(plan_make(&plan, layout, &tiny, MATH_EXACT, 65536, 16, 0, &error));
    assert_int_equal(error.code, ERROR_MEMORY);
    assert_false(plan_make(&plan, layout, &tiny, MATH_EXACT, 65536, 16, gib, &error));
    assert_true(plan_make(&plan, layout, &large, MATH_EXACT, 65536, 16, 0, &error));
    layout_destroy(layout);
}

// Without a limit a usual image is one band, and every core has tiles to spare.
static void test_roomy(void **state)
{
    (void)state;
    Layout *layout = layout_good(plain_scene);
    Plan plan;
    Error error = {0};
    const DeviceInfo cpu = device_of(DEVICE_CPU, 2, 8 * gib), gpu = device_of(DEVICE_GPU, 80, 8 * gib);
    assert_true(plan_make(&plan, layout, &cpu, MATH_EXACT, 800, 600, 0, &error));
    assert_int_equal(plan.band_rows, 600);
    assert_true(plan.groups >= 2 * 2);
    assert_true(plan.shape.group == 1 && plan.shape.lanes == 8 && plan.shape.batch % 8 == 0);
    assert_true(plan_make(&plan, layout, &gpu, MATH_EXACT, 800, 600, 0, &error));
    assert_int_equal(plan.band_rows, 600);
    assert_true(plan.groups == plan_tiles(&plan, 600) && plan_tiles(&plan, 600) == 50 * 38);
    assert_true(plan.shape.lanes == 1 && plan.shape.batch == 1 && plan.shape.group > 1);
    // The first launch is short: few samples of a large image, more of a small one, at least one.
    assert_int_equal(plan_first_samples(&plan), 4);
    assert_true(plan_make(&plan, layout, &cpu, MATH_EXACT, 65536, 65536, 0, &error));
    assert_int_equal(plan_first_samples(&plan), 1);
    assert_true(plan_make(&plan, layout, &cpu, MATH_EXACT, 1, 1, 0, &error));
    assert_int_equal(plan_first_samples(&plan), 64);
    layout_destroy(layout);
}

// No buffer is larger than the device allows.
static void test_allocation(void **state)
{
    (void)state;
    Layout *layout = layout_good(full_scene);
    DeviceInfo gpu = device_of(DEVICE_GPU, 80, 8 * gib);
    Plan plan;
    Error error = {0};
    assert_true(plan_make(&plan, layout, &gpu, MATH_EXACT, 4096, 4096, 0, &error));
    const u32 groups = plan.groups;
    gpu.allocation_max = 100 * mib;
    assert_true(plan_make(&plan, layout, &gpu, MATH_EXACT, 4096, 4096, 0, &error));
    assert_true(plan.groups < groups && plan.groups > 100);
    assert_true((u64)plan.groups * plan.real_fields * TILE_SLOTS * 4 <= gpu.allocation_max);
    layout_destroy(layout);
}

// What a scene does not use takes no room in a slot.
static void test_fields(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        u32 reals, ints; // beyond those of the first
    } scenes[] = {
        {"sphere { center 0 0 -4 radius 1 }", 0, 0},
        {"box { min -1 -1 -5 max 1 1 -4 } background 1 camera { orthographic 3 }", 0, 0},
        {"light point { position 0 4 0 } sphere { center 0 0 -4 radius 1 }", 3 + 7, 1},
        {"light point { position 0 4 0 } light point { position 1 4 0 } sphere { center 0 0 -4 radius 1 }",
         3 + 14, 1},
        {"light point { position 0 4 0 } render { shadows off } sphere { center 0 0 -4 radius 1 }", 0, 0},
        {"material m phong { transmit 1 reflect 1 } render { max_depth 3 }\n"
         "sphere { center 0 0 -4 radius 1 material m }", 3 * 9, 1 + 3 * 2},
        {"object o { sphere { center 0 0 -4 radius 1 } sphere { center 0 1 -4 radius 1 } } instance o { }", 0,
         2},
    };
    const DeviceInfo cpu = device_of(DEVICE_CPU, 2, gib);
    u32 reals = 0, ints = 0;
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        Layout *layout = layout_good(scenes[i].text);
        Plan plan;
        Error error = {0};
        assert_true(plan_make(&plan, layout, &cpu, MATH_EXACT, 64, 64, 0, &error));
        reals = i ? reals : plan.real_fields;
        ints = i ? ints : plan.int_fields;
        assert_int_equal(plan.real_fields, reals + scenes[i].reals);
        assert_int_equal(plan.int_fields, ints + scenes[i].ints);
        layout_destroy(layout);
    }
    assert_true(reals <= 16 && ints <= 8);
}

// A pass takes no more lights than a slot has bits for.
static void test_many_lights(void **state)
{
    (void)state;
    char text[4000] = "sphere { center 0 0 -4 radius 1 }\n";
    for (int i = 0; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "light point { position %d 4 0 }\n", i);
    Layout *layout = layout_good(text);
    const DeviceInfo cpu = device_of(DEVICE_CPU, 2, gib);
    Plan plan;
    Error error = {0};
    assert_true(plan_make(&plan, layout, &cpu, MATH_EXACT, 64, 64, 0, &error));
    assert_int_equal(plan.lights_per_pass, LIGHTS_PER_PASS_MAX);
    layout_destroy(layout);
}

static void expect_shape_of(MathMode math, const char *wish, const DeviceInfo *info, u32 lanes, u32 batch,
                            u32 group)
{
    if (wish)
        setenv("CLRT_SHAPE", wish, 1);
    const DeviceShape shape = plan_device_shape(info, math);
    unsetenv("CLRT_SHAPE");
    if (shape.lanes != lanes || shape.batch != batch || shape.group != group)
        fail_msg("%s: %u,%u,%u", wish, shape.lanes, shape.batch, shape.group);
}

static void expect_shape(const char *wish, const DeviceInfo *info, u32 lanes, u32 batch, u32 group)
{
    expect_shape_of(MATH_EXACT, wish, info, lanes, batch, group);
}

// Doubles go one by one on every device, whatever is asked for.
static void test_shapes_of_doubles(void **state)
{
    (void)state;
    const DeviceInfo cpu = device_of(DEVICE_CPU, 2, gib), gpu = device_of(DEVICE_GPU, 2, gib);
    expect_shape_of(MATH_DOUBLE, NULL, &cpu, 1, 1, 1);
    expect_shape_of(MATH_DOUBLE, NULL, &gpu, 1, 1, 64);
    expect_shape_of(MATH_DOUBLE, "1,1,16", &cpu, 1, 1, 16);
    expect_shape_of(MATH_DOUBLE, "8,32,1", &cpu, 1, 1, 1);
    expect_shape_of(MATH_DOUBLE, "1,8,1", &cpu, 1, 1, 1);
    expect_shape_of(MATH_FAST, NULL, &cpu, 8, 32, 1);
}

// Their state takes twice the room.
static void test_state_of_doubles(void **state)
{
    (void)state;
    Layout *layout = layout_good(plain_scene);
    Plan floats, doubles;
    Error error = {0};
    const DeviceInfo gpu = device_of(DEVICE_GPU, 2, 8 * gib);
    assert_true(plan_make(&floats, layout, &gpu, MATH_FAST, 64, 64, 0, &error));
    assert_true(plan_make(&doubles, layout, &gpu, MATH_DOUBLE, 64, 64, 0, &error));
    assert_true(floats.real_bytes == 4 && doubles.real_bytes == 8);
    assert_int_equal(plan_state_bytes(&doubles, 3) - plan_state_bytes(&floats, 3),
                     3 * 4 * TILE_SLOTS * floats.real_fields);
    layout_destroy(layout);
}

static void test_shapes(void **state)
{
    (void)state;
    DeviceInfo cpu = device_of(DEVICE_CPU, 2, gib);
    const DeviceInfo gpu = device_of(DEVICE_GPU, 2, gib);
    expect_shape(NULL, &gpu, 1, 1, 64);
    expect_shape(NULL, &cpu, 8, 32, 1);
    cpu.float_width = 16;
    expect_shape(NULL, &cpu, 16, 32, 1);
    cpu.float_width = 2;
    expect_shape(NULL, &cpu, 4, 32, 1);
    expect_shape("8,16,1", &cpu, 8, 16, 1);
    expect_shape("1,1,16", &cpu, 1, 1, 16);
    // What no program can be made for is not heeded.
    static const char *const wrong[] = {"",       "8",      "8,32",    "0,0,1", "8,12,1", "8,64,1",
                                        "8,32,0", "1,1,257", "8,0,1",   "3,3,1", "2,32,1", "32,32,1"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++)
        expect_shape(wrong[i], &cpu, 4, 32, 1);
}

static void test_program_options(void **state)
{
    (void)state;
    DeviceInfo cpu = device_of(DEVICE_CPU, 2, gib);
    char text[4096];
    size_t length = render_program_options(feature_bit(FEATURE_CONE), &cpu, MATH_EXACT, text, sizeof text);
    assert_int_equal(length, strlen(text));
    assert_true(length < 2048); // what the render has room for
    assert_non_null(strstr(text, "-DLANES=8 -DBATCH=32 -DGROUP=1"));
    assert_non_null(strstr(text, "-DHAS_CONE=1"));
    assert_null(strstr(text, "correctly-rounded"));
    assert_non_null(strstr(text, "-DMATH_FAST=0 -DMATH_DOUBLE=0"));
    cpu.exact_divide = true;
    length = render_program_options(feature_bit(FEATURE_CONE), &cpu, MATH_EXACT, text, 10);
    assert_true(text[9] == 0 && length > 10);
    render_program_options(feature_bit(FEATURE_CONE), &cpu, MATH_EXACT, text, sizeof text);
    assert_non_null(strstr(text, "-cl-fp32-correctly-rounded-divide-sqrt"));
    render_program_options(feature_bit(FEATURE_CONE), &cpu, MATH_DOUBLE, text, sizeof text);
    assert_non_null(strstr(text, "-DLANES=1 -DBATCH=1 -DGROUP=1 -DMATH_FAST=0 -DMATH_DOUBLE=1"));
    render_program_options(feature_bit(FEATURE_CONE), &cpu, MATH_FAST, text, sizeof text);
    assert_non_null(strstr(text, "-DMATH_FAST=1 -DMATH_DOUBLE=0"));
    assert_null(strstr(text, "correctly-rounded"));
    assert_null(strstr(text, "finite-math"));
    assert_null(strstr(text, "relaxed"));
}

int main(void)
{
    unsetenv("CLRT_SHAPE");
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_limits),          cmocka_unit_test(test_too_small),
        cmocka_unit_test(test_roomy),           cmocka_unit_test(test_fields),
        cmocka_unit_test(test_many_lights),     cmocka_unit_test(test_shapes),
        cmocka_unit_test(test_shapes_of_doubles), cmocka_unit_test(test_state_of_doubles),
        cmocka_unit_test(test_program_options), cmocka_unit_test(test_allocation),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
