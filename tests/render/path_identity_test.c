// Paths by other ways through the kernels, the same bytes: where camera rays take the slots of paths that
// have ended, nothing tells which slot, lane, tile, band or launch a sample was in. (Of all features
// together: identity_test.c.)
#include "support.h"

#include "render/plan.h"

// Paths of very different lengths, so that slots are free at different times.
static const char den[] =
    "image { size 43 37 samples 37 seed 3 filter tent }\n"
    "camera { position 0.5 2 5 look_at 0 0.5 0 fov 50 }\n"
    "render { integrator path max_depth 9 }\n"
    "environment { file \"sky.hdr\" intensity 0.5 rotate 40 }\n"
    "light sphere { center 2 2.5 1 radius 0.5 radiance 4 3 2 }\n"
    "light rectangle { corner -2 3 -1.5 edge1 1.5 0 0 edge2 0 0.5 1 radiance 3 2 2 }\n"
    "light point { position 0 3 3 intensity 0.25 }\n"
    "material floor phong { diffuse 0.875 0.75 0.625 }\n"
    "material glass phong { diffuse 0 reflect 1 transmit 0.875 1 0.9375 fresnel on }\n"
    "material copper pbr { base_color 0.875 0.5 0.25 metallic 1 roughness 0.25 }\n"
    "plane { point 0 0 0 normal 0 1 0 material floor }\n"
    "object things { sphere { center 0 0.5 0 radius 0.5 }\n"
    "    sphere { center 0.5 0.25 1 radius 0.25 material glass } }\n"
    "instance things { rotate y 20 translate -1 0 0 material copper }\n"
    "instance things { scale 1 1.5 0.75 translate 0.75 0 0.5 material floor }\n";

// Hardly anything, for a group of two work-items: compilers for CPUs copy the kernel for each work-item.
static const char cell[] = "image { size 43 37 samples 21 seed 3 }\n"
                           "camera { position 0 2 5 look_at 0 0 0 fov 50 }\n"
                           "render { integrator path max_depth 9 }\n"
                           "material glow phong { diffuse 0.875 0.75 0.625 emission 0.25 0.5 1 }\n"
                           "plane { point 0 0 0 normal 0 1 0 material glow }\n"
                           "plane { point 0 3 0 normal 0.25 -1 0 material glow }\n";

typedef struct Fixture {
    Device *device;
    Layout *layout;
    Picture picture; // made in the usual way
} Fixture;

static void expect_same(const Fixture *f, const RenderHow *how, const char *what)
{
    Picture picture = render_layout(f->device, f->layout, how);
    assert_same_picture(&f->picture, &picture, what);
    picture_destroy(&picture);
}

static void test_shapes(void **state)
{
    static const char *const shapes[] = {"4,32,1", "1,1,1"};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        expect_same(*state, &(RenderHow){.shape = shapes[i]}, shapes[i]);
}

static void test_groups(void **state)
{
    const Fixture *f = *state;
    static const char *const shapes[] = {"16,32,1", "1,1,2"};
    Layout *layout = layout_of(cell);
    Picture plain = render_layout(f->device, layout, NULL);
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const RenderHow how = {.shape = shapes[i]};
        Picture other = render_layout(f->device, layout, &how);
        assert_same_picture(&plain, &other, shapes[i]);
        picture_destroy(&other);
    }
    picture_destroy(&plain);
    layout_destroy(layout);
}

// For a tile and one row of tiles.
static u64 least_memory(const Fixture *f)
{
    const RenderStats *stats = &f->picture.stats;
    const u64 strip = stats->film_bytes / f->picture.height * TILE_SIDE;
    return stats->scene_bytes + stats->state_bytes / stats->groups + strip;
}

static void test_memory(void **state)
{
    const Fixture *f = *state;
    const RenderStats *stats = &f->picture.stats;
    static const u32 more[] = {1, 3, 20};
    u32 launches = 0;
    for (size_t i = 0; i < sizeof more / sizeof *more; i++) {
        const RenderHow how = {.memory = least_memory(f) + 4096 * more[i]};
        Picture picture = render_layout(f->device, f->layout, &how);
        assert_same_picture(&f->picture, &picture, "another limit of memory");
        launches = launches ? launches : picture.stats.launches;
        picture_destroy(&picture);
    }
    assert_true(launches > stats->launches);
}

static void test_crop(void **state)
{
    const Fixture *f = *state;
    static const u32 crops[][4] = {{17, 9, 19, 22}, {42, 36, 1, 1}, {5, 0, 2, 37}};
    for (size_t i = 0; i < sizeof crops / sizeof *crops; i++) {
        const u32 *c = crops[i];
        const RenderHow how = {.left = c[0], .top = c[1], .width = c[2], .height = c[3]};
        Picture crop = render_layout(f->device, f->layout, &how);
        for (u32 y = 0; y < c[3]; y++)
            assert_memory_equal(crop.rgb + 3 * (size_t)c[2] * y, pixel_at(&f->picture, c[0], c[1] + y),
                                3 * sizeof(f32) * c[2]);
        picture_destroy(&crop);
    }
}

// A tile alone, as nobody else takes its rays' places: each pixel for itself.
static void test_pixels(void **state)
{
    const Fixture *f = *state;
    for (u32 k = 0; k < 4; k++) {
        const u32 x = 7 + 9 * k, y = 5 + 8 * k;
        const RenderHow how = {.left = x, .top = y, .width = 1, .height = 1};
        Picture pixel = render_layout(f->device, f->layout, &how);
        assert_memory_equal(pixel.rgb, pixel_at(&f->picture, x, y), 3 * sizeof(f32));
        picture_destroy(&pixel);
    }
}

// Begun again with another seed, also in the middle: as if it had been begun with it.
static void test_restart(void **state)
{
    const Fixture *f = *state;
    const u32 seed = f->layout->params.seed;
    f32 *both = render_with_seeds(f->device, f->layout, seed - 1, 2);
    const size_t values = 3 * (size_t)f->picture.width * f->picture.height;
    assert_memory_equal(both + values, f->picture.rgb, values * sizeof(f32));
    assert_true(memcmp(both, both + values, values * sizeof(f32)) != 0);
    free(both);
    const RenderJob job = {.layout = f->layout,
                           .device = f->device,
                           .width = f->picture.width,
                           .height = f->picture.height,
                           .memory_limit = least_memory(f)}; // several launches
    Error error = {0};
    RenderRows rows = {0};
    Render *render = render_create(&job, &error);
    assert_non_null(render);
    assert_true(render_restart(render, seed + 5, &error) && render_step(render, &rows, &error));
    assert_true(!render_finished(render) && render_restart(render, seed, &error));
    for (u32 done = 0; !render_finished(render); done += rows.count) {
        assert_true(render_step(render, &rows, &error));
        if (rows.count)
            assert_memory_equal(rows.rgb, f->picture.rgb + (size_t)done * 3 * job.width,
                                (size_t)rows.count * 3 * job.width * sizeof(f32));
    }
    render_destroy(render);
}

static void test_threads(void **state)
{
    const Fixture *f = *state;
    if (device_info(f->device)->type != DEVICE_CPU) {
        skip();
        return;
    }
    const Fixture other = {test_device_open(1), f->layout, f->picture};
    assert_non_null(other.device);
    expect_same(&other, NULL, "one thread");
    device_close(other.device);
}

int main(void)
{
    Fixture f = {.device = test_device_open(0)};
    if (!f.device)
        return TEST_SKIP;
    f.layout = layout_of(den);
    f.picture = render_layout(f.device, f.layout, NULL);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_memory, &f),  cmocka_unit_test_prestate(test_crop, &f),
        cmocka_unit_test_prestate(test_pixels, &f),  cmocka_unit_test_prestate(test_restart, &f),
        cmocka_unit_test_prestate(test_threads, &f), cmocka_unit_test_prestate(test_shapes, &f),
        cmocka_unit_test_prestate(test_groups, &f),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    layout_destroy(f.layout);
    picture_destroy(&f.picture);
    device_close(f.device);
    return failed;
}
