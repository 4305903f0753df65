// Doc: the report as one JSON document, which every page, table and plot reads. Places in it are paths of
// keys with dots between them.
#ifndef CLRT_REPORT_DOC_H
#define CLRT_REPORT_DOC_H

#include <jansson.h>

#include "base/arena.h"
#include "base/error.h"
#include "base/types.h"
#include "statistics.h"

// The value at a path, NULL where there is none. A whole number as a key is an index into an array.
json_t *doc_at(const json_t *from, const char *path);

// NaN where there is no number.
f64 doc_number(const json_t *from, const char *path);

// NULL where there is no text.
const char *doc_text(const json_t *from, const char *path);

// null where the value is not finite, since JSON has no such numbers.
json_t *doc_real(f64 value);
json_t *doc_whole(u64 value);

// null for NULL, and for what is no UTF-8.
json_t *doc_string(const char *text);

// Puts value, which it takes over, at a path; the objects on the way are there. A value NULL is null.
void doc_set(json_t *into, const char *path, json_t *value);

// {"median":, "mad":}; the latter is null below two values.
json_t *doc_spread(const f64 *values, size_t count);

// Sets PATH, PATH_low and PATH_high.
void doc_set_estimate(json_t *into, const char *path, Estimate estimate);

// Reads a JSON file; NULL with ERROR_IO, which names the path and the place.
json_t *doc_read(const char *path, Error *error);

// Indented, or in one line each of an array where lines is true. False with ERROR_IO.
bool doc_write(const json_t *document, bool lines, const char *path, Error *error);

#endif
