#include "scene/diagnostics.h"

#include <stdlib.h>
#include <string.h>

#include "base/arena.h"
#include "base/text.h"

enum {
    LINE_CHARACTERS_MAX = 160,
    LINE_BYTES_MAX = 4 * LINE_CHARACTERS_MAX,
    CONTEXT_CHARACTERS = 100, // before the spot, where a line is cut
    MESSAGE_BYTES = 512
};

typedef struct Message {
    Severity severity;
    const char *file_name;
    u32 line, column, length;
    u32 shown_column; // of the spot in shown, from 1
    const char *shown; // the source line or a part of it; NULL: none
    char text[MESSAGE_BYTES];
} Message;

struct Diagnostics {
    Arena *arena;
    Message messages[DIAGNOSTICS_SHOWN_MAX];
    u32 kept;
    u32 kept_warnings;
    u32 errors, warnings;
};

Diagnostics *diagnostics_create(void)
{
    Diagnostics *diagnostics = calloc(1, sizeof *diagnostics);
    if (!diagnostics)
        return NULL;
    diagnostics->arena = arena_create();
    if (!diagnostics->arena) {
        free(diagnostics);
        return NULL;
    }
    return diagnostics;
}

void diagnostics_destroy(Diagnostics *diagnostics)
{
    if (!diagnostics)
        return;
    arena_destroy(diagnostics->arena);
    free(diagnostics);
}

static bool is_inner_byte(char c)
{
    return ((unsigned char)c & 0xC0) == 0x80;
}

// The next character at or before end; a stray inner byte counts with the character before it.
static const char *next_character(const char *p, const char *end)
{
    if (p < end)
        ++p;
    while (p < end && is_inner_byte(*p))
        ++p;
    return p;
}

// Copies the part of the line about column into arena. Sets the column of the spot in that part.
static const char *copy_line(Arena *arena, const char *line, u32 column, u32 *shown_column)
{
    const char *end = line + strcspn(line, "\n");
    if (end > line && end[-1] == '\r')
        --end;
    const char *first = line;
    u32 skipped = 0;
    for (; skipped + CONTEXT_CHARACTERS < column && first < end; ++skipped)
        first = next_character(first, end);
    const char *last = first;
    for (u32 i = 0; i < LINE_CHARACTERS_MAX && last < end; ++i)
        last = next_character(last, end);
    if (last == end) { // the rest fits: show as much as possible of what is before it
        first = line;
        skipped = 0;
        u32 characters = 0;
        for (const char *p = line; p < end; p = next_character(p, end))
            ++characters;
        for (; characters - skipped > LINE_CHARACTERS_MAX; ++skipped)
            first = next_character(first, end);
    }
    if (last - first > LINE_BYTES_MAX)
        last = first + LINE_BYTES_MAX; // only where it is no UTF-8
    *shown_column = column - skipped;
    return arena_copy_text(arena, first, (size_t)(last - first));
}

// Makes room for an error by giving up the last warning. Returns false where there is none.
static bool drop_warning(Diagnostics *diagnostics)
{
    for (u32 i = diagnostics->kept; i-- > 0;) {
        Message *message = &diagnostics->messages[i];
        if (message->severity == SEVERITY_WARNING) {
            memmove(message, message + 1, (diagnostics->kept - i - 1) * sizeof *message);
            --diagnostics->kept;
            --diagnostics->kept_warnings;
            return true;
        }
    }
    return false;
}

// Messages of one file are kept in the order of its text, whenever they were found.
static Message *insert_slot(Diagnostics *diagnostics, const char *file_name, u32 line, u32 column)
{
    u32 at = diagnostics->kept;
    for (; at > 0; --at) {
        const Message *before = &diagnostics->messages[at - 1];
        if (strcmp(before->file_name, file_name) != 0 || before->line < line ||
            (before->line == line && before->column <= column))
            break;
    }
    Message *slot = &diagnostics->messages[at];
    memmove(slot + 1, slot, (diagnostics->kept - at) * sizeof *slot);
    ++diagnostics->kept;
    return slot;
}

void diagnostics_add_list(Diagnostics *diagnostics, Severity severity, const char *file_name, u32 line,
                          u32 column, u32 length, const char *source_line, const char *format,
                          va_list arguments)
{
    const bool error = severity == SEVERITY_ERROR;
    error ? ++diagnostics->errors : ++diagnostics->warnings;
    if (diagnostics->kept == DIAGNOSTICS_SHOWN_MAX && !(error && drop_warning(diagnostics)))
        return;
    const char *name = arena_copy_text(diagnostics->arena, file_name, strlen(file_name));
    if (!name)
        return; // it is counted all the same
    Message *message = insert_slot(diagnostics, name, line, column);
    *message = (Message){
        .severity = severity, .file_name = name, .line = line, .column = column, .length = length};
    diagnostics->kept_warnings += !error;
    vsnprintf(message->text, sizeof message->text, format, arguments);
    if (source_line && line > 0 && column > 0)
        message->shown = copy_line(diagnostics->arena, source_line, column, &message->shown_column);
}

void diagnostics_add(Diagnostics *diagnostics, Severity severity, const char *file_name, u32 line,
                     u32 column, u32 length, const char *source_line, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    diagnostics_add_list(diagnostics, severity, file_name, line, column, length, source_line, format,
                         arguments);
    va_end(arguments);
}

bool diagnostics_full(const Diagnostics *diagnostics)
{
    return diagnostics->kept == DIAGNOSTICS_SHOWN_MAX && diagnostics->kept_warnings == 0;
}

u32 diagnostics_error_count(const Diagnostics *diagnostics)
{
    return diagnostics->errors;
}

u32 diagnostics_warning_count(const Diagnostics *diagnostics)
{
    return diagnostics->warnings;
}

static void print_clean(const char *text, FILE *stream)
{
    const char *end = text + strlen(text);
    const char *invalid = text + text_find_invalid_utf8(text, (size_t)(end - text));
    for (const char *p = text; p < end; ++p) {
        const unsigned char c = (unsigned char)*p;
        if (p == invalid) {
            fputc('?', stream);
            invalid = p + 1 + text_find_invalid_utf8(p + 1, (size_t)(end - p - 1));
        } else if (c == 0xC2 && (unsigned char)p[1] < 0xA0) { // U+0080 to U+009F
            fputc('?', stream);
            ++p;
        } else {
            fputc((c < 0x20 && c != '\t') || c == 0x7F ? '?' : c, stream);
        }
    }
}

// The spot, under the line; tabs are repeated so that the caret stands where the terminal puts it.
static void print_caret(const Message *message, FILE *stream)
{
    const char *p = message->shown, *end = p + strlen(p);
    for (u32 i = 1; i < message->shown_column; ++i) {
        fputc(p < end && *p == '\t' ? '\t' : ' ', stream);
        p = next_character(p, end);
    }
    fputc('^', stream);
    p = next_character(p, end);
    for (u32 i = 1; i < message->length && p < end; ++i, p = next_character(p, end))
        fputc('~', stream);
}

void diagnostics_print(const Diagnostics *diagnostics, FILE *stream)
{
    for (u32 i = 0; i < diagnostics->kept; ++i) {
        const Message *message = &diagnostics->messages[i];
        print_clean(message->file_name, stream);
        if (message->line > 0)
            fprintf(stream, ":%u:%u", message->line, message->column);
        fputs(message->severity == SEVERITY_ERROR ? ": error: " : ": warning: ", stream);
        print_clean(message->text, stream);
        fputc('\n', stream);
        if (message->shown) {
            fputs("    ", stream);
            print_clean(message->shown, stream);
            fputs("\n    ", stream);
            print_caret(message, stream);
            fputc('\n', stream);
        }
    }
    const u32 total = diagnostics->errors + diagnostics->warnings;
    if (total > diagnostics->kept)
        fprintf(stream, "%u more not shown\n", total - diagnostics->kept);
}
