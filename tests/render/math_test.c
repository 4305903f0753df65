// The three kinds of arithmetic: doubles are what floats are measured by, so they must come close to both the
// exact kernels and the long double reference renderer, and closer to that than floats do; fast kernels must
// give a picture without garbage. Errors are of a pixel's three values, relative to the largest of them.
#include "scenes.h"
#include "support.h"

#include <math.h>
#include <unistd.h>

#include "image/pfm.h"
#include "render/math_mode.h"

// From this error on a pixel sees something else: another object, another cell of a checker.
#define FAR 1e-3
// Darker pixels are measured as this bright.
#define DARK 1e-3

typedef struct Apart {
    u32 pixels, far; // far: above FAR
    f64 median, p99, most; // error of the other pixels
    u32 ulp_p99, ulp_most; // of all their values
} Apart;

static f64 brightest(const f32 *rgb)
{
    return fmax(fmax(fabs((f64)rgb[0]), fabs((f64)rgb[1])), fmax(fabs((f64)rgb[2]), DARK));
}

static f64 pixel_error(const f32 *a, const f32 *b)
{
    f64 most = 0;
    for (int c = 0; c < 3; c++)
        most = fmax(most, fabs((f64)a[c] - (f64)b[c]));
    return most / brightest(b);
}

// Floats between two that are not negative.
static u32 ulps(f32 a, f32 b)
{
    i32 x, y;
    memcpy(&x, &a, sizeof x);
    memcpy(&y, &b, sizeof y);
    return (u32)abs(x - y);
}

static int by_size(const void *a, const void *b)
{
    const f64 x = *(const f64 *)a, y = *(const f64 *)b;
    return (x > y) - (x < y);
}

static int by_number(const void *a, const void *b)
{
    const u32 x = *(const u32 *)a, y = *(const u32 *)b;
    return (x > y) - (x < y);
}

// How far a is from b; what and which are for the table.
static Apart measure(const Picture *a, const Picture *b, const char *what, const char *which)
{
    assert_true(a->width == b->width && a->height == b->height);
    Apart apart = {.pixels = a->width * a->height};
    f64 *errors = calloc(apart.pixels, sizeof *errors);
    u32 *steps = calloc(3 * (size_t)apart.pixels, sizeof *steps);
    assert_true(errors && steps);
    u32 near = 0;
    for (u32 i = 0; i < apart.pixels; i++) {
        const f32 *x = a->rgb + 3 * (size_t)i, *y = b->rgb + 3 * (size_t)i;
        for (int c = 0; c < 3; c++)
            assert_true(isfinite(x[c]) && x[c] >= -1); // filters may have negative lobes
        const f64 error = pixel_error(x, y);
        if (!(error <= FAR)) {
            apart.far++;
            continue;
        }
        for (u32 c = 0; c < 3; c++)
            steps[3 * near + c] = ulps(x[c], y[c]);
        errors[near++] = error;
    }
    assert_true(near > 0);
    qsort(errors, near, sizeof *errors, by_size);
    qsort(steps, 3 * (size_t)near, sizeof *steps, by_number);
    apart.median = errors[near / 2];
    apart.p99 = errors[(u64)near * 99 / 100];
    apart.most = errors[near - 1];
    apart.ulp_p99 = steps[(u64)near * 3 * 99 / 100];
    apart.ulp_most = steps[3 * near - 1];
    free(errors);
    free(steps);
    printf("%-28s %-8s median %.1e  p99 %.1e  most %.1e  (%u and %u ulp)  other sight %u of %u\n", what,
           which, apart.median, apart.p99, apart.most, apart.ulp_p99, apart.ulp_most, apart.far, apart.pixels);
    return apart;
}

// Pixels far apart must be where the picture b has an edge as high as that.
static void assert_far_at_edges(const Picture *a, const Picture *b)
{
    for (u32 y = 0; y < b->height; y++) {
        for (u32 x = 0; x < b->width; x++) {
            const f32 *pixel = pixel_at(b, x, y);
            f64 contrast = 0;
            for (u32 v = y > 0 ? y - 1 : 0; v <= y + 1 && v < b->height; v++)
                for (u32 u = x > 0 ? x - 1 : 0; u <= x + 1 && u < b->width; u++)
                    contrast = fmax(contrast, pixel_error(pixel_at(b, u, v), pixel));
            const f64 error = pixel_error(pixel_at(a, x, y), pixel);
            if (error > FAR && error > 1.5 * contrast)
                fail_msg("pixel %u, %u is off by %g, and no neighbour differs by more than %g", x, y, error,
                         contrast);
        }
    }
}

typedef struct Fixture {
    Device *device;
    bool doubles;
    Layout *layouts[2]; // that together have every feature
} Fixture;

static const char *const LAYOUT_NAMES[2] = {"glass", "toys"};

static Picture picture_of(const Fixture *f, const Layout *layout, MathMode math, const char *shape)
{
    const RenderHow how = {.math = math, .shape = shape};
    return render_layout(f->device, layout, &how);
}

static void skip_without_doubles(const Fixture *f)
{
    if (!f->doubles) {
        printf("skipped: the device has no doubles\n");
        skip();
    }
}

static void test_double_and_exact(void **state)
{
    const Fixture *f = *state;
    skip_without_doubles(f);
    for (int k = 0; k < 2; k++) {
        Picture exact = picture_of(f, f->layouts[k], MATH_EXACT, NULL);
        Picture reference = picture_of(f, f->layouts[k], MATH_DOUBLE, NULL);
        const Apart apart = measure(&exact, &reference, LAYOUT_NAMES[k], "exact");
        assert_true(apart.far * 100 < apart.pixels);
        assert_far_at_edges(&exact, &reference);
        assert_true(apart.p99 > 0x1p-24); // doubles are something else than floats
        assert_true(apart.median < 1e-6 && apart.p99 < 1e-4);
        picture_destroy(&exact);
        picture_destroy(&reference);
    }
}

// Work-items that share a tile give the same bytes; shapes that doubles cannot have are not heeded.
static void test_double_shapes(void **state)
{
    const Fixture *f = *state;
    skip_without_doubles(f);
    Picture reference = picture_of(f, f->layouts[0], MATH_DOUBLE, NULL);
    static const char *const shapes[] = {"1,1,16", "8,32,1"};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        Picture other = picture_of(f, f->layouts[0], MATH_DOUBLE, shapes[i]);
        assert_same_picture(&reference, &other, shapes[i]);
        picture_destroy(&other);
    }
    picture_destroy(&reference);
}

static void test_fast(void **state)
{
    const Fixture *f = *state;
    for (int k = 0; k < 2; k++) {
        Picture exact = picture_of(f, f->layouts[k], MATH_EXACT, NULL);
        Picture fast = picture_of(f, f->layouts[k], MATH_FAST, NULL);
        const Apart apart = measure(&fast, &exact, LAYOUT_NAMES[k], "fast");
        assert_true(apart.far * 50 < apart.pixels);
        assert_far_at_edges(&fast, &exact);
        assert_true(apart.median < 1e-5 && apart.p99 < 1e-3);
        picture_destroy(&exact);
        picture_destroy(&fast);
    }
}

// What the reference renderer makes of a scene file.
static Picture oracle_picture(const char *scene)
{
    char *command = text_of("\"%s\" \"%s\" math_test.pfm", CLRT_ORACLE, scene);
    assert_int_equal(system(command), 0);
    free(command);
    Error error = {0};
    Image *image = pfm_image_read("math_test.pfm", &error);
    if (!image)
        fail_msg("%s", error.text);
    unlink("math_test.pfm");
    Picture picture = {.width = image->width, .height = image->height, .rgb = image->values};
    assert_int_equal(image->channels, 3);
    image->values = NULL;
    image_destroy(image);
    return picture;
}

static Layout *layout_of_file(const char *path)
{
    char *text = text_of_file(path);
    Layout *layout = layout_of(text);
    free(text);
    return layout;
}

// Nothing in this scene is rounded on its way to device memory, and no ray of a pixel's centre meets an edge.
static const char whole_numbers[] =
    "image { size 160 128 }\n"
    "camera { position 0 0 0 look_at 0 0 -1 fov 90 }\n"
    "background 0.125 0.25 0.5\n"
    "ambient 0.0625\n"
    "light point { position 4 6 2 intensity 0.75 0.5 0.625 attenuation 1 0.125 0.0625 }\n"
    "light directional { direction 0 -1 0 intensity 0.25 }\n"
    "texture check checker3d { colors 0.75 0.5 0.25  0.25 0.5 1 scale 1.75 }\n"
    "material matt phong { diffuse check specular 0.5 shininess 32 }\n"
    "material mirror blinn_phong { diffuse 0.25 specular 0.5 shininess 64 reflect 0.5 0.25 0.75 }\n"
    "material glass phong { diffuse 0.125 transmit 0.75 reflect 0.25 ior 2 fresnel on }\n"
    "plane { point 0 -1.546875 0 normal 0 1 0 material matt }\n"
    "sphere { center -1.5 0.25 -3 radius 1 material mirror }\n"
    "sphere { center 0.25 -0.5 -2 radius 0.5 material glass }\n"
    "torus { center 1.5 -0.5 -3 axis 0 0 1 major 0.5 minor 0.125 material matt }\n"
    "box { min -0.453125 0.515625 -5 max 0.765625 1.890625 -4.125 material matt }\n"
    "cylinder { base 2 -1.5 -4.5 top 2 0.5 -4.5 radius 0.5 material mirror }\n"
    "triangle { vertices -3.046875 -1.015625 -4.125  -2.015625 2.109375 -5  -4 0.796875 -3.25\n"
    "    material mirror }\n"
    "disk { center -0.890625 1.90625 -3.0625 normal 0 0 1 radius 0.5 material mirror }\n"
    "cone { base 1.5 0.5 -2.5 top 1.5 1.5 -2.5 radius 0.25 top_radius 0.125 material matt }\n"
    "tetrahedron { vertices 0.265625 -1.484375 -3.0625  1.265625 -1.484375 -3.0625\n"
    "    0.265625 -0.484375 -3.0625  0.265625 -1.484375 -2.0625 material matt }\n";

static void test_whole_numbers(void **state)
{
    const Fixture *f = *state;
    skip_without_doubles(f);
    FILE *file = fopen("math_test.txt", "w");
    assert_true(file && fputs(whole_numbers, file) >= 0 && fclose(file) == 0);
    Picture truth = oracle_picture("math_test.txt");
    unlink("math_test.txt");
    Layout *layout = layout_of(whole_numbers);
    Picture doubles = picture_of(f, layout, MATH_DOUBLE, NULL);
    Picture floats = picture_of(f, layout, MATH_EXACT, NULL);
    const Apart best = measure(&doubles, &truth, "nothing rounded", "double");
    const Apart other = measure(&floats, &truth, "nothing rounded", "exact");
    assert_int_equal(best.far, 0);
    assert_true(best.ulp_most <= 1 && best.ulp_p99 == 0); // of floats, to which pictures are rounded
    assert_true(other.p99 < 2e-6 && other.far * 1000 < other.pixels);
    picture_destroy(&doubles);
    picture_destroy(&floats);
    picture_destroy(&truth);
    layout_destroy(layout);
}

// What doubles are off from long double is the rounding of the scene to the floats of device memory, so it is
// less than what floats are off, which also round all that follows.
static void test_oracle(void **state)
{
    const Fixture *f = *state;
    skip_without_doubles(f);
    static const char *const cases[] = {"fresnel-opaque", "shape-torus", "glass-solids", "checker3d-solids"};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char *path = text_of(CLRT_SOURCE "/tests/golden/%s/scene.txt", cases[i]);
        Picture truth = oracle_picture(path);
        Layout *layout = layout_of_file(path);
        Picture doubles = picture_of(f, layout, MATH_DOUBLE, NULL);
        Picture floats = picture_of(f, layout, MATH_EXACT, NULL);
        const Apart best = measure(&doubles, &truth, cases[i], "double");
        const Apart other = measure(&floats, &truth, cases[i], "exact");
        assert_true(best.median < 1e-7 && best.p99 < 2e-6);
        assert_true(best.p99 < 0.7 * other.p99 && best.far <= other.far);
        assert_true(best.far * 1000 < best.pixels);
        assert_far_at_edges(&doubles, &truth);
        picture_destroy(&doubles);
        picture_destroy(&floats);
        picture_destroy(&truth);
        layout_destroy(layout);
        free(path);
    }
}

// Between launches the sums of doubles are two floats, which keep what one would lose.
static void test_film(void **state)
{
    const Fixture *f = *state;
    skip_without_doubles(f);
    Layout *layout = layout_of("image { size 4 4 samples 65536 }\ncamera { position 0 0 1 look_at 0 0 0 }\n"
                               "background 0.1 0.7 0.3\n");
    Picture picture = picture_of(f, layout, MATH_DOUBLE, NULL);
    for (u32 i = 0; i < 16; i++) {
        assert_true(picture.rgb[3 * i] == 0.1f && picture.rgb[3 * i + 1] == 0.7f);
        assert_true(picture.rgb[3 * i + 2] == 0.3f);
    }
    assert_true(picture.stats.launches > 1); // the sums have been in memory between
    picture_destroy(&picture);
    layout_destroy(layout);
}

static void test_no_doubles(void **state)
{
    (void)state;
    const DeviceInfo without = {.name = "Lesser GPU"}, with = {.name = "GPU", .fp64 = true};
    Error error = {0};
    assert_true(math_mode_check(MATH_EXACT, &without, &error));
    assert_true(math_mode_check(MATH_FAST, &without, &error));
    assert_true(math_mode_check(MATH_DOUBLE, &with, &error));
    assert_false(math_mode_check(MATH_DOUBLE, &without, &error));
    assert_int_equal(error.code, ERROR_DEVICE);
    assert_non_null(strstr(error.text, "Lesser GPU has no 64-bit floating point"));
}

int main(void)
{
    Fixture f = {.device = test_device_open(0)};
    if (!f.device)
        return TEST_SKIP;
    f.doubles = device_info(f.device)->fp64;
    const char *const marked[2] = {scene_glass, scene_toys};
    for (int k = 0; k < 2; k++) {
        char *text = scene_under(marked[k], NULL);
        f.layouts[k] = layout_of(text);
        free(text);
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_double_and_exact, &f),
        cmocka_unit_test_prestate(test_double_shapes, &f),
        cmocka_unit_test_prestate(test_fast, &f),
        cmocka_unit_test_prestate(test_oracle, &f),
        cmocka_unit_test_prestate(test_whole_numbers, &f),
        cmocka_unit_test_prestate(test_film, &f),
        cmocka_unit_test(test_no_doubles),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    for (int k = 0; k < 2; k++)
        layout_destroy(f.layouts[k]);
    device_close(f.device);
    return failed;
}
