// Text of C-like sources, line by line, as clrt-bundle needs it. Knows nothing of bundles.
#ifndef CLRT_TOOLS_BUNDLE_TEXT_H
#define CLRT_TOOLS_BUNDLE_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>

// A line `# name rest`.
typedef struct Directive {
    char name[16];
    char rest[512]; // without blanks around it; cut if longer
} Directive;

// The whole file with a final 0, to be freed; NULL with errno set where it cannot be read.
char *text_read(const char *path);

// True where the first two directives of the text are #ifndef X and #define X.
bool text_is_guarded(const char *text);

// Reads a line of length characters; false where it is no directive.
bool directive_read(Directive *directive, const char *line, size_t length);
bool directive_is(const Directive *directive, const char *name);
// The path of `include "path"`; false where it has another form or does not fit.
bool directive_include_path(const Directive *directive, char *path, size_t size);

// Writes text as the C definition of `const char symbol[]` and of `const size_t symbol_size`.
void text_write_c(const char *text, const char *symbol, FILE *out);

#endif
