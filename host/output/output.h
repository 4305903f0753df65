// Output: rows of radiance in, a picture file out. Streams: memory is a few rows, whatever the size.
// It knows nothing of how the rows were made.
#ifndef CLRT_OUTPUT_OUTPUT_H
#define CLRT_OUTPUT_OUTPUT_H

#include "base/error.h"
#include "base/types.h"
#include "scene/scene.h"

typedef struct OutputText {
    const char *key;  // 1 to 79 characters of ASCII
    const char *text; // UTF-8
} OutputText;

typedef struct OutputOptions {
    OutputSettings settings; // exposure, tone map, white, encoding; the *_given members are not read
    u32 bits;                // of a PNG: 8 or 16
    const OutputText *texts; // of a PNG, EXR or HDR, in this order, before the image; for output_open only
    size_t text_count;
} OutputOptions;

typedef struct Output Output;

// Opens path for a picture of width x height, at least 1 each. The format goes by the suffix, of any case:
// .png, .exr, .hdr and .pfm; "-" is a PNG on standard output, and so is a device or pipe without a suffix. A
// regular file is written under a temporary name in the same folder and appears at output_commit; until then
// an older file of that name stays as it is. Other kinds of files are written directly. NULL with ERROR_USAGE
// for a suffix that is not supported, ERROR_IO or ERROR_MEMORY. path must stay valid as long as the Output.
Output *output_open(const char *path, const OutputOptions *options, u32 width, u32 height, Error *error);

// The next row_count rows, from the top down, 3 floats a pixel, linear radiance. After a failure only
// output_abort is allowed.
bool output_write_rows(Output *output, const f32 *rgb_rows, u32 row_count, Error *error);

// More texts of a PNG, of what is known only when all rows are; they follow the image in the file. Before
// output_commit. Other formats have none, and true is returned.
bool output_add_texts(Output *output, const OutputText *texts, size_t count, Error *error);

// Call after the last row. Finishes the file and puts it in its place. The Output is gone afterwards,
// also where this fails; then the temporary file is gone too.
bool output_commit(Output *output, Error *error);

// Gives up: removes the temporary file and frees the Output. Takes NULL.
void output_abort(Output *output);

// The temporary file's path, which a signal handler may unlink, or NULL where there is none. Valid until
// output_commit or output_abort.
const char *output_temporary_path(const Output *output);

// True for formats that keep OutputOptions.texts.
bool output_takes_texts(const char *path);

// True for formats that take radiance alone, so that exposure, tone map, encoding and bits say nothing.
bool output_ignores_display_settings(const char *path);

#endif
