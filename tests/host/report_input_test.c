// What clrt-report reads: its command line, peers, histograms; what it writes for other programs; its
// children.
#define _XOPEN_SOURCE 700

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "arguments.h"
#include "child.h"
#include "csv.h"
#include "doc.h"
#include "feature_scenes.h"
#include "folder.h"
#include "ulp.h"

typedef struct Fixture {
    char folder[64];
    Arena *arena;
} Fixture;

static int set_up(void **state)
{
    Fixture *f = calloc(1, sizeof *f);
    strcpy(f->folder, "/tmp/clrt-report-test-XXXXXX");
    f->arena = arena_create();
    *state = f;
    return mkdtemp(f->folder) && chdir(f->folder) == 0 ? 0 : -1;
}

static int tear_down(void **state)
{
    Fixture *f = *state;
    if (chdir("/") != 0)
        return -1;
    folder_remove(f->folder);
    const bool gone = !folder_exists(f->folder);
    arena_destroy(f->arena);
    free(f);
    return gone ? 0 : -1;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void expect_file(const char *name, const char *text)
{
    char found[4096];
    FILE *file = fopen(name, "rb");
    assert_non_null(file);
    found[fread(found, 1, sizeof found - 1, file)] = 0;
    fclose(file);
    assert_string_equal(found, text);
}

// ---- the command line -----------------------------------------------------------------------

enum { WORDS = 12 };

static bool parse(Fixture *f, const char *line, Arguments *arguments, Error *error)
{
    static char copy[256];
    char *words[WORDS + 1] = {(char *)(uintptr_t) "clrt-report"};
    int count = 1;
    snprintf(copy, sizeof copy, "%s", line);
    for (char *word = strtok(copy, "|"); word && count < WORDS; word = strtok(NULL, "|"))
        words[count++] = word;
    return arguments_parse(count, words, f->arena, arguments, error);
}

static void test_defaults(void **state)
{
    Arguments a;
    Error error;
    assert_true(parse(*state, "a.txt|b.txt", &a, &error));
    assert_int_equal(a.scene_count, 2);
    assert_string_equal(a.scenes[1], "b.txt");
    assert_string_equal(a.out, "report");
    assert_int_equal(a.mode_count, 3);
    assert_string_equal(a.modes[2].math, "double");
    assert_int_equal(a.sample_count, 4);
    assert_int_equal(a.samples[3], 64);
    assert_true(a.runs == 5 && a.cold_runs == 5 && a.pixels_max == 0);
    assert_true(parse(*state, "--quick|a.txt", &a, &error));
    assert_true(a.runs == 3 && a.cold_runs == 1 && a.sample_count == 3 && a.pixels_max > 0);
    assert_true(parse(*state, "--quick|--size|64x48|--runs|9|a.txt", &a, &error));
    assert_true(a.runs == 9 && a.pixels_max == 0 && a.width == 64 && a.height == 48);
    assert_true(parse(*state, "--features", &a, &error));
    assert_int_equal(a.scene_count, 0);
}

static void test_modes(void **state)
{
    Arguments a;
    Error error;
    assert_true(parse(*state, "--variant|low=--depth 1  --math=double|--math|fast|a.txt", &a, &error));
    assert_int_equal(a.mode_count, 2);
    assert_string_equal(a.modes[0].name, "fast");
    assert_string_equal(a.modes[1].name, "low");
    assert_string_equal(a.modes[1].math, "double");
    assert_int_equal(a.modes[1].word_count, 3);
    assert_string_equal(a.modes[1].words[1], "1");
    // Variants come after the modes of --math, wherever they stand.
    assert_true(parse(*state, "--variant|low=--depth 1|a.txt", &a, &error));
    assert_int_equal(a.mode_count, 4);
    assert_string_equal(a.modes[3].name, "low");
    assert_string_equal(a.modes[3].math, "exact");
}

static void test_wrong_command_lines(void **state)
{
    static const char *const LINES[][2] = {
        {"--quick", "no scene"},
        {"--samples|4,2|a.txt", "rising"},
        {"--samples|1,,2|a.txt", "rising"},
        {"--samples|0|a.txt", "rising"},
        {"--samples|1,2,|a.txt", "rising"},
        {"--size|64|a.txt", "WxH"},
        {"--runs|1|a.txt", "from 2 to"},
        {"--math|exact,half|a.txt", "not a list of exact"},
        {"--math|exact,exact|a.txt", "two modes"},
        {"--variant|exact=--depth 1|a.txt", "two modes"},
        {"--variant|depth|a.txt", "NAME="},
        {"--variant|a/b=--depth 1|a.txt", "letters, digits"},
        {"--variant|a=--math half|a.txt", "no --math half"},
        {"--reference-seconds|-1|a.txt", "at least 0"},
        {"--nothing|a.txt", "not an option"},
        {"a.txt|--size", "missing"},
    };
    for (size_t i = 0; i < sizeof LINES / sizeof LINES[0]; i++) {
        Arguments a;
        Error error = {.code = ERROR_NONE};
        if (parse(*state, LINES[i][0], &a, &error) || error.code != ERROR_USAGE ||
            !strstr(error.text, LINES[i][1]))
            fail_msg("%s: not \"%s\" but \"%s\"", LINES[i][0], LINES[i][1], error.text);
    }
}

// ---- files ----------------------------------------------------------------------------------

static void test_peers(void **state)
{
    (void)state;
    Peer peers[PEERS_MAX];
    size_t count;
    Error error;
    write_file("peers.csv", "name,seconds,rmse\n# a comment\n\nPOV-Ray 3.7,1.5,0.02\r\nother,2e-1,1\n");
    assert_true(csv_read_peers("peers.csv", peers, &count, &error));
    assert_int_equal(count, 2);
    assert_string_equal(peers[0].name, "POV-Ray 3.7");
    assert_true(peers[0].seconds == 1.5 && peers[0].rmse == 0.02 && peers[1].seconds == 0.2);
    static const char *const WRONG[] = {"a,1\n",   "a,1,2,3\n", "a,0,1\n",  "a,-1,1\n",
                                        "a,x,1\n", ",1,1\n",    "a,1,inf\n"};
    for (size_t i = 0; i < sizeof WRONG / sizeof WRONG[0]; i++) {
        write_file("peers.csv", WRONG[i]);
        if (csv_read_peers("peers.csv", peers, &count, &error) || !strstr(error.text, "peers.csv:1:"))
            fail_msg("%s is taken for a peer", WRONG[i]);
    }
    assert_false(csv_read_peers("none.csv", peers, &count, &error));
    assert_int_equal(error.code, ERROR_IO);
}

static void test_ulp(void **state)
{
    (void)state;
    Error error;
    write_file("ulp.json", "{\"shapes\": [{\"name\": \"a\", \"rays\": 3, \"max_ulp\": 2, \"p99_ulp\": null,"
                           "\"histogram\": [{\"ulp\": 1, \"count\": 2}, {\"ulp\": null, \"count\": 1}]}]}");
    json_t *ulp = ulp_read("ulp.json", &error);
    assert_non_null(ulp);
    assert_true(doc_number(ulp, "shapes.0.histogram.0.count") == 2);
    assert_true(isnan(doc_number(ulp, "shapes.0.p99_ulp")) && isnan(doc_number(ulp, "shapes.1.rays")));
    json_decref(ulp);
    static const char *const WRONG[] = {"{",
                                        "[]",
                                        "{\"shapes\": 1}",
                                        "{\"shapes\": [{\"name\": \"a\"}]}",
                                        "{\"shapes\": [{\"name\": 1, \"histogram\": []}]}",
                                        "{\"shapes\": [{\"name\": \"a\", \"histogram\": [{\"ulp\": 1}]}]}"};
    for (size_t i = 0; i < sizeof WRONG / sizeof WRONG[0]; i++) {
        write_file("ulp.json", WRONG[i]);
        if (ulp_read("ulp.json", &error) || error.code != ERROR_IO)
            fail_msg("%s is taken for histograms", WRONG[i]);
    }
}

static void test_csv(void **state)
{
    (void)state;
    Error error;
    json_t *rows = json_loads("[{\"a\": {\"x\": 1.5, \"s\": \"plain\"}, \"l\": [\"P\", \"Q\"], \"n\": null},"
                              " {\"a\": {\"x\": null, \"s\": \"with, \\\"both\\\"\"}, \"l\": null, \"n\": 7,"
                              "  \"convergence\": []}]",
                              0, NULL);
    assert_non_null(rows);
    json_t *before = json_deep_copy(rows);
    assert_true(csv_write_rows(rows, "rows.csv", &error));
    assert_true(json_equal(rows, before));
    expect_file("rows.csv", "a.x,a.s,l,n\n1.5,plain,P Q,\n,\"with, \"\"both\"\"\",,7\n");
    assert_false(csv_write_rows(rows, "none/rows.csv", &error));
    json_decref(before);
    json_decref(rows);
}

static void test_folders(void **state)
{
    const Fixture *f = *state;
    Error error;
    assert_true(folder_make("old", &error) && folder_make("new", &error));
    write_file("old/a", "old");
    write_file("new/a", "new");
    assert_false(folder_make("old", &error));
    assert_true(folder_is_empty("old") == false && folder_exists("old"));
    assert_true(folder_replace("new", "old", f->arena, &error));
    expect_file("old/a", "new");
    assert_false(folder_exists("new"));
    // What cannot be replaced stays.
    assert_false(folder_replace("none", "old", f->arena, &error));
    assert_int_equal(error.code, ERROR_IO);
    expect_file("old/a", "new");
}

// ---- children -------------------------------------------------------------------------------

static void test_children(void **state)
{
    (void)state;
    Error error;
    ChildEnd end;
    const char *const environment[] = {"CLRT_REPORT_TEST=here", NULL};
    const char *const talk[] = {"sh", "-c", "pwd; echo $CLRT_REPORT_TEST >&2; exit 3", NULL};
    const Child child = {.argv = talk, .environment = environment, .talk_path = "talk"};
    child_hold_signals();
    assert_true(child_run(&child, &end, &error));
    assert_int_equal(end.status, 3);
    assert_string_equal(end.talk, "here");
    assert_true(end.seconds > 0 && end.seconds < 60);
    assert_null(getenv("CLRT_REPORT_TEST"));

    const char *const killed[] = {"sh", "-c", "kill -9 $$", NULL};
    assert_true(child_run(&(Child){.argv = killed, .talk_path = "talk"}, &end, &error));
    assert_int_equal(end.status, 128 + 9);

    const char *const none[] = {"./no-such-program", NULL};
    assert_false(child_run(&(Child){.argv = none, .talk_path = "talk"}, &end, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_non_null(strstr(error.text, "no-such-program"));

    // Asked to end, it ends the child and fails; afterwards nothing is held back.
    const char *const slow[] = {"sh", "-c", "kill -INT $PPID; exec sleep 30", NULL};
    assert_false(child_run(&(Child){.argv = slow, .talk_path = "talk"}, &end, &error));
    assert_int_equal(error.code, ERROR_INTERRUPTED);
    assert_true(child_run(&child, &end, &error));
}

static void test_feature_scenes(void **state)
{
    const Fixture *f = *state;
    const char *base = feature_scene_text(0, FEATURE_BASE, f->arena);
    assert_non_null(base);
    assert_string_equal(feature_scene_text(0, FEATURE_USED, f->arena), base); // the control
    for (size_t i = 1; i < FEATURE_SCENE_COUNT; i++) {
        const char *used = feature_scene_text(i, FEATURE_USED, f->arena);
        const char *unused = feature_scene_text(i, FEATURE_UNUSED, f->arena);
        assert_string_not_equal(used, base);
        if (unused)
            assert_string_not_equal(unused, used);
    }
    const char *mesh = feature_scene_mesh(f->arena);
    size_t faces = 0;
    for (const char *at = strstr(mesh, "\nf "); at; at = strstr(at + 1, "\nf "))
        faces++;
    assert_int_equal(faces, 480);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_defaults, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_modes, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_wrong_command_lines, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_peers, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_ulp, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_csv, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_folders, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_children, set_up, tear_down),
        cmocka_unit_test_setup_teardown(test_feature_scenes, set_up, tear_down),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
