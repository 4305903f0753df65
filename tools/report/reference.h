// Reference: a picture so well sampled that others can be held against it, with how sure it is. It is the
// mean of independent renders, whose spread tells its standard error.
#ifndef CLRT_REPORT_REFERENCE_H
#define CLRT_REPORT_REFERENCE_H

#include <jansson.h>

#include "image/image.h"
#include "runner.h"
#include "statistics.h"

enum { REFERENCE_PARTS = 8, REFERENCE_SEED = 1000003 };

// A reference whose standard error is more than this part of an error says nothing about that error.
static const f64 REFERENCE_SHARE = 0.25;

typedef struct Reference {
    Image *mean;        // NULL: there is none, and `reason` says why
    Image *variance;    // of each value of the mean
    f64 standard_error; // root of the mean variance
    Mean level;         // the mean of all values, over the parts
    f64 seconds;        // of all renders
    char reason[256];
} Reference;

// Renders the shot REFERENCE_PARTS times with `samples` each and seeds from REFERENCE_SEED on; its own
// samples and seed are not read. A clrt that fails is a failure.
bool reference_make(Runner *runner, const Shot *shot, u32 samples, Reference *reference, Error *error);

// Writes the mean and the variance as PFM. False with ERROR_IO.
bool reference_write(const Reference *reference, const char *mean_path, const char *variance_path,
                     Error *error);

// What the report says of it.
json_t *reference_to_json(const Reference *reference, const char *math, u32 samples);

void reference_destroy(Reference *reference);

// Writes an image as its suffix says, linear values encoded as sRGB where that is a PNG.
bool image_write(const Image *image, const char *path, Error *error);

#endif
