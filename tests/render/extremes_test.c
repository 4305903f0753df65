// The ends of the ranges: nothing to see, one pixel, one row or column as long as there are, no depth and the
// greatest.
#include "support.h"

#include <math.h>

static void expect_color(const Picture *picture, f32 r, f32 g, f32 b)
{
    const f32 color[3] = {r, g, b};
    for (u32 i = 0; i < 3 * picture->width * picture->height; i++)
        if (picture->rgb[i] != color[i % 3])
            fail_msg("value %u of a picture of one color is %.9g, not %.9g", i, (f64)picture->rgb[i],
                     (f64)color[i % 3]);
}

static void expect_text_color(Device *device, const char *text, f32 r, f32 g, f32 b)
{
    Picture picture = render_text(device, text, NULL);
    expect_color(&picture, r, g, b);
    picture_destroy(&picture);
}

static void test_nothing(void **state)
{
    expect_text_color(*state, "image { size 37 21 }\n", 0, 0, 0);
    expect_text_color(*state, "image { size 37 21 }\nbackground 0.25 0.5 2\n", 0.25f, 0.5f, 2);
    expect_text_color(*state, "image { size 1 1 }\nbackground 0.25 0.5 2\n", 0.25f, 0.5f, 2);
    expect_text_color(*state, "image { size 1 1 }\nbackground 0.1 0.5 2\nlight point { position 0 0 0 }\n",
                      0.1f, 0.5f, 2);
    expect_text_color(*state, "image { size 65536 1 }\nbackground 0.25 0.5 2\n", 0.25f, 0.5f, 2);
    expect_text_color(*state, "image { size 1 65536 }\nbackground 0.25 0.5 2\n", 0.25f, 0.5f, 2);
}

static void test_behind(void **state)
{
    expect_text_color(*state, "image { size 40 30 }\nbackground 0.25 0.5 2\n"
                              "sphere { center 0 0 4 radius 1 }\nplane { point 0 0 1 normal 0 0 1 }\n", 0.25f,
                      0.5f, 2);
}

// From the middle of a sphere there is only its inside.
static void test_one_pixel(void **state)
{
    const char *format = "image { size %u %u }\nbackground 1\nambient 0.5\n"
                         "material m phong { ambient 0.5 0.25 1 }\n"
                         "sphere { center 0 0 0 radius 1 material m }\n"
                         "plane { point 0 -2 0 normal 0 1 0 }\n";
    static const u32 sizes[][2] = {{1, 1}, {2, 1}, {1, 2}, {16, 16}, {17, 15}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        char *text = text_of(format, sizes[i][0], sizes[i][1]);
        expect_text_color(*state, text, 0.25f, 0.125f, 0.5f);
        free(text);
    }
}

// A picture one pixel high or wide is that row or column in each of its pixels, to the very ends.
static void test_long(void **state)
{
    const char *format = "image { size %u %u }\nbackground 1\nambient 0.5\ncamera { fov %g }\n"
                         "material m phong { ambient 0.5 0.25 1 }\n"
                         "sphere { center 0 0 -4 radius 1 material m }\n"
                         "plane { point 0 -2 0 normal 0 1 0 }\n";
    char *text = text_of(format, 65536u, 1u, 0.01);
    Picture row = render_text(*state, text, NULL);
    free(text);
    u32 hits = 0;
    const f64 k = tan(0.005 * acos(-1) / 180);
    for (u32 x = 0; x < 65536; x++) {
        const f32 *pixel = pixel_at(&row, x, 0);
        const bool hit = pixel[0] == 0.25f;
        const f32 sphere[3] = {0.25f, 0.125f, 0.5f}, background[3] = {1, 1, 1};
        assert_memory_equal(pixel, hit ? sphere : background, sizeof sphere);
        hits += hit;
        assert_true(hit == (*pixel_at(&row, 65535 - x, 0) == 0.25f));
    }
    // The sphere's edge is seen under asin(1/4).
    const f64 half = tan(asin(0.25)) / (2 * k); // in pixels; a pixel is 2k wide
    assert_true(fabs(hits / 2.0 - half) <= 1);
    const RenderHow crop = {.left = 65000, .width = 536, .height = 1};
    text = text_of(format, 65536u, 1u, 0.01);
    Picture end = render_text(*state, text, &crop);
    free(text);
    for (u32 x = 0; x < 536; x++)
        assert_memory_equal(pixel_at(&end, x, 0), pixel_at(&row, 65000 + x, 0), 3 * sizeof(f32));
    picture_destroy(&end);
    picture_destroy(&row);
    text = text_of(format, 1u, 65536u, 90.0);
    Picture column = render_text(*state, text, NULL);
    free(text);
    // Up: background; the sphere between +-tan(asin(1/4)); then the plane, from just below the horizon on.
    const f64 edge = tan(asin(0.25)) * 32768;
    for (u32 y = 0; y < 65536; y++) {
        const f64 at = 32768 - (y + 0.5);
        const f32 *pixel = pixel_at(&column, 0, y);
        const f64 expected = fabs(at) < edge ? 0.25 : at > 0 ? 1 : 0.4; // default: diffuse 0.8
        if (fabs(fabs(at) - edge) > 1.5 && fabs((f64)pixel[0] - expected) > 1e-6)
            fail_msg("row %u: %.9g, not %.9g", y, (f64)pixel[0], expected);
    }
    picture_destroy(&column);
}

static const char hall[] =
    "image { size 40 30 }\ncamera { position 0 0.5 3 look_at 0 0.25 0 }\nambient 0.25\n"
    "background 0.5 0.75 1\n"
    "light point { position 2 4 3 }\n"
    "material m phong { diffuse 0.5 0.25 0.125 %s }\n"
    "sphere { center -0.6 0 0 radius 0.6 material m }\nsphere { center 0.7 0 0.25 radius 0.5 material m }\n"
    "plane { point 0 -0.6 0 normal 0 1 0 material m }\nrender { max_depth %u min_weight %g }\n";

// Depth 0 is the camera ray alone, whatever the surfaces would do.
static void test_depth_0(void **state)
{
    char *mirrors = text_of(hall, "reflect 0.5", 0u, 0.0), *plain = text_of(hall, "", 5u, 0.0);
    Picture a = render_text(*state, mirrors, NULL), b = render_text(*state, plain, NULL);
    assert_same_picture(&a, &b, "no depth, and no mirrors");
    assert_true(a.stats.rays[2] == 0 && a.stats.rays[3] == 0 && a.stats.rays[0] == 40 * 30);
    picture_destroy(&a);
    picture_destroy(&b);
    free(mirrors);
    free(plain);
}

// At depth 64 the least weight ends every path first: 60 sees the same; at 3 something is missing.
static void test_depth_64(void **state)
{
    Picture pictures[3];
    static const u32 depths[3] = {64, 60, 3};
    for (int i = 0; i < 3; i++) {
        char *text = text_of(hall, "reflect 0.25 transmit 0.875 ior 1.25", depths[i], 0.01);
        pictures[i] = render_text(*state, text, NULL);
        free(text);
    }
    assert_same_picture(&pictures[0], &pictures[1], "depth 64 and 60");
    assert_true(pictures[0].stats.rays[2] == pictures[1].stats.rays[2] &&
                pictures[0].stats.rays[3] == pictures[1].stats.rays[3]);
    assert_true(pictures[2].stats.rays[3] < pictures[0].stats.rays[3]);
    assert_true(memcmp(pictures[0].rgb, pictures[2].rgb, 3 * 40 * 30 * sizeof(f32)) != 0);
    for (int i = 0; i < 3; i++)
        picture_destroy(&pictures[i]);
}

// The deepest path there is: a ray that runs between mirrors, and the stack of what it parks on the way.
static void test_deepest_path(void **state)
{
    const char *scene = "image { size 1 1 }\nambient 0\nrender { max_depth 64 min_weight 0 }\n"
                        "material m phong { diffuse 0 reflect 1 transmit 0.5 ior 1 emission 1 }\n"
                        "material end phong { diffuse 0 emission 1 }\n"
                        "plane { point 0 0 -1 normal 0 0 1 material m }\n"
                        "plane { point 0 0 1 normal 0 0 -1 material m }\n"
                        "plane { point 0 0 -2 normal 0 0 1 material end }\n"
                        "plane { point 0 0 2 normal 0 0 -1 material end }\n";
    Picture picture = render_text(*state, scene, NULL);
    // 65 mirrors shine 1 each; 64 of them let one ray through that sees half of the light outside.
    expect_color(&picture, 65 + 32, 65 + 32, 65 + 32);
    assert_true(picture.stats.rays[2] == 64 && picture.stats.rays[3] == 64);
    picture_destroy(&picture);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_nothing, device),  cmocka_unit_test_prestate(test_behind, device),
        cmocka_unit_test_prestate(test_one_pixel, device), cmocka_unit_test_prestate(test_long, device),
        cmocka_unit_test_prestate(test_depth_0, device),  cmocka_unit_test_prestate(test_depth_64, device),
        cmocka_unit_test_prestate(test_deepest_path, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
