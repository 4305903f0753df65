// Table: rows of short texts, printed in columns or as Markdown.
#ifndef CLRT_BENCH_TABLE_H
#define CLRT_BENCH_TABLE_H

#include "base/types.h"

enum { TABLE_COLUMNS_MAX = 20, TABLE_ROWS_MAX = 160, TABLE_CELL = 40 };

typedef struct Table {
    char cells[TABLE_ROWS_MAX][TABLE_COLUMNS_MAX][TABLE_CELL];
    u32 columns; // of the fullest row
    u32 rows;
    u32 filled; // cells of the last row
} Table;

// Rows and cells beyond the limits are left out; texts are cut.
void table_row(Table *table);
void table_cell(Table *table, const char *format, ...) __attribute__((format(printf, 2, 3)));

// The first row is the heading; its column and the numbers to the right.
void table_print(const Table *table, bool markdown);

#endif
