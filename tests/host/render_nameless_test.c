// Renders with a driver that tells no names of arguments, which this program's own clGetKernelArgInfo makes
// of any driver. On the device that CLRT_DEVICE names; skipped (77) without one.
#include "layout_fixture.h"

#include <CL/cl.h>

#include "render/render.h"

enum { SKIPPED = 77, SIDE = 17 };

static u32 asked; // for names

// Stands before the function of the OpenCL library.
cl_int clGetKernelArgInfo(cl_kernel kernel, cl_uint index, cl_kernel_arg_info what, size_t size, void *value,
                          size_t *size_needed)
{
    (void)kernel, (void)index, (void)what, (void)size, (void)value, (void)size_needed;
    asked++;
    return CL_KERNEL_ARG_INFO_NOT_AVAILABLE;
}

static void render(Device *device, const char *text, f32 *pixels)
{
    Error error = {0};
    Layout *layout = layout_good(text);
    const RenderJob job = {.layout = layout, .device = device, .width = SIDE, .height = SIDE};
    const u32 before = asked;
    Render *render = render_create(&job, &error);
    if (!render)
        fail_msg("%s", error.text);
    assert_true(asked > before);
    u32 row = 0;
    while (!render_finished(render)) {
        RenderRows rows;
        if (!render_step(render, &rows, &error))
            fail_msg("%s", error.text);
        if (rows.count > 0)
            memcpy(pixels + (size_t)row * SIDE * 3, rows.rgb, (size_t)rows.count * SIDE * 3 * sizeof(f32));
        row += rows.count;
    }
    assert_int_equal(row, SIDE);
    render_destroy(render);
    layout_destroy(layout);
}

static void expect(const f32 *pixels, u32 x, u32 y, f32 r, f32 g, f32 b)
{
    const f32 *found = pixels + ((size_t)y * SIDE + x) * 3;
    if (found[0] != r || found[1] != g || found[2] != b)
        fail_msg("pixel %u, %u is %g %g %g", x, y, (f64)found[0], (f64)found[1], (f64)found[2]);
}

#define IMAGE(more) "image { size 17 17 " more "}\ncamera { position 0 0 5 look_at 0 0 0 }\n"

static void nothing_to_hit(void **state)
{
    f32 pixels[SIDE * SIDE * 3];
    render(*state, IMAGE("") "background 0.25 0.5 0.75\n", pixels);
    expect(pixels, 8, 8, 0.25f, 0.5f, 0.75f);
    expect(pixels, 0, 16, 0.25f, 0.5f, 0.75f);
}

static void a_glowing_ball(void **state)
{
    f32 pixels[SIDE * SIDE * 3];
    render(*state, IMAGE("") "background 0.25\nambient 0\nmaterial m phong { diffuse 0 emission 2 3 4 }\n"
                         "sphere { center 0 0 0 radius 1 material m }\n", pixels);
    expect(pixels, 8, 8, 2, 3, 4);
    expect(pixels, 0, 0, 0.25f, 0.25f, 0.25f);
}

// Arguments of several features at once: a texture, lights, samples.
static void a_textured_plane(void **state)
{
    f32 pixels[SIDE * SIDE * 3];
    render(*state, IMAGE("samples 4 ") "background 0\nambient 0\n"
                         "texture t checker3d { colors 0.5 0.5 scale 1 }\nmaterial m phong { diffuse t }\n"
                         "light directional { direction 0 0 -1 }\n"
                         "plane { point 0 0 0 normal 0 0 1 material m }\n"
                         "sphere { center 50 0 0 radius 1 material m }\n", pixels);
    expect(pixels, 8, 8, 0.5f, 0.5f, 0.5f);
    expect(pixels, 0, 0, 0.5f, 0.5f, 0.5f);
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
        cmocka_unit_test_prestate(nothing_to_hit, device),
        cmocka_unit_test_prestate(a_glowing_ball, device),
        cmocka_unit_test_prestate(a_textured_plane, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
