// What the tests of the parser share: text in, scene and messages out.
#ifndef CLRT_TESTS_SCENE_PARSE_FIXTURE_H
#define CLRT_TESTS_SCENE_PARSE_FIXTURE_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "scene/parse.h"

typedef struct Parsed {
    Arena *arena;
    Diagnostics *diagnostics;
    Scene *scene;
    Error error;
    char *messages; // as diagnostics_print prints them
} Parsed;

static inline char *printed(const Diagnostics *diagnostics)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    diagnostics_print(diagnostics, stream);
    fclose(stream);
    char *copy = strdup(text);
    assert_non_null(copy);
    free(text);
    return copy;
}

static inline Parsed parsed_begin(void)
{
    Parsed parsed = {.arena = arena_create(), .diagnostics = diagnostics_create()};
    assert_non_null(parsed.arena);
    assert_non_null(parsed.diagnostics);
    return parsed;
}

static inline Parsed parse_bytes(const char *text, size_t length)
{
    Parsed parsed = parsed_begin();
    // Exactly length bytes, so that a read behind them is seen.
    char *exact = malloc(length ? length : 1);
    memcpy(exact, text, length);
    parsed.scene = scene_parse_text("t", exact, length, parsed.arena, parsed.diagnostics, &parsed.error);
    free(exact);
    parsed.messages = printed(parsed.diagnostics);
    return parsed;
}

static inline Parsed parse_file(const char *path)
{
    Parsed parsed = parsed_begin();
    parsed.scene = scene_parse_file(path, parsed.arena, parsed.diagnostics, &parsed.error);
    parsed.messages = printed(parsed.diagnostics);
    return parsed;
}

// The scene of a text without errors.
static inline Parsed parse_good(const char *text)
{
    Parsed parsed = parse_bytes(text, strlen(text));
    assert_non_null(parsed.scene);
    assert_string_equal(parsed.messages, "");
    return parsed;
}

static inline void parsed_end(Parsed *parsed)
{
    free(parsed->messages);
    diagnostics_destroy(parsed->diagnostics);
    arena_destroy(parsed->arena);
}

// Cuts the first line off *rest; NULL where there is none.
static inline char *next_line(char **rest)
{
    char *line = *rest;
    char *feed = line ? strchr(line, '\n') : NULL;
    if (!feed)
        return NULL;
    *feed = 0;
    *rest = feed + 1;
    return line;
}

// Asserts that the text has exactly these errors: lines "LINE:COLUMN: message", in order, each without
// the line of text and the caret.
static inline void expect_errors(const char *text, const char *const *expected, u32 count)
{
    Parsed parsed = parse_bytes(text, strlen(text));
    char *rest = parsed.messages;
    for (u32 i = 0; i < count; ++i) {
        char *line = next_line(&rest);
        assert_non_null(line);
        assert_memory_equal(line, "t:", 2);
        char *error = strstr(line, ": error: ");
        assert_non_null(error);
        char found[600];
        snprintf(found, sizeof found, "%.*s: %s", (int)(error - line - 2), line + 2,
                 error + strlen(": error: "));
        assert_string_equal(found, expected[i]);
        for (u32 j = 0; j < 2; ++j) { // the text and the caret
            line = next_line(&rest);
            assert_non_null(line);
            assert_memory_equal(line, "    ", 4);
        }
    }
    if (rest && *rest)
        fail_msg("more messages than expected: %s", rest);
    assert_int_equal(diagnostics_error_count(parsed.diagnostics), count);
    parsed_end(&parsed);
}

static inline void expect_error(const char *text, const char *expected)
{
    expect_errors(text, &expected, 1);
}

static inline void assert_vec(Vec3 found, f64 x, f64 y, f64 z)
{
    assert_true(found.x == x && found.y == y && found.z == z);
}

static inline void assert_near(f64 found, f64 expected, f64 tolerance)
{
    if (!(found >= expected - tolerance && found <= expected + tolerance))
        fail_msg("%.17g is not within %g of %.17g", found, tolerance, expected);
}

static inline void assert_vec_near(Vec3 found, Vec3 expected, f64 tolerance)
{
    assert_near(found.x, expected.x, tolerance);
    assert_near(found.y, expected.y, tolerance);
    assert_near(found.z, expected.z, tolerance);
}

#endif
