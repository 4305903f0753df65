// The command line: what is taken, what is refused and with which words.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "cli/options.h"

enum { ARGUMENTS_MAX = 32 };

// Parses words parted by single blanks.
static bool parse(const char *line, Options *options, Error *error)
{
    static char text[512];
    static char *arguments[ARGUMENTS_MAX + 1];
    int count = 0;
    snprintf(text, sizeof text, "clrt %s", line);
    for (char *word = strtok(text, " "); word && count < ARGUMENTS_MAX; word = strtok(NULL, " "))
        arguments[count++] = word;
    arguments[count] = NULL;
    return options_parse(count, arguments, options, error);
}

static Options accepted(const char *line)
{
    Options options;
    Error error;
    if (!parse(line, &options, &error))
        fail_msg("%s: %s", line, error.text);
    return options;
}

static void refused(const char *line, const char *text)
{
    Options options;
    Error error = {0};
    if (parse(line, &options, &error))
        fail_msg("%s: should be refused", line);
    assert_int_equal(error.code, ERROR_USAGE);
    assert_string_equal(error.text, text);
}

static void reads_operands(void **state)
{
    (void)state;
    Options options = accepted("a.txt b.png");
    assert_int_equal(options.action, ACTION_RENDER);
    assert_string_equal(options.scene, "a.txt");
    assert_string_equal(options.out, "b.png");
    assert_int_equal(options.bits, 8);
    assert_false(options.size_given || options.samples_given || options.seed_given || options.depth_given);
    assert_false(options.crop_given || options.exposure_given);
    assert_false(options.tone_map_given || options.bits_given);
    options = accepted("- -");
    assert_string_equal(options.scene, "-");
    assert_string_equal(options.out, "-");
    options = accepted("-q -- -q --help");
    assert_true(options.quiet);
    assert_string_equal(options.scene, "-q");
    assert_string_equal(options.out, "--help");
    options = accepted("a.txt -n 4 b.png");
    assert_string_equal(options.out, "b.png");
}

static void reads_every_form_of_a_value(void **state)
{
    (void)state;
    static const char *const LINES[] = {"--size 640x480 a b", "--size=640x480 a b", "-s 640x480 a b",
                                        "-s640x480 a b", "-qs640x480 a b", "a b -qs 640x480"};
    for (size_t i = 0; i < sizeof LINES / sizeof LINES[0]; i++) {
        const Options options = accepted(LINES[i]);
        assert_true(options.size_given);
        assert_int_equal(options.width, 640);
        assert_int_equal(options.height, 480);
        assert_string_equal(options.scene, "a");
    }
}

static void reads_values(void **state)
{
    (void)state;
    Options options =
        accepted("-n 1048576 --seed 4294967295 --depth 64 --bits 16 --memory 256 --threads 3 a b");
    assert_int_equal(options.samples, 1048576);
    assert_int_equal(options.seed, UINT32_MAX);
    assert_int_equal(options.depth, 64);
    assert_int_equal(options.bits, 16);
    assert_int_equal(options.memory, 256u << 20);
    assert_int_equal(options.threads, 3);
    assert_int_equal(options.math, MATH_EXACT);
    assert_int_equal(accepted("--math fast a b").math, MATH_FAST);
    assert_int_equal(accepted("--math=double a b").math, MATH_DOUBLE);
    options = accepted("--seed 0 --depth 0 --exposure -1.5 --crop 65535,0,1,65536 a b");
    assert_true(options.seed_given && options.depth_given && options.exposure_given && options.crop_given);
    assert_int_equal(options.seed, 0);
    assert_true(options.exposure == -1.5);
    assert_int_equal(options.crop_x, 65535);
    assert_int_equal(options.crop_height, 65536);
    assert_true(accepted("a b").clamp == 0);
    assert_true(accepted("--clamp 2.5 a b").clamp == 2.5f);
    assert_true(accepted("--clamp=1e-37 a b").clamp == 1e-37f);
    options = accepted("--tone-map aces a b");
    assert_int_equal(options.tone_map, TONE_MAP_ACES);
    options = accepted("--tone-map none a b");
    assert_int_equal(options.tone_map, TONE_MAP_NONE);
    assert_true(options.tone_map_given);
    options = accepted("--tone-map reinhard_extended,2.5 a b");
    assert_int_equal(options.tone_map, TONE_MAP_REINHARD_EXTENDED);
    assert_true(options.white == 2.5);
    options = accepted("--stats a b");
    assert_true(options.stats);
    assert_null(options.stats_file);
    options = accepted("--stats=s.json -vv -d 1:0 a b");
    assert_string_equal(options.stats_file, "s.json");
    assert_int_equal(options.verbose, 2);
    assert_string_equal(options.device, "1:0");
}

static void refuses_values_out_of_range(void **state)
{
    (void)state;
    static const char *const LINES[] = {
        "--size 0x1", "--size 1x0", "--size 65537x1", "--size 640", "--size 640x480x2", "--size x",
        "--size +1x1",
        "--size 640X480", "--samples 0", "--samples 1048577", "--samples 1.0", "--samples -1", "--samples 4x",
        "--samples 99999999999999999999", "--seed -1", "--seed 4294967296", "--depth 65", "--crop 1,2,3",
        "--crop 1,2,3,0", "--crop 65536,0,1,1", "--crop 1,2,3,4,5", "--bits 12", "--exposure x",
        "--exposure inf", "--exposure nan", "--exposure 0x1", "--exposure 1e39", "--tone-map filmic",
        "--tone-map reinhard_extended", "--tone-map reinhard_extended,0", "--tone-map reinhard_extended,-1",
        "--memory 0", "--memory 16777217",
        "--clamp 0", "--clamp -1", "--clamp nan", "--clamp inf", "--clamp 1e39", "--clamp 1e-39", "--clamp 2x",
        "--clamp=", "--threads 0", "--math fat", "--math Exact", "--math=", "--stats=", "--samples="};
    for (size_t i = 0; i < sizeof LINES / sizeof LINES[0]; i++) {
        char line[128];
        Options options;
        Error error;
        snprintf(line, sizeof line, "%s a b", LINES[i]);
        if (parse(line, &options, &error))
            fail_msg("%s: should be refused", LINES[i]);
        if (!strstr(error.text, "must be"))
            fail_msg("%s: %s", LINES[i], error.text);
        assert_int_equal(error.code, ERROR_USAGE);
    }
}

static void refuses_with_words(void **state)
{
    (void)state;
    refused("", "SCENE and OUT are missing");
    refused("a", "OUT is missing");
    refused("a b c", "one SCENE and one OUT, not also 'c'");
    refused("--check", "SCENE is missing");
    refused("--sise 3x3 a b",
            "unknown option '--sise'; did you mean '--size'?\none SCENE and one OUT, not also 'b'");
    refused("--frobnicate a b", "unknown option '--frobnicate'");
    refused("-x a b", "unknown option '-x'");
    refused("--samples a b", "--samples 'a': must be a whole number from 1 to 1048576\nOUT is missing");
    refused("a b --samples", "--samples needs a value: N");
    refused("--samples --quiet a b", "--samples needs a value: N");
    refused("a b -n", "-n needs a value: N");
    refused("--quiet=1 a b", "--quiet takes no value");
    refused("--json a b", "--json goes with --list-devices");
    refused("-qv a b", "--quiet and --verbose exclude each other");
    refused("-l a", "--list-devices takes no SCENE");
    refused("--aov depth,colour a b",
            "--aov 'depth,colour': must be a list of depth, normal, position, albedo, id, with commas between");
    refused("--aov id a -", "--aov needs a file's name for OUT");
    refused("--environment-lighting baked a b", "--environment-lighting 'baked': must be sampled or prefiltered");
    refused("--integrator light a b", "--integrator 'light': must be whitted or path");
    refused("--sampling light a b", "--sampling 'light': must be both, lights or surfaces");
    refused("a b --sampling", "--sampling needs a value: HOW");
    refused("--bits 9 --depth 99 a b",
            "--bits '9': must be 8 or 16\n--depth '99': must be a whole number from 0 to 64");
}

static void says_what_comes_later(void **state)
{
    (void)state;
    refused("--error=0.1 a b", "--error is not supported yet");
    refused("--confidence 0.9 a b", "--confidence is not supported yet");
    refused("--time 5 a b", "--time is not supported yet");
    refused("--part 1/2 a b", "--part is not supported yet");
    refused("--resume a b", "--resume is not supported yet");
    refused("a b --part", "--part is not supported yet");
}

static void takes_the_other_actions(void **state)
{
    (void)state;
    assert_int_equal(accepted("-h").action, ACTION_HELP);
    assert_int_equal(accepted("--help --frobnicate").action, ACTION_HELP);
    assert_int_equal(accepted("--version").action, ACTION_VERSION);
    assert_int_equal(accepted("-l").action, ACTION_LIST_DEVICES);
    assert_int_equal(accepted("--self-test").action, ACTION_SELF_TEST);
    assert_null(accepted("-q -d 0 --self-test").self_test_file);
    assert_string_equal(accepted("--self-test=t.json").self_test_file, "t.json");
    refused("--self-test=", "--self-test '': must be a file's name");
    refused("--self-test a b", "--self-test takes no SCENE");
    assert_true(accepted("--force-device a b").force_device);
    assert_false(accepted("a b").force_device);
    assert_true(accepted("--list-devices --json").json);
    assert_int_equal(accepted("--check a").action, ACTION_CHECK);
    assert_null(accepted("--check a").out);
    assert_string_equal(accepted("--check a b").out, "b");
}

static void survives_many_mistakes(void **state)
{
    (void)state;
    enum { MANY = 1000 };
    static char *arguments[MANY + 1];
    arguments[0] = "clrt";
    for (int i = 1; i < MANY; i++)
        arguments[i] = "--frobnicate";
    Options options;
    Error error;
    assert_false(options_parse(MANY, arguments, &options, &error));
    assert_int_equal(strlen(error.text), sizeof error.text - 1);
}

static void overrides_the_scene(void **state)
{
    (void)state;
    Error error;
    Scene scene = {.image = {.width = 800, .height = 600, .samples = 1, .seed = 5}};
    scene.render.max_depth = 7;
    Options options = accepted("a b");
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.image.width, 800);
    assert_int_equal(scene.image.seed, 5);
    assert_int_equal(scene.render.max_depth, 7);
    assert_false(scene.output.exposure_given || scene.output.tone_map_given);
    options = accepted("-s 20x10 -n 9 --seed 0 --depth 0 --exposure 2 --tone-map hable --crop 15,5,5,5 a b");
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.image.width, 20);
    assert_int_equal(scene.image.height, 10);
    assert_int_equal(scene.image.samples, 9);
    assert_int_equal(scene.image.seed, 0);
    assert_int_equal(scene.render.max_depth, 0);
    assert_true(scene.output.exposure == 2 && scene.output.exposure_given && scene.output.tone_map_given);
    assert_int_equal(scene.output.tone_map, TONE_MAP_HABLE);
    assert_int_equal(scene.render.environment_lighting, ENVIRONMENT_SAMPLED);
    options = accepted("--environment-lighting prefiltered a b");
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.render.environment_lighting, ENVIRONMENT_PREFILTERED);
    assert_int_equal(scene.render.integrator, INTEGRATOR_WHITTED);
    assert_int_equal(scene.render.light_sampling, LIGHT_SAMPLING_BOTH);
    options = accepted("--integrator path --sampling surfaces a b");
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.render.integrator, INTEGRATOR_PATH);
    assert_int_equal(scene.render.light_sampling, LIGHT_SAMPLING_SURFACES);
    options = accepted("--sampling=lights a b"); // the scene's integrator stays
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.render.integrator, INTEGRATOR_PATH);
    assert_int_equal(scene.render.light_sampling, LIGHT_SAMPLING_LIGHTS);
    options = accepted("--integrator whitted --sampling both a b");
    assert_true(options_override(&options, &scene, &error));
    assert_int_equal(scene.render.integrator, INTEGRATOR_WHITTED);
    assert_int_equal(scene.render.light_sampling, LIGHT_SAMPLING_BOTH);
    options = accepted("--crop 16,5,5,5 a b");
    assert_false(options_override(&options, &scene, &error));
    assert_int_equal(error.code, ERROR_USAGE);
    assert_non_null(strstr(error.text, "20 x 10"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_operands),
        cmocka_unit_test(reads_every_form_of_a_value),
        cmocka_unit_test(reads_values),
        cmocka_unit_test(refuses_values_out_of_range),
        cmocka_unit_test(refuses_with_words),
        cmocka_unit_test(says_what_comes_later),
        cmocka_unit_test(takes_the_other_actions),
        cmocka_unit_test(survives_many_mistakes),
        cmocka_unit_test(overrides_the_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
