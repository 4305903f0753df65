// Report: what was measured, as a table or as JSON.
#ifndef CLRT_ULP_REPORT_H
#define CLRT_ULP_REPORT_H

#include "device/list.h"
#include "tally.h"

typedef struct UlpResult {
    const char *name;
    Tally tally;
} UlpResult;

void ulp_report_heading(const DeviceInfo *device);
void ulp_report_row(const UlpResult *result);

// Share of the hits by how far they are off, a line a shape.
void ulp_report_histogram(const UlpResult *results, u32 count);

// Schema "clrt-ulp/1". Fails with ERROR_IO or ERROR_MEMORY.
bool ulp_report_json(const UlpResult *results, u32 count, const DeviceInfo *device, const char *path,
                     Error *error);

// False with ERROR_SELF_TEST, and a text that names the shapes, where a hit or a verdict is beyond what is
// allowed.
bool ulp_verdict(const UlpResult *results, u32 count, Error *error);

#endif
