// Direct light is the same by both integrators: scenes of depth 0 on matt phong and rough pbr materials, each
// pixel within its noise.
#include "statistics.h"

enum { SEEDS = 32 };

// All lights that stand somewhere, with their shadows.
static const char room[] = "image { size 40 30 samples 64 }\n"
                           "camera { position 0.5 2.5 7 look_at 0 0.75 0 fov 45 }\n"
                           "ambient 0\n"
                           "light point { position -3 4 2 intensity 6 4 3 attenuation 0 0 1 }\n"
                           "light directional { direction 1 -2 -1 intensity 0.25 0.25 0.5 }\n"
                           "light spot { position 0 5 4 look_at 0.5 0 0 intensity 0.75 inner 20 outer 50 }\n"
                           "light sphere { center 2.5 2.5 1 radius 0.75 radiance 2 3 4 }\n"
                           "light rectangle { corner -2 3 -1.5 edge1 1.5 0 0 edge2 0 0.5 1 radiance 3 2 2 }\n"
                           "material floor phong { diffuse 0.75 0.625 0.5 }\n"
                           "material chalk blinn_phong { diffuse 0.25 0.5 0.75 emission 0.0625 }\n"
                           "material copper pbr { base_color 0.875 0.5 0.25 metallic 1 roughness 0.375 }\n"
                           "material clay pbr { base_color 0.5 metallic 0.25 roughness 0.75 }\n"
                           "plane { point 0 0 0 normal 0 1 0 material floor }\n"
                           "plane { point 0 0 -4 normal 0 0 1 material clay }\n"
                           "sphere { center -1.25 0.75 0.5 radius 0.75 material copper }\n"
                           "sphere { center 0.5 0.5 1.75 radius 0.5 material chalk }\n"
                           "sphere { center 1.5 1 -1 radius 1 material clay }\n";

// Under a sky with all that pbr has and path and whitted treat alike.
static const char garden[] =
    "image { size 40 30 samples 256 }\n"
    "camera { position 0.5 2.5 7 look_at 0 0.75 0 fov 45 }\n"
    "environment { file \"sky.hdr\" intensity 0.5 rotate 40 }\n"
    "light rectangle { corner -2 3 -1.5 edge1 1.5 0 0 edge2 0 0.5 1 radiance 3 2 2 }\n"
    "material floor pbr { base_color 0.75 0.625 0.5 roughness 1 }\n"
    "material copper pbr { base_color 0.875 0.5 0.25 metallic 1 roughness 0.125 }\n"
    "material clay pbr { base_color 0.5 metallic 0.25 roughness 0.5 }\n"
    "material dull pbr { base_color 0.5 0.75 0.25 roughness 0.01 }\n"
    "plane { point 0 0 0 normal 0 1 0 material floor }\n"
    "sphere { center -1.25 0.75 0.5 radius 0.75 material copper }\n"
    "sphere { center 0.5 0.5 1.75 radius 0.5 material dull }\n"
    "sphere { center 1.5 1 -1 radius 1 material clay }\n";

static void expect_alike(Device *device, const char *scene, const char *what)
{
    static const char settings[] = "render { integrator %s max_depth 0 }\n%s";
    char *whitted_text = text_of(settings, "whitted", scene), *path_text = text_of(settings, "path", scene);
    Layout *whitted = layout_of(whitted_text), *path = layout_of(path_text);
    assert_true(path->path.on && !whitted->path.on);
    Seeds a = seeds_render(device, whitted, 1, SEEDS), b = seeds_render(device, path, 1, SEEDS);
    expect_same_mean(&a, &b, 2e-3, what);
    seeds_destroy(&a);
    seeds_destroy(&b);
    layout_destroy(whitted);
    layout_destroy(path);
    free(whitted_text);
    free(path_text);
}

static void test_lights(void **state) { expect_alike(*state, room, "lights, whitted and path"); }

static void test_sky(void **state) { expect_alike(*state, garden, "sky, whitted and path"); }

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_lights, device),
                                       cmocka_unit_test_prestate(test_sky, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
