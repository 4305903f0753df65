// Html page: the parts of which a page is put together. It knows nothing of reports.
#ifndef CLRT_REPORT_HTML_PAGE_H
#define CLRT_REPORT_HTML_PAGE_H

#include <stdio.h>

#include "base/error.h"
#include "base/types.h"

// Up to the body, with all of the style; and the end.
void page_begin(FILE *file, const char *title);
void page_end(FILE *file);

// Text with the characters of markup escaped.
void page_text(FILE *file, const char *text);

// Three digits, as people write them: 12.3, 1.23 x 10^-7; a dash for what is not finite.
void page_number(FILE *file, f64 value);

// "low to high" in small print, nothing where it is not known.
void page_interval(FILE *file, f64 low, f64 high);

// A cell of a table with a number, or a text.
void page_cell(FILE *file, f64 value);
void page_cell_text(FILE *file, const char *text);

// A row of heads, separated by '|'; begins a table of the class.
void page_table(FILE *file, const char *heads);

// The file at path as an image within the page. False with ERROR_IO.
bool page_image(FILE *file, const char *path, const char *type, const char *what, Error *error);

#endif
