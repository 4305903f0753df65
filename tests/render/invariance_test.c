// What may not change a picture: the unit of length (by powers of two not a bit of it), the place of the
// scene in the world, and the hand of space, which mirrors it.
#include "scenes.h"
#include "support.h"

#include <math.h>

static Picture render_under(Device *device, const char *marked, SceneMap map)
{
    char *text = scene_under(marked, &map);
    Picture picture = render_text(device, text, NULL);
    free(text);
    return picture;
}

// The unit is a matter of taste: lengths times a power of two give the same bytes.
static void test_scale(void **state)
{
    const char *const scenes[] = {scene_glass, scene_toys};
    static const int exponents[] = {-20, -3, 20};
    for (int k = 0; k < 2; k++) {
        Picture one = render_under(*state, scenes[k], (SceneMap){0});
        for (int i = 0; i < 3; i++) {
            Picture scaled = render_under(*state, scenes[k], (SceneMap){.scale = ldexp(1, exponents[i])});
            char *what = text_of("scene %d times 2^%d", k, exponents[i]);
            assert_same_picture(&one, &scaled, what);
            free(what);
            picture_destroy(&scaled);
        }
        picture_destroy(&one);
    }
}

// Other factors round the numbers of the scene anew: a pixel on an edge may see the other side.
static void test_scale_by_ten(void **state)
{
    const char *const scenes[] = {scene_glass, scene_toys};
    static const f64 factors[] = {1e-6, 0.1, 1e6};
    for (int k = 0; k < 2; k++) {
        Picture one = render_under(*state, scenes[k], (SceneMap){0});
        for (int i = 0; i < 3; i++) {
            Picture scaled = render_under(*state, scenes[k], (SceneMap){.scale = factors[i]});
            const u32 apart = levels_apart(&one, &scaled, 1);
            print_message("scene %d times %g: %u of %u values more than a level away\n", k, factors[i], apart,
                          3 * one.width * one.height);
            assert_true(apart <= 3 * one.width * one.height / 500);
            picture_destroy(&scaled);
        }
        picture_destroy(&one);
    }
}

// A room of all shapes without textures, whose cells do not mirror.
static const char scene_mirror[] =
    "image { size 121 90 }\n"
    "camera { position P(0.5 2 7) look_at P(0 0.75 0) up D(0.125 1 0) fov 45 }\n"
    "render { max_depth 5 }\nbackground 0.25 0.375 0.5\nambient 0.125\n"
    "light point { position P(-4 6 5) intensity 0.75 }\n"
    "light spot { position P(3 5 2) look_at P(0 0 0) intensity 0.5 inner 10 outer 70 }\n"
    "light directional { direction D(0.25 -1 -0.5) intensity 0.25 }\n"
    "material a phong { diffuse 0.75 0.5 0.25 specular 0.5 shininess 30 reflect 0.125 }\n"
    "material b blinn_phong { diffuse 0.25 0.5 0.75 specular 0.5 shininess 30 }\n"
    "material glass phong { diffuse 0 reflect 1 transmit 1 0.875 1 fresnel on }\n"
    "plane { point P(0 0 0) normal D(0 1 0) material a }\n"
    "sphere { center P(-1.5 0.75 0) radius ~0.75 material glass }\n"
    "sphere { center L(0 0 0) radius ~1 scale 0.5 1 0.75 rotate A(0 0 1) 20\n"
    "    translate P(2.75 1 -1) material a }\n"
    "box { center L(0 0 0) size ~1 ~0.5 ~0.75 rotate A(0.25 1 0.5) 35 translate P(-3 0.5 1) material b }\n"
    "tetrahedron { vertices P(-1 0.5 1.5) P(0 0.5 1.25) P(-0.75 0.5 0.5) P(-0.5 1.5 1) material b }\n"
    "triangle { vertices P(-3 0.5 -3) P(-1 0.5 -3.5) P(-2 3 -3) normals D(0.25 0 1) D(0 0 1) D(0 0.5 1)\n"
    "    material a }\n"
    "disk { center P(0.5 2.5 -2) normal D(0.5 0.25 1) radius ~0.75 material b }\n"
    "cylinder { base P(1 0 0.5) top P(1.25 1 0.25) radius ~0.375 material a }\n"
    "cone { base P(2.5 0 1.5) top P(2.25 1.25 1.5) radius ~0.5 top_radius ~0.125 caps off material b }\n"
    "torus { center P(0.5 0.5 -1) axis D(0.5 1 0.25) major ~0.75 minor ~0.25 material a }\n"
    "object pair { sphere { center L(0 0.25 0) radius ~0.25 material glass }\n"
    "    box { center L(0 0 0) size ~0.5 } }\n"
    "instance pair { scale 1 2 0.5 rotate A(1 1 0) 30 translate P(1 1 2.5) material b }\n"
    // What a file holds is mirrored by the first scale.
    "mesh { file \"vase.obj\" scale L(0.75 0.75 0.75) rotate A(0.25 1 0.5) 35 translate P(-1.25 0.25 3)\n"
    "    terminator on material a }\n"
    "mesh { file \"gem.obj\" smooth on scale L(0.5 0.5 0.5) translate P(2 0.5 2.75) material glass }\n"
    "object stones { mesh { file \"gem.obj\" scale L(0.5 0.5 0.5) translate L(0.25 0.25 0) } }\n"
    "instance stones { scale 0.75 1 0.5 rotate A(1 1 0) 30 translate P(-2.25 1.75 1) }\n"
    "instance stones { scale -0.75 1 0.5 rotate A(0 0 1) 50 translate P(1.25 2 0.5) material b }\n";

// Render space begins at the camera. Where coordinates stay exact in double, nothing at all is lost a million
// units away; where they do not, the numbers are those of the scene up to a rounding of double. (The cells of
// the toys stand in the world: they move on where the way is no multiple of two of them.)
static void test_moved(void **state)
{
    const char *const scenes[] = {scene_glass, scene_toys, scene_mirror};
    for (int k = 0; k < 3; k++) {
        Picture one = render_under(*state, scenes[k], (SceneMap){0});
        Picture moved = render_under(*state, scenes[k], (SceneMap){.offset = {1048576, 0, -1048576}});
        assert_same_picture(&one, &moved, "moved by 2^20 along two axes");
        picture_destroy(&moved);
        if (scenes[k] != scene_toys) {
            moved = render_under(*state, scenes[k], (SceneMap){.offset = {1e6 + 0.1, -1e6 / 3, 1e6}});
            const u32 apart = levels_apart(&one, &moved, 1);
            print_message("scene %d moved: %u of %u values more than a level away\n", k, apart,
                          3 * one.width * one.height);
            assert_true(apart <= 3 * one.width * one.height / 1000);
            picture_destroy(&moved);
        }
        picture_destroy(&one);
    }
}

static void test_mirrored(void **state)
{
    Picture one = render_under(*state, scene_mirror, (SceneMap){0});
    Picture other = render_under(*state, scene_mirror, (SceneMap){.mirrored = true});
    for (u32 y = 0; y < other.height; y++) {
        for (u32 x = 0; x < other.width / 2; x++) {
            f32 *a = other.rgb + 3 * ((size_t)y * other.width + x);
            f32 *b = other.rgb + 3 * ((size_t)y * other.width + other.width - 1 - x);
            for (int c = 0; c < 3; c++) {
                const f32 kept = a[c];
                a[c] = b[c];
                b[c] = kept;
            }
        }
    }
    const u32 apart = levels_apart(&one, &other, 1), any = levels_apart(&one, &other, 0.01);
    print_message("mirrored: %u of %u values more than a level away, %u more than a hundredth\n", apart,
                  3 * one.width * one.height, any);
    assert_int_equal(apart, 0);
    // And the scene has a left and a right.
    Picture again = render_under(*state, scene_mirror, (SceneMap){.mirrored = true});
    assert_true(levels_apart(&one, &again, 1) > one.width * one.height / 4);
    picture_destroy(&again);
    picture_destroy(&one);
    picture_destroy(&other);
}

int main(void)
{
    Device *device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_scale, device),
        cmocka_unit_test_prestate(test_scale_by_ten, device),
        cmocka_unit_test_prestate(test_moved, device),
        cmocka_unit_test_prestate(test_mirrored, device),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
