// Same scene, same bytes: whatever the limit of memory, the crop, the number of threads, the shape of the
// kernels and the run, on four scenes, one of them with few and with many samples, and on one of nothing
// but meshes, that together have every feature.
#include "meshes.h"
#include "scenes.h"
#include "support.h"

#include "render/plan.h"

enum { SCENES = 6, SCENE_MESHES = 4 };

typedef struct Fixture {
    Device *device;
    Layout *layouts[SCENES];
    Picture pictures[SCENES]; // made in the usual way
} Fixture;

// Triangles alone, so many and so small that packets of rays and single rays meet them in blocks of all
// kinds.
static Layout *layout_of_meshes(void)
{
    char *ball = mesh_write_bumpy("identity_test_ball.obj", 60);
    char *soup = mesh_write_soup("identity_test_soup.obj", 300, 4);
    char *text = text_of(
        "image { size 100 76 }\n"
        "camera { position 0.5 1.5 6 look_at 0 0 0 fov 40 }\n"
        "render { environment_lighting prefiltered }\n"
        "environment { file \"sky.hdr\" intensity 0.75 }\n"
        "light point { position -4 6 5 intensity 0.75 }\n"
        "light directional { direction 1 -2 -1 intensity 0.25 }\n"
        "material skin phong { diffuse 0.5 0.375 0.25 specular 0.25 reflect 0.25 }\n"
        "material clear phong { diffuse 0.125 transmit 0.75 reflect 0.25 ior 1.25 }\n"
        "material wax pbr { base_color 0.75 0.625 0.5 roughness 0.375 }\n"
        "mesh { file \"%s\" smooth on material skin translate -0.75 0 0 }\n"
        "mesh { file \"%s\" material clear scale 0.75 rotate 1 1 1 40 translate 1 -0.25 1 }\n"
        "mesh { file \"%s\" translate 0 0 -3 material wax }\n",
        ball, ball, soup);
    Layout *layout = layout_of(text);
    free(text);
    mesh_remove(ball);
    mesh_remove(soup);
    return layout;
}

static Layout *layout_of_marked(const char *marked)
{
    char *text = scene_under(marked, NULL);
    Layout *layout = layout_of(text);
    free(text);
    return layout;
}

static void test_every_feature(void **state)
{
    const Fixture *f = *state;
    const FeatureSet all = feature_bit(FEATURE_COUNT) - 1;
    FeatureSet have = FEATURES_OF_RENDERS; // clamp_test.c
    for (int k = 0; k < SCENES; k++)
        have |= f->layouts[k]->features;
    for (Feature feature = 0; feature < FEATURE_COUNT; feature++)
        if (!features_have(have, feature))
            fail_msg("no scene has %s", feature_name(feature));
    assert_true(have == all);
    const FeatureSet meshes = f->layouts[SCENE_MESHES]->features;
    assert_true(features_have(meshes, FEATURE_MESH) && !features_have(meshes, FEATURE_TRIANGLE));
    for (int k = 0; k < SCENES; k++) { // and there is something to see
        const Picture *p = &f->pictures[k];
        u32 changes = 0;
        for (u32 y = 0; y < p->height; y++)
            for (u32 x = 1; x < p->width; x++)
                changes += memcmp(pixel_at(p, x, y), pixel_at(p, x - 1, y), 3 * sizeof(f32)) != 0;
        assert_true(changes > p->width * p->height / 10);
    }
}

static void expect_same(const Fixture *f, int k, const RenderHow *how, const char *what)
{
    Picture picture = render_layout(f->device, f->layouts[k], how);
    assert_same_picture(&f->pictures[k], &picture, what);
    picture_destroy(&picture);
}

static void test_again(void **state)
{
    for (int k = 0; k < SCENES; k++)
        expect_same(*state, k, NULL, "the second run");
}

// The smallest limit of memory that the scene can be rendered with.
static u64 least_memory(const Fixture *f, int k)
{
    u64 low = 1, high = (u64)1 << 30;
    while (low < high) {
        const u64 middle = (low + high) / 2;
        Plan plan;
        Error error;
        const Picture *picture = &f->pictures[k];
        if (plan_make(&plan, f->layouts[k], device_info(f->device), MATH_EXACT, picture->width, picture->height,
                      middle, &error))
            high = middle;
        else
            low = middle + 1;
    }
    return low;
}

static void test_memory(void **state)
{
    const Fixture *f = *state;
    for (int k = 0; k < SCENES; k++) {
        const u64 least = least_memory(f, k);
        u32 bands = 0;
        static const f64 factors[] = {1, 1.05, 1.3, 2, 5, 20};
        for (size_t i = 0; i < sizeof factors / sizeof *factors; i++) {
            const RenderHow how = {.memory = (u64)((f64)least * factors[i])};
            Picture picture = render_layout(f->device, f->layouts[k], &how);
            assert_same_picture(&f->pictures[k], &picture, "another limit of memory");
            if (i == 0) {
                assert_int_equal(picture.stats.groups, 1);
                assert_int_equal(picture.stats.band_rows, TILE_SIDE);
                bands = picture.stats.launches;
            }
            assert_true(picture.stats.scene_bytes + picture.stats.state_bytes + picture.stats.film_bytes <=
                        how.memory);
            picture_destroy(&picture);
        }
        assert_true(bands >= 5);
        const RenderHow less = {.memory = least - 1};
        const RenderJob job = {.layout = f->layouts[k], .device = f->device, .width = f->pictures[k].width,
                               .height = f->pictures[k].height, .memory_limit = less.memory};
        Error error = {0};
        assert_null(render_create(&job, &error));
        assert_int_equal(error.code, ERROR_MEMORY);
    }
}

static void test_crop(void **state)
{
    const Fixture *f = *state;
    static const u32 crops[][4] = {{17, 9, 50, 40}, {0, 0, 1, 1}, {89, 69, 1, 1}, {31, 0, 2, 70},
                                   {0, 33, 90, 1}};
    for (int k = 0; k < SCENES; k++) {
        const Picture *whole = &f->pictures[k];
        for (size_t i = 0; i < sizeof crops / sizeof *crops; i++) {
            const u32 *c = crops[i];
            const RenderHow how = {.left = c[0], .top = c[1], .width = c[2], .height = c[3]};
            Picture crop = render_layout(f->device, f->layouts[k], &how);
            Picture cut = {.width = c[2], .height = c[3], .rgb = malloc(3 * sizeof(f32) * c[2] * c[3])};
            assert_non_null(cut.rgb);
            for (u32 y = 0; y < c[3]; y++)
                memcpy(cut.rgb + 3 * (size_t)y * c[2], pixel_at(whole, c[0], c[1] + y),
                       3 * sizeof(f32) * c[2]);
            assert_same_picture(&cut, &crop, "a crop");
            picture_destroy(&crop);
            picture_destroy(&cut);
        }
    }
}

static void test_threads(void **state)
{
    const Fixture *f = *state;
    if (device_info(f->device)->type != DEVICE_CPU) {
        skip();
        return;
    }
    for (u32 threads = 1; threads <= 2; threads++) {
        Fixture other = *f;
        other.device = test_device_open(threads);
        assert_non_null(other.device);
        assert_true(device_info(other.device)->compute_units <= threads);
        for (int k = 0; k < SCENES; k++)
            expect_same(&other, k, NULL, "another number of threads");
        device_close(other.device);
    }
}

// Vectors of another width, single rays, groups of work-items as GPUs have them.
static void test_shapes(void **state)
{
    const Fixture *f = *state;
    static const char *const shapes[] = {"4,32,1", "1,1,16", "8,32,1", "8,8,1", "16,32,1"};
    // Each program takes its time to compile, so not every scene sees every shape.
    static const bool seen[][SCENES] = {
        {1, 0, 1, 1, 0, 0}, {1, 1, 1, 1, 0, 1}, {1, 1, 1, 1, 0, 0}, {0, 0, 0, 1, 0, 1}, {1, 0, 1, 1, 0, 0}};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        const RenderHow how = {.shape = shapes[i]};
        for (int k = 0; k < SCENES; k++) {
            if (!seen[i][k])
                continue;
            char *what = text_of("scene %d as %s", k, shapes[i]);
            expect_same(f, k, &how, what);
            free(what);
        }
    }
}

int main(void)
{
    Fixture f = {.device = test_device_open(0)};
    if (!f.device)
        return TEST_SKIP;
    const char *const marked[SCENES] = {scene_glass, scene_toys, scene_studio, scene_glass, NULL, scene_hall};
    const u32 samples[SCENES] = {4, 1, 2, 21, 1, 5};
    for (int k = 0; k < SCENES; k++) {
        f.layouts[k] = marked[k] ? layout_of_marked(marked[k]) : layout_of_meshes();
        f.layouts[k]->params.samples = samples[k];
        f.pictures[k] = render_layout(f.device, f.layouts[k], NULL);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_every_feature, &f), cmocka_unit_test_prestate(test_again, &f),
        cmocka_unit_test_prestate(test_memory, &f),        cmocka_unit_test_prestate(test_crop, &f),
        cmocka_unit_test_prestate(test_threads, &f),       cmocka_unit_test_prestate(test_shapes, &f),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (int k = 0; k < SCENES; k++) {
        layout_destroy(f.layouts[k]);
        picture_destroy(&f.pictures[k]);
    }
    device_close(f.device);
    return failed;
}
