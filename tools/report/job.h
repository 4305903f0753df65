// Job: one scene with the modes that it is measured in, while that is done.
#ifndef CLRT_REPORT_JOB_H
#define CLRT_REPORT_JOB_H

#include "measure.h"
#include "reference.h"
#include "series.h"

enum { COUNTS_MAX = SAMPLE_COUNTS_MAX + 1 };

// A scene in one mode.
typedef struct Candidate {
    const Mode *mode;
    json_t *row; // borrowed
    bool available;
    f64 seconds_a_sample; // of kernels, a sample of all pixels; of a run with one
    Series cold, warm[COUNTS_MAX];
} Candidate;

typedef struct Job {
    Campaign *campaign;
    const char *scene, *name; // name: of the folder in the report
    const char *folder;       // where that is now
    u32 width, height;
    u32 counts[COUNTS_MAX]; // of samples, rising
    u32 count;
    u32 own; // index into counts of the scene's own samples, or of the most where those are more
    Candidate candidates[MODES_MAX];
    u32 candidate_count;
    Reference reference;
    json_t *reference_json;
} Job;

// The path of a file that goes with the campaign, in its arena; NULL when memory is exhausted.
const char *job_temporary(const Job *job, const char *name);

// The scene at the job's size in a candidate's mode (NULL: exact), into a temporary file shot.pfm. samples 0:
// the scene's.
Shot job_shot(const Job *job, const Candidate *candidate, u32 samples);

// The candidate of that mode if clrt can render in it, else NULL.
Candidate *job_find(Job *job, const char *mode);

#endif
