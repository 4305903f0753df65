// Plots: the pictures of a report's numbers.
#ifndef CLRT_REPORT_PLOTS_H
#define CLRT_REPORT_PLOTS_H

#include "measure.h"

// Draws into the folder `plots` of the report, which it makes, and lists them in report's "plots". Kinds, of
// each scene: "convergence", "pareto", "stages"; of the report: "ulp", "features". Those without data are
// left out. Sets settings.gnuplot to the version of gnuplot; where there is none it is null and data and
// scripts are all.
bool plots_make(const Campaign *campaign, json_t *report, Error *error);

#endif
