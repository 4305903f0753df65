// Diagnostics: what the user wrote wrongly (or unwisely), with its place; many, collected, shown at the end.
#ifndef CLRT_SCENE_DIAGNOSTICS_H
#define CLRT_SCENE_DIAGNOSTICS_H

#include <stdarg.h>
#include <stdio.h>

#include "base/types.h"

typedef struct Diagnostics Diagnostics;

typedef enum Severity { SEVERITY_WARNING, SEVERITY_ERROR } Severity;

enum { DIAGNOSTICS_SHOWN_MAX = 20 };

// Returns NULL when memory is exhausted.
Diagnostics *diagnostics_create(void);
void diagnostics_destroy(Diagnostics *diagnostics);

// Adds a message about length characters from column of line in the file called file_name (line and
// column from 1; line 0: the file as a whole). source_line is the text of that line, up to its end or
// a 0 (copied; may be NULL where there is none). Messages beyond DIAGNOSTICS_SHOWN_MAX are counted,
// not kept; errors go before warnings.
void diagnostics_add(Diagnostics *diagnostics, Severity severity, const char *file_name, u32 line,
                     u32 column, u32 length, const char *source_line, const char *format, ...)
    __attribute__((format(printf, 8, 9)));

// The same with the arguments of a variadic caller.
void diagnostics_add_list(Diagnostics *diagnostics, Severity severity, const char *file_name, u32 line,
                          u32 column, u32 length, const char *source_line, const char *format,
                          va_list arguments) __attribute__((format(printf, 8, 0)));

// Whether a further error would be counted only, so that nobody need prepare its text.
bool diagnostics_full(const Diagnostics *diagnostics);

u32 diagnostics_error_count(const Diagnostics *diagnostics);
u32 diagnostics_warning_count(const Diagnostics *diagnostics);

// Prints each kept message as
//   scene.txt:3:9: error: unknown property 'radus' of sphere; did you mean 'radius'?
//       sphere { radus 1 }
//                ^~~~~
// in the order of the text, and a last line when some were left out. Of a line above 160
// characters the part about the spot is shown; what a terminal might obey is shown as '?'.
void diagnostics_print(const Diagnostics *diagnostics, FILE *stream);

#endif
