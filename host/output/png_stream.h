// PngStream: a PNG written row by row through libpng into a Sink. It takes levels, not radiance.
#ifndef CLRT_OUTPUT_PNG_STREAM_H
#define CLRT_OUTPUT_PNG_STREAM_H

#include "output/output.h"
#include "output/sink.h"

typedef struct PngStream PngStream;

// Writes everything before the first row: RGB of options->bits, an sRGB chunk or, for linear levels, gAMA
// 1.0, and the texts. The sink stays the caller's. NULL with ERROR_IO or ERROR_MEMORY.
PngStream *png_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error);

// One row of levels, 3 a pixel, 16-bit ones with the high byte first.
bool png_stream_write_row(PngStream *stream, const u8 *levels, Error *error);

// More texts, which will follow the last row. They are copied.
bool png_stream_add_texts(PngStream *stream, const OutputText *texts, size_t count, Error *error);

// What follows the last row.
bool png_stream_finish(PngStream *stream, Error *error);

// Takes NULL. Writes nothing.
void png_stream_destroy(PngStream *stream);

#endif
