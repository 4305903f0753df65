// Plots overall: those that are of no scene.
#ifndef CLRT_REPORT_PLOTS_OVERALL_H
#define CLRT_REPORT_PLOTS_OVERALL_H

#include "measure.h"

// As plots_make; nothing is drawn where the report has no such data.
bool plots_overall_features(const Campaign *campaign, json_t *report, Error *error);
bool plots_overall_ulp(const Campaign *campaign, json_t *report, Error *error);

#endif
