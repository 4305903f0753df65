/* The integrals: area lights, environment, ambient occlusion, filters and the lens, against closed forms. */
#include <stdio.h>

#include "environment.h"
#include "film.h"
#include "light.h"
#include "oracle_test.h"

/* A camera straight down on one point of a floor, through nothing that stands above 0.5. */
#define DOWN "camera { position %Lg 0.5 %Lg look_at %Lg 0 %Lg up 0 0 -1 } "

/* The mean of many points, as the golden images take them. */
static Vec pixel_of_points(const char *text, int points)
{
    Scene scene;
    scene_init(&scene);
    scene.width = scene.height = 1;
    scene.points = points;
    scene_read_text(&scene, text);
    Camera camera = camera_make(&scene);
    Vec value = film_pixel(&scene, &camera, 1, 0, 0, 0, 0);
    scene_free(&scene);
    return value;
}

/* Irradiance of a polygon of radiance 1 on an unoccluded horizon (Lambert): 1/2 sum of angle times the edge's
 * normal. */
static real lambert(Vec p, Vec n, const Vec *corners, int count)
{
    real sum = 0;
    for (int i = 0; i < count; i++) {
        Vec a = normalized(sub(corners[i], p));
        Vec b = normalized(sub(corners[(i + 1) % count], p));
        sum += acosl(dot(a, b)) * dot(n, normalized(cross(a, b))) / 2;
    }
    return fabsl(sum);
}

static void test_rectangle_irradiance(void **state)
{
    (void)state;
    static const real PLACES[][2] = {{0, 0}, {0.3L, -0.2L}, {2, 1}};
    const Vec corners[4] = {{-0.5L, 0.75L, 0.5L}, {-0.5L, 0.75L, -0.5L}, {1, 1.25L, -0.5L}, {1, 1.25L, 0.5L}};
    for (size_t i = 0; i < CASES(PLACES); i++) {
        real x = PLACES[i][0], z = PLACES[i][1];
        real e = lambert(vec(x, 0, z), vec(0, 1, 0), corners, 4);
        char text[600];
        snprintf(text, sizeof text, DOWN "ambient 0 plane { point 0 0 0 normal 0 1 0 } "
                 "light rectangle { corner -0.5 0.75 -0.5 edge1 1.5 0.5 0 edge2 0 0 1 radiance 3 } ",
                 x, z, x, z);
        assert_near(pixel_of_points(text, 4000).x, (real)0.8 * 3 * e / PI, 1e-3L * e);
        /* The other way round it is black below. */
        snprintf(text, sizeof text, DOWN "ambient 0 plane { point 0 0 0 normal 0 1 0 } "
                 "light rectangle { corner -0.5 0.75 -0.5 edge2 1.5 0.5 0 edge1 0 0 1 radiance 3 } ",
                 x, z, x, z);
        assert_near(pixel_of_points(text, 100).x, 0, 0);
    }
}

static void test_sphere_irradiance(void **state)
{
    (void)state;
    /* A sphere wholly above the horizon: pi L (r/d)^2 cos. Also one that almost touches. */
    static const real PLACES[][3] = {{0, 2, 0.5L}, {1, 1.5L, 0.4L}, {0, 0.3L, 0.2999L}};
    for (size_t i = 0; i < CASES(PLACES); i++) {
        real x = PLACES[i][0], y = PLACES[i][1], r = PLACES[i][2];
        real d2 = x * x + y * y;
        real e = PI * r * r / d2 * y / sqrtl(d2);
        char text[600];
        snprintf(text, sizeof text, "camera { position 0.1 5e-5 0 look_at 0 0 0 } ambient 0 "
                 "light sphere { center %Lg %Lg 0 radius %Lg radiance 2 } "
                 "plane { point 0 0 0 normal 0 1 0 } ", x, y, r);
        assert_near(pixel_of_points(text, 4000).x, (real)0.8 * 2 * e / PI, 2e-3L * e);
    }
    /* Seen itself: bright from outside, black from inside, and it casts a shadow of other lights. */
    assert_near(pixel_of("light sphere { center 0 0 -5 radius 1 radiance 3 }").x, 3, 0);
    assert_near(pixel_of("light sphere { center 0 0 0 radius 1 radiance 3 }").x, 0, 0);
    assert_near(pixel_of("light rectangle { corner -1 -1 -5 edge1 2 0 0 edge2 0 2 0 radiance 3 }").x, 3, 0);
    assert_near(pixel_of("light rectangle { corner -1 -1 -5 edge2 2 0 0 edge1 0 2 0 radiance 3 }").x, 0, 0);
    assert_near(pixel_of("ambient 0 camera { position 2 1 0 look_at 0 0 0 } "
                         "plane { point 0 0 0 normal 0 1 0 } "
                         "light directional { direction 0 -1 0 } "
                         "light rectangle { corner -1 2 -1 edge1 2 0 0 edge2 0 0 2 radiance 0 }").x, 0, 0);
}

static void test_occlusion(void **state)
{
    (void)state;
    /* A sphere over a floor hides sin^2 of its half angle times the cosine of its direction. */
    real x = 0.5L, y = 1, r = 0.4L;
    real d2 = x * x + y * y;
    real hidden = r * r / d2 * y / sqrtl(d2);
    const char *scene =
        "camera { position -0.3 0.1 0 look_at 0 0 0 } ambient 1 render { ambient_occlusion 1 %s } "
                        "plane { point 0 0 0 normal 0 1 0 } sphere { center 0.5 1 0 radius 0.4 }";
    char text[400];
    snprintf(text, sizeof text, scene, "100");
    assert_near(pixel_of_points(text, 20000).x, (real)0.8 * (1 - hidden), 1e-3L);
    snprintf(text, sizeof text, scene, "0.7");
    assert_near(pixel_of_points(text, 2000).x, (real)0.8, 0);
    /* A normal map that tilts by 60 degrees puts (1 - cos 60) / 2 of the directions below the surface. */
    Scene tilted;
    scene_init(&tilted);
    tilted.width = tilted.height = 1;
    tilted.points = 20000;
    scene_read_text(&tilted, "camera { position 0 5 0 look_at 0 0 0 up 0 0 -1 } ambient 1 "
                             "render { ambient_occlusion 1 1 } texture t checker { colors 0 0 } "
                             "material m phong { normal_map t } "
                             "plane { point 0 0 0 normal 0 1 0 material m }");
    tilted.textures[0].colors[0] = tilted.textures[0].colors[1] = vec(0.5L + sqrtl(3) / 4, 0.5L, 0.75L);
    Camera camera = camera_make(&tilted);
    assert_near(film_pixel(&tilted, &camera, 1, 0, 0, 0, 0).x, (real)0.8 * 0.75L, 1e-3L);
    scene_free(&tilted);
}

/* A constant map of radiance 1. */
static Image constant_map(Vec *texel)
{
    *texel = grey(1);
    return (Image){1, 1, true, texel, texel};
}

static void test_environment_directions(void **state)
{
    (void)state;
    Environment environment = {.intensity = grey(1)};
    environment_turn(&environment, 0);
    real u, v;
    environment_uv(&environment, vec(0, 0, -1), &u, &v);
    assert_near(u, 0.5L, 1e-18L);
    assert_near(v, 0.5L, 1e-18L);
    environment_uv(&environment, vec(1, 0, 0), &u, &v);
    assert_near(u, 0.75L, 1e-18L);
    environment_uv(&environment, vec(-1, 0, 0), &u, &v);
    assert_near(u, 0.25L, 1e-18L);
    environment_uv(&environment, vec(0, 1, 0), &u, &v);
    assert_near(v, 0, 1e-18L);
    environment_uv(&environment, vec(0, -1, 0), &u, &v);
    assert_near(v, 1, 1e-18L);
    /* A right-hand turn by 90 degrees takes -z to -x: what was ahead is found there. */
    environment_turn(&environment, 90);
    environment_uv(&environment, vec(-1, 0, 0), &u, &v);
    assert_near(u, 0.5L, 1e-18L);
    assert_vec_near(environment_direction(&environment, 0.5L, 0.5L), vec(-1, 0, 0), 1e-18L);
    assert_vec_near(environment_direction(&environment, 0.5L, 0), vec(0, 1, 0), 1e-18L);
}

static void test_environment_sampling(void **state)
{
    (void)state;
    /* The mean of 1 / density over the chosen directions is the solid angle, and their densities integrate to
     * 1. */
    Vec texels[8];
    for (int i = 0; i < 8; i++)
        texels[i] = grey(i == 2 ? 1000 : 1 + i);
    Image image = {4, 2, true, texels, texels};
    Store store = {NULL};
    Environment environment = {.image = &image, .intensity = grey(1)};
    environment_turn(&environment, 30);
    environment_prepare(&store, &environment);
    Lattice lattice = lattice_at(200000, grey(0), 0);
    real angle = 0, total = 0;
    for (int i = 0; i < lattice.count; i++) {
        Square s = lattice_point(&lattice, i);
        angle += 1 / environment_density(&environment, environment_choose(&environment, s)) / lattice.count;
        Vec any = around(vec(0, 1, 0), 2 * s.x - 1, s.y);
        total += environment_density(&environment, any) * 4 * PI / lattice.count;
    }
    assert_near(angle, 4 * PI, 4 * PI * 1e-3L);
    assert_near(total, 1, 1e-3L);
    store_free(&store);
}

static real furnace(const char *material, Vec eye, int points)
{
    Scene scene;
    scene_init(&scene);
    char text[400];
    snprintf(text, sizeof text,
             "ambient 1 material m pbr { %s } plane { point 0 0 0 normal 0 1 0 material m } "
             "camera { position %Lg %Lg %Lg look_at 0 0 0 up 0 0.1 -1 }", material, eye.x, eye.y, eye.z);
    scene_read_text(&scene, text);
    Vec texel;
    Image map = constant_map(&texel);
    scene.environment = (Environment){.image = &map, .intensity = grey(1)};
    environment_turn(&scene.environment, 0);
    environment_prepare(&scene.store, &scene.environment);
    scene.points = points;
    scene.width = scene.height = 1;
    Camera camera = camera_make(&scene);
    real value = film_pixel(&scene, &camera, 1, 0, 0, 0, 0).x;
    scene_free(&scene);
    return value;
}

static void test_furnace(void **state)
{
    (void)state;
    /* A smooth metal of base color 1 loses nothing; no ambient under an environment. */
    assert_near(furnace("base_color 1 metallic 1 roughness 0", vec(1, 1, 0), 10), 1, 1e-15L);
    /* ior 1: F = (1 - V.H)^5, so the whole integral lies between the diffuse part's bounds. */
    real lambertian = furnace("base_color 0.5 ior 1", vec(0, 1, 0), 4000);
    assert_true(lambertian > 0.49L && lambertian < 0.51L);
    /* Single scattering loses with roughness, never gains. The value for roughness 1 straight on, F = 1: the
     * integral of D Vis N.L; with Vis = 0.5 / (N.L + 1) and D = 1 / pi it is the integral of c / (1 + c) = 1
     * - ln 2. */
    assert_near(furnace("base_color 1 metallic 1 roughness 1", vec(0, 1, 0), 20000), 1 - logl(2), 1e-3L);
    real last = 1.0001L;
    for (int i = 1; i <= 10; i++) {
        char text[100];
        snprintf(text, sizeof text, "base_color 1 metallic 1 roughness %g", i / 10.0);
        real value = furnace(text, vec(0.6L, 0.8L, 0), 4000);
        assert_true(value < last);
        last = value + 1e-4L;
    }
}

static void test_filters(void **state)
{
    (void)state;
    /* Integrals of one axis: box and tent 1, mitchell with lobes below 0, gaussian by erf. */
    static const Filter FILTERS[] = {FILTER_BOX, FILTER_TENT, FILTER_GAUSSIAN, FILTER_MITCHELL};
    for (size_t i = 0; i < CASES(FILTERS); i++) {
        int steps = 40000;
        real sum = 0, below = 0;
        real radius = filter_radius(FILTERS[i]);
        for (int k = 0; k < steps; k++) {
            real value = filter_value(FILTERS[i], ((k + 0.5L) / steps * 2 - 1) * radius) * 2 * radius / steps;
            sum += value;
            below += value < 0 ? -value : 0;
        }
        real expected = 1;
        if (FILTERS[i] == FILTER_GAUSSIAN)
            expected = sqrtl(PI / 2) * erfl(1.5L * sqrtl(2)) - 3 * expl(-4.5L);
        assert_near(sum, expected, 1e-8L);
        if (FILTERS[i] != FILTER_MITCHELL)
            assert_near(below, 0, 0);
        else
            assert_true(below > 0.01L && below < 0.1L);
    }
    assert_near(filter_value(FILTER_MITCHELL, 0), 8.0L / 9, 1e-18L);
    assert_near(filter_value(FILTER_MITCHELL, 1), 1.0L / 18, 1e-18L);
    assert_near(filter_value(FILTER_MITCHELL, 2), 0, 1e-18L);
    assert_true(filter_value(FILTER_MITCHELL, 1.5L) < 0);
}

/* An edge through a pixel's centre and one a pixel away, by the filter's own integral over it. */
static void test_filtered_edge(void **state)
{
    (void)state;
    static const char *const NAMES[] = {"box", "tent", "gaussian", "mitchell"};
    for (int i = 0; i < 4; i++) {
        Scene scene;
        scene_init(&scene);
        char text[300];
        snprintf(text, sizeof text, "image { size 4 1 filter %s } camera { orthographic 1 } ambient 1 "
                 "triangle { vertices 0 -99 -1 200 0 -1 0 99 -1 material m }", NAMES[i]);
        char whole[400];
        snprintf(whole, sizeof whole, "material m phong { ambient 1 } %s", text);
        scene_read_text(&scene, whole);
        Camera camera = camera_make(&scene);
        real inside = 0, all = 0;
        for (int k = -20000; k < 20000; k++) {
            real x = (k + 0.5L) / 10000;
            real value = filter_value((Filter)i, x);
            all += value;
            inside += x > 0.5L ? value : 0;
        }
        /* The edge is at pixel coordinate 2: half a pixel right of the centre of pixel 1, left of that of
         * pixel 2. */
        assert_near(film_pixel(&scene, &camera, 128, 1, 0, 0, 0).x, inside / all, 1e-2L);
        assert_near(film_pixel(&scene, &camera, 128, 2, 0, 0, 0).x, 1 - inside / all, 1e-2L);
        scene_free(&scene);
    }
}

#define BRIGHT "ambient 1 material m phong { ambient 1 } "

static void test_lens(void **state)
{
    (void)state;
    /* A disk of radius 0.5 at twice the focus distance: its image on the focus plane is a disk of radius 0.25
     * seen through a lens of radius 0.3, whose points scatter over 0.3 (1/2 - 1) = 0.15 there: the centre
     * sees all of it. */
    assert_near(pixel_of_points(BRIGHT "camera { aperture 0.3 focus_distance 2 } "
                                "disk { center 0 0 -4 normal 0 0 1 radius 0.5 material m }", 1000).x,
                1, 1e-15L);
    /* Radius 0.2: rays from lens radius below 0.2 hit it, (0.2 / 0.3)^2. */
    assert_near(pixel_of_points(BRIGHT "camera { aperture 0.3 focus_distance 2 } "
                                "disk { center 0 0 -4 normal 0 0 1 radius 0.2 material m }", 9000).x,
                4.0L / 9, 1e-3L);
    /* In the focus plane, by default that of look_at, a point is a point. */
    assert_near(pixel_of_points(BRIGHT "camera { aperture 0.3 look_at 0 0 -3 } "
                                "disk { center 0 0 -3 normal 0 0 1 radius 1e-6 material m }", 1000).x,
                1, 1e-15L);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_rectangle_irradiance),
        cmocka_unit_test(test_sphere_irradiance),
        cmocka_unit_test(test_occlusion),
        cmocka_unit_test(test_environment_directions),
        cmocka_unit_test(test_environment_sampling),
        cmocka_unit_test(test_furnace),
        cmocka_unit_test(test_filters),
        cmocka_unit_test(test_filtered_edge),
        cmocka_unit_test(test_lens),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
