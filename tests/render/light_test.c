// Area lights and ambient occlusion against closed forms. Each picture shows one point of a plane: its pixels
// are independent estimates of what arrives there.
#include "estimate.h"
#include "irradiance.h"

static const f64 pi = 3.14159265358979323846;

// Of everything that the scenes have there is one that neither shines on what is looked at nor is seen, so
// that they share a program.
#define ELSEWHERE                                                                                            \
    "light sphere { center 500 0 -50 radius 1 radiance 1 }\n"                                                \
    "light rectangle { corner 500 0 50 edge1 1 0 0 edge2 0 1 0 radiance 1 }\n"                               \
    "box { min 500 0 -60 max 501 1 -59 }\ntriangle { vertices 500 0 -70 501 0 -70 500 1 -70 }\n"             \
    "sphere { center 500 0 -80 radius 1 }\n"

// The scene with a camera that sees nothing but the point (x, y) of the plane z = 0, from right above it, so
// that lights and blockers are behind.
static Picture render_point(Device *device, f64 x, f64 y, u32 samples, u32 side, const char *scene)
{
    char *text = text_of("image { size %u %u samples %u }\n"
                         "camera { position %.17g %.17g 1e-5 look_at %.17g %.17g 0 orthographic 1e-6 }\n"
                         "material white phong { diffuse 1 }\n"
                         "plane { point 0 0 0 normal 0 0 1 material white }\n" ELSEWHERE "%s",
                         side, side, samples, x, y, x, y, scene);
    Picture picture = render_text(device, text, NULL);
    free(text);
    return picture;
}

static Estimate estimate_point(Device *device, f64 x, f64 y, u32 samples, const char *scene)
{
    Picture picture = render_point(device, x, y, samples, 32, scene);
    const Estimate estimate = estimate_of(&picture, 0);
    picture_destroy(&picture);
    return estimate;
}

// ---- area lights ------------------------------------------------------------------------------------------

static void test_rectangle(void **state)
{
    static const struct {
        Vec3 corner, edge1, edge2;
        f64 x, y;
        u32 lights; // samples of the light
    } cases[] = {
        { { -1, -1, 2 }, { 0, 2, 0 }, { 2, 0, 0 }, 0, 0, 1 },
        { { -1, -1, 2 }, { 0, 2, 0 }, { 2, 0, 0 }, 3, -1, 4 },
        { { -1, -1, 0.1 }, { 0, 2, 0 }, { 2, 0, 0 }, 0.3, 0.2, 4 },
        { { -1, -1, 0.1 }, { 0, 2, 0 }, { 2, 0, 0 }, 1.5, 0.2, 1 },
        { { 1, -1, -1 }, { 0.5, 0, 3 }, { 0, 2, 0 }, 0, 0.5, 2 },
        { { 1, -1, 0.25 }, { 1, 0.75, 1 }, { 0, 2, 0 }, 0.5, 0, 1 },
        { { -500, -300, 4000 }, { 0, 700, 0 }, { 900, 50, 80 }, 10, 20, 1 },
        { { -1, -1, 2 }, { 2, 0, 0 }, { 0, 2, 0 }, 0, 0, 1 }, // shines upward
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Vec3 a = cases[i].corner, b = cases[i].edge1, c = cases[i].edge2;
        const Vec3 p = {cases[i].x, cases[i].y, 0};
        const bool behind = vec_dot(vec_cross(b, c), vec_sub(p, a)) <= 0;
        const Polygon light = {{a, vec_add(a, b), vec_add(a, vec_add(b, c)), vec_add(a, c)}, 4};
        char *scene = text_of("light rectangle { corner %.17g %.17g %.17g edge1 %.17g %.17g %.17g "
                              "edge2 %.17g %.17g %.17g radiance 3 samples %u }\nambient 0\n",
                              a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, cases[i].lights);
        char *what = text_of("rectangle %zu", i);
        const Estimate found = estimate_point(*state, p.x, p.y, 64, scene);
        expect_estimate(found, behind ? 0 : 3 * polygon_irradiance(light, p) / pi, what);
        free(what);
        free(scene);
    }
}

static void test_sphere(void **state)
{
    // Place, height and radius: beside, below the horizon, next to the surface, far away.
    static const f64 cases[][3] = { { 0, 2, 1 },     { 3, 1, 0.5 },     { 3, 0.25, 1 },  { 2, -0.5, 1 },
                                    { 0, 1.001, 1 }, { 0, 1.00001, 1 }, { 1, 1.5, 1.8 }, { 500, 9e3, 1 },
                                    { 2e4, 1e4, 1 }, { 0, 1e-3, 4e-4 } };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 x = cases[i][0], z = cases[i][1], radius = cases[i][2], distance = hypot(x, z);
        char *scene = text_of("light sphere { center %.17g 0 %.17g radius %.17g radiance 2 samples %d }\n"
                              "ambient 0\n", x, z, radius, 1 + (int)i % 3);
        char *what = text_of("sphere of %g at %g %g", radius, x, z);
        const f64 half = distance > radius ? asin(radius / distance) : 0;
        const Estimate found = estimate_point(*state, 0, 0, 64, scene);
        expect_estimate(found, 2 * sphere_irradiance(half, acos(z / distance)) / pi, what);
        free(what);
        free(scene);
    }
}

// A half-plane at z = 1 over x < 0: a point of the light at z = 2 is seen where it lies beyond -x.
static void test_penumbra(void **state)
{
    static const char blocker[] = "triangle { vertices 0 -500 1 0 500 1 -500 0 1 }\nambient 0\n";
    static const f64 places[] = {-1.5, -0.8, -0.3, 0, 0.4, 0.9, 1.5};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const Vec3 p = {places[i], 0.2, 0};
        const Polygon light = {{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, 4};
        const Polygon seen = polygon_clipped(&light, (Vec3){1, 0, 0}, -p.x);
        char *scene =
            text_of("light rectangle { corner -1 -1 2 edge1 0 2 0 edge2 2 0 0 radiance 3 samples %d }\n%s",
                    1 + (int)i % 2, blocker);
        char *what = text_of("penumbra at %g", p.x);
        expect_estimate(estimate_point(*state, p.x, p.y, 64, scene), 3 * polygon_irradiance(seen, p) / pi,
                        what);
        free(what);
        free(scene);
    }
}

// The share of a sphere light's directions that pass the half-plane, weighted by their cosine.
static void test_penumbra_of_sphere(void **state)
{
    enum { RINGS = 1000, STEPS = 4000 };
    static const f64 places[] = {-0.6, -0.2, 0.1, 0.5};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const Vec3 to = {-places[i], 0, 2};
        const f64 half = asin(0.5 / vec_length(to)), tilt = atan2(to.x, to.z);
        f64 sum = 0;
        for (int ring = 0; ring < RINGS; ring++) {
            const f64 angle = (ring + 0.5) / RINGS * half;
            for (int k = 0; k < STEPS; k++) {
                const f64 turn = 2 * pi * (k + 0.5) / STEPS;
                const f64 x = sin(tilt) * cos(angle) + cos(tilt) * sin(angle) * cos(turn);
                const f64 z = cos(tilt) * cos(angle) - sin(tilt) * sin(angle) * cos(turn);
                sum += places[i] + x / z > 0 ? z * sin(angle) : 0;
            }
        }
        const f64 expected = 2 * sum * half / RINGS * 2 * pi / STEPS / pi;
        char *what = text_of("penumbra of a sphere at %g", places[i]);
        expect_estimate(
            estimate_point(*state, places[i], 0, 64,
                           "light sphere { center 0 0 2 radius 0.5 radiance 2 samples 2 }\nambient 0\n"
                           "triangle { vertices 0 -500 1 0 500 1 -500 0 1 }\n"),
            expected, what);
        free(what);
    }
}

// A light is a surface: what the camera sees of it, from both sides, and first by its place in the file.
static void test_seen(void **state)
{
    static const struct {
        const char *scene;
        f64 expected;
    } cases[] = {
        {"light rectangle { corner -1 -1 -1 edge1 2 0 0 edge2 0 2 0 radiance 5 }\n", 5},
        {"light rectangle { corner -1 -1 -1 edge1 0 2 0 edge2 2 0 0 radiance 5 }\n", 0},
        {"light sphere { center 0 0 -2 radius 1 radiance 5 }\n", 5},
        {"light sphere { center 0 0 0 radius 1 radiance 5 }\n", 0},
        {"light sphere { center 0 0 -2 radius 1 radiance 0 }\nmaterial glow phong { emission 7 }\n"
         "plane { point 0 0 -5 normal 0 0 1 material glow }\n", 0},
        {"light rectangle { corner -1 -1 -1 edge1 2 0 0 edge2 0 2 0 radiance 5 }\n"
         "plane { point 0 0 -1 normal 0 0 1 }\n", 5},
        {"plane { point 0 0 -1 normal 0 0 1 }\n"
         "light rectangle { corner -1 -1 -1 edge1 2 0 0 edge2 0 2 0 radiance 5 }\n", 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = text_of("image { size 8 6 samples 2 }\ncamera { fov 10 }\nambient 0\n"
                             "plane { point 0 0 -90 normal 0 0 1 }\n" ELSEWHERE "%s", cases[i].scene);
        Picture picture = render_text(*state, text, NULL);
        for (u32 k = 0; k < 3 * picture.width * picture.height; k++)
            if ((f64)picture.rgb[k] != cases[i].expected)
                fail_msg("light %zu seen: %g is not %g", i, (f64)picture.rgb[k], cases[i].expected);
        picture_destroy(&picture);
        free(text);
    }
}

// On the surface that carries it, and next to it, a light is not shadowed by itself or its carrier.
static void test_carried(void **state)
{
    static const char *const carriers[] = {"", "plane { point 0 0 2 normal 0 0 -1 }\n",
                                           "box { min -9 -9 2 max 9 9 3 }\n"};
    const Vec3 p = {6, 1, 0};
    const Polygon light = {{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, 4};
    for (size_t i = 0; i < sizeof carriers / sizeof *carriers; i++) {
        char *scene =
            text_of("light rectangle { corner -1 -1 2 edge1 0 2 0 edge2 2 0 0 radiance 3 }\nambient 0\n%s",
                    carriers[i]);
        expect_estimate(estimate_point(*state, p.x, p.y, 16, scene), 3 * polygon_irradiance(light, p) / pi,
                        "a light on its carrier");
        free(scene);
    }
}

// ---- ambient occlusion ------------------------------------------------------------------------------------

static void test_occlusion(void **state)
{
    static const f64 places[] = {0, 0.5, 1, 2, 5};
    for (size_t i = 0; i < sizeof places / sizeof *places; i++) {
        const f64 h = 1.5, r = 1, x = places[i];
        char *scene = text_of("render { ambient_occlusion %d 100 %s }\nambient 0.75\n"
                              "sphere { center 0 0 1.5 radius 1 }\n", 1 + (int)i, i % 2 ? "shadows off" : "");
        char *what = text_of("occlusion at %g", x);
        const f64 hidden = r * r * h / pow(h * h + x * x, 1.5);
        expect_estimate(estimate_point(*state, x, 0, 64, scene), 0.75 * (1 - hidden), what);
        free(what);
        free(scene);
    }
    // What is farther than the rays go, or is glass: nothing, and all.
    const Estimate near = estimate_point(*state, 0, 0, 16,
                                         "render { ambient_occlusion 2 0.49 }\nambient 0.75\n"
                                         "sphere { center 0 0 1.5 radius 1 }\n");
    expect_estimate(near, 0.75, "occlusion out of reach");
    const Estimate glass = estimate_point(*state, 0, 0, 16,
                                          "render { ambient_occlusion 2 9 }\nambient 0.75\n"
                                          "material glass phong { transmit 1 }\n"
                                          "light point { position 0 0 -5 }\n"
                                          "box { min -500 -500 0.5 max 500 500 1 material glass }\n");
    expect_estimate(glass, 0.75 * pow(0.5 / 9, 2), "occlusion by glass");
}

// ---- convergence ------------------------------------------------------------------------------------------

// The error of a pixel falls faster than with independent samples, whose slope is -1/2.
static void test_slope(void **state)
{
    static const char *const scenes[] = {
        "light rectangle { corner -1 -1 2 edge1 0 2 0 edge2 2 0 0 radiance 3 }\nambient 0\n",
        "light sphere { center 1 0 2 radius 1 radiance 3 }\nambient 0\n",
        "light rectangle { corner -1 -1 2 edge1 0 2 0 edge2 2 0 0 radiance 3 }\nambient 0\n"
        "triangle { vertices 0 -500 1 0 500 1 -500 0 1 }\n",
        "render { ambient_occlusion 1 9 }\nambient 1\nsphere { center 1 0 1.5 radius 1 }\n",
    };
    static const f64 slopes[] = {-1.2, -1.2, -0.65, -0.65};
    for (size_t i = 0; i < sizeof scenes / sizeof *scenes; i++) {
        f64 deviation[2];
        for (int k = 0; k < 2; k++) {
            Picture picture = render_point(*state, 0.2, 0.1, k ? 256 : 4, 32, scenes[i]);
            deviation[k] = estimate_of(&picture, 0).error * 32;
            picture_destroy(&picture);
        }
        const f64 slope = log2(deviation[1] / deviation[0]) / 6;
        print_message("scene %zu: deviation of a pixel %.4g with 4 samples, %.4g with 256: slope %.2f\n", i,
                      deviation[0], deviation[1], slope);
        assert_true(slope < slopes[i]);
    }
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_rectangle, device),
        cmocka_unit_test_prestate(test_sphere, device),
        cmocka_unit_test_prestate(test_penumbra, device),
        cmocka_unit_test_prestate(test_penumbra_of_sphere, device),
        cmocka_unit_test_prestate(test_seen, device),
        cmocka_unit_test_prestate(test_carried, device),
        cmocka_unit_test_prestate(test_occlusion, device),
        cmocka_unit_test_prestate(test_slope, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
