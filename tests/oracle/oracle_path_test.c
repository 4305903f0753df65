/* The path integrator against closed forms. */
#include <stdio.h>
#include <string.h>

#include "environment.h"
#include "film.h"
#include "light.h"
#include "oracle_test.h"
#include "scatter.h"

/* The pixel's centre of a scene of one pixel by rounds of one path each. */
static Vec path_pixel(const char *text, int rounds)
{
    Scene scene;
    scene_init(&scene);
    scene.width = scene.height = 1;
    scene.path = true;
    scene_read_text(&scene, text);
    Camera camera = camera_make(&scene);
    Paths paths = {1, rounds, 0};
    Vec value = film_paths(&scene, &camera, &paths, 0, 0, 0, 0).mean;
    scene_free(&scene);
    return value;
}

/* Straight down on a floor of the material m; little reaches the camera's sides. */
#define DOWN "camera { position 0 0.5 0 look_at 0 0 0 up 0 0 -1 } " \
             "plane { point 0 0 0 normal 0 1 0 material m } "
#define PATH(depth) "render { integrator path max_depth " #depth " } "
#define UNDER_SKY PATH(3) "background 1 "

static void test_punctual(void **state)
{
    (void)state;
    /* A diffuse surface is as bright as under whitted, but for the ambient term. */
    static const char LIT[] =
        "ambient 0 camera { position 0 2 3 look_at 0 0 0 } plane { point 0 0 0 normal 0 1 0 material m } "
        "light point { position 1 2 0 intensity 3 2 1 attenuation 1 0.1 0.2 } "
        "light directional { direction 1 -1 0 intensity 0.3 } "
        "light spot { position 0 3 1 look_at 0.3 0 0 intensity 2 inner 5 outer 30 } "
        "light point { position 0 -1 0 intensity 9 } ";
    static const char *const MATERIALS[] = {"material m phong { diffuse 0.5 0.6 0.7 }",
                                            "material m pbr { roughness 0.3 metallic 0.4 }",
                                            "material m pbr { roughness 0 }"};
    for (size_t i = 0; i < CASES(MATERIALS); i++) {
        char text[700];
        snprintf(text, sizeof text, "%s%s", MATERIALS[i], LIT);
        assert_vec_near(path_pixel(text, 2), pixel_of(text), 1e-15L);
    }
    assert_near(path_pixel("ambient 9 material m phong { ambient 1 } " DOWN, 2).x, 0, 0);
    /* The lobe has its norm and its cosine: light at 60 degrees from a normal that the eye is on. */
    static const char LOBE[] = "material m %s { diffuse 0 specular 0.5 shininess 3 } " DOWN
                               "light directional { direction 0.866025403784438646764 -0.5 0 intensity 2 } ";
    char text[400];
    snprintf(text, sizeof text, LOBE, "phong");
    assert_near(path_pixel(text, 2).x, PI * 2 * 0.5L * 0.5L * 5 / (2 * PI) / 8, 1e-15L);
    snprintf(text, sizeof text, LOBE, "blinn_phong");
    assert_near(path_pixel(text, 2).x, PI * 2 * 0.5L * 0.5L * 11 / (8 * PI) * powl(0.75L, 1.5L), 1e-15L);
}

static void test_furnace(void **state)
{
    (void)state;
    /* In a sky of 1 a diffuse surface is its albedo, whatever the depth; phong's lobe seen straight, k_s. */
    assert_near(path_pixel(UNDER_SKY "material m phong { diffuse 0.3 } " DOWN, 16).x, 0.3L, 1e-15L);
    assert_near(path_pixel(UNDER_SKY "material m phong { diffuse 0 specular 0.6 shininess 5 } " DOWN,
                           40000).x, 0.6L, 2e-3L);
    /* blinn_phong's, with u = cos^2 of half the angle: (n + 8) / 4 times the integral of u^(n/2) (2 u - 1)
     * 2 du from 1/2 to 1. */
    real n = 9;
    real half = powl(0.5L, n / 2);
    real whole = 2 * ((2 - 0.5L * half) / (n / 2 + 2) - (1 - 0.5L * half) / (n / 2 + 1));
    assert_near(path_pixel(UNDER_SKY "material m blinn_phong { diffuse 0 specular 0.6 shininess 9 } " DOWN,
                           40000).x, 0.6L * (n + 8) / 4 * whole, 2e-3L);
    /* Rough metal of roughness 1: 1 - ln 2. */
    assert_near(path_pixel(UNDER_SKY "material m pbr { base_color 1 metallic 1 roughness 1 } " DOWN, 40000).x,
                1 - logl(2), 2e-3L);
    /* Closed and of emission E and albedo rho: E sum rho^k up to the depth. */
    static const char ROOM[] = "material m phong { diffuse 0.7 emission 0.25 } "
                               "sphere { center 0.3 0 0 radius 1 material m } "
                               "render { integrator path max_depth %d }";
    real expected = 0;
    for (int depth = 0; depth <= 6; depth++) {
        expected += 0.25L * powl(0.7L, depth);
        char text[300];
        snprintf(text, sizeof text, ROOM, depth);
        assert_near(path_pixel(text, 4).x, expected, 1e-15L);
        /* A lamp outside is one more way to choose directions, and no light. */
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 " light sphere { center 3 1 0 radius 1.5 radiance 9 }");
        assert_near(path_pixel(text, 4000).x, expected, 0.01L * expected);
    }
}

/* Irradiance of a square of half side h at height 1 above a floor, from its middle. */
static real square_irradiance(real h)
{
    real side = sqrtl(1 + h * h);
    return 4 * h / side * atanl(h / side);
}

#define LAMP "light rectangle { corner -0.5 1 -0.5 edge1 1 0 0 edge2 0 0 1 radiance 3 } "

static void test_area_lights(void **state)
{
    (void)state;
    real square = 0.8L * 3 / PI * square_irradiance(0.5L);
    assert_near(path_pixel(PATH(0) "material m phong { } " DOWN LAMP, 8000).x, square, 1e-2L * square);
    assert_near(path_pixel(PATH(4) "material m phong { } " DOWN LAMP, 8000).x, square, 1e-2L * square);
    real sphere = 0.8L * 2 * 0.5L * 0.5L / 4;
    assert_near(path_pixel(PATH(0) "material m phong { } " DOWN
                           "light sphere { center 0 2 0 radius 0.5 radiance 2 } ", 20000).x,
                sphere, 1e-2L * sphere);
    /* Seen by the camera and by a mirror, which is one deeper. */
    assert_near(path_pixel(PATH(0) "light sphere { center 0 0 -5 radius 1 radiance 3 }", 2).x, 3, 0);
    static const char MIRROR[] = "material m phong { diffuse 0 reflect 0.5 } " DOWN LAMP
                                 "render { max_depth %d }";
    char text[400];
    snprintf(text, sizeof text, MIRROR, 1);
    assert_near(path_pixel(text, 2).x, 1.5L, 1e-15L);
    snprintf(text, sizeof text, MIRROR, 0);
    assert_near(path_pixel(text, 2).x, 0, 0);
}

/* Where nothing is scattered twice and nothing transmits, pbr is as under whitted. */
static void test_beside_whitted(void **state)
{
    (void)state;
    static const char *const MATERIALS[] = {
        "base_color 0.9 0.5 0.2 metallic 0.6 roughness 0.2", "base_color 0.9 0.5 0.2 roughness 0.6",
        "base_color 0.9 0.5 0.2 metallic 0.5 roughness 0.3 normal_map tilt",
        "base_color 0.9 0.5 0.2 roughness 0"};
    for (size_t i = 0; i < CASES(MATERIALS); i++) {
        Scene scene;
        scene_init(&scene);
        char text[900];
        snprintf(text, sizeof text,
                 "ambient 0 texture tilt checker { colors 0.9 0.5 0.8  0.9 0.5 0.8 } material m pbr { %s } "
                 "camera { position -2 0.7 0 look_at 0 0 0 } render { max_depth 0 } "
                 "plane { point 0 0 0 normal 0 1 0 material m } sphere { center 0.4 0.4 -0.6 radius 0.3 } "
                 "light rectangle { corner 1 1 0.5 edge1 0 0 -1 edge2 0 1 0 radiance 3 } "
                 "light sphere { center 1 0.3 1 radius 0.25 radiance 4 } ", MATERIALS[i]);
        scene_read_text(&scene, text);
        Vec texels[8];
        for (int k = 0; k < 8; k++)
            texels[k] = grey(k == 2 ? 8 : k * 0.1L);
        Image image = {4, 2, true, texels, texels};
        scene.environment = (Environment){.image = &image, .intensity = vec(0.5L, 1, 2)};
        environment_turn(&scene.environment, 30);
        environment_prepare(&scene.store, &scene.environment);
        scene.width = scene.height = 1;
        scene.points = 20000;
        Camera camera = camera_make(&scene);
        Vec expected = film_pixel(&scene, &camera, 1, 0, 0, 0, 0);
        Estimate value = film_paths(&scene, &camera, &(Paths){1, 40000, 1}, 0, 0, 0, 0);
        for (int channel = 0; channel < 3; channel++) {
            real error = sqrtl(component(value.variance, channel));
            assert_true(error < 0.01L * component(expected, channel));
            assert_near(component(value.mean, channel), component(expected, channel), 5 * error);
        }
        scene_free(&scene);
    }
}

static void test_glass(void **state)
{
    (void)state;
    /* Glass that absorbs nothing is not seen in a constant sky. */
    assert_near(path_pixel(PATH(64) "background 1 "
                           "material g phong { diffuse 0 reflect 1 transmit 1 fresnel on } "
                           "sphere { center 0.3 0.2 -3 radius 1 material g }", 64).x, 1, 1e-12L);
    assert_near(path_pixel(PATH(64) "background 1 material g pbr { base_color 1 transmit 1 roughness 0.5 } "
                           "sphere { center 0.6 0.3 -3 radius 1 material g }", 64).x, 1, 1e-12L);
    /* Shadow rays end at it: a point light's light does not come through, a lamp's does once a ray may be as
     * deep as the lamp behind it. */
    static const char PANE[] = "material m phong { } material g phong { diffuse 0 transmit 1 ior 1 } "
                               "plane { point 0 0.75 0 normal 0 1 0 material g } ";
    char text[600];
    snprintf(text, sizeof text, "%s" PATH(9) DOWN "light point { position 0 1 0 }", PANE);
    assert_near(path_pixel(text, 4).x, 0, 0);
    snprintf(text, sizeof text, "%s" PATH(1) DOWN LAMP, PANE);
    assert_near(path_pixel(text, 400).x, 0, 0);
    snprintf(text, sizeof text, "%s" PATH(2) DOWN LAMP, PANE);
    real square = 0.8L * 3 / PI * square_irradiance(0.5L);
    assert_near(path_pixel(text, 20000).x, square, 1e-2L * square);
}

static void test_shadows_off(void **state)
{
    (void)state;
    /* A glowing ceiling hides the sky and the lamp above it, but not without shadows; it is a surface of its
     * own all the same. */
    static const char CEILED[] = "material m phong { } material c phong { diffuse 0 emission 0.5 } "
                                 "background 1 plane { point 0 0.75 0 normal 0 1 0 material c } ";
    real square = 0.8L * 3 / PI * square_irradiance(0.5L);
    static const char *const RENDER[] = {"render { max_depth 0 shadows off }",
                                         "render { max_depth 1 shadows off }", "render { max_depth 1 }"};
    /* The ray that meets the lamp's surface brings it once. */
    real expected[] = {0.8L + square, 0.8L * 1.5L + square, 0.4L};
    for (size_t i = 0; i < CASES(RENDER); i++) {
        char text[600];
        snprintf(text, sizeof text, "%s" DOWN LAMP "%s", CEILED, RENDER[i]);
        assert_near(path_pixel(text, 20000).x, expected[i], 1e-2L * expected[i]);
    }
}

/* The chosen directions have the density that they say: it integrates to 1 over the sphere, and over a cap to
 * the share of them that lies there. */
static void test_densities(void **state)
{
    (void)state;
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene,
                    "material p phong { specular 1 shininess 7 } "
                    "material b blinn_phong { specular 1 shininess 7 } "
                    "material g pbr { roughness 0.6 } "
                    "light sphere { center 0.3 2 0.4 radius 1.3 radiance 1 } "
                    "light rectangle { corner -1 1 1 edge1 0 0.5 -2 edge2 2 0.3 0 radiance 1 } ");
    Hit hit = {.normal = {0, 1, 0}};
    Lattice lattice = lattice_at(200000, grey(1), 0);
    for (int i = 0; i < 5; i++) {
        Spot spot = {.scene = &scene, .hit = &hit, .d = {0, -1, 0}, .normal = {0, 1, 0}};
        spot.look.material = &scene.materials[i < 3 ? i : 0];
        spot.look.roughness = 0.6L;
        int way = i < 3 ? WAY_LOBE : WAY_LIGHTS + i - 3;
        assert_true(scatter_has(&spot, way));
        real total = 0, above = 0, chosen = 0;
        for (int k = 0; k < lattice.count; k++) {
            Square s = lattice_point(&lattice, k);
            Vec any = around(vec(0, 1, 0), 2 * s.x - 1, s.y);
            real density = scatter_density(&spot, way, any);
            total += density * 4 * PI / lattice.count;
            above += any.y > 0.8L ? density * 4 * PI / lattice.count : 0;
            Vec l = scatter_choose(&spot, way, s);
            assert_true(scatter_density(&spot, way, l) > 0);
            chosen += l.y > 0.8L ? 1 / (real)lattice.count : 0;
        }
        assert_near(total, 1, 3e-3L);
        assert_near(above, chosen, 3e-3L);
    }
    scene_free(&scene);
}

/* The variance is that of the value over independent seeds; a filter's weights have the mean 1. */
static void test_variance(void **state)
{
    (void)state;
    static const char *const FILTERS[] = {"box", "tent", "gaussian", "mitchell"};
    for (size_t i = 0; i < CASES(FILTERS); i++) {
        char text[400];
        snprintf(text, sizeof text, "image { filter %s samples 4 } camera { orthographic 1 } background 1 "
                 "sphere { center 0.8 0 -2 radius 0.7 }", FILTERS[i]);
        Scene scene;
        scene_init(&scene);
        scene_read_text(&scene, text);
        scene.width = scene.height = 1;
        Camera camera = camera_make(&scene);
        enum { SEEDS = 400 };
        real sum = 0, squares = 0, variance = 0;
        for (unsigned int seed = 0; seed < SEEDS; seed++) {
            Estimate value = film_paths(&scene, &camera, &(Paths){2, 8, seed}, 0, 0, 0, 0);
            sum += value.mean.x / SEEDS;
            squares += value.mean.x * value.mean.x / SEEDS;
            variance += value.variance.x / SEEDS;
        }
        real spread = squares - sum * sum;
        assert_true(spread > 0);
        assert_near(variance, spread, 0.25L * spread);
        scene.primitive_count = scene.run_count = 0;
        Estimate empty = film_paths(&scene, &camera, &(Paths){8, 100, 0}, 0, 0, 0, 0);
        assert_near(empty.mean.x, 1, 4 * sqrtl(empty.variance.x) + 1e-15L);
        scene_free(&scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_punctual),       cmocka_unit_test(test_furnace),
        cmocka_unit_test(test_area_lights),    cmocka_unit_test(test_beside_whitted),
        cmocka_unit_test(test_glass),          cmocka_unit_test(test_shadows_off),
        cmocka_unit_test(test_densities),      cmocka_unit_test(test_variance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
