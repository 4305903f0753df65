#include "scene/parser.h"

#include <stdio.h>
#include <string.h>

#include "scene/statement.h"

SourcePos parser_position(const Parser *parser, const Token *token)
{
    return (SourcePos){parser->input->file, token->line, token->column};
}

static void add_error(Parser *parser, const Token *at, const char *format, va_list arguments)
{
    diagnostics_add_list(parser->diagnostics, SEVERITY_ERROR, parser->scene->files[parser->input->file],
                         at->line, at->column, at->width, at->line_text, format, arguments);
}

void parser_error(Parser *parser, const Token *at, const char *format, ...)
{
    if (at->fault != FAULT_NONE)
        return;
    va_list arguments;
    va_start(arguments, format);
    add_error(parser, at, format, arguments);
    va_end(arguments);
}

const char *parser_show(const Token *token, char shown[TOKEN_SHOWN_MAX])
{
    enum { BYTES_MAX = TOKEN_SHOWN_MAX - 8 };
    if (token->kind == TOKEN_END)
        return strcpy(shown, "the end of the file");
    const bool whole = token->length <= BYTES_MAX;
    u32 length = whole ? token->length : BYTES_MAX;
    while (!whole && length > 0 && ((unsigned char)token->text[length] & 0xC0) == 0x80)
        --length; // not within a character
    const char *quote = token->kind == TOKEN_STRING ? "" : "'";
    snprintf(shown, TOKEN_SHOWN_MAX, "%s%.*s%s%s", quote, (int)length, token->text, whole ? "" : "...",
             quote);
    return shown;
}

const char *parser_show_place(const Parser *parser, SourcePos place, char shown[PLACE_SHOWN_MAX])
{
    if (place.file == parser->input->file)
        snprintf(shown, PLACE_SHOWN_MAX, "line %u", place.line);
    else
        snprintf(shown, PLACE_SHOWN_MAX, "%s:%u", parser->scene->files[place.file], place.line);
    return shown;
}

static void report_fault(Parser *parser, const Token *token)
{
    static const char *const messages[] = {
        [FAULT_NUMBER] = "%s is not a number",
        [FAULT_LARGE] = "number %s is too large",
        [FAULT_NAME] = "%s is not a name; names have letters, digits and '_'",
        [FAULT_JUNK] = "unexpected %s",
        [FAULT_UNCLOSED] = "string %s does not end on its line",
        [FAULT_ESCAPE] = "string %s has a '\\' that is not before '\"' or another '\\'",
        [FAULT_CONTROL] = "string %s has a control character",
    };
    char shown[TOKEN_SHOWN_MAX];
    Token place = *token;
    place.fault = FAULT_NONE;
    parser_error(parser, &place, messages[token->fault], parser_show(token, shown));
}

void parser_advance(Parser *parser)
{
    do {
        lexer_next(&parser->input->lexer, &parser->token);
        if (parser->token.fault != FAULT_NONE)
            report_fault(parser, &parser->token);
    } while (parser->token.kind == TOKEN_JUNK);
}

void *parser_alloc(Parser *parser, size_t count, size_t size)
{
    void *memory = arena_alloc(parser->arena, count, size);
    parser->out_of_memory |= !memory;
    return memory;
}

char *parser_copy_name(Parser *parser, const Token *token)
{
    char *copy = arena_copy_text(parser->arena, token->text, token->length);
    parser->out_of_memory |= !copy;
    return copy;
}

void *parser_grow(Parser *parser, void *array, u32 count, size_t size)
{
    void *grown = arena_grow(parser->arena, array, count, size);
    parser->out_of_memory |= !grown;
    return grown;
}

bool parser_define(Parser *parser, Names *names, const char *what, const char **copy)
{
    char shown[TOKEN_SHOWN_MAX];
    const Token name = parser->token;
    if (name.kind != TOKEN_NAME) {
        parser_error(parser, &name, "expected the name of the %s, found %s", what, parser_show(&name, shown));
        return false;
    }
    parser_advance(parser);
    *copy = NULL;
    if (names_find(names, name.text, name.length) >= 0) {
        parser_error(parser, &name, "%s %s is defined already", what, parser_show(&name, shown));
        return true;
    }
    *copy = parser_copy_name(parser, &name);
    if (!*copy || !names_add(names, parser->arena, *copy, name.length))
        parser->out_of_memory = true;
    return !parser->out_of_memory;
}

i32 parser_find_word(const Token *token, const char *const *words)
{
    for (i32 i = 0; words[i]; ++i) {
        if (token_is(token, words[i]))
            return i;
    }
    return -1;
}

bool parser_read_word(Parser *parser, const char *const *words, const char *what, u32 *index)
{
    const Token word = parser->token;
    char shown[TOKEN_SHOWN_MAX], hint[SUGGEST_TEXT_MAX];
    parser_show(&word, shown);
    if (word.kind != TOKEN_NAME) {
        parser_error(parser, &word, "expected the %s, found %s", what, shown);
        return false;
    }
    parser_advance(parser);
    const i32 found = parser_find_word(&word, words);
    if (found < 0) {
        Suggestion suggestion = suggest_begin(word.text, word.length);
        for (u32 i = 0; words[i]; ++i)
            suggest_offer(&suggestion, words[i], strlen(words[i]));
        parser_error(parser, &word, "unknown %s %s%s", what, shown, suggest_text(&suggestion, hint));
        return false;
    }
    *index = (u32)found;
    return true;
}

bool parser_find_defined(Parser *parser, const Names *names, const char *what, i32 *index)
{
    const Token name = parser->token;
    parser_advance(parser);
    const i32 found = names_find(names, name.text, name.length);
    if (found >= 0) {
        *index = found;
        return true;
    }
    char shown[TOKEN_SHOWN_MAX], hint[SUGGEST_TEXT_MAX];
    Suggestion suggestion = suggest_begin(name.text, name.length);
    if (!diagnostics_full(parser->diagnostics))
        names_suggest(names, &suggestion);
    if (name.fault == FAULT_NONE)
        parser_error(parser, &name, "%s %s is not defined%s", what, parser_show(&name, shown),
                     suggest_text(&suggestion, hint));
    return false;
}

bool parser_expect_open(Parser *parser)
{
    const Token open = parser->token;
    if (open.kind == TOKEN_OPEN) {
        parser_advance(parser);
        return true;
    }
    char shown[TOKEN_SHOWN_MAX];
    parser_error(parser, &open, "expected '{', found %s", parser_show(&open, shown));
    return false;
}

void parser_skip_braces(Parser *parser)
{
    u32 depth = 0;
    do {
        depth += parser->token.kind == TOKEN_OPEN;
        depth -= parser->token.kind == TOKEN_CLOSE;
        parser_advance(parser);
    } while (depth > 0 && parser->token.kind != TOKEN_END);
}

void parser_skip_values(Parser *parser)
{
    while (parser->token.kind == TOKEN_NUMBER || parser->token.kind == TOKEN_STRING ||
           parser->token.kind == TOKEN_OPEN) {
        if (parser->token.kind == TOKEN_OPEN)
            parser_skip_braces(parser);
        else
            parser_advance(parser);
    }
}

void parser_skip_statement(Parser *parser)
{
    while (parser->token.kind != TOKEN_END && parser->token.kind != TOKEN_CLOSE &&
           !statement_begins(parser)) {
        if (parser->token.kind == TOKEN_OPEN) {
            parser_skip_braces(parser);
            return;
        }
        parser_advance(parser);
    }
}
