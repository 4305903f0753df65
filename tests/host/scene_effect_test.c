// What has no effect: settings that the path integrator does not look at are warnings where they stand.
#include "scene_parse_fixture.h"

#include "scene/effect.h"

// What is said of a scene without errors once its integrator is this one.
static void expect_said(const char *text, Integrator integrator, const char *said)
{
    Parsed p = parse_good(text);
    p.scene->render.integrator = integrator;
    scene_check_effect(p.scene, p.diagnostics);
    assert_int_equal(diagnostics_error_count(p.diagnostics), 0);
    char *messages = printed(p.diagnostics);
    assert_string_equal(messages, said);
    free(messages);
    parsed_end(&p);
}

static void test_whitted(void **state)
{
    (void)state;
    expect_said("render { ambient_occlusion 4 2 environment_lighting prefiltered }", INTEGRATOR_WHITTED, "");
    // The command line has the last word.
    expect_said("render { integrator path ambient_occlusion 4 2 }", INTEGRATOR_WHITTED, "");
}

static void test_path(void **state)
{
    (void)state;
    expect_said("", INTEGRATOR_PATH, "");
    expect_said("ambient 0.5 render { min_weight 0.1 environment_samples 4 environment_lighting sampled }\n"
                "light sphere { center 0 0 0 radius 1 radiance 1 samples 4 }",
                INTEGRATOR_PATH, "");
    expect_said("render { ambient_occlusion 4 2 }", INTEGRATOR_PATH,
                "t:1:10: warning: 'ambient_occlusion' has no effect with 'integrator path', which has no ambient "
                "light\n"
                "    render { ambient_occlusion 4 2 }\n"
                "             ^~~~~~~~~~~~~~~~~\n");
    expect_said("render {\n integrator path environment_lighting prefiltered }", INTEGRATOR_PATH,
                "t:2:18: warning: 'prefiltered' has no effect with 'integrator path', which samples the "
                "environment\n"
                "     integrator path environment_lighting prefiltered }\n"
                "                     ^~~~~~~~~~~~~~~~~~~~\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_whitted),
        cmocka_unit_test(test_path),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
