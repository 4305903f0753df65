#include "output/output.h"

#include "output/exr_stream.h"
#include "output/hdr_stream.h"
#include "output/png_stream.h"
#include "output/quantize.h"
#include "output/sink.h"

#include <assert.h>
#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

typedef enum Format { FORMAT_PNG, FORMAT_PFM, FORMAT_HDR, FORMAT_EXR, FORMAT_UNKNOWN } Format;

struct Output {
    const char *path;
    Format format;
    u32 width, height;
    u32 rows_written;
    Sink *sink;
    u8 *row;              // one encoded row
    Quantizer *quantizer; // PNG
    PngStream *png;       // PNG
    HdrStream *hdr;       // HDR
    ExrStream *exr;       // EXR
    size_t header_bytes;  // PFM
};

// The last dot of the file's name and what follows, or the end of the path.
static const char *path_suffix(const char *path)
{
    const char *slash = strrchr(path, '/');
    const char *name = slash ? slash + 1 : path;
    const char *dot = strrchr(name, '.');
    return dot ? dot : name + strlen(name);
}

static bool same_suffix(const char *suffix, const char *lower)
{
    for (; *suffix && *lower; suffix++, lower++) {
        if (tolower((unsigned char)*suffix) != *lower)
            return false;
    }
    return *suffix == *lower;
}

static Format path_format(const char *path)
{
    if (strcmp(path, "-") == 0)
        return FORMAT_PNG;
    const char *suffix = path_suffix(path);
    if (same_suffix(suffix, ".png"))
        return FORMAT_PNG;
    if (same_suffix(suffix, ".pfm"))
        return FORMAT_PFM;
    if (same_suffix(suffix, ".hdr"))
        return FORMAT_HDR;
    if (same_suffix(suffix, ".exr"))
        return FORMAT_EXR;
    struct stat file;
    if (*suffix || stat(path, &file) != 0 || S_ISREG(file.st_mode) || S_ISDIR(file.st_mode))
        return FORMAT_UNKNOWN;
    return FORMAT_PNG;
}

bool output_ignores_display_settings(const char *path)
{
    const Format format = path_format(path);
    return format == FORMAT_PFM || format == FORMAT_HDR || format == FORMAT_EXR;
}

bool output_takes_texts(const char *path)
{
    return path_format(path) != FORMAT_PFM;
}

static bool check_format(Format format, const char *path, Error *error)
{
    if (format == FORMAT_EXR && !exr_stream_available())
        return error_set(error, ERROR_USAGE,
                         "%s: this build writes no OpenEXR; the output may be .png, .hdr or .pfm", path);
    if (format == FORMAT_UNKNOWN)
        return error_set(error, ERROR_USAGE,
                         "%s: the suffix says the format and must be .png, .exr, .hdr or .pfm", path);
    return true;
}

static bool open_png(Output *output, const OutputOptions *options, Error *error)
{
    output->quantizer = quantizer_create(&options->settings, options->bits, error);
    if (!output->quantizer)
        return false;
    output->png = png_stream_create(output->sink, options, output->width, output->height, error);
    return output->png != NULL;
}

static bool open_pfm(Output *output, Error *error)
{
    char header[64];
    const int length = snprintf(header, sizeof header, "PF\n%u %u\n-1.0\n", output->width, output->height);
    output->header_bytes = (size_t)length;
    return sink_write(output->sink, header, output->header_bytes, error);
}

static bool open_format(Output *output, const OutputOptions *options, Error *error)
{
    switch (output->format) {
    case FORMAT_HDR:
        output->hdr = hdr_stream_create(output->sink, options, output->width, output->height, error);
        return output->hdr != NULL;
    case FORMAT_EXR:
        output->exr = exr_stream_create(output->sink, options, output->width, output->height, error);
        return output->exr != NULL;
    case FORMAT_PFM:
        return open_pfm(output, error);
    default:
        return open_png(output, options, error);
    }
}

Output *output_open(const char *path, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    assert(width > 0 && height > 0 && (options->bits == 8 || options->bits == 16));
    const Format format = path_format(path);
    if (!check_format(format, path, error))
        return NULL;
    Output *output = calloc(1, sizeof *output);
    size_t row_bytes;
    const bool overflow = __builtin_mul_overflow((size_t)width, 3 * sizeof(f32), &row_bytes);
    if (output && !overflow)
        output->row = malloc(row_bytes);
    if (!output || !output->row) {
        output_abort(output);
        error_set(error, ERROR_MEMORY, "%s: no memory to write it", path);
        return NULL;
    }
    output->path = path;
    output->format = format;
    output->width = width;
    output->height = height;
    output->sink = sink_open(path, format == FORMAT_PFM || format == FORMAT_EXR, error);
    if (!output->sink || !open_format(output, options, error)) {
        output_abort(output);
        return NULL;
    }
    return output;
}

static void encode_floats(const f32 *values, size_t count, u8 *bytes)
{
    for (size_t i = 0; i < count; i++, bytes += 4) {
        u32 bits;
        memcpy(&bits, &values[i], sizeof bits);
        bytes[0] = (u8)bits;
        bytes[1] = (u8)(bits >> 8);
        bytes[2] = (u8)(bits >> 16);
        bytes[3] = (u8)(bits >> 24);
    }
}

// A PFM runs from the bottom up, so a block of rows is written in reverse, to its place from the end.
static bool write_pfm_rows(Output *output, const f32 *rgb_rows, u32 row_count, Error *error)
{
    const size_t count = (size_t)output->width * 3;
    const u64 below = output->height - output->rows_written - row_count;
    if (!sink_seek(output->sink, output->header_bytes + below * count * sizeof(f32), error))
        return false;
    for (u32 i = row_count; i > 0; i--) {
        encode_floats(rgb_rows + (i - 1) * count, count, output->row);
        if (!sink_write(output->sink, output->row, count * sizeof(f32), error))
            return false;
    }
    return true;
}

static bool write_png_rows(Output *output, const f32 *rgb_rows, u32 row_count, Error *error)
{
    const size_t count = (size_t)output->width * 3;
    for (u32 i = 0; i < row_count; i++) {
        quantizer_apply(output->quantizer, rgb_rows + i * count, count, output->row);
        if (!png_stream_write_row(output->png, output->row, error))
            return false;
    }
    return true;
}

static bool write_stream_rows(Output *output, const f32 *rgb_rows, u32 row_count, Error *error)
{
    const size_t count = (size_t)output->width * 3;
    for (u32 i = 0; i < row_count; i++) {
        const f32 *row = rgb_rows + i * count;
        if (!(output->hdr ? hdr_stream_write_row(output->hdr, row, error)
                          : exr_stream_write_row(output->exr, row, error)))
            return false;
    }
    return true;
}

bool output_write_rows(Output *output, const f32 *rgb_rows, u32 row_count, Error *error)
{
    assert(row_count <= output->height - output->rows_written);
    const bool done = output->png                    ? write_png_rows(output, rgb_rows, row_count, error)
                      : output->format == FORMAT_PFM ? write_pfm_rows(output, rgb_rows, row_count, error)
                                                     : write_stream_rows(output, rgb_rows, row_count, error);
    output->rows_written += row_count;
    return done;
}

bool output_add_texts(Output *output, const OutputText *texts, size_t count, Error *error)
{
    return !output->png || png_stream_add_texts(output->png, texts, count, error);
}

bool output_commit(Output *output, Error *error)
{
    assert(output->rows_written == output->height);
    bool done = (!output->png || png_stream_finish(output->png, error)) &&
                (!output->exr || exr_stream_finish(output->exr, error));
    if (done) {
        done = sink_commit(output->sink, error);
        output->sink = NULL;
    }
    output_abort(output);
    return done;
}

void output_abort(Output *output)
{
    if (!output)
        return;
    png_stream_destroy(output->png);
    hdr_stream_destroy(output->hdr);
    exr_stream_destroy(output->exr);
    quantizer_destroy(output->quantizer);
    sink_abort(output->sink);
    free(output->row);
    free(output);
}

const char *output_temporary_path(const Output *output)
{
    return sink_temporary_path(output->sink);
}
