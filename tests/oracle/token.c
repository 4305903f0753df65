#include "token.h"

#include <ctype.h>
#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

typedef struct Reader {
    Store *store;
    const char *path;
    const char *at;
    const char *end;
    int line;
} Reader;

static bool ends_word(const Reader *reader)
{
    return reader->at == reader->end || strchr(" \t\r\n\v\f{}\"#", *reader->at) != NULL;
}

static void skip_space(Reader *reader)
{
    while (reader->at < reader->end) {
        if (*reader->at == '#') {
            while (reader->at < reader->end && *reader->at != '\n')
                reader->at++;
        } else if (isspace((unsigned char)*reader->at)) {
            reader->line += *reader->at == '\n';
            reader->at++;
        } else {
            return;
        }
    }
}

static void read_string(Reader *reader, Token *token)
{
    token->kind = TOKEN_STRING;
    char *text = store_alloc(reader->store, (size_t)(reader->end - reader->at));
    size_t length = 0;
    for (reader->at++; reader->at < reader->end && *reader->at != '"'; reader->at++) {
        if (*reader->at == '\n')
            break;
        if (*reader->at == '\\' && reader->at + 1 < reader->end)
            reader->at++;
        text[length++] = *reader->at;
    }
    if (reader->at == reader->end || *reader->at != '"')
        die("%s:%d: a string that does not end", reader->path, reader->line);
    reader->at++;
    token->text = text;
}

static void read_word(Reader *reader, Token *token)
{
    const char *start = reader->at;
    while (!ends_word(reader))
        reader->at++;
    token->text = store_text(reader->store, start, (size_t)(reader->at - start));
    if (isalpha((unsigned char)*start) || *start == '_') {
        token->kind = TOKEN_NAME;
        return;
    }
    char *rest;
    token->kind = TOKEN_NUMBER;
    token->number = strtod(token->text, &rest);
    if (*rest != '\0')
        die("%s:%d: `%s` is not a number", reader->path, reader->line, token->text);
    token->text = NULL;
}

static void read_token(Reader *reader, Token *token)
{
    skip_space(reader);
    *token = (Token){TOKEN_END, 0, NULL, reader->line};
    if (reader->at == reader->end)
        return;
    if (*reader->at == '"') {
        read_string(reader, token);
    } else if (*reader->at == '{' || *reader->at == '}') {
        token->kind = *reader->at == '{' ? TOKEN_OPEN : TOKEN_CLOSE;
        reader->at++;
    } else {
        read_word(reader, token);
    }
}

Token *tokens_from_text(Store *store, const char *path, const char *text, size_t size)
{
    Reader reader = {store, path, text, text + size, 1};
    if (size >= 3 && memcmp(text, "\xEF\xBB\xBF", 3) == 0)
        reader.at += 3;
    Token *tokens = NULL;
    size_t count = 0;
    do {
        tokens = store_grow(store, tokens, count, sizeof *tokens);
        read_token(&reader, &tokens[count]);
    } while (tokens[count++].kind != TOKEN_END);
    return tokens;
}

Token *tokens_read(Store *store, const char *path)
{
    size_t size;
    char *text = store_file(store, path, &size);
    if (text == NULL)
        die("%s: %s", path, strerror(errno));
    return tokens_from_text(store, path, text, size);
}
