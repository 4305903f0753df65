// Measure: random rays at a shape, on a device and by the reference.
#ifndef CLRT_ULP_MEASURE_H
#define CLRT_ULP_MEASURE_H

#include "selftest/probe.h"
#include "tally.h"

typedef struct Subject {
    const char *name;
    Family family;
    bool mesh; // a face of a mesh
} Subject;

enum { SUBJECT_COUNT = FAMILY_COUNT + 1 };

// Number k < SUBJECT_COUNT of what is measured.
Subject subject_at(u32 k);

// At least `rays` rays, rounded up to whole batches of them: the same ones whatever the device and the threads.
// Fails with ERROR_DEVICE or ERROR_MEMORY.
bool measure_subject(Probe *probe, const Subject *subject, u64 rays, Tally *tally, Error *error);

#endif
