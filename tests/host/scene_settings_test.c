// image, camera, render, output, background, ambient, environment: values, defaults, ranges.
#include "scene_parse_fixture.h"

static void test_defaults(void **state)
{
    (void)state;
    Parsed p = parse_good("");
    const Scene *s = p.scene;
    assert_int_equal(s->image.width, 800);
    assert_int_equal(s->image.height, 600);
    assert_int_equal(s->image.samples, 1);
    assert_int_equal(s->image.filter, FILTER_BOX);
    assert_int_equal(s->image.seed, 0);
    assert_vec(s->camera.position, 0, 0, 0);
    assert_vec(s->camera.look_at, 0, 0, -1);
    assert_vec(s->camera.up, 0, 1, 0);
    assert_false(s->camera.orthographic);
    assert_true(s->camera.fov == 60);
    assert_true(s->camera.aperture == 0);
    assert_true(s->camera.focus_distance == 1);
    assert_int_equal(s->render.max_depth, 5);
    assert_true(s->render.min_weight == 0.001);
    assert_int_equal(s->render.integrator, INTEGRATOR_WHITTED);
    assert_int_equal(s->render.ambient_occlusion_samples, 0);
    assert_int_equal(s->render.environment_samples, 1);
    assert_int_equal(s->render.environment_lighting, ENVIRONMENT_SAMPLED);
    assert_true(s->render.shadows);
    assert_true(s->output.exposure == 0);
    assert_int_equal(s->output.tone_map, TONE_MAP_NONE);
    assert_int_equal(s->output.encoding, ENCODING_SRGB);
    assert_false(s->output.exposure_given);
    assert_false(s->output.tone_map_given);
    assert_vec(s->background, 0, 0, 0);
    assert_vec(s->ambient, 0.1, 0.1, 0.1);
    assert_false(s->environment.present);
    assert_int_equal(s->material_count, 1);
    assert_string_equal(s->materials[0].name, "default");
    assert_int_equal(s->world.count, 0);
    assert_int_equal(s->file_count, 1);
    assert_string_equal(s->files[0], "t");
    parsed_end(&p);
}

static void test_image(void **state)
{
    (void)state;
    Parsed p = parse_good("image { size 65536 1 samples 16 filter box seed 4294967295 }");
    assert_int_equal(p.scene->image.width, 65536);
    assert_int_equal(p.scene->image.height, 1);
    assert_int_equal(p.scene->image.samples, 16);
    assert_int_equal(p.scene->image.seed, UINT32_MAX);
    parsed_end(&p);
    p = parse_good("image { size 4.0 3e0 filter mitchell }"); // one sample is the centre with any filter
    assert_int_equal(p.scene->image.width, 4);
    assert_int_equal(p.scene->image.filter, FILTER_MITCHELL);
    assert_int_equal(p.scene->image.filter_at.column, 22);
    parsed_end(&p);
    expect_error("image { size 10.5 10 }", "1:14: 'size' must be a whole number");
    expect_error("image { size 10 }", "1:9: 'size' takes 2 whole numbers, found 1");
    expect_error("image { samples 1048577 }", "1:17: 'samples' must be from 1 to 1048576");
    expect_error("image { seed -1 }", "1:14: 'seed' must be from 0 to 4294967295");
}

static void test_camera(void **state)
{
    (void)state;
    Parsed p = parse_good("camera { position 1 2 3 look_at 1 2 -1 up 0 0.5 0 fov 40 }");
    assert_vec(p.scene->camera.position, 1, 2, 3);
    assert_vec(p.scene->camera.look_at, 1, 2, -1);
    assert_vec(p.scene->camera.up, 0, 0.5, 0);
    assert_true(p.scene->camera.fov == 40);
    assert_true(p.scene->camera.focus_distance == 4);
    parsed_end(&p);
    p = parse_good("camera { aperture 0 focus_distance 7 }");
    assert_true(p.scene->camera.focus_distance == 7);
    parsed_end(&p);
    p = parse_good("camera { position 0 0 5 aperture 0.1 }");
    assert_true(p.scene->camera.aperture == 0.1 && p.scene->camera.focus_distance == 6);
    parsed_end(&p);
    expect_error("camera { aperture -1 }", "1:19: 'aperture' must be 0 or more");
}

static void test_camera_orthographic(void **state)
{
    (void)state;
    Parsed p = parse_good("camera { orthographic 4 }");
    assert_true(p.scene->camera.orthographic);
    assert_true(p.scene->camera.height == 4);
    parsed_end(&p);
    expect_error("camera { orthographic 0 }", "1:23: 'orthographic' must be above 0");
    expect_error("camera { focus_distance 2 orthographic 1 }",
                 "1:27: 'focus_distance' and 'orthographic' exclude each other");
    expect_error("camera { fov 0 }", "1:14: 'fov' must be above 0 and below 180");
}

static void test_camera_view(void **state)
{
    (void)state;
    // The sine of the angle between up and view decides: 1e-6 is the limit.
    Parsed p = parse_good("camera { up 2e-6 0 -1 }");
    parsed_end(&p);
    expect_error("camera { up 5e-7 0 -1 }", "1:10: the camera's 'up' is parallel to its view");
    expect_error("camera { up 0 0 1e-30 }", "1:10: the camera's 'up' is parallel to its view");
    expect_error("camera { look_at 0 0 0 }", "1:10: the camera looks at its own position (0 0 0)");
    // A value that is wrong is not also used to find further mistakes.
    expect_error("camera { position 0 0 x look_at 0 0 0 }", "1:23: 'position' takes 3 numbers, not 'x'");
}

static void test_render(void **state)
{
    (void)state;
    Parsed p = parse_good("render { max_depth 0 min_weight 0 integrator whitted shadows off\n"
                          "environment_samples 4 environment_lighting prefiltered }");
    assert_int_equal(p.scene->render.max_depth, 0);
    assert_true(p.scene->render.min_weight == 0);
    assert_false(p.scene->render.shadows);
    assert_int_equal(p.scene->render.integrator, INTEGRATOR_WHITTED);
    assert_int_equal(p.scene->render.environment_samples, 4);
    assert_int_equal(p.scene->render.environment_lighting, ENVIRONMENT_PREFILTERED);
    parsed_end(&p);
    expect_error("render { max_depth 65 }", "1:20: 'max_depth' must be from 0 to 64");
    expect_error("render { min_weight -0.1 }", "1:21: 'min_weight' must be 0 or more");
    expect_error("render { ambient_occlusion 4 -1 }", "1:30: 'ambient_occlusion' must be above 0");
    p = parse_good("render { ambient_occlusion 4 2 }");
    assert_int_equal(p.scene->render.ambient_occlusion_samples, 4);
    assert_true(p.scene->render.ambient_occlusion_distance == 2);
    parsed_end(&p);
    p = parse_good("render { integrator path }");
    assert_int_equal(p.scene->render.integrator, INTEGRATOR_PATH);
    parsed_end(&p);
}

static void test_output(void **state)
{
    (void)state;
    Parsed p = parse_good("output { exposure -1.5 tone_map reinhard_extended 4 encoding linear }");
    assert_true(p.scene->output.exposure == -1.5);
    assert_int_equal(p.scene->output.tone_map, TONE_MAP_REINHARD_EXTENDED);
    assert_true(p.scene->output.white == 4);
    assert_int_equal(p.scene->output.encoding, ENCODING_LINEAR);
    assert_true(p.scene->output.exposure_given);
    assert_true(p.scene->output.tone_map_given);
    parsed_end(&p);
    static const char *const names[] = {"none", "reinhard", NULL, "aces", "hable"};
    for (u32 i = 0; i < 5; ++i) {
        if (!names[i])
            continue;
        char text[64];
        snprintf(text, sizeof text, "output { tone_map %s encoding srgb }", names[i]);
        p = parse_good(text);
        assert_int_equal(p.scene->output.tone_map, i);
        assert_false(p.scene->output.exposure_given);
        parsed_end(&p);
    }
    expect_error("output { tone_map aces 4 }",
                 "1:24: unexpected '4'; 'tone_map' takes none, reinhard, reinhard_extended and a number, "
                 "aces or hable");
    expect_error("output { tone_map reinhard_extended 0 }",
                 "1:37: 'tone_map reinhard_extended' must be above 0");
}

static void test_colors(void **state)
{
    (void)state;
    Parsed p = parse_good("background \"#ff8000\" ambient 0.25");
    assert_true(p.scene->background.x == 1);
    assert_near(p.scene->background.y, 0.21586050011389926, 1e-15); // 128/255, IEC 61966-2-1
    assert_true(p.scene->background.z == 0);
    assert_vec(p.scene->ambient, 0.25, 0.25, 0.25);
    parsed_end(&p);
    p = parse_good("background 1e30 2 3 ambient \"#0A0b0C\"");
    assert_vec(p.scene->background, 1e30, 2, 3);
    assert_near(p.scene->ambient.x, 10 / 255.0 / 12.92, 1e-17); // the straight part of the curve
    parsed_end(&p);
    expect_error("background \"#fff\"", "1:12: \"#fff\" is not a color like \"#ff8000\"");
    expect_error("background", "1:1: 'background' takes a color: 1 or 3 numbers or \"#rrggbb\"");
    expect_error("ambient 1 2 3 4", "1:15: expected a statement, found '4'");
}

static void test_environment(void **state)
{
    (void)state;
    expect_error("environment { intensity 1 }", "1:1: environment lacks 'file'");
    Parsed p = parse_bytes("environment { file \"sky.hdr\" rotate -30 }", 41);
    assert_true(p.scene->environment.present);
    assert_string_equal(p.scene->environment.file, "sky.hdr");
    assert_true(p.scene->environment.rotate == -30);
    assert_vec(p.scene->environment.intensity, 1, 1, 1);
    parsed_end(&p);
    expect_error("environment { file \"a\" } background 0",
                 "1:26: 'environment' and 'background' exclude each other");
}

static void test_once(void **state)
{
    (void)state;
    static const char *const texts[] = {"image { }\nimage { }",           "camera { }\ncamera { }",
                                        "render { }\nrender { }",         "output { }\noutput { }",
                                        "background 0\nbackground 0",     "ambient 0\nambient 0",
                                        "environment { file \"a\" }\nenvironment { file \"a\" }"};
    for (u32 i = 0; i < sizeof texts / sizeof *texts; ++i) {
        char expected[100];
        snprintf(expected, sizeof expected, "2:1: '%.*s' stands once in a scene; the first is at line 1",
                 (int)strcspn(texts[i], " "), texts[i]);
        expect_error(texts[i], expected);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_defaults),    cmocka_unit_test(test_image),
        cmocka_unit_test(test_camera),      cmocka_unit_test(test_camera_orthographic),
        cmocka_unit_test(test_camera_view), cmocka_unit_test(test_render),
        cmocka_unit_test(test_output),      cmocka_unit_test(test_colors),
        cmocka_unit_test(test_environment), cmocka_unit_test(test_once),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
