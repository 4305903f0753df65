// Html: the report as one page that needs nothing beside itself.
#ifndef CLRT_REPORT_HTML_H
#define CLRT_REPORT_HTML_H

#include "measure.h"

// Writes report.html into the report's folder, where the plots and pictures that the document names are.
// False with ERROR_IO or ERROR_MEMORY.
bool html_write(const Campaign *campaign, const json_t *report, Error *error);

#endif
