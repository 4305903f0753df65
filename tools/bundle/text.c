#include "bundle/text.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

char *text_read(const char *path)
{
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    size_t size = 0, room = 0, got = 0;
    char *text = NULL;
    do {
        size += got;
        room = room ? 2 * room : 16384;
        char *grown = realloc(text, room);
        if (!grown) {
            free(text);
            fclose(file);
            errno = ENOMEM;
            return NULL;
        }
        text = grown;
        got = fread(text + size, 1, room - size - 1, file);
    } while (got == room - size - 1);
    text[size + got] = '\0';
    const int failed = ferror(file) ? errno : 0; // a folder opens, but cannot be read
    fclose(file);
    if (failed) {
        free(text);
        errno = failed;
        return NULL;
    }
    return text;
}

bool directive_read(Directive *directive, const char *line, size_t length)
{
    const char *end = line + length;
    while (line < end && strchr(" \t", *line))
        line++;
    if (line == end || *line++ != '#')
        return false;
    while (line < end && strchr(" \t", *line))
        line++;
    size_t used = 0;
    for (; line < end && *line >= 'a' && *line <= 'z' && used + 1 < sizeof directive->name; line++)
        directive->name[used++] = *line;
    directive->name[used] = '\0';
    while (line < end && strchr(" \t", *line))
        line++;
    while (end > line && strchr(" \t\r", end[-1]))
        end--;
    size_t rest = (size_t)(end - line);
    if (rest >= sizeof directive->rest)
        rest = sizeof directive->rest - 1;
    memcpy(directive->rest, line, rest);
    directive->rest[rest] = '\0';
    return true;
}

bool directive_is(const Directive *directive, const char *name)
{
    return strcmp(directive->name, name) == 0;
}

bool directive_include_path(const Directive *directive, char *path, size_t size)
{
    if (directive->rest[0] != '"')
        return false;
    const size_t length = strcspn(directive->rest + 1, "\"");
    if (directive->rest[1 + length] != '"' || length == 0 || length >= size)
        return false;
    memcpy(path, directive->rest + 1, length);
    path[length] = '\0';
    return true;
}

bool text_is_guarded(const char *text)
{
    char guard[512] = "";
    for (const char *at = text; *at; at += strcspn(at, "\n")) {
        at += *at == '\n';
        Directive directive;
        if (!directive_read(&directive, at, strcspn(at, "\n")))
            continue;
        if (guard[0])
            return directive_is(&directive, "define") && strcmp(directive.rest, guard) == 0;
        if (!directive_is(&directive, "ifndef"))
            return false;
        strcpy(guard, directive.rest);
    }
    return false;
}

void text_write_c(const char *text, const char *symbol, FILE *out)
{
    fprintf(out, "#include <stddef.h>\n\nextern const char %s[];\nextern const size_t %s_size;\n\n", symbol,
            symbol);
    fprintf(out, "const size_t %s_size = %zu;\nconst char %s[] =\n\"", symbol, strlen(text), symbol);
    for (const char *at = text; *at; at++) {
        const unsigned char c = (unsigned char)*at;
        if (c == '\n')
            fputs(at[1] ? "\\n\"\n\"" : "\\n", out);
        else if (c == '"' || c == '\\' || c == '?') // ? would begin a trigraph
            fprintf(out, "\\%c", c);
        else if (c < 32 || c > 126)
            fprintf(out, "\\%03o", c);
        else
            fputc(c, out);
    }
    fputs("\";\n", out);
}
