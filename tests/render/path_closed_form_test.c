// The path integrator against closed forms: light of spheres, rectangles and the sky on a plane by each way
// of looking for it, and light between the walls of closed rooms. Pixels of a picture are independent
// estimates of one number.
#include "irradiance.h"
#include "statistics.h"

static const f64 pi = 3.14159265358979323846;

// Of all that the scenes have there is one that nothing of interest sees, so that they share a program.
#define ELSEWHERE                                                                                            \
    "light sphere { center 0 0 -3e4 radius 1 radiance 0.5 }\n"                                               \
    "light rectangle { corner 50 0 -3e4 edge1 1 0 0 edge2 0 1 0 radiance 0.5 }\n"                            \
    "plane { point 0 0 -4e4 normal 0 0 1 }\nbox { min 0 0 -3.5e4 max 1 1 -3.4e4 }\n"                         \
    "sphere { center 90 0 -3e4 radius 1 }\n"

typedef struct Way {
    LightSampling sampling;
    u32 depth;
    const char *name;
} Way;

static const Way ways[] = {{LIGHT_SAMPLING_BOTH, 2, "both"},
                           {LIGHT_SAMPLING_LIGHTS, 2, "lights"},
                           {LIGHT_SAMPLING_SURFACES, 2, "surfaces"},
                           {LIGHT_SAMPLING_BOTH, 0, "both, depth 0"},
                           {LIGHT_SAMPLING_SURFACES, 0, "surfaces, depth 0"}};
enum { WAYS = sizeof ways / sizeof *ways };

static Estimate estimate_text(Device *device, const char *text, LightSampling sampling, u32 channel)
{
    Layout *layout = layout_by(text, sampling);
    Picture picture = render_layout(device, layout, NULL);
    const Estimate estimate = estimate_of(&picture, channel);
    picture_destroy(&picture);
    layout_destroy(layout);
    return estimate;
}

// The point (x, y) of a white plane z = 0, seen from right above.
static void expect_plane(Device *device, Verdicts *verdicts, f64 x, f64 y, const Way *way, const char *scene,
                         const char *name, f64 expected)
{
    char *text = text_of("image { size 32 32 samples 64 }\nrender { integrator path max_depth %u }\n"
                         "camera { position %.17g %.17g 1e-5 look_at %.17g %.17g 0 orthographic 1e-6 }\n"
                         "material white phong { diffuse 1 }\n"
                         "plane { point 0 0 0 normal 0 0 1 material white }\n%s",
                         way->depth, x, y, x, y, scene);
    char *what = text_of("%s, by %s", name, way->name);
    verdict_add(verdicts, what, estimate_text(device, text, way->sampling, 0), expected,
                0.03 * expected + 0.002);
    free(what);
    free(text);
}

static void test_rectangles(void **state)
{
    static const struct {
        Vec3 corner, edge1, edge2;
        f64 x, y;
    } cases[] = {
        {{-1, -1, 2}, {0, 2, 0}, {2, 0, 0}, 0, 0},
        {{-1, -1, 0.1}, {0, 2, 0}, {2, 0, 0}, 0.3, 0.2},
        {{-1, -1, 0.5}, {0, 2, 0}, {2, 0, 0}, 1.5, 0.2},
        {{1, -1, -1}, {0.5, 0, 3}, {0, 2, 0}, 0, 0.5},
        {{-500, -300, 400}, {0, 700, 0}, {900, 50, 80}, 10, 20},
        {{-1, -1, 2}, {2, 0, 0}, {0, 2, 0}, 0, 0}, // shines upward
    };
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const Vec3 a = cases[i].corner, b = cases[i].edge1, c = cases[i].edge2,
                   p = {cases[i].x, cases[i].y, 0};
        const bool behind = vec_dot(vec_cross(b, c), vec_sub(p, a)) <= 0;
        const Polygon light = {{a, vec_add(a, b), vec_add(a, vec_add(b, c)), vec_add(a, c)}, 4};
        char *scene = text_of("light rectangle { corner %.17g %.17g %.17g edge1 %.17g %.17g %.17g "
                              "edge2 %.17g %.17g %.17g radiance 3 }\n" ELSEWHERE,
                              a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z);
        char *name = text_of("rectangle %zu", i);
        for (int k = i == 0 ? 0 : 2 * ((int)i % 2); k < (i == 0 ? WAYS : 2 * ((int)i % 2) + 2); k++)
            expect_plane(*state, &verdicts, p.x, p.y, &ways[k], scene, name,
                         behind ? 0 : 3 * polygon_irradiance(light, p) / pi);
        free(name);
        free(scene);
    }
    verdicts_end(&verdicts);
}

// Above the point it is pi L (r / d)^2; elsewhere it is summed, where the horizon cuts it off as well.
static void test_spheres(void **state)
{
    static const f64 cases[][3] = {{0, 2, 1},    {3, 1, 0.5},   {3, 0.25, 1},
                                   {2, -0.5, 1}, {0, 1.001, 1}, {1, 1.5, 1.8}};
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 x = cases[i][0], z = cases[i][1], radius = cases[i][2], distance = hypot(x, z);
        char *scene = text_of("light sphere { center %.17g 0 %.17g radius %.17g radiance 2 }\n" ELSEWHERE, x,
                              z, radius);
        char *name = text_of("sphere of %g at %g %g", radius, x, z);
        const f64 summed =
            2 * sphere_irradiance(distance > radius ? asin(radius / distance) : 0, acos(z / distance)) / pi;
        const f64 expected = x == 0 ? 2 * pow(radius / distance, 2) : summed;
        for (int k = i == 0 ? 0 : 2 * ((int)i % 2); k < (i == 0 ? WAYS : 2 * ((int)i % 2) + 2); k++)
            expect_plane(*state, &verdicts, 0, 0, &ways[k], scene, name, expected);
        free(name);
        free(scene);
    }
    verdicts_end(&verdicts);
}

// A sky of radiance 1 makes a surface as bright as its albedo; a light hides its part of the sky.
static void test_sky(void **state)
{
    Verdicts verdicts = {0};
    const Polygon light = {{{-1, -1, 2}, {-1, 1, 2}, {1, 1, 2}, {1, -1, 2}}, 4};
    const f64 share = polygon_irradiance(light, (Vec3){0.5, 0, 0}) / pi;
    for (int k = 0; k < WAYS; k++) {
        expect_plane(*state, &verdicts, 0, 0, &ways[k], "background 1\n" ELSEWHERE, "sky", 1);
        expect_plane(
            *state, &verdicts, 0.5, 0, &ways[k],
            "background 1\nlight rectangle { corner -1 -1 2 edge1 0 2 0 edge2 2 0 0 radiance 3 }\n" ELSEWHERE,
            "sky and rectangle", 1 + 2 * share);
    }
    char *text = text_of(
        "image { size 32 32 samples 16 }\nrender { integrator path max_depth 3 }\nbackground 2 1 0.5\n"
        "camera { position 1 1 3 look_at 0 0 0 orthographic 1e-6 }\n"
        "material paint phong { diffuse 0.75 0.5 0.25 }\n"
        "plane { point 0 0 0 normal 0 0 1 material paint }\n" ELSEWHERE);
    for (u32 c = 0; c < 3; c++)
        verdict_add(&verdicts, "sky on paint", estimate_text(*state, text, LIGHT_SAMPLING_BOTH, c),
                    c == 0   ? 1.5
                    : c == 1 ? 0.5
                             : 0.125,
                    1e-3);
    free(text);
    verdicts_end(&verdicts);
}

static f64 geometric_sum(f64 q, u32 last) { return (1 - pow(q, last + 1)) / (1 - q); }

// All walls shine 1 and reflect rho: each ray meets 1, whatever its direction.
static void test_shining_box(void **state)
{
    static const struct {
        f64 albedo;
        u32 depth;
    } cases[] = {{0.5, 0},  {0.5, 1},  {0.5, 3}, {0.5, 64}, {0.9, 3},
                 {0.9, 12}, {0.9, 64}, {1, 5},   {1, 64},   {0.02, 9}};
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 rho = cases[i].albedo;
        char *text = text_of("image { size 32 32 samples 16 }\nrender { integrator path max_depth %u }\n"
                             "camera { position 0.25 0.5 0 look_at 0.5 0.25 -1 orthographic 1 }\n"
                             "material wall phong { diffuse %.9g emission 1 }\n"
                             "box { min -1 -1 -1 max 1 1 1 material wall }\n" ELSEWHERE,
                             cases[i].depth, rho);
        char *what = text_of("shining box, albedo %g, depth %u", rho, cases[i].depth);
        const f64 expected = rho < 1 ? geometric_sum(rho, cases[i].depth) : cases[i].depth + 1.0;
        // Up to depth 3 nothing is left to chance.
        verdict_add(&verdicts, what, estimate_text(*state, text, LIGHT_SAMPLING_BOTH, 1), expected,
                    cases[i].depth <= 3 ? 2e-6 * expected : 0.02 * expected);
        free(what);
        free(text);
    }
    verdicts_end(&verdicts);
}

// A sphere of radius 2 and albedo rho about a lamp of radius r, which swallows what it gets: the share (r /
// 2)^2 of what leaves the wall.
static void test_lamp_in_sphere(void **state)
{
    static const struct {
        f64 radius, albedo;
        u32 depth;
        LightSampling sampling;
    } cases[] = {{0.5, 0.5, 64, LIGHT_SAMPLING_BOTH},   {0.5, 0.9, 12, LIGHT_SAMPLING_BOTH},
                 {1, 0.9, 12, LIGHT_SAMPLING_LIGHTS},   {1, 0.9, 12, LIGHT_SAMPLING_SURFACES},
                 {1.5, 1, 64, LIGHT_SAMPLING_BOTH},     {1.5, 1, 64, LIGHT_SAMPLING_SURFACES},
                 {0.125, 0.75, 7, LIGHT_SAMPLING_BOTH}, {0.5, 0.9, 0, LIGHT_SAMPLING_BOTH}};
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 share = pow(cases[i].radius / 2, 2), rho = cases[i].albedo;
        char *text =
            text_of("image { size 32 32 samples 64 }\nrender { integrator path max_depth %u }\n"
                    "camera { position 0.5 1.75 0 look_at 0.5 2 0 up 0 0 1 orthographic 0.25 }\n"
                    "material wall phong { diffuse %.9g }\nsphere { center 0 0 0 radius 2 material wall }\n"
                    "light sphere { center 0 0 0 radius %.17g radiance 8 }\n" ELSEWHERE,
                    cases[i].depth, rho, cases[i].radius);
        char *what = text_of("lamp of %g in albedo %g, depth %u, way %d", cases[i].radius, rho,
                             cases[i].depth, (int)cases[i].sampling);
        const f64 expected = 8 * rho * share * geometric_sum(rho * (1 - share), cases[i].depth);
        verdict_add(&verdicts, what, estimate_text(*state, text, cases[i].sampling, 2), expected,
                    0.01 * expected);
        free(what);
        free(text);
    }
    verdicts_end(&verdicts);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_rectangles, device),
        cmocka_unit_test_prestate(test_spheres, device),
        cmocka_unit_test_prestate(test_sky, device),
        cmocka_unit_test_prestate(test_shining_box, device),
        cmocka_unit_test_prestate(test_lamp_in_sphere, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
