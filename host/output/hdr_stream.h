// HdrStream: a Radiance HDR file written row by row into a Sink. Values become m/256 2^(e-128), m the nearest
// whole number, e that of the pixel's largest value: within 1/256 of that one.
#ifndef CLRT_OUTPUT_HDR_STREAM_H
#define CLRT_OUTPUT_HDR_STREAM_H

#include "output/output.h"
#include "output/sink.h"

typedef struct HdrStream HdrStream;

// Writes the header, with the texts as lines KEY=TEXT. The sink stays the caller's. NULL with ERROR_IO or
// ERROR_MEMORY.
HdrStream *hdr_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error);

// One row of radiance, 3 floats a pixel. What is below 0 or NaN becomes 0, what is above the largest that the
// format has (1.7e38) that.
bool hdr_stream_write_row(HdrStream *stream, const f32 *rgb, Error *error);

// Takes NULL. Writes nothing.
void hdr_stream_destroy(HdrStream *stream);

// The four bytes of a pixel.
void hdr_encode(const f32 rgb[3], u8 rgbe[4]);

#endif
