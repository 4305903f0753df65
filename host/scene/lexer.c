#include "scene/lexer.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/text.h"

// What a byte is; 0 is everything else that a word may hold.
enum { SPACE = 1, DELIMITER = 2, DIGIT = 4, LETTER = 8, WORD_END = SPACE | DELIMITER };

static const u8 CLASS[256] = {
    [' '] = SPACE, ['\t'] = SPACE, ['\n'] = SPACE, ['\v'] = SPACE, ['\f'] = SPACE, ['\r'] = SPACE,
    ['{'] = DELIMITER, ['}'] = DELIMITER, ['"'] = DELIMITER, ['#'] = DELIMITER,
    ['0'] = DIGIT, ['1'] = DIGIT, ['2'] = DIGIT, ['3'] = DIGIT, ['4'] = DIGIT, ['5'] = DIGIT, ['6'] = DIGIT,
    ['7'] = DIGIT, ['8'] = DIGIT, ['9'] = DIGIT,
    ['A'] = LETTER, ['B'] = LETTER, ['C'] = LETTER, ['D'] = LETTER, ['E'] = LETTER, ['F'] = LETTER,
    ['G'] = LETTER, ['H'] = LETTER, ['I'] = LETTER, ['J'] = LETTER, ['K'] = LETTER, ['L'] = LETTER,
    ['M'] = LETTER, ['N'] = LETTER, ['O'] = LETTER, ['P'] = LETTER, ['Q'] = LETTER, ['R'] = LETTER,
    ['S'] = LETTER, ['T'] = LETTER, ['U'] = LETTER, ['V'] = LETTER, ['W'] = LETTER, ['X'] = LETTER,
    ['Y'] = LETTER, ['Z'] = LETTER, ['a'] = LETTER, ['b'] = LETTER, ['c'] = LETTER, ['d'] = LETTER,
    ['e'] = LETTER, ['f'] = LETTER, ['g'] = LETTER, ['h'] = LETTER, ['i'] = LETTER, ['j'] = LETTER,
    ['k'] = LETTER, ['l'] = LETTER, ['m'] = LETTER, ['n'] = LETTER, ['o'] = LETTER, ['p'] = LETTER,
    ['q'] = LETTER, ['r'] = LETTER, ['s'] = LETTER, ['t'] = LETTER, ['u'] = LETTER, ['v'] = LETTER,
    ['w'] = LETTER, ['x'] = LETTER, ['y'] = LETTER, ['z'] = LETTER, ['_'] = LETTER,
};

static u8 class_of(char c)
{
    return CLASS[(unsigned char)c];
}

static bool is_space(char c)
{
    return class_of(c) & SPACE;
}

static bool is_digit(char c)
{
    return class_of(c) & DIGIT;
}

static bool is_name_start(char c)
{
    return class_of(c) & LETTER;
}

Lexer lexer_begin(const char *text, size_t length)
{
    const size_t mark = length >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0 ? 3 : 0;
    return (Lexer){.cursor = text + mark,
                   .end = text + length,
                   .line_text = text + mark,
                   .origin = text + mark,
                   .line = 1};
}

// Bytes that are not the first of their character take no column.
static void move_origin(Lexer *lexer, const char *text, size_t length)
{
    lexer->origin += length - text_count_characters(text, length);
}

static void skip_comment(Lexer *lexer)
{
    const char *feed = memchr(lexer->cursor, '\n', (size_t)(lexer->end - lexer->cursor));
    const char *stop = feed ? feed : lexer->end;
    if (!feed) // only the end of the file asks for a column behind a comment
        move_origin(lexer, lexer->cursor, (size_t)(stop - lexer->cursor));
    lexer->cursor = stop;
}

static void skip_space(Lexer *lexer)
{
    for (;;) {
        const char *p = lexer->cursor;
        while (is_space(*p)) { // the 0 at the end is none
            if (*p++ == '\n') {
                lexer->line_text = lexer->origin = p;
                ++lexer->line;
            }
        }
        lexer->cursor = p;
        if (*p != '#')
            return;
        skip_comment(lexer);
    }
}

// The string at the cursor. One that does not close on its line is taken to end before the next brace,
// which more probably belongs to a block.
static void read_string(const Lexer *lexer, Token *token)
{
    token->kind = TOKEN_STRING;
    const char *first = lexer->cursor + 1, *p = first;
    for (; p < lexer->end && *p != '"' && *p != '\n'; ++p) {
        const unsigned char c = (unsigned char)*p;
        if (c == '\\') {
            if (p + 1 == lexer->end || (p[1] != '"' && p[1] != '\\'))
                token->fault = FAULT_ESCAPE;
            else
                ++p;
        } else if ((c < 0x20 && c != '\t') || c == 0x7F) {
            token->fault = FAULT_CONTROL;
        }
    }
    if (p < lexer->end && *p == '"') {
        token->length = (u32)(p + 1 - lexer->cursor);
        return;
    }
    token->fault = FAULT_UNCLOSED;
    p = first;
    while (p < lexer->end && *p != '\n' && *p != '\r' && *p != '{' && *p != '}')
        ++p;
    token->length = (u32)(p - lexer->cursor);
}

static void read_number(Token *token)
{
    token->kind = TOKEN_NUMBER;
    if (!text_parse_decimal(token->text, token->length, &token->number))
        token->fault = FAULT_NUMBER;
    else if (fabs(token->number) > (f64)FLT_MAX)
        token->fault = FAULT_LARGE;
}

static void read_name(Token *token)
{
    token->kind = TOKEN_NAME;
    for (u32 i = 0; i < token->length; ++i) {
        if (!(class_of(token->text[i]) & (LETTER | DIGIT)))
            token->fault = FAULT_NAME;
    }
}

// A word is what stands between white space, braces, quotes and comments.
static void read_word(const Lexer *lexer, Token *token)
{
    const char *p = lexer->cursor;
    while (p < lexer->end && !(class_of(*p) & WORD_END))
        ++p;
    token->length = (u32)(p - lexer->cursor);
    const char first = *token->text;
    const bool sign = first == '+' || first == '-';
    const char second = token->length > 1 ? token->text[1] : 0;
    if (is_digit(first) || (first == '.' && is_digit(second)) ||
        (sign && (is_digit(second) || second == '.' || is_name_start(second)))) {
        read_number(token);
    } else if (is_name_start(first)) {
        read_name(token);
    } else {
        token->kind = TOKEN_JUNK;
        token->fault = FAULT_JUNK;
    }
}

// In place, because to return a struct just written piece by piece costs more than to fill it.
void lexer_next(Lexer *lexer, Token *token)
{
    skip_space(lexer);
    token->fault = FAULT_NONE;
    token->text = lexer->cursor;
    token->line_text = lexer->line_text;
    token->line = lexer->line;
    token->column = (u32)(lexer->cursor - lexer->origin) + 1;
    const char c = *lexer->cursor;
    if (lexer->cursor == lexer->end) {
        token->kind = TOKEN_END;
        token->length = 0;
    } else if (c == '{' || c == '}') {
        token->kind = c == '{' ? TOKEN_OPEN : TOKEN_CLOSE;
        token->length = 1;
    } else if (c == '"') {
        read_string(lexer, token);
    } else {
        read_word(lexer, token);
    }
    lexer->cursor += token->length;
    token->width = token->length;
    if (token->kind == TOKEN_STRING || token->fault != FAULT_NONE) { // else it is ASCII
        move_origin(lexer, token->text, token->length);
        token->width = (u32)text_count_characters(token->text, token->length);
    }
}

bool token_is(const Token *token, const char *name)
{
    return token->kind == TOKEN_NAME && token->text[0] == name[0] &&
           strncmp(token->text, name, token->length) == 0 && name[token->length] == 0;
}

size_t token_unescape(const Token *token, char *text)
{
    size_t length = 0;
    for (u32 i = 1; i + 1 < token->length; ++i) {
        if (token->text[i] == '\\')
            ++i;
        text[length++] = token->text[i];
    }
    text[length] = 0;
    return length;
}
