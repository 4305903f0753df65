// Sink: where the bytes of a file go. A regular file is replaced as a whole at the end or not at all;
// standard output, devices and pipes are written directly. It knows nothing of picture formats.
#ifndef CLRT_OUTPUT_SINK_H
#define CLRT_OUTPUT_SINK_H

#include "base/error.h"
#include "base/types.h"

typedef struct Sink Sink;

// path "-" is standard output. With `seekable`, sink_seek works whatever the path is: what cannot seek
// gets its bytes from a spool at sink_commit. NULL with ERROR_IO or ERROR_MEMORY. path must stay valid
// as long as the Sink.
Sink *sink_open(const char *path, bool seekable, Error *error);

bool sink_write(Sink *sink, const void *bytes, size_t length, Error *error);

// The next write goes to this offset from the start. Only for a Sink opened as seekable.
bool sink_seek(Sink *sink, u64 offset, Error *error);

// Closes, and renames into place. The Sink is gone afterwards, also where this fails.
bool sink_commit(Sink *sink, Error *error);

// Removes the temporary file; takes NULL.
void sink_abort(Sink *sink);

// NULL where the file is written directly.
const char *sink_temporary_path(const Sink *sink);

#endif
