#include "lines.h"

#include <stdlib.h>
#include <string.h>

bool lines_open(Lines *lines, Store *store, const char *path)
{
    size_t size;
    *lines = (Lines){.store = store, .path = path, .at = store_file(store, path, &size)};
    return lines->at != NULL;
}

/* Ends the line in hand with a zero byte, comment and continuations blanked out; returns what follows. */
static char *cut_line(Lines *lines)
{
    bool comment = false;
    lines->line++;
    for (char *c = lines->at;; c++) {
        char *next = c[0] == '\\' && c[1] == '\r' ? c + 2 : c + 1;
        if (*c == '\0')
            return c;
        if (*c == '\\' && *next == '\n') {
            memset(c, ' ', (size_t)(next - c) + 1);
            lines->line++;
        } else if (*c == '\n') {
            *c = '\0';
            return c + 1;
        }
        comment |= *c == '#';
        if (comment)
            *c = ' ';
    }
}

static void cut_words(Lines *lines)
{
    lines->count = 0;
    lines->words = NULL;
    for (char *word = strtok(lines->at, " \t\r\v\f"); word != NULL; word = strtok(NULL, " \t\r\v\f")) {
        lines->words = store_grow(lines->store, lines->words, lines->count, sizeof *lines->words);
        lines->words[lines->count++] = word;
    }
}

bool lines_next(Lines *lines)
{
    while (*lines->at != '\0') {
        char *next = cut_line(lines);
        cut_words(lines);
        lines->at = next;
        if (lines->count > 0)
            return true;
    }
    return false;
}

char *lines_rest(const Lines *lines)
{
    size_t length = 0;
    for (size_t i = 1; i < lines->count; i++)
        length += strlen(lines->words[i]) + 1;
    char *text = store_alloc(lines->store, length + 1);
    for (size_t i = 1; i < lines->count; i++) {
        if (i > 1)
            strcat(text, " ");
        strcat(text, lines->words[i]);
    }
    return text;
}

bool lines_has_number(const Lines *lines, size_t word)
{
    if (word >= lines->count)
        return false;
    char *end;
    strtod(lines->words[word], &end);
    return *end == '\0' && end != lines->words[word];
}

double lines_number(const Lines *lines, size_t word)
{
    if (!lines_has_number(lines, word))
        die("%s:%d: a number expected", lines->path, lines->line);
    return strtod(lines->words[word], NULL);
}
