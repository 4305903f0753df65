#include "table.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void table_row(Table *table)
{
    table->rows += table->rows < TABLE_ROWS_MAX;
    table->filled = 0;
}

void table_cell(Table *table, const char *format, ...)
{
    if (table->rows == 0 || table->filled == TABLE_COLUMNS_MAX)
        return;
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(table->cells[table->rows - 1][table->filled++], TABLE_CELL, format, arguments);
    va_end(arguments);
    if (table->filled > table->columns)
        table->columns = table->filled;
}

static int width_of(const Table *table, u32 column)
{
    size_t width = 0;
    for (u32 row = 0; row < table->rows; row++) {
        const size_t length = strlen(table->cells[row][column]);
        width = length > width ? length : width;
    }
    return (int)width;
}

void table_print(const Table *table, bool markdown)
{
    for (u32 row = 0; row < table->rows; row++) {
        for (u32 column = 0; column < table->columns; column++) {
            const int width = width_of(table, column), side = column < 1 ? -width : width;
            printf(markdown ? "| %*s " : "%*s  ", side, table->cells[row][column]);
        }
        printf(markdown ? "|\n" : "\n");
        if (!markdown || row > 0)
            continue;
        for (u32 column = 0; column < table->columns; column++)
            printf(column < 1 ? "|---" : "|--:");
        printf("|\n");
    }
    printf("\n");
}
