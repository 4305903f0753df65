// The names of a kernel's arguments from its text, for drivers that do not tell them.
#include <ctype.h>
#include <string.h>

#include "device/conditions.h"
#include "device/internal.h"

typedef struct Text {
    const char *at, *end;
    Conditions *conditions; // NULL: those of the text do not matter
} Text;

static bool is_word(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

static bool starts(const Text *text, const char *with)
{
    const size_t length = strlen(with);
    return (size_t)(text->end - text->at) >= length && memcmp(text->at, with, length) == 0;
}

static void skip_line(Text *text)
{
    while (text->at < text->end && *text->at != '\n')
        text->at += *text->at == '\\' && text->end - text->at > 1 ? 2 : 1;
}

static void take_directive(Text *text)
{
    const char *line = text->at;
    skip_line(text);
    if (text->conditions)
        conditions_take(text->conditions, line, (size_t)(text->at - line));
}

// Moves to the next character that is neither blank, comment, part of a line of the preprocessor nor left out
// by one.
static void skip_blanks(Text *text)
{
    while (text->at < text->end) {
        if (isspace((unsigned char)*text->at)) {
            text->at++;
        } else if (*text->at == '#') {
            take_directive(text);
        } else if (starts(text, "//")) {
            skip_line(text);
        } else if (starts(text, "/*")) {
            text->at += 2;
            while (text->at < text->end && !starts(text, "*/"))
                text->at++;
            text->at = text->end - text->at > 2 ? text->at + 2 : text->end;
        } else if (text->conditions && !conditions_hold(text->conditions)) {
            text->at++;
        } else {
            return;
        }
    }
}

// Reads a word or a single other character; length 0 is the end.
static Text next_token(Text *text)
{
    skip_blanks(text);
    Text token = {text->at, text->at, NULL};
    if (text->at < text->end)
        text->at++;
    if (token.at < text->end && is_word(*token.at))
        while (text->at < text->end && is_word(*text->at))
            text->at++;
    token.end = text->at;
    return token;
}

static bool token_is(const Text *token, const char *word)
{
    const size_t length = strlen(word);
    return (size_t)(token->end - token->at) == length && memcmp(token->at, word, length) == 0;
}

// Moves behind the parenthesis that opens the arguments of the kernel.
static bool find_kernel(Text *text, const char *kernel_name)
{
    bool in_kernel = false; // between `kernel` and the parenthesis of its arguments
    bool named = false;
    for (;;) {
        const Text token = next_token(text);
        if (token.at == token.end)
            return false;
        if (token_is(&token, "kernel") || token_is(&token, "__kernel"))
            in_kernel = true;
        else if (token_is(&token, "__attribute__"))
            continue;
        else if (token_is(&token, "(") && in_kernel && named)
            return true;
        else if (token_is(&token, "{") || token_is(&token, ";"))
            in_kernel = false;
        named = in_kernel && token_is(&token, kernel_name);
    }
}

static void copy_name(char *name, size_t size, const Text *word)
{
    const size_t length = (size_t)(word->end - word->at);
    const size_t kept = length < size ? length : size - 1;
    memcpy(name, word->at, kept);
    name[kept] = '\0';
}

i32 source_argument_names(const char *source, size_t length, const char *options, const char *kernel_name,
                          char *names, size_t name_size, u32 name_max)
{
    Text text = {source, source + length, NULL};
    if (!find_kernel(&text, kernel_name))
        return -1;
    Conditions conditions = {.options = options};
    text.conditions = &conditions;
    u32 count = 0;
    u32 depth = 0;
    Text last = {NULL, NULL, NULL}; // the last word of an argument is its name
    for (;;) {
        const Text token = next_token(&text);
        if (token.at == token.end || conditions.broken)
            return -1;
        const bool closes = token_is(&token, ")");
        if (depth == 0 && (closes || token_is(&token, ","))) {
            if (last.at && !token_is(&last, "void")) {
                if (count < name_max)
                    copy_name(names + count * name_size, name_size, &last);
                count++;
            }
            if (closes)
                return (i32)count;
            last.at = NULL;
        } else if (token_is(&token, "(") || token_is(&token, "[")) {
            depth++;
        } else if (closes || token_is(&token, "]")) {
            depth--;
        } else if (depth == 0 && is_word(*token.at) && !token_is(&token, "__attribute__")) {
            last = token;
        }
    }
}
