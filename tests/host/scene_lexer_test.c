// Tokens: what they are, where they end, where they stand.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "scene/lexer.h"

static Token first_of(const char *text)
{
    Lexer lexer = lexer_begin(text, strlen(text));
    Token token;
    lexer_next(&lexer, &token);
    return token;
}

static void test_numbers(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        f64 value;
    } numbers[] = {
        {"5", 5}, {"+5", 5}, {"-5", -5}, {"5.", 5}, {"-.5e3", -500}, {"+.5", 0.5}, {"1e-400", 0},
        {"4.0", 4}, {"1E+2", 100}, {"1e-2", 0.01}, {"007", 7}, {"3.4028234663852886e38", 0x1.fffffep127},
        {"0.1", 0.1}, {"123456789012345678901234567890", 1.2345678901234568e29}, {"1e0000000001", 10},
    };
    for (u32 i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        const Token token = first_of(numbers[i].text);
        assert_int_equal(token.kind, TOKEN_NUMBER);
        assert_int_equal(token.fault, FAULT_NONE);
        assert_true(token.number == numbers[i].value);
        assert_int_equal(token.length, strlen(numbers[i].text));
    }
}

static void test_faulty_words(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        TokenKind kind;
        TokenFault fault;
    } words[] = {
        {"5fov", TOKEN_NUMBER, FAULT_NUMBER},     {"1.2.3", TOKEN_NUMBER, FAULT_NUMBER},
        {"0x10", TOKEN_NUMBER, FAULT_NUMBER},     {"1e", TOKEN_NUMBER, FAULT_NUMBER},
        {"1e+", TOKEN_NUMBER, FAULT_NUMBER},      {"-inf", TOKEN_NUMBER, FAULT_NUMBER},
        {"+nan", TOKEN_NUMBER, FAULT_NUMBER},     {"-.", TOKEN_NUMBER, FAULT_NUMBER},
        {"1,", TOKEN_NUMBER, FAULT_NUMBER},       {"1-2", TOKEN_NUMBER, FAULT_NUMBER},
        {"1.0f", TOKEN_NUMBER, FAULT_NUMBER},     {"1e400", TOKEN_NUMBER, FAULT_LARGE},
        {"-3.5e38", TOKEN_NUMBER, FAULT_LARGE},   {"3.4028235e38", TOKEN_NUMBER, FAULT_LARGE},
        {"a-b", TOKEN_NAME, FAULT_NAME},          {"a.b", TOKEN_NAME, FAULT_NAME},
        {"gr\xC3\xBCn", TOKEN_NAME, FAULT_NAME},  {"=", TOKEN_JUNK, FAULT_JUNK},
        {"-", TOKEN_JUNK, FAULT_JUNK},            {".", TOKEN_JUNK, FAULT_JUNK},
        {"\xC3\xBC", TOKEN_JUNK, FAULT_JUNK},     {"\"abc", TOKEN_STRING, FAULT_UNCLOSED},
        {"\"", TOKEN_STRING, FAULT_UNCLOSED},     {"\"a\nb\"", TOKEN_STRING, FAULT_UNCLOSED},
        {"\"a\\\"", TOKEN_STRING, FAULT_UNCLOSED}, {"\"a\\n\"", TOKEN_STRING, FAULT_ESCAPE},
        {"\"a\x01\"", TOKEN_STRING, FAULT_CONTROL},
    };
    for (u32 i = 0; i < sizeof words / sizeof *words; ++i) {
        const Token token = first_of(words[i].text);
        assert_int_equal(token.kind, words[i].kind);
        assert_int_equal(token.fault, words[i].fault);
    }
}

static void test_what_ends_a_word(void **state)
{
    (void)state;
    const char *text = "1#2\n3{4}5\"s\"6 _a9\ta{\"t\"b#";
    static const TokenKind kinds[] = {TOKEN_NUMBER, TOKEN_NUMBER, TOKEN_OPEN,   TOKEN_NUMBER, TOKEN_CLOSE,
                                      TOKEN_NUMBER, TOKEN_STRING, TOKEN_NUMBER, TOKEN_NAME,   TOKEN_NAME,
                                      TOKEN_OPEN,   TOKEN_STRING, TOKEN_NAME,   TOKEN_END,    TOKEN_END};
    Lexer lexer = lexer_begin(text, strlen(text));
    for (u32 i = 0; i < sizeof kinds / sizeof *kinds; ++i) {
        Token token;
        lexer_next(&lexer, &token);
        assert_int_equal(token.kind, kinds[i]);
        assert_int_equal(token.fault, FAULT_NONE);
    }
}

static void test_places(void **state)
{
    (void)state;
    // Columns are characters; a tab is one, a byte-order mark none; CR LF ends a line.
    const char *text =
        "\xEF\xBB\xBF" "a\t\"\xC3\xA4\xE2\x82\xAC\" b\r\n  c # \xC3\xA4\n\n\xC3\xA4 d # \xC3\xA4";
    static const u32 places[][3] = {{1, 1, 1}, {1, 3, 4}, {1, 8, 1}, {2, 3, 1}, {4, 1, 1}, {4, 3, 1},
                                    {4, 8, 0}};
    Lexer lexer = lexer_begin(text, strlen(text));
    for (u32 i = 0; i < sizeof places / sizeof *places; ++i) {
        Token token;
        lexer_next(&lexer, &token);
        assert_int_equal(token.line, places[i][0]);
        assert_int_equal(token.column, places[i][1]);
        assert_int_equal(token.width, places[i][2]);
    }
}

static void test_unescape(void **state)
{
    (void)state;
    char text[20];
    Token token = first_of("\"a\\\"b\\\\c\"");
    assert_int_equal(token_unescape(&token, text), 5);
    assert_string_equal(text, "a\"b\\c");
    token = first_of("\"\"");
    assert_int_equal(token_unescape(&token, text), 0);
    assert_string_equal(text, "");
}

static void test_unclosed_string_leaves_brace(void **state)
{
    (void)state;
    const char *text = "\"wood.png }\nb";
    Lexer lexer = lexer_begin(text, strlen(text));
    Token token;
    lexer_next(&lexer, &token);
    assert_int_equal(token.fault, FAULT_UNCLOSED);
    lexer_next(&lexer, &token);
    assert_int_equal(token.kind, TOKEN_CLOSE);
    lexer_next(&lexer, &token);
    assert_true(token_is(&token, "b"));
    assert_false(token_is(&token, "bc"));
    assert_false(token_is(&token, ""));
    assert_int_equal(token.line, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_numbers),  cmocka_unit_test(test_faulty_words),
        cmocka_unit_test(test_what_ends_a_word), cmocka_unit_test(test_places),
        cmocka_unit_test(test_unescape), cmocka_unit_test(test_unclosed_string_leaves_brace),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
