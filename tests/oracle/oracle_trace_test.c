/* Whole rays through small scenes whose radiance has a closed form. */
#include <stdio.h>

#include "oracle_test.h"

#define CAMERA_DOWN "camera { position 0 5 0 look_at 0 0 0 up 0 0 -1 orthographic 1 } "
#define FLOOR "plane { point 0 0 0 normal 0 1 0 } "

static void test_background_and_default(void **state)
{
    (void)state;
    assert_vec_near(pixel_of("background 0.1 0.2 0.3"), vec(0.1, 0.2, 0.3), 0);
    assert_near(pixel_of(CAMERA_DOWN FLOOR).x, (real)0.8 * (real)0.1, 1e-18L);
    assert_near(pixel_of(CAMERA_DOWN FLOOR "material default phong { diffuse 0.5 } ambient 1").x, 0.5L,
                1e-18L);
}

static void test_lit_plane(void **state)
{
    (void)state;
    /* Light 2 away, 60 degrees from the normal; the mirror direction is 60 degrees from the eye. */
    const char *text =
        CAMERA_DOWN FLOOR "ambient 0 "
        "material default phong { diffuse 0.5 specular 0.25 shininess 2 } "
        "light point { position 1.7320508075688772 1 0 intensity 6 attenuation 1 0.5 0.25 }";
    assert_near(pixel_of(text).x, 2 * (0.5L * 0.5L + 0.25L * 0.25L), 1e-15L);
    text = CAMERA_DOWN FLOOR "ambient 0 "
        "material default blinn_phong { diffuse 0.5 specular 0.25 shininess 2 } "
        "light directional { direction -1 -1 0 intensity 2 }";
    /* H is 22.5 degrees from N. */
    real h = cosl(PI / 8);
    assert_near(pixel_of(text).x, 2 * (0.5L * sqrtl(0.5L) + 0.25L * h * h), 1e-15L);
}

static void test_shadow(void **state)
{
    (void)state;
#define SHADOW_SCENE "ambient 0 light directional { direction -1 -1 0 } " \
    "material glass phong { diffuse 0 transmit 0.5 0.25 1 fresnel on } " \
    "material solid phong { } " FLOOR CAMERA_DOWN
    real lit = (real)0.8 * sqrtl(0.5L);
    assert_near(pixel_of(SHADOW_SCENE).x, lit, 1e-15L);
    assert_vec_near(pixel_of(SHADOW_SCENE "box { center 2 2 0 size 1 material glass }"),
                    vec(lit / 4, lit / 16, lit), 1e-15L);
    assert_near(pixel_of(SHADOW_SCENE "box { center 2 2 0 size 1 material solid }").x, 0, 0);
    assert_near(pixel_of("render { shadows off } " SHADOW_SCENE
                         "box { center 2 2 0 size 1 material solid }").x, lit, 1e-15L);
    /* A quad of two triangles, hit on the diagonal they share: one surface. */
    assert_vec_near(pixel_of(SHADOW_SCENE "triangle { vertices 1 2 -1  3 2 -1  3 2 1 material glass } "
                                          "triangle { vertices 1 2 -1  3 2 1  1 2 1 material glass }"),
                    vec(lit / 2, lit / 4, lit), 1e-15L);
}

static void test_parallel_mirrors(void **state)
{
    (void)state;
    static const int DEPTHS[] = {0, 1, 10, 64};
    for (size_t i = 0; i < CASES(DEPTHS); i++) {
        char text[400];
        snprintf(text, sizeof text,
                 "ambient 0 render { max_depth %d min_weight 0 } "
                 "material mirror phong { diffuse 0 emission 1 reflect 0.9 } "
                 "camera { position 0 0.5 0 look_at 0 0 0 up 0 0 -1 } "
                 "plane { point 0 0 0 normal 0 1 0 material mirror } "
                 "plane { point 0 1 0 normal 0 -1 0 material mirror }", DEPTHS[i]);
        real k = 0.9;
        assert_near(pixel_of(text).x, (1 - powl(k, DEPTHS[i] + 1)) / (1 - k), 1e-15L);
    }
}

static void test_min_weight(void **state)
{
    (void)state;
#define TWO_MIRRORS "ambient 0 material mirror phong { diffuse 0 emission 1 reflect 0.5 0.125 0.125 } " \
    "camera { position 0 0.5 0 look_at 0 0 0 up 0 0 -1 } " \
    "plane { point 0 0 0 normal 0 1 0 material mirror } " \
    "plane { point 0 1 0 normal 0 -1 0 material mirror } "
    assert_near(pixel_of(TWO_MIRRORS "render { min_weight 0.25 }").x, 1.75L, 0);
    assert_near(pixel_of(TWO_MIRRORS "render { min_weight 0.250001 }").x, 1.5L, 0);
    assert_near(pixel_of(TWO_MIRRORS "render { min_weight 0.25 }").y, 1 + 0.125L + 0.015625L, 0);
}

static void test_refraction(void **state)
{
    (void)state;
    /* A plate of thickness 1 met at 30 degrees shifts the ray by 0.1938137822: without it
     * the ray would meet y = -1 at x = 3 tan 30; a spot of 1e-8 stands where it does. */
    real s = sinl(PI / 6);
    real c = cosl(PI / 6);
    real shift = s * (1 - c / sqrtl(1.5L * 1.5L - s * s));
    assert_near(shift, 0.1938137822L, 1e-10L);
    real x = 3 * tanl(PI / 6) - shift / c;
    char text[500];
    snprintf(text, sizeof text,
             "ambient 0 material glass phong { diffuse 0 transmit 0.5 } material lamp phong { emission 1 } "
             "camera { position 0 2 0 look_at %.20Lf 0 0 up 0 0 -1 } "
             "box { min -9 0 -9 max 9 1 9 material glass } "
             "disk { center %.20Lf -1 0 normal 0 1 0 radius 1e-8 material lamp }", 2 * tanl(PI / 6), x);
    assert_near(pixel_of(text).x, 0.25L, 0);
}

static void test_total_reflection(void **state)
{
    (void)state;
    /* From inside glass at 45 degrees; the reflected ray goes to the background. */
#define INSIDE "ambient 0 background 1 camera { position 0 -1 0 look_at 1 0 0 } " \
    "plane { point 0 0 0 normal 0 1 0 material glass } "
    assert_vec_near(pixel_of("material glass phong { diffuse 0 reflect 0.25 transmit 0.5 0.5 0.125 } "
                             INSIDE),
                    vec(0.75L, 0.75L, 0.375L), 1e-18L);
}

static void test_fresnel_weights(void **state)
{
    (void)state;
#define GLASS "ambient 0 material glass phong { diffuse 0 reflect 0.25 transmit 0.5 0.5 0.125 fresnel on } "
    /* Total reflection: max(k_r, k_t). */
    assert_vec_near(pixel_of(GLASS "background 1 camera { position 0 -1 0 look_at 1 0 0 } "
                             "plane { point 0 0 0 normal 0 1 0 material glass }"),
                    vec(0.5L, 0.5L, 0.25L), 1e-18L);
    /* Straight on: 0.04 and 0.96 of the weights. */
    assert_near(pixel_of(GLASS "background 1 " CAMERA_DOWN
                         "plane { point 0 0 0 normal 0 1 0 material glass }").x,
                0.04L * 0.25L + 0.96L * 0.5L, 1e-17L);
    /* An opaque surface keeps the outside's F from both sides. */
    assert_near(pixel_of("ambient 0 background 1 material glossy phong { diffuse 0 reflect 1 fresnel on } "
                         "camera { position 0 -1 0 look_at 1 0 0 } plane { point 0 0 0 normal 0 1 0 "
                         "material glossy }").x, fresnel_reflectance(sqrtl(0.5L), 1 / 1.5L), 1e-17L);
}

static void test_order_and_materials(void **state)
{
    (void)state;
#define LAMPS "ambient 0 material red phong { emission 1 0 0 } " \
    "material green phong { emission 0 1 0 } " CAMERA_DOWN
    assert_vec_near(pixel_of(LAMPS "sphere { center 0 0 0 radius 1 material green } "
                                   "sphere { center 0 0 0 radius 1 material red }"), vec(0, 1, 0), 0);
    assert_vec_near(pixel_of(LAMPS "disk { center 0 0 0 normal 0 1 0 radius 1 material red } "
                                   "plane { point 0 0 0 normal 0 -1 0 material green }"), vec(1, 0, 0), 0);
    /* The nearest enclosing instance that names a material gives it; a shape's own comes first. */
    assert_vec_near(pixel_of(LAMPS "object a { sphere { center 0 0 0 radius 1 } } "
                                   "object b { instance a { } } "
                                   "instance b { material green scale 2 }"), vec(0, 1, 0), 0);
    assert_vec_near(pixel_of(LAMPS "object a { sphere { center 0 0 0 radius 1 } } "
                                   "object b { instance a { material red } } instance b { material green }"),
                    vec(1, 0, 0), 0);
    assert_vec_near(pixel_of(LAMPS "object a { sphere { center 0 0 0 radius 1 material green } } "
                                   "instance a { material red }"), vec(0, 1, 0), 0);
}

static void test_scale(void **state)
{
    (void)state;
    /* No acne and no lost shadow at any scale: a lit sphere, and the point under a sphere's contact. */
    static const real SCALES[] = {1e-6L, 1e-3L, 1, 1e3L, 1e6L};
    for (size_t i = 0; i < CASES(SCALES); i++) {
        char text[400];
        real s = SCALES[i];
        snprintf(text, sizeof text,
                 "ambient 0 light directional { direction -1 -1 -1 } "
                 "camera { position 0 %.20Lg 0 look_at %.20Lg 0 0 } "
                 "sphere { center 0 0 0 radius 1 scale 7 3 5 rotate 1 2 3 40 scale %.20Lg }",
                 90 * s, 0.1L * s, s);
        assert_true(pixel_of(text).x > 0.1L);
        snprintf(text, sizeof text,
                 "ambient 0 light directional { direction 0 -1 0 } "
                 "camera { position 0 %.20Lg %.20Lg look_at %.20Lg 0 0 } "
                 "sphere { center 0 1 0 radius 1 scale %.20Lg } plane { point 0 0 0 normal 0 1 0 }",
                 1e-7L * s, 1e-2L * s, 1e-3L * s, s);
        assert_near(pixel_of(text).x, 0, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_background_and_default),
        cmocka_unit_test(test_lit_plane),
        cmocka_unit_test(test_shadow),
        cmocka_unit_test(test_parallel_mirrors),
        cmocka_unit_test(test_min_weight),
        cmocka_unit_test(test_refraction),
        cmocka_unit_test(test_total_reflection),
        cmocka_unit_test(test_fresnel_weights),
        cmocka_unit_test(test_order_and_materials),
        cmocka_unit_test(test_scale),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
