#include "assets/obj_text.h"

#include <ctype.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"

enum { SHOWN_BYTES_AFTER = 4096, QUOTED_BYTES_MAX = 60 };

ObjText obj_text_begin(const char *text, size_t length)
{
    return (ObjText){ .cursor = text, .end = text + length, .line_text = text, .line = 1 };
}

static bool is_blank(char c)
{
    return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// Bytes of the end of a line at p, 0 where there is none. p may be the end of the text, which is a 0.
static size_t line_end_bytes(const char *p)
{
    return *p == '\n' ? 1 : *p == '\r' ? (p[1] == '\n' ? 2 : 1) : 0;
}

static bool at_continuation(const ObjText *text, const char *p)
{
    return *p == '\\' && (line_end_bytes(p + 1) > 0 || p + 1 == text->end);
}

static bool at_statement_end(const ObjText *text, const char *p)
{
    return p == text->end || line_end_bytes(p) > 0;
}

// Goes over the end of a line, of which the cursor is at the first byte.
static void next_line(ObjText *text)
{
    text->cursor += line_end_bytes(text->cursor);
    text->line_text = text->cursor;
    ++text->line;
}

static void skip_blanks(ObjText *text)
{
    for (;;) {
        if (is_blank(*text->cursor)) {
            ++text->cursor;
        } else if (at_continuation(text, text->cursor)) {
            ++text->cursor;
            if (text->cursor < text->end)
                next_line(text);
        } else {
            return;
        }
    }
}

bool obj_text_word(ObjText *text, ObjWord *word)
{
    skip_blanks(text);
    const char *p = text->cursor;
    *word = (ObjWord){ .text = p, .line_text = text->line_text, .line = text->line };
    while (!is_blank(*p) && *p != '#' && !at_statement_end(text, p) && !at_continuation(text, p))
        ++p;
    word->length = (size_t)(p - text->cursor);
    text->cursor = p;
    return word->length > 0;
}

void obj_text_next_statement(ObjText *text)
{
    const char *p = text->cursor, *end = text->end;
    for (;; ++p) {
        while (p < end && *p != '\n' && *p != '\r' && *p != '#' && *p != '\\')
            ++p;
        if (p == end || *p != '\\')
            break;
        if (p + 1 < end && at_continuation(text, p)) {
            text->cursor = p + 1;
            next_line(text);
            p = text->cursor - 1;
        }
    }
    while (p < end && *p != '\n' && *p != '\r') // a comment is not continued
        ++p;
    text->cursor = p;
    if (p < end)
        next_line(text);
}

size_t obj_text_rest_bound(const ObjText *text)
{
    const char *p = text->cursor;
    while (!at_statement_end(text, p)) {
        const bool continued = at_continuation(text, p);
        ++p;
        if (continued)
            p += line_end_bytes(p);
    }
    return (size_t)(p - text->cursor) + 1;
}

size_t obj_text_rest(ObjText *text, char *to, ObjWord *place)
{
    skip_blanks(text);
    *place = (ObjWord){ .text = text->cursor, .line_text = text->line_text, .line = text->line };
    size_t length = 0;
    while (!at_statement_end(text, text->cursor)) {
        if (at_continuation(text, text->cursor)) {
            skip_blanks(text);
            to[length++] = ' ';
        } else {
            to[length++] = *text->cursor++;
        }
        if (text->line == place->line)
            place->length = (size_t)(text->cursor - place->text);
    }
    while (length > 0 && is_blank(to[length - 1]))
        --length;
    to[length] = 0;
    while (place->length > 0 && is_blank(place->text[place->length - 1]))
        --place->length;
    return length;
}

bool obj_word_is(const ObjWord *word, const char *name)
{
    for (size_t i = 0; i < word->length; ++i) {
        if (name[i] != word->text[i] || name[i] == 0)
            return false;
    }
    return name[word->length] == 0;
}

bool obj_text_number(ObjText *text, const ObjWord *word, f64 *value)
{
    const int shown = word->length < QUOTED_BYTES_MAX ? (int)word->length : QUOTED_BYTES_MAX;
    if (!text_parse_decimal(word->text, word->length, value)) {
        obj_text_report(text, SEVERITY_ERROR, word, "'%.*s' is not a number", shown, word->text);
        return false;
    }
    if (fabs(*value) > (f64)FLT_MAX) {
        obj_text_report(text, SEVERITY_ERROR, word, "%.*s is above %g", shown, word->text, (f64)FLT_MAX);
        return false;
    }
    return true;
}

// The line of the word, far enough for what is shown of it; to be freed. NULL where memory is exhausted.
static char *copy_line(const ObjText *text, const ObjWord *word)
{
    const char *p = word->text;
    while (p < text->end && p - word->text < SHOWN_BYTES_AFTER && line_end_bytes(p) == 0)
        ++p;
    const size_t length = (size_t)(p - word->line_text);
    char *copy = malloc(length + 1);
    if (copy) {
        for (size_t i = 0; i < length; ++i)
            copy[i] = (char)(word->line_text[i] ? word->line_text[i] : ' ');
        copy[length] = 0;
    }
    return copy;
}

void obj_text_report(ObjText *text, Severity severity, const ObjWord *word, const char *format, ...)
{
    *(severity == SEVERITY_ERROR ? &text->errors : &text->warnings) = true;
    if (!text->diagnostics)
        return;
    char *line = NULL;
    u32 column = 1, width = 1;
    if (!diagnostics_full(text->diagnostics)) {
        line = copy_line(text, word);
        const size_t before = text_count_characters(word->line_text, (size_t)(word->text - word->line_text));
        const size_t characters = text_count_characters(word->text, word->length);
        column = before < UINT32_MAX ? (u32)before + 1 : UINT32_MAX;
        width = characters < UINT32_MAX ? (u32)characters : UINT32_MAX;
    }
    va_list arguments;
    va_start(arguments, format);
    diagnostics_add_list(text->diagnostics, severity, text->file_name,
                         text->line < UINT32_MAX ? (u32)word->line : UINT32_MAX, column, width, line, format,
                         arguments);
    va_end(arguments);
    free(line);
}

bool obj_words_add(ObjWords *words, const char *text, size_t length)
{
    char word[OBJ_WORD_BYTES] = { 0 };
    memcpy(word, text, length < sizeof word ? length : sizeof word - 1);
    for (u32 i = 0; i < words->count; ++i) {
        if (memcmp(words->words[i], word, sizeof word) == 0)
            return false;
    }
    if (words->count == OBJ_WORDS_MAX)
        return false;
    memcpy(words->words[words->count++], word, sizeof word);
    return true;
}
