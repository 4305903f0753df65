// Messages: how they look, how many are shown, in which order; names that were meant.
#include "scene_parse_fixture.h"

#include "scene/names.h"
#include "scene/report.h"

static char *shown_once(const char *line, u32 column, u32 length)
{
    Diagnostics *d = diagnostics_create();
    diagnostics_add(d, SEVERITY_ERROR, "s.txt", 3, column, length, line, "bad %s", "thing");
    char *text = printed(d);
    diagnostics_destroy(d);
    return text;
}

static void test_look(void **state)
{
    (void)state;
    char *text = shown_once("sphere { radus 1 }\nnext", 10, 5);
    assert_string_equal(text, "s.txt:3:10: error: bad thing\n"
                              "    sphere { radus 1 }\n"
                              "             ^~~~~\n");
    free(text);
    // Tabs are repeated under the line, wide characters are one, the underline ends with the line.
    text = shown_once("\ta\xC3\xA4\tbc\r\n", 5, 9);
    assert_string_equal(text, "s.txt:3:5: error: bad thing\n    \ta\xC3\xA4\tbc\n    \t  \t^~\n");
    free(text);
    text = shown_once("ab", 3, 0); // the end of the line
    assert_string_equal(text, "s.txt:3:3: error: bad thing\n    ab\n      ^\n");
    free(text);
    text = shown_once(NULL, 3, 1);
    assert_string_equal(text, "s.txt:3:3: error: bad thing\n");
    free(text);
}

static void test_file_as_a_whole(void **state)
{
    (void)state;
    Diagnostics *d = diagnostics_create();
    diagnostics_add(d, SEVERITY_WARNING, "m.mtl", 0, 0, 0, "no line", "is empty");
    char *text = printed(d);
    assert_string_equal(text, "m.mtl: warning: is empty\n");
    assert_int_equal(diagnostics_error_count(d), 0);
    assert_int_equal(diagnostics_warning_count(d), 1);
    free(text);
    diagnostics_destroy(d);
}

static void test_nothing_for_the_terminal_to_obey(void **state)
{
    (void)state;
    char *text = shown_once("a\x1B[31m\xC2\x9B\xFFz\xC3\xA4", 1, 1);
    assert_non_null(strstr(text, "    a?[31m??z\xC3\xA4\n"));
    free(text);
}

static void test_long_line(void **state)
{
    (void)state;
    enum { LENGTH = 5000 };
    char line[LENGTH + 1];
    memset(line, '.', LENGTH);
    line[LENGTH] = 0;
    static const u32 columns[] = {1, 50, 101, 160, 161, 2500, 4990, 5000};
    for (u32 i = 0; i < sizeof columns / sizeof *columns; ++i) {
        const u32 at = columns[i] - 1;
        line[at] = 'X';
        char *text = shown_once(line, columns[i], 3);
        char *shown = strchr(text, '\n') + 5, *end = strchr(shown, '\n');
        assert_int_equal(end - shown, 160);
        // The caret stands under the X.
        assert_int_equal(strchr(end + 5, '^') - (end + 5), strchr(shown, 'X') - shown);
        free(text);
        line[at] = '.';
    }
}

static void test_twenty(void **state)
{
    (void)state;
    Diagnostics *d = diagnostics_create();
    for (u32 i = 0; i < 5; ++i)
        diagnostics_add(d, SEVERITY_WARNING, "s", 1000 + i, 1, 1, "x", "w%u", i);
    assert_false(diagnostics_full(d));
    for (u32 i = 1; i <= 30; ++i)
        diagnostics_add(d, SEVERITY_ERROR, "s", i, 1, 1, "x", "e%u", i);
    assert_true(diagnostics_full(d));
    diagnostics_add(d, SEVERITY_WARNING, "s", 1, 1, 1, "x", "late");
    assert_int_equal(diagnostics_error_count(d), 30);
    assert_int_equal(diagnostics_warning_count(d), 6);
    char *text = printed(d);
    u32 errors = 0;
    for (const char *p = text; (p = strstr(p, ": error: ")); ++p)
        ++errors;
    assert_int_equal(errors, 20); // they push the warnings out
    assert_null(strstr(text, "warning"));
    assert_non_null(strstr(text, ": error: e20\n"));
    assert_null(strstr(text, ": error: e21\n"));
    assert_non_null(strstr(text, "\n16 more not shown\n"));
    free(text);
    diagnostics_destroy(d);
}

static void test_order(void **state)
{
    (void)state;
    Diagnostics *d = diagnostics_create();
    static const struct {
        const char *file;
        u32 line, column;
    } places[] = {{"a", 3, 1}, {"a", 1, 2}, {"a", 3, 4}, {"a", 1, 1}, {"b", 9, 1}, {"b", 2, 1}, {"a", 2, 1}};
    for (u32 i = 0; i < sizeof places / sizeof *places; ++i)
        diagnostics_add(d, SEVERITY_ERROR, places[i].file, places[i].line, places[i].column, 1, NULL, "e");
    char *text = printed(d);
    assert_string_equal(text, "a:1:1: error: e\na:1:2: error: e\na:3:1: error: e\na:3:4: error: e\n"
                              "b:2:1: error: e\nb:9:1: error: e\na:2:1: error: e\n");
    free(text);
    diagnostics_destroy(d);
}

static void check_suggestion(const char *word, const char *expected)
{
    static const char *const known[] = {"center", "radius", "up", "fov", "on", "off", "reinhard_extended"};
    Suggestion s = suggest_begin(word, strlen(word));
    for (u32 i = 0; i < sizeof known / sizeof *known; ++i)
        suggest_offer(&s, known[i], strlen(known[i]));
    char text[SUGGEST_TEXT_MAX];
    suggest_text(&s, text);
    if (!expected) {
        assert_string_equal(text, "");
        return;
    }
    char wanted[SUGGEST_TEXT_MAX];
    snprintf(wanted, sizeof wanted, "; did you mean '%s'?", expected);
    assert_string_equal(text, wanted);
}

static void test_suggestions(void **state)
{
    (void)state;
    check_suggestion("radus", "radius");
    check_suggestion("RADIUS", "radius");
    check_suggestion("raduis", "radius"); // neighbours exchanged
    check_suggestion("centre", "center");
    check_suggestion("fvo", "fov");
    check_suggestion("reinhart_extendet", "reinhard_extended");
    check_suggestion("u", NULL);
    check_suggestion("x", NULL);
    check_suggestion("diameter", NULL);
    check_suggestion("wobble", NULL);
    char endless[200];
    memset(endless, 'r', sizeof endless);
    endless[199] = 0;
    check_suggestion(endless, NULL);
}

static void test_names(void **state)
{
    (void)state;
    enum { COUNT = 5000 };
    static char texts[COUNT][8];
    Arena *arena = arena_create();
    Names names = {0};
    assert_int_equal(names_find(&names, "a", 1), -1);
    for (u32 i = 0; i < COUNT; ++i) {
        const int length = snprintf(texts[i], sizeof texts[i], "n%u", i);
        assert_int_equal(names_find(&names, texts[i], (size_t)length), -1);
        assert_true(names_add(&names, arena, texts[i], (size_t)length));
    }
    for (u32 i = 0; i < COUNT; ++i)
        assert_int_equal(names_find(&names, texts[i], strlen(texts[i])), i);
    assert_int_equal(names_find(&names, "n", 1), -1);
    assert_int_equal(names_find(&names, "n12", 2), 1); // only the first two letters
    arena_destroy(arena);
}

static void test_report(void **state)
{
    (void)state;
    Parsed p = parse_good("\xEF\xBB\xBF# \xC3\xA4\n"
                          "  sphere { center 0 0 0 radius 1 }\r\nbox{ center 0 0 0 size 1 }");
    scene_report(p.scene, p.diagnostics, SEVERITY_ERROR, p.scene->shapes[0].at, "no file %d", 7);
    scene_report(p.scene, p.diagnostics, SEVERITY_WARNING, p.scene->shapes[1].at, "odd");
    char *text = printed(p.diagnostics);
    assert_string_equal(text, "t:2:3: error: no file 7\n"
                              "      sphere { center 0 0 0 radius 1 }\n      ^~~~~~\n"
                              "t:3:1: warning: odd\n    box{ center 0 0 0 size 1 }\n    ^~~\n");
    free(text);
    parsed_end(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_look),        cmocka_unit_test(test_file_as_a_whole),
        cmocka_unit_test(test_nothing_for_the_terminal_to_obey),
        cmocka_unit_test(test_long_line),   cmocka_unit_test(test_twenty),
        cmocka_unit_test(test_order),       cmocka_unit_test(test_suggestions),
        cmocka_unit_test(test_names),       cmocka_unit_test(test_report),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
