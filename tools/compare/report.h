// Report: what clrt-compare says, for people and for programs.
#ifndef CLRT_COMPARE_REPORT_H
#define CLRT_COMPARE_REPORT_H

#include "metrics.h"
#include "options.h"

// Both write to standard output; false with ERROR_IO or ERROR_MEMORY.
bool report_text(const Options *options, const Pictures *pictures, const Metrics *metrics, Error *error);

// Schema "clrt-compare/1", described in README.md.
bool report_json(const Options *options, const Pictures *pictures, const Metrics *metrics, Error *error);

// For both of them: "red", "alpha" and the like; flushes standard output, false with ERROR_IO.
const char *report_channel(const Pictures *pictures, u32 channel);
bool report_finish(Error *error);

#endif
