// Pictures whose every value is known: coverage of pixels by an edge, mirrors and panes that face each other,
// and light that adds up.
#include "support.h"

#include <float.h>
#include <math.h>

static void expect_near(f64 found, f64 expected, f64 relative, const char *what)
{
    if (!(fabs(found - expected) <= relative * fabs(expected)))
        fail_msg("%s: %.9g is not within %g of %.9g", what, found, relative, expected);
}

// Every value of the picture.
static void expect_all(const Picture *picture, f64 expected, f64 relative, const char *what)
{
    for (u32 i = 0; i < 3 * picture->width * picture->height; i++)
        expect_near((f64)picture->rgb[i], expected, relative, what);
}

// Two mirrors that face each other and shine: 1 + k + k^2 + ... up to the last depth.
static void test_facing_mirrors(void **state)
{
    static const struct {
        f64 reflect, min_weight;
        u32 depth, terms;
    } cases[] = {{0.9, 0, 0, 1},   {0.9, 0, 1, 2},    {0.9, 0, 5, 6},      {0.9, 0, 10, 11}, {0.9, 0, 64, 65},
                 {1, 0, 64, 65},   {0.5, 0.125, 9, 4}, {0.5, 0.1251, 9, 3}, {0.9, 0.5, 64, 7}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *text = text_of("image { size 5 4 }\nrender { max_depth %u min_weight %.17g }\nambient 0\n"
                             "material m phong { diffuse 0 reflect %.17g emission 1 }\n"
                             "plane { point 0 0 -1 normal 0 0 1 material m }\n"
                             "plane { point 0 0 1 normal 0 0 -1 material m }\n",
                             cases[i].depth, cases[i].min_weight, cases[i].reflect);
        const f64 k = (f64)(f32)cases[i].reflect;
        f64 expected = 0;
        for (u32 n = 0; n < cases[i].terms; n++)
            expected += pow(k, n);
        Picture picture = render_text(*state, text, NULL);
        char *what = text_of("mirrors of %g to depth %u", cases[i].reflect, cases[i].depth);
        expect_all(&picture, expected, 1e-6, what);
        free(what);
        free(text);
        picture_destroy(&picture);
    }
}

// Two panes that mirror and transmit before a wall that shines: t^2 / (1 - r^2). One ray stays in flight and
// one is parked at every depth.
static void test_panes(void **state)
{
    static const f64 cases[][2] = {{0.5, 0.5}, {0.75, 0.25}, {0.125, 0.875}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const f64 r = cases[i][0], t = cases[i][1];
        char *text = text_of("image { size 3 3 }\nrender { max_depth 64 min_weight 1e-9 }\nambient 0\n"
                             "material pane phong { diffuse 0 reflect %.17g transmit %.17g ior 1 }\n"
                             "material wall phong { diffuse 0 emission 1 }\n"
                             "plane { point 0 0 -1 normal 0 0 1 material pane }\n"
                             "plane { point 0 0 -2 normal 0 0 1 material pane }\n"
                             "plane { point 0 0 -3 normal 0 0 1 material wall }\n", r, t);
        Picture picture = render_text(*state, text, NULL);
        expect_all(&picture, t * t / (1 - r * r), 1e-6, "panes");
        picture_destroy(&picture);
        free(text);
    }
}

// ---- coverage ---------------------------------------------------------------------------------------------

typedef struct Point {
    f64 x, y;
} Point;

// The part of a polygon on the side of sign * (coordinate - limit) >= 0; returns its number of corners.
static int clip(const Point *in, int count, int axis, f64 limit, f64 sign, Point *out)
{
    int kept = 0;
    for (int i = 0; i < count; i++) {
        const Point a = in[i], b = in[(i + 1) % count];
        const f64 da = sign * ((axis ? a.y : a.x) - limit), db = sign * ((axis ? b.y : b.x) - limit);
        if (da >= 0)
            out[kept++] = a;
        if ((da >= 0) != (db >= 0)) {
            const f64 s = da / (da - db);
            out[kept++] = (Point){a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)};
        }
    }
    return kept;
}

// The share of the pixel that the triangle covers, in pixel coordinates.
static f64 coverage(const Point triangle[3], u32 x, u32 y)
{
    Point a[16], b[16];
    int count = clip(triangle, 3, 0, x, 1, a);
    count = clip(a, count, 0, x + 1.0, -1, b);
    count = clip(b, count, 1, y, 1, a);
    count = clip(a, count, 1, y + 1.0, -1, b);
    f64 area = 0;
    for (int i = 0; i < count; i++) {
        const Point p = b[i], q = b[(i + 1) % count];
        area += 0.5 * (p.x * q.y - q.x * p.y);
    }
    return fabs(area);
}

typedef struct Errors {
    f64 rms, mean; // over the pixels that edges cross
    u32 edge_pixels;
} Errors;

// A bright triangle seen without perspective: each pixel's mean is the share of it that is covered.
static Errors coverage_errors(Device *device, u32 samples, u32 seed)
{
    enum { W = 32, H = 24 };
    static const Point triangle[3] = {{2.3, 21.7}, {29.2, 16.1}, {11.6, 1.9}};
    char *text = text_of("image { size %d %d samples %u seed %u }\nambient 0\n"
                         "camera { position 0 0 5 look_at 0 0 0 orthographic %d }\n"
                         "material m phong { diffuse 0 emission 0.1 }\ntriangle { vertices",
                         W, H, samples, seed, H);
    for (int i = 0; i < 3; i++)
        text_append(&text, " %.17g %.17g 0", triangle[i].x - W / 2.0, H / 2.0 - triangle[i].y);
    text_append(&text, " material m }\n");
    Picture picture = render_text(device, text, NULL);
    free(text);
    Errors errors = {0, 0, 0};
    for (u32 y = 0; y < H; y++) {
        for (u32 x = 0; x < W; x++) {
            const f64 exact = coverage(triangle, x, y), found = (f64)*pixel_at(&picture, x, y) / (f64)0.1f;
            if (exact < 1e-9)
                assert_true(found == 0);
            else if (exact > 1 - 1e-9)
                expect_near(found, 1, 1.2e-7, "a pixel that is covered"); // whatever the number of samples
            else {
                errors.rms += (found - exact) * (found - exact);
                errors.mean += found - exact;
                errors.edge_pixels++;
                // Five times what samples at random would be off by.
                assert_true(fabs(found - exact) <= 5 * sqrt(exact * (1 - exact) / samples) + 1.0 / samples);
            }
        }
    }
    picture_destroy(&picture);
    errors.rms = sqrt(errors.rms / errors.edge_pixels);
    errors.mean /= errors.edge_pixels;
    return errors;
}

static void test_coverage(void **state)
{
    f64 rms[3];
    static const u32 samples[3] = {16, 64, 256};
    for (int i = 0; i < 3; i++) {
        Errors sum = {0, 0, 0};
        for (u32 seed = 0; seed < 4; seed++) {
            const Errors errors = coverage_errors(*state, samples[i], seed);
            sum.rms += errors.rms / 4;
            sum.mean += errors.mean / 4;
            sum.edge_pixels = errors.edge_pixels;
        }
        print_message("%3u samples: %u edge pixels are off by %.4f (rms) and %+.5f (mean)\n", samples[i],
                      sum.edge_pixels, sum.rms, sum.mean);
        rms[i] = sum.rms;
        // Random samples of these pixels have a deviation of 0.37 / sqrt(n) each.
        assert_true(sum.edge_pixels > 60);
        assert_true(sum.rms < 0.37 / sqrt(samples[i]));
        assert_true(fabs(sum.mean) < 4 * 0.37 / sqrt(samples[i] * 4.0 * sum.edge_pixels));
    }
    assert_true(rms[1] < 0.6 * rms[0] && rms[2] < 0.6 * rms[1]);
    // A number of samples that no power of two divides, and a mean that is a third.
    coverage_errors(*state, 1000, 1);
    coverage_errors(*state, 3, 1);
}

// ---- lights -----------------------------------------------------------------------------------------------

// Lights first .. last - 1 of a row of points, spots and directions.
static Picture lit_by(Device *device, u32 first, u32 last, bool shadows)
{
    char *text = text_of("image { size 64 48 }\ncamera { position 0 3 8 look_at 0 0.5 0 fov 45 }\nambient 0\n"
                         "render { max_depth 2 shadows %s }\n"
                         "material m phong { diffuse 0.5 0.75 0.25 specular 0.5 shininess 20 reflect 0.25 }\n"
                         "material veil phong { diffuse 0.25 transmit 0.5 0.25 0.75 }\n"
                         "plane { point 0 0 0 normal 0 1 0 material m }\n"
                         "sphere { center -1 1 0 radius 1 material m }\n"
                         "box { center 1.5 0.75 1 size 1 material veil }\n", shadows ? "on" : "off");
    for (u32 i = first; i < last; i++) {
        const f64 angle = 0.7 * i, x = 5 * cos(angle), z = 5 * sin(angle);
        if (i % 3 == 0)
            text_append(&text, "light point { position %.3f 4 %.3f intensity 0.%u 0.2 0.1 }\n", x, z,
                        i % 9 + 1);
        else if (i % 3 == 1)
            text_append(&text, "light directional { direction %.3f -3 %.3f intensity 0.1 0.%u 0.2 }\n", x, z,
                        i % 9 + 1);
        else
            text_append(&text, "light spot { position %.3f 5 %.3f look_at 0 0 0 inner 20 outer 40 "
                               "intensity 0.2 0.1 0.%u attenuation 0.5 0.1 0.01 }\n", x, z, i % 9 + 1);
    }
    Picture picture = render_text(device, text, NULL);
    free(text);
    return picture;
}

// More lights than a pass takes: the picture is the sum of those with a part of the lights each.
static void expect_sum(Device *device, u32 parts, const u32 *limits, bool shadows)
{
    Picture all = lit_by(device, limits[0], limits[parts], shadows);
    f64 *sum = calloc(3 * (size_t)all.width * all.height, sizeof *sum);
    assert_non_null(sum);
    u64 shadow_rays = 0;
    for (u32 part = 0; part < parts; part++) {
        Picture picture = lit_by(device, limits[part], limits[part + 1], shadows);
        for (u32 i = 0; i < 3 * all.width * all.height; i++)
            sum[i] += (f64)picture.rgb[i];
        shadow_rays += picture.stats.rays[1];
        picture_destroy(&picture);
    }
    f64 most = 0;
    for (u32 i = 0; i < 3 * all.width * all.height; i++) {
        if (!(fabs((f64)all.rgb[i] - sum[i]) <= 3e-6 * sum[i]))
            fail_msg("value %u: %.9g, the sum is %.9g", i, (f64)all.rgb[i], sum[i]);
        most = sum[i] > most ? sum[i] : most;
    }
    assert_true(most > 1);
    assert_true(all.stats.rays[1] == shadow_rays && (shadow_rays > 0) == shadows);
    free(sum);
    picture_destroy(&all);
}

static void test_lights_add_up(void **state)
{
    expect_sum(*state, 2, (const u32[]){0, 10, 20}, true);
    expect_sum(*state, 2, (const u32[]){0, 16, 20}, true);
    expect_sum(*state, 2, (const u32[]){0, 17, 20}, true);
    expect_sum(*state, 3, (const u32[]){0, 3, 16, 19}, true);
    expect_sum(*state, 4, (const u32[]){0, 5, 32, 35, 49}, true);
    expect_sum(*state, 2, (const u32[]){0, 16, 20}, false);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_facing_mirrors, device),
        cmocka_unit_test_prestate(test_panes, device),
        cmocka_unit_test_prestate(test_coverage, device),
        cmocka_unit_test_prestate(test_lights_add_up, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
