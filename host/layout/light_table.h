// The table by which paths draw lights where there are too many to look at all of them (shared/light_table.h).
#ifndef CLRT_LAYOUT_LIGHT_TABLE_H
#define CLRT_LAYOUT_LIGHT_TABLE_H

#include "layout/layout.h"

// Once the lights have their records: how many a path looks at, and room for the table. Fails with ERROR_MEMORY.
bool light_table_plan(Layout *layout, Error *error);

// Once the hierarchy is there, which tells how far light goes: the table. Fails with ERROR_MEMORY.
bool light_table_fill(Layout *layout, Error *error);

#endif
