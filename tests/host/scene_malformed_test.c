// Every scene of cli/malformed has one error, the one in its .expected; nothing of crashers upsets the
// parser.
#include <dirent.h>

#include "scene_parse_fixture.h"

#include "base/file.h"

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), tail = strlen(end);
    return length >= tail && strcmp(text + length - tail, end) == 0;
}

// Calls check with the path of each file in the folder; returns how many.
static u32 for_each_file(const char *folder, const char *suffix, void (*check)(const char *path))
{
    DIR *directory = opendir(folder);
    assert_non_null(directory);
    u32 count = 0;
    for (const struct dirent *entry; (entry = readdir(directory));) {
        if (entry->d_name[0] == '.' || !ends_with(entry->d_name, suffix))
            continue;
        char path[1000];
        snprintf(path, sizeof path, "%s/%s", folder, entry->d_name);
        check(path);
        ++count;
    }
    closedir(directory);
    return count;
}

static void check_malformed(const char *path)
{
    Arena *arena = arena_create();
    char expected_path[1000];
    snprintf(expected_path, sizeof expected_path, "%.*s.expected",
             (int)(strlen(path) - strlen(".txt")), path);
    FileContent expected;
    Error error;
    if (!file_read(expected_path, true, arena, &expected, &error))
        fail_msg("%s: %s", expected_path, error.text);
    expected.text[strcspn(expected.text, "\n")] = 0;
    Parsed p = parse_file(path);
    assert_non_null(p.scene);
    if (diagnostics_error_count(p.diagnostics) != 1)
        fail_msg("%s: not one error:\n%s", path, p.messages);
    p.messages[strcspn(p.messages, "\n")] = 0;
    char tail[700];
    snprintf(tail, sizeof tail, ":%s", expected.text);
    if (!ends_with(p.messages, tail))
        fail_msg("%s\nsays     %s\nexpected %s", path, p.messages, expected.text);
    parsed_end(&p);
    arena_destroy(arena);
}

static void test_malformed(void **state)
{
    (void)state;
    assert_true(for_each_file(CLRT_TESTS "/cli/malformed", ".txt", check_malformed) >= 45);
}

// What counts is that it returns, under the sanitizers, with a message or without.
static void check_crasher(const char *path)
{
    Parsed p = parse_file(path);
    assert_non_null(p.scene);
    assert_true((diagnostics_error_count(p.diagnostics) > 0) == (p.messages[0] != 0));
    parsed_end(&p);
}

static void test_crashers(void **state)
{
    (void)state;
    assert_true(for_each_file(CLRT_TESTS "/crashers", ".txt", check_crasher) >= 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_malformed),
        cmocka_unit_test(test_crashers),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
