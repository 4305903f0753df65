// Report: the story of a run of clrt-report, from its arguments to a folder.
#ifndef CLRT_REPORT_REPORT_H
#define CLRT_REPORT_REPORT_H

#include "arguments.h"

// Measures, and puts the folder in its place when all is in it; until then, and where this fails, an older
// report there stays as it is. The table goes to standard output. `program` is argv[0].
bool report_make(const Arguments *arguments, const char *program, Arena *arena, Error *error);

#endif
