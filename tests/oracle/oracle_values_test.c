/* The contract's worked values (section 7), text, transforms, output, lights: against closed forms. */
#include <string.h>

#include "light.h"
#include "look.h"
#include "oracle_test.h"
#include "picture.h"
#include "shape.h"
#include "texture.h"
#include "token.h"

static void test_tangents(void **state)
{
    (void)state;
    Vec t1, t2;
    tangents_of(vec(0, 1, 0), &t1, &t2);
    assert_vec_near(t1, vec(1, 0, 0), 0);
    assert_vec_near(t2, vec(0, 0, -1), 0);
    tangents_of(vec(0, 0, 1), &t1, &t2);
    assert_vec_near(t1, vec(1, 0, 0), 0);
    assert_vec_near(t2, vec(0, 1, 0), 0);
}

static void test_camera(void **state)
{
    (void)state;
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene, "image { size 2 2 } camera { fov 90 }");
    Camera camera = camera_make(&scene);
    Ray ray = camera_ray(&camera, 0.5L, 0.5L, vec(0, 0, 0));
    assert_vec_near(ray.d, normalized(vec(-0.5L, 0.5L, -1)), 1e-18L);
    scene_free(&scene);

    scene_init(&scene);
    scene_read_text(&scene, "image { size 4 2 } camera { position 1 2 3 look_at 1 2 0 orthographic 6 }");
    camera = camera_make(&scene);
    ray = camera_ray(&camera, 0, 2, vec(0, 0, 0));
    assert_vec_near(ray.o, vec(1 - 6, 2 - 3, 3), 1e-18L);
    assert_vec_near(ray.d, vec(0, 0, -1), 1e-18L);
    scene_free(&scene);
}

static void test_specular(void **state)
{
    (void)state;
    Vec n = vec(0, 1, 0);
    Vec l = normalized(vec(1, 1, 0));
    Vec v = normalized(vec(-1, 1, 0));
    assert_near(specular_term(false, 1, n, l, v), 1, 1e-18L);
    assert_near(specular_term(true, 1e6L, n, l, v), 1, 1e-12L);
    /* R turned 60 degrees from V: 0.5^3. */
    Vec turned = vec(cosl(PI * 75 / 180), sinl(PI * 75 / 180), 0);
    assert_near(specular_term(false, 3, n, l, turned), 0.125L, 1e-18L);
    /* Behind: nothing, but 0^0 = 1. */
    assert_near(specular_term(false, 2, n, l, l), 0, 1e-18L);
    assert_near(specular_term(false, 0, n, l, vec(0.8L, 0, 0.6L)), 1, 0);
}

static void test_fresnel(void **state)
{
    (void)state;
    assert_near(fresnel_reflectance(1, 1 / 1.5L), 0.04L, 1e-18L);
    assert_near(fresnel_reflectance(1, 1.5L), 0.04L, 1e-18L);
    /* Brewster's angle, tan = 1.5: no p, and s = cos(2 Brewster)^2. */
    real cosine = 1 / sqrtl(1 + 2.25L);
    real s = 1 - 2 * cosine * cosine;
    assert_near(fresnel_reflectance(cosine, 1 / 1.5L), s * s / 2, 1e-18L);
    /* Leaving: the critical cosine is sqrt(5)/3. */
    assert_near(fresnel_reflectance(sqrtl(5) / 3 - 1e-12L, 1.5L), 1, 0);
    assert_true(fresnel_reflectance(sqrtl(5) / 3 + 1e-12L, 1.5L) < 1);
    assert_near(fresnel_reflectance(0, 1 / 1.5L), 1, 1e-18L);
}

static void test_output(void **state)
{
    (void)state;
    Scene scene;
    scene_init(&scene);
    assert_int_equal(output_level(&scene, 0.5L, 8), 188);
    assert_int_equal(output_level(&scene, 0.0031308L, 8), 10);
    assert_int_equal(output_level(&scene, -1, 8), 0);
    assert_int_equal(output_level(&scene, 1e30L, 16), 65535);
    for (int level = 0; level < 256; level++)
        assert_int_equal(output_level(&scene, srgb_decode(level / 255.0L), 8), level);
    scene.srgb = false;
    assert_int_equal(output_level(&scene, 0.5L, 8), 128);
    assert_int_equal(output_level(&scene, 0.5L, 16), 32768);
    scene.exposure = -2;
    assert_near(output_value(&scene, 1), 0.25L, 0);
    scene.exposure = 0;
    scene.tone_map = TONE_REINHARD;
    assert_near(output_value(&scene, 3), 0.75L, 1e-18L);
    scene.tone_map = TONE_REINHARD_EXTENDED;
    scene.white = 2;
    assert_near(output_value(&scene, 2), 1, 1e-18L);
    assert_near(output_value(&scene, 1), 0.625L, 1e-18L);
    scene.tone_map = TONE_ACES;
    assert_near(output_value(&scene, 1), 2.54L / 3.16L, 1e-18L);
    scene.tone_map = TONE_HABLE;
    assert_near(output_value(&scene, 5.6L), 1, 1e-18L);
    assert_near(output_value(&scene, 0), 0, 1e-18L);
    scene_free(&scene);
}

static void test_text(void **state)
{
    (void)state;
    static const char TEXT[] = "\xEF\xBB\xBF" "a{-1.5e1#c } \"\r\n\"q\\\"\\\\\"}\r\n.5 _b2";
    Store store = {NULL};
    Token *t = tokens_from_text(&store, "text", TEXT, sizeof TEXT - 1);
    static const TokenKind KINDS[] = {TOKEN_NAME,  TOKEN_OPEN,   TOKEN_NUMBER, TOKEN_STRING,
                                      TOKEN_CLOSE, TOKEN_NUMBER, TOKEN_NAME,   TOKEN_END};
    for (size_t i = 0; i < CASES(KINDS); i++)
        assert_int_equal(t[i].kind, KINDS[i]);
    assert_near(t[2].number, -15, 0);
    assert_string_equal(t[3].text, "q\"\\");
    assert_int_equal(t[3].line, 2);
    assert_near(t[5].number, 0.5L, 0);
    store_free(&store);
}

static void test_transforms(void **state)
{
    (void)state;
    Transform t = transform_rotate(vec(0, 3, 0), 90);
    assert_vec_near(transform_vector(&t, vec(0, 0, 1)), vec(1, 0, 0), 1e-18L);
    Transform move = transform_translate(vec(1, 2, 3));
    t = transform_then(&t, &move);
    assert_vec_near(transform_point(&t, vec(0, 0, 1)), vec(2, 2, 3), 1e-18L);
    Transform back = transform_inverse(&t);
    assert_vec_near(transform_point(&back, vec(2, 2, 3)), vec(0, 0, 1), 1e-17L);
    /* numerics.md C40: a normal under a strong scale. */
    t = transform_scale(vec(1e-6L, 1, 1e6L));
    back = transform_inverse(&t);
    assert_vec_near(transform_normal(&back, vec(1, 1, 1)), normalized(vec(1, 1e-6L, 1e-12L)), 1e-18L);
}

static void test_lights(void **state)
{
    (void)state;
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene, "light spot { position 0 2 0 look_at 0 0 0 intensity 3 inner 30 outer 50 }"
                            "light spot { position 0 2 0 look_at 0 0 0 outer 90 }"
                            "light point { position 1 0 0 intensity 6 attenuation 1 0.5 0.25 }");
    Arrival arrival;
    real c = cosl(PI / 9);
    real t = (c - cosl(PI * 25 / 180)) / (cosl(PI * 15 / 180) - cosl(PI * 25 / 180));
    assert_true(light_arrives(&scene.lights[0], vec(2 * tanl(PI / 9), 0, 0), (Square){0, 0}, &arrival));
    assert_near(arrival.intensity.x, 3 * (3 * t * t - 2 * t * t * t), 1e-17L);
    assert_near(arrival.distance, 2 / c, 1e-18L);
    assert_true(light_arrives(&scene.lights[1], vec(1.999L, 0, 0), (Square){0, 0}, &arrival));
    assert_near(arrival.intensity.y, 1, 0);
    assert_false(light_arrives(&scene.lights[1], vec(2.001L, 0, 0), (Square){0, 0}, &arrival));
    assert_true(light_arrives(&scene.lights[2], vec(-1, 0, 0), (Square){0, 0}, &arrival));
    assert_near(arrival.intensity.z, 2, 1e-18L);
    assert_false(light_arrives(&scene.lights[2], vec(1, 0, 0), (Square){0, 0}, &arrival));
    scene_free(&scene);
}

static void test_checkers(void **state)
{
    (void)state;
    Scene scene;
    scene_init(&scene);
    scene_read_text(&scene, "texture a checker { colors \"#ffffff\" 0 0.5 0 scale 2 4 }"
                            "texture b checker3d { colors 0.25 0.75 scale 0.5 }");
    Paint a = {grey(1), 0};
    Paint b = {grey(1), 1};
    Surface s = {.u = 0.3L, .v = 0.3L, .normal = vec(0, 1, 0)};
    assert_vec_near(paint_color(&scene, &a, vec(0, 0, 0), &s), vec(0, 0.5L, 0), 0); /* 0 + 1 */
    s.u = -0.3L;
    assert_vec_near(paint_color(&scene, &a, vec(0, 0, 0), &s), grey(1), 0); /* -1 + 1 */
    /* On a cell's border the inside counts: y = 2 belongs to the cell 0 below an upward face. */
    assert_near(paint_color(&scene, &b, vec(0.1L, 2, 0.1L), &s).x, 0.25L, 0);
    s.normal = vec(0, -1, 0);
    assert_near(paint_color(&scene, &b, vec(0.1L, 2, 0.1L), &s).x, 0.75L, 0);
    scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_tangents), cmocka_unit_test(test_camera),     cmocka_unit_test(test_specular),
        cmocka_unit_test(test_fresnel),  cmocka_unit_test(test_output),     cmocka_unit_test(test_text),
        cmocka_unit_test(test_lights),   cmocka_unit_test(test_transforms), cmocka_unit_test(test_checkers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
