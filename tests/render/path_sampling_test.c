// Next-event estimation alone, sampling of surfaces alone and both together have the same expected values: on
// all lights with an area, the sky and every kind of material, three bounces deep; where shading normals are
// not those of the surface as well.
#include "statistics.h"

enum { SEEDS = 32 };

// Lights large enough to be found by rays that do not look for them.
static const char scene[] =
    "image { size 40 30 samples 256 }\n"
    "camera { position 0.5 2.5 7 look_at 0 0.75 0 fov 45 }\n"
    "render { integrator path max_depth 3 }\n"
    "light sphere { center 2.5 2.5 1 radius 0.75 radiance 2 3 4 }\n"
    "light rectangle { corner -2 3 -1.5 edge1 1.5 0 0 edge2 0 0.5 1 radiance 3 2 2 }\n"
    "light rectangle { corner 4 0 -3 edge1 0 0 4 edge2 0 2 0 radiance 0.5 0.75 1 }\n"
    "texture dents image { file \"dents.png\" filter nearest scale 8 4 }\n"
    "material floor phong { diffuse 0.75 0.625 0.5 }\n"
    "material gloss phong { diffuse 0.25 0.375 0.5 specular 0.5 shininess 40 normal_map dents }\n"
    "material satin blinn_phong { diffuse 0.5 0.25 0.25 specular 0.25 shininess 60 reflect 0.125 }\n"
    "material copper pbr { base_color 0.875 0.5 0.25 metallic 1 roughness 0.25 normal_map dents }\n"
    "material clay pbr { base_color 0.5 metallic 0.25 roughness 0.625 }\n"
    "material frost pbr { base_color 0.75 0.875 0.75 roughness 0.25 transmit 0.5 }\n"
    "material glass phong { diffuse 0 reflect 1 transmit 1 fresnel on }\n"
    "plane { point 0 0 0 normal 0 1 0 material floor }\n"
    "box { min -4 0 -5 max 4 4 -4 material clay }\n"
    "sphere { center -1.5 0.75 0.5 radius 0.75 material copper }\n"
    "sphere { center 0.25 0.5 2 radius 0.5 material glass }\n"
    "sphere { center 1.5 1 -1 radius 1 material gloss }\n"
    "sphere { center 1.625 0.5 1.5 radius 0.5 material satin }\n"
    "sphere { center -0.75 0.375 2.25 radius 0.375 material frost }\n"
    "mesh { file \"vase.obj\" smooth on scale 0.75 rotate x -20 translate 0.125 1 -1.5 material satin }\n"
    "environment { file \"sky.hdr\" intensity 0.5 rotate 40 }\n";

static void test_techniques(void **state)
{
    Seeds seeds[3];
    for (int k = 0; k < 3; k++) {
        Layout *layout = layout_by(scene, (LightSampling)k);
        seeds[k] = seeds_render(*state, layout, 1 + SEEDS * (u32)k, SEEDS);
        layout_destroy(layout);
    }
    expect_same_mean(&seeds[LIGHT_SAMPLING_BOTH], &seeds[LIGHT_SAMPLING_LIGHTS], 2e-3,
                     "both, and lights alone");
    expect_same_mean(&seeds[LIGHT_SAMPLING_BOTH], &seeds[LIGHT_SAMPLING_SURFACES], 4e-3,
                     "both, and surfaces alone");
    for (int k = 0; k < 3; k++)
        seeds_destroy(&seeds[k]);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_techniques, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
