// ExrStream: an OpenEXR file of floats, R G B, written row by row through OpenEXRCore into a Sink that can
// seek.
#ifndef CLRT_OUTPUT_EXR_STREAM_H
#define CLRT_OUTPUT_EXR_STREAM_H

#include "output/output.h"
#include "output/sink.h"

typedef struct ExrStream ExrStream;

// Whether this build has OpenEXR; without it the other functions must not be called.
bool exr_stream_available(void);

// Writes the header: scanlines in blocks under ZIP, and each of the texts as an attribute of type string. The
// sink stays the caller's. NULL with ERROR_IO (also for a text whose key is an attribute of another type) or
// ERROR_MEMORY.
ExrStream *exr_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error);

// One row of radiance, 3 floats a pixel; kept as they are, NaN and infinity too.
bool exr_stream_write_row(ExrStream *stream, const f32 *rgb, Error *error);

// What follows the last row.
bool exr_stream_finish(ExrStream *stream, Error *error);

// Takes NULL. Call while the sink is open.
void exr_stream_destroy(ExrStream *stream);

#endif
