// Arithmetic: a mode against the same samples in double precision.
#ifndef CLRT_REPORT_ARITHMETIC_H
#define CLRT_REPORT_ARITHMETIC_H

#include "job.h"

// Sets error.r64 and error.r64_one_sample of the candidate's row, and its map; where there is no double to
// hold it against, their reason. False with ERROR_IO, ERROR_MEMORY, ERROR_INTERRUPTED.
bool arithmetic_measure(Job *job, Candidate *candidate, Error *error);

#endif
