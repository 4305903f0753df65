// Ulp: distances of the shapes' arithmetic from the right answers, as measured by another program.
#ifndef CLRT_REPORT_ULP_H
#define CLRT_REPORT_ULP_H

#include <jansson.h>

#include "base/error.h"

// Reads {"shapes": [{"name":, "rays":, "max_ulp":, "p99_ulp":, "histogram": [{"ulp":, "count":}, ...]},
// ...]}, as clrt-ulp --json writes it; further members are kept. "ulp" is the upper end of a bin, null: no
// end. A missing figure is null. NULL with ERROR_IO, which says what is wrong.
json_t *ulp_read(const char *path, Error *error);

#endif
