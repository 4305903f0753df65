// UTF-8, decimal and whole numbers, arenas, paths, files, the clock.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/clock.h"
#include "base/file.h"
#include "base/text.h"

static void test_utf8(void **state)
{
    (void)state;
    static const char *const good[] = {"", "abc", "\xC3\xA4", "\xE2\x82\xAC", "\xF0\x9F\x98\x80",
                                       "\xED\x9F\xBF", "\xF4\x8F\xBF\xBF", "\x7F",
                                       "12345678\xC3\xA4" "12345678"};
    static const u32 characters[] = {0, 3, 1, 1, 1, 1, 1, 1, 17};
    for (u32 i = 0; i < sizeof good / sizeof *good; ++i) {
        assert_int_equal(text_find_invalid_utf8(good[i], strlen(good[i])), strlen(good[i]));
        assert_int_equal(text_count_characters(good[i], strlen(good[i])), characters[i]);
    }
    static const char *const bad[] = {"\x80", "\xC3", "\xC0\xAF", "\xC1\xBF", "\xE0\x80\xAF", "\xED\xA0\x80",
                                      "\xF0\x80\x80\xAF", "\xF4\x90\x80\x80", "\xF5\x80\x80\x80", "\xFF",
                                      "\xE2\x82", "\xE2\x28\xA1"};
    for (u32 i = 0; i < sizeof bad / sizeof *bad; ++i) {
        char text[40];
        snprintf(text, sizeof text, "123456789%s", bad[i]);
        assert_int_equal(text_find_invalid_utf8(text, strlen(text)), 9);
        assert_int_equal(text_find_invalid_utf8(bad[i], strlen(bad[i])), 0);
    }
}

static void test_decimal(void **state)
{
    (void)state;
    static const char *const numbers[] = {
        "0", "-0", "1", "0.1", "123456789.123456789", "9007199254740992", "9007199254740993", "1e22", "1e23",
        "1e-22", "1e-23", "8.5e-22", "123456789012345678e4", "0.00000000000000000000000000000123", "4.9e-324",
        "1e-330", "1.7976931348623157e308", "1e309", "-1e-5", "3.14159265358979323846264338327950288",
        "99999999999999999999", "100000000000000000", "0.30000000000000004", "5.", ".5", "+.5E+1",
        "00000000000000000000000000000001", "1e00000000000000000000001", "1e-99999999999999999999"};
    for (u32 i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        f64 value = NAN;
        assert_true(text_parse_decimal(numbers[i], strlen(numbers[i]), &value));
        const f64 expected = strtod(numbers[i], NULL);
        assert_memory_equal(&value, &expected, sizeof value);
    }
    static const char *const bad[] = {"", "+", "-", ".", "-.", "e5", ".e5", "1e", "1e+", "1e5x", "1.2.3",
                                      "--1", "0x1", "1f", "inf", "nan", "1 ", " 1", "1e5.5", "1_000"};
    for (u32 i = 0; i < sizeof bad / sizeof *bad; ++i) {
        f64 value;
        assert_false(text_parse_decimal(bad[i], strlen(bad[i]), &value));
    }
}

static void test_decimal_agrees_with_libc(void **state)
{
    (void)state;
    u64 random = 88172645463325252u;
    for (u32 i = 0; i < 100000; ++i) {
        random ^= random << 13;
        random ^= random >> 7;
        random ^= random << 17;
        char text[64];
        const u32 digits = (u32)(random >> 40) % 19 + 1;
        snprintf(text, sizeof text, "%.*fe%d", (int)(random >> 50) % 8, (f64)(random % 1000000000000u) / 1e4,
                 (i32)(digits * 3) - 30);
        f64 value;
        assert_true(text_parse_decimal(text, strlen(text), &value));
        assert_true(value == strtod(text, NULL));
    }
}

static void test_arena(void **state)
{
    (void)state;
    Arena *arena = arena_create();
    // Many arrays that grow in turn, small and large, keep what is in them.
    enum { ARRAYS = 7, COUNT = 30000 };
    u64 *arrays[ARRAYS] = {NULL};
    for (u32 i = 0; i < COUNT; ++i) {
        for (u32 j = 0; j < ARRAYS; ++j) {
            arrays[j] = arena_grow(arena, arrays[j], i, sizeof **arrays);
            assert_non_null(arrays[j]);
            assert_int_equal((uintptr_t)arrays[j] % 16, 0);
            arrays[j][i] = (u64)i * ARRAYS + j;
        }
    }
    for (u32 j = 0; j < ARRAYS; ++j) {
        for (u32 i = 0; i < COUNT; ++i)
            assert_true(arrays[j][i] == (u64)i * ARRAYS + j);
    }
    assert_null(arena_alloc(arena, SIZE_MAX / 2, 4));
    assert_null(arena_resize(arena, arrays[0], COUNT, SIZE_MAX / 4, 8));
    assert_non_null(arena_alloc(arena, 0, 8));
    const char *zeroed = arena_alloc(arena, 1000, 1);
    for (u32 i = 0; i < 1000; ++i)
        assert_int_equal(zeroed[i], 0);
    assert_string_equal(arena_copy_text(arena, "abcdef", 3), "abc");
    arena_destroy(arena);
    arena_destroy(NULL);
}

static void test_paths(void **state)
{
    (void)state;
    Arena *arena = arena_create();
    assert_string_equal(path_beside(arena, "scene.txt", "a.png"), "a.png");
    assert_string_equal(path_beside(arena, "x/y/scene.txt", "a.png"), "x/y/a.png");
    assert_string_equal(path_beside(arena, "/scene.txt", "../a.png"), "/../a.png");
    assert_string_equal(path_beside(arena, "x/scene.txt", "/a.png"), "/a.png");
    assert_string_equal(path_beside(arena, "", "b/a.png"), "b/a.png");
    arena_destroy(arena);
}

static void test_files(void **state)
{
    (void)state;
    Arena *arena = arena_create();
    char path[] = "/tmp/clrt-file-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    FILE *file = fdopen(descriptor, "wb");
    for (u32 i = 0; i < 20000; ++i)
        fputs("0123456789", file);
    fclose(file);
    FileContent content, again;
    Error error;
    assert_true(file_read(path, true, arena, &content, &error));
    assert_true(file_read(path, false, arena, &again, &error));
    assert_int_equal(content.length, 200000);
    assert_int_equal(content.text[199999], '9');
    assert_int_equal(content.text[200000], 0);
    assert_true(content.inode == again.inode && content.device == again.device);
    remove(path);
    assert_false(file_read(path, false, arena, &content, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_string_equal(error.text, "No such file or directory");
    assert_false(file_read("/dev/null", true, arena, &content, &error));
    assert_string_equal(error.text, "not a regular file");
    assert_true(file_read("/dev/null", false, arena, &content, &error));
    assert_int_equal(content.length, 0);
    arena_destroy(arena);
}

// From a pipe, whose length nobody knows before its end.
static void test_standard_input(void **state)
{
    (void)state;
    enum { LENGTH = 50000 };
    static char written[LENGTH];
    for (u32 i = 0; i < LENGTH; ++i)
        written[i] = (char)('a' + i % 23);
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    assert_int_equal(write(ends[1], written, LENGTH), LENGTH); // a pipe holds 64 KiB
    close(ends[1]);
    const int before = dup(STDIN_FILENO);
    assert_true(before >= 0 && dup2(ends[0], STDIN_FILENO) >= 0);
    close(ends[0]);
    Arena *arena = arena_create();
    FileContent content;
    Error error;
    const bool read = file_read("-", false, arena, &content, &error);
    dup2(before, STDIN_FILENO);
    close(before);
    assert_true(read);
    assert_int_equal(content.length, LENGTH);
    assert_memory_equal(content.text, written, LENGTH);
    assert_int_equal(content.text[LENGTH], 0);
    arena_destroy(arena);
}

static void test_no_files(void **state)
{
    (void)state;
    Arena *arena = arena_create();
    FileContent content;
    Error error;
    assert_false(file_read("/", false, arena, &content, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_string_equal(error.text, "Is a directory");
    char path[] = "/tmp/clrt-file-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(ftruncate(descriptor, (off_t)FILE_BYTES_MAX + 1), 0); // a hole: takes no room
    assert_false(file_read(path, true, arena, &content, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_string_equal(error.text, "larger than 1024 MiB");
    close(descriptor);
    remove(path);
    arena_destroy(arena);
}

static void test_whole(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        u32 number;
        const char *rest; // NULL: no number
    } cases[] = {
        {"0", 0, ""},           {"007:1", 7, ":1"},      {"4294967295x", UINT32_MAX, "x"},
        {"4294967296", 0, NULL}, {"99999999999999999999999", 0, NULL},
        {"", 0, NULL},          {"-1", 0, NULL},         {"+1", 0, NULL},
        {" 1", 0, NULL},        {"x", 0, NULL},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        u32 number = 12345;
        const char *rest = text_read_whole(cases[i].text, &number);
        if (!cases[i].rest) {
            assert_null(rest);
            assert_int_equal(number, 12345); // left alone
        } else {
            assert_non_null(rest);
            assert_string_equal(rest, cases[i].rest);
            assert_int_equal(number, cases[i].number);
        }
    }
}

static void test_clock(void **state)
{
    (void)state;
    const f64 start = clock_seconds();
    f64 now = start;
    for (u32 i = 0; i < 1000; ++i) {
        const f64 next = clock_seconds();
        assert_true(next >= now);
        now = next;
    }
    nanosleep(&(struct timespec){.tv_nsec = 20 * 1000 * 1000}, NULL);
    now = clock_seconds() - start;
    assert_true(now >= 0.02 && now < 20);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_utf8),  cmocka_unit_test(test_decimal),
        cmocka_unit_test(test_decimal_agrees_with_libc),
        cmocka_unit_test(test_arena), cmocka_unit_test(test_paths),
        cmocka_unit_test(test_files), cmocka_unit_test(test_standard_input),
        cmocka_unit_test(test_no_files), cmocka_unit_test(test_whole),
        cmocka_unit_test(test_clock),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
