#include "scene/report.h"

#include <string.h>

// The place in the text; *line_text becomes the beginning of its line.
static const char *find_place(const char *text, SourcePos at, const char **line_text)
{
    for (u32 line = 1; line < at.line; ++line) {
        const char *feed = strchr(text, '\n');
        if (!feed)
            break;
        text = feed + 1;
    }
    *line_text = text;
    for (u32 column = 1; column < at.column && *text && *text != '\n'; ++column) {
        do {
            ++text;
        } while (((unsigned char)*text & 0xC0) == 0x80);
    }
    return text;
}

void scene_report(const Scene *scene, Diagnostics *diagnostics, Severity severity, SourcePos at,
                  const char *format, ...)
{
    const char *line_text = NULL;
    u32 length = 1;
    if (!diagnostics_full(diagnostics)) {
        const char *place = find_place(scene->file_texts[at.file], at, &line_text);
        length = (u32)strcspn(place, " \t\r\n\v\f{}\"#");
    }
    va_list arguments;
    va_start(arguments, format);
    diagnostics_add_list(diagnostics, severity, scene->files[at.file], at.line, at.column, length, line_text,
                         format, arguments);
    va_end(arguments);
}
