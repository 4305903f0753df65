// Html tables: the rows of a scene as tables of the page, each with what it means.
#ifndef CLRT_REPORT_HTML_TABLES_H
#define CLRT_REPORT_HTML_TABLES_H

#include <jansson.h>
#include <stdio.h>

#include "base/types.h"

bool html_row_is_of(const json_t *row, const char *scene);

// Whether clrt could render in the row's mode.
bool html_row_is_available(const json_t *row);

// All of the rows of the scene.
void html_tables_times(FILE *file, const json_t *rows, const char *scene);
void html_tables_rays(FILE *file, const json_t *rows, const char *scene);
void html_tables_arithmetic(FILE *file, const json_t *rows, const char *scene);
void html_tables_sampling(FILE *file, const json_t *rows, const char *scene);
void html_tables_slopes(FILE *file, const json_t *rows, const char *scene);

// A group of the rows whose members are numbers and texts, with a column a mode; what no mode knows is left
// out.
void html_tables_group(FILE *file, const json_t *rows, const char *scene, const char *group);

#endif
