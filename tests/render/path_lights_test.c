// More lights than a path looks at for each hit, which it draws by a table: the light of all of them on a
// plane, by closed forms; and lights that cast no shadows.
#include "irradiance.h"
#include "statistics.h"

static const f64 pi = 3.14159265358979323846;

// Lights above the plane z = 0, so apart that none hides another one from the origin.
typedef struct Lamps {
    char *text;
    f64 shine;  // radiance that a white plane sends back of them, at the origin
    f64 hidden; // share of the sky that their surfaces hide there, weighed by the cosine
} Lamps;

static void add_sphere(Lamps *lamps, Vec3 dir, f64 distance, f64 radius, f64 radiance)
{
    const f64 share = sphere_irradiance(asin(radius / distance), acos(dir.z)) / pi;
    text_append(&lamps->text, "light sphere { center %.17g %.17g %.17g radius %.17g radiance %.9g }\n",
                dir.x * distance, dir.y * distance, dir.z * distance, radius, radiance);
    lamps->shine += share * radiance;
    lamps->hidden += share;
}

// About the direction; it shines towards the origin or, where `away`, to the other side.
static void add_rectangle(Lamps *lamps, Vec3 dir, f64 distance, f64 side, f64 radiance, bool away)
{
    const Vec3 a = vec_scale(vec_normalize(vec_cross(dir, (Vec3){0.3, -0.9, 0.2})), side);
    const Vec3 b = vec_scale(vec_normalize(vec_cross(dir, a)), side * 0.75);
    const Vec3 corner = vec_sub(vec_scale(dir, distance), vec_scale(vec_add(a, b), 0.5));
    const Vec3 edge1 = away ? a : b, edge2 = away ? b : a; // a x b leads away from the origin
    const Polygon polygon = {{corner, vec_add(corner, a), vec_add(corner, vec_add(a, b)), vec_add(corner, b)},
                             4};
    const f64 share = polygon_irradiance(polygon, (Vec3){0, 0, 0}) / pi;
    text_append(&lamps->text,
                "light rectangle { corner %.17g %.17g %.17g edge1 %.17g %.17g %.17g "
                "edge2 %.17g %.17g %.17g radiance %.9g }\n",
                corner.x, corner.y, corner.z, edge1.x, edge1.y, edge1.z, edge2.x, edge2.y, edge2.z, radiance);
    lamps->shine += away ? 0 : share * radiance;
    lamps->hidden += share;
}

static void add_punctual(Lamps *lamps, Vec3 dir, f64 intensity, u32 kind)
{
    const Vec3 at = vec_scale(dir, 0.5);
    if (kind == 0)
        text_append(&lamps->text,
                    "light point { position %.17g %.17g %.17g intensity %.9g attenuation 0 0 1 }\n", at.x,
                    at.y, at.z, intensity);
    else if (kind == 1)
        text_append(&lamps->text, "light directional { direction %.17g %.17g %.17g intensity %.9g }\n",
                    -dir.x, -dir.y, -dir.z, intensity);
    else
        text_append(&lamps->text,
                    "light spot { position %.17g %.17g %.17g look_at 0 0 0 intensity %.9g outer 30 }\n", at.x,
                    at.y, at.z, intensity);
    lamps->shine += dir.z * intensity * (kind == 0 ? 4 : 1);
}

// Area lights on rings about the pole, brightnesses over four powers of ten; between them lights without
// area, in front of all others.
static Lamps lamps_make(void)
{
    Lamps lamps = {0};
    u64 seed = 7;
    for (u32 i = 0; i < 24; i++) {
        const u32 ring = i / 8;
        const f64 turn = 2 * pi * (i % 8) / 8, tilt = (20 + 25 * ring) * pi / 180;
        const Vec3 dir = {sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)};
        const f64 distance = random_in(&seed, 1, 5), radiance = pow(10, random_in(&seed, -2, 2)),
                  size = ring ? 0.15 : 0.1;
        if (i % 2)
            add_sphere(&lamps, dir, distance, size / 2 * distance, radiance);
        else
            add_rectangle(&lamps, dir, distance, size * distance, radiance, i % 6 == 0);
    }
    for (u32 i = 0; i < 9; i++) {
        const f64 turn = 2 * pi * (i + 0.5) / 8, tilt = (15 + 7 * i) * pi / 180;
        const Vec3 dir = {sin(tilt) * cos(turn), sin(tilt) * sin(turn), cos(tilt)};
        add_punctual(&lamps, dir, pow(10, random_in(&seed, -3, 0)), i % 3);
    }
    return lamps;
}

// A ceiling of lights so large that rays which do not look for them find them as often; the other kinds, for
// one program, below the plane.
static Lamps ceiling_make(void)
{
    Lamps lamps = {0};
    u64 seed = 9;
    text_append(&lamps.text, "light sphere { center 0 0 -5 radius 1 radiance 1 }\n"
                             "light point { position 0 0 -2 }\nlight directional { direction 0 0 1 }\n"
                             "light spot { position 0 0 -2 look_at 0 0 0 }\n");
    for (u32 i = 0; i < 12; i++) {
        const f64 x = i % 4 * 1.5 - 3, y = i / 4 * 1.5 - 2, radiance = pow(10, random_in(&seed, -1, 1));
        const Polygon tile = {{{x, y, 1}, {x + 1.5, y, 1}, {x + 1.5, y + 1.5, 1}, {x, y + 1.5, 1}}, 4};
        const f64 share = polygon_irradiance(tile, (Vec3){0, 0, 0}) / pi;
        text_append(&lamps.text,
                    "light rectangle { corner %.17g %.17g 1 edge1 0 1.5 0 edge2 1.5 0 0 radiance %.9g }\n", x,
                    y, radiance);
        lamps.shine += share * radiance;
        lamps.hidden += share;
    }
    return lamps;
}

static Estimate estimate_under(Device *device, const char *lights, const char *settings, f64 sky,
                               LightSampling sampling)
{
    char *text =
        text_of("image { size 32 32 samples 256 }\nrender { integrator path %s }\nbackground %.17g\n"
                "camera { position 0 0 1e-5 look_at 0 0 0 orthographic 1e-6 }\n"
                "material white phong { diffuse 1 }\nplane { point 0 0 0 normal 0 0 1 material white }\n%s",
                settings, sky, lights);
    Layout *layout = layout_by(text, sampling);
    assert_non_null(layout->light_table);
    Picture picture = render_layout(device, layout, NULL);
    const Estimate estimate = estimate_of(&picture, 0);
    picture_destroy(&picture);
    layout_destroy(layout);
    free(text);
    return estimate;
}

static void test_many_lights(void **state)
{
    static const struct {
        const char *settings, *name;
        f64 sky;
        LightSampling sampling;
    } cases[] = {{"max_depth 0", "dark sky, depth 0", 0.001, LIGHT_SAMPLING_BOTH},
                 {"max_depth 2", "dark sky", 0.001, LIGHT_SAMPLING_BOTH},
                 {"max_depth 2", "dark sky, by lights", 0.001, LIGHT_SAMPLING_LIGHTS},
                 {"max_depth 2", "dark sky, by surfaces", 0.001, LIGHT_SAMPLING_SURFACES},
                 {"max_depth 2", "bright sky", 10, LIGHT_SAMPLING_BOTH},
                 {"max_depth 1", "bright sky, by lights", 10, LIGHT_SAMPLING_LIGHTS}};
    Lamps lamps = lamps_make();
    Verdicts verdicts = {0};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 expected = lamps.shine + cases[i].sky * (1 - lamps.hidden);
        verdict_add(&verdicts, cases[i].name,
                    estimate_under(*state, lamps.text, cases[i].settings, cases[i].sky, cases[i].sampling),
                    expected, 0.02 * expected);
    }
    verdicts_end(&verdicts);
    free(lamps.text);
}

static void test_large_lights(void **state)
{
    static const LightSampling ways[] = {LIGHT_SAMPLING_BOTH, LIGHT_SAMPLING_LIGHTS, LIGHT_SAMPLING_SURFACES};
    static const f64 skies[] = {0.001, 1};
    Lamps lamps = ceiling_make();
    Verdicts verdicts = {0};
    for (u32 i = 0; i < 6; i++) {
        const f64 sky = skies[i / 3], expected = lamps.shine + sky * (1 - lamps.hidden);
        char *what = text_of("ceiling, sky %g, way %u", sky, i % 3);
        verdict_add(&verdicts, what, estimate_under(*state, lamps.text, "max_depth 2", sky, ways[i % 3]),
                    expected, 0.01 * expected);
        free(what);
    }
    verdicts_end(&verdicts);
    free(lamps.text);
}

// Nothing is hidden: not the sky by lights, nor anything by the lid.
static void test_no_shadows(void **state)
{
    static const f64 skies[] = {0.001, 10};
    Lamps lamps = lamps_make();
    text_append(&lamps.text,
                "material soot phong { diffuse 0 }\nsphere { center 0 0 0.25 radius 0.125 material soot }\n");
    Verdicts verdicts = {0};
    for (size_t i = 0; i < 2; i++) {
        char *what = text_of("no shadows, sky %g", skies[i]);
        const f64 expected = lamps.shine + skies[i];
        for (u32 depth = 0; depth < 2; depth++)
            verdict_add(&verdicts, what,
                        estimate_under(*state, lamps.text,
                                       depth ? "shadows off max_depth 3" : "shadows off max_depth 0",
                                       skies[i], LIGHT_SAMPLING_BOTH),
                        expected, 0.02 * expected);
        free(what);
    }
    verdicts_end(&verdicts);
    free(lamps.text);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {cmocka_unit_test_prestate(test_many_lights, device),
                                       cmocka_unit_test_prestate(test_large_lights, device),
                                       cmocka_unit_test_prestate(test_no_shadows, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
