// Table: the rows of the report in columns, for a terminal.
#ifndef CLRT_REPORT_TABLE_H
#define CLRT_REPORT_TABLE_H

#include <jansson.h>
#include <stdio.h>

void table_print(const json_t *report, FILE *stream);

#endif
