#include "output/hdr_stream.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum {
    RGBE = 4,
    RUN_MIN = 3,     // shorter ones cost as much as they save
    RUN_MAX = 127,   // codes 129 to 255
    PLAIN_MAX = 128, // codes 1 to 128
    RUNS_WIDTH_MIN = 8,
    RUNS_WIDTH_MAX = 0x7fff, // scanlines of other widths are always flat
};

struct HdrStream {
    Sink *sink;
    u32 width;
    u8 *planes; // a component of the row after the other
    u8 *bytes;  // the encoded row
};

// A text may not end its line.
static bool write_text(Sink *sink, const OutputText *text, Error *error)
{
    if (!sink_write(sink, text->key, strlen(text->key), error) || !sink_write(sink, "=", 1, error))
        return false;
    for (const char *c = text->text; *c;) {
        const size_t length = strcspn(c, "\r\n");
        if (!sink_write(sink, c, length, error))
            return false;
        c += length;
        if (*c && !sink_write(sink, " ", 1, error))
            return false;
        c += *c != 0;
    }
    return sink_write(sink, "\n", 1, error);
}

static bool write_header(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    static const char MAGIC[] = "#?RADIANCE\n";
    if (!sink_write(sink, MAGIC, sizeof MAGIC - 1, error))
        return false;
    for (size_t i = 0; i < options->text_count; i++) {
        if (!write_text(sink, &options->texts[i], error))
            return false;
    }
    char end[96];
    const int length = snprintf(end, sizeof end, "FORMAT=32-bit_rle_rgbe\n\n-Y %u +X %u\n", height, width);
    return sink_write(sink, end, (size_t)length, error);
}

HdrStream *hdr_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    HdrStream *stream = calloc(1, sizeof *stream);
    if (stream) {
        stream->sink = sink;
        stream->width = width;
        stream->planes = calloc(width, RGBE);
        // Plain bytes need one code each 128, begun anew in each component; and 4 bytes go first.
        stream->bytes = calloc((size_t)width + width / PLAIN_MAX + 2, RGBE);
    }
    if (!stream || !stream->planes || !stream->bytes)
        error_set(error, ERROR_MEMORY, "no memory to write an HDR");
    else if (write_header(sink, options, width, height, error))
        return stream;
    hdr_stream_destroy(stream);
    return NULL;
}

void hdr_encode(const f32 rgb[3], u8 rgbe[4])
{
    f64 values[3], largest = 0;
    for (int c = 0; c < 3; c++) {
        values[c] = rgb[c] > 0 ? fmin((f64)rgb[c], (f64)FLT_MAX) : 0;
        largest = fmax(largest, values[c]);
    }
    memset(rgbe, 0, RGBE);
    int exponent;
    frexp(largest, &exponent);
    if (ldexp(largest, 8 - exponent) >= 255.5)
        exponent++; // it would round to 256
    if (largest <= 0 || exponent < -127)
        return;
    exponent = exponent > 127 ? 127 : exponent;
    for (int c = 0; c < 3; c++)
        rgbe[c] = (u8)fmin(255, floor(ldexp(values[c], 8 - exponent) + 0.5));
    rgbe[3] = (u8)(exponent + 128);
}

static u32 run_length(const u8 *values, u32 count)
{
    u32 length = 1;
    while (length < count && length < RUN_MAX && values[length] == values[0])
        length++;
    return length;
}

// Runs where they save something, else the bytes as they are.
static u8 *encode_runs(const u8 *values, u32 count, u8 *out)
{
    for (u32 x = 0; x < count;) {
        const u32 run = run_length(values + x, count - x);
        if (run >= RUN_MIN) {
            *out++ = (u8)(128 + run);
            *out++ = values[x];
            x += run;
            continue;
        }
        u32 plain = run;
        while (x + plain < count && plain < PLAIN_MAX) {
            const u32 next = run_length(values + x + plain, count - x - plain);
            if (next >= RUN_MIN)
                break;
            plain += next;
        }
        plain = plain < PLAIN_MAX ? plain : PLAIN_MAX;
        *out++ = (u8)plain;
        memcpy(out, values + x, plain);
        out += plain;
        x += plain;
    }
    return out;
}

bool hdr_stream_write_row(HdrStream *stream, const f32 *rgb, Error *error)
{
    const u32 width = stream->width;
    const bool runs = width >= RUNS_WIDTH_MIN && width <= RUNS_WIDTH_MAX;
    u8 *out = stream->bytes;
    for (u32 x = 0; x < width; x++) {
        u8 rgbe[RGBE];
        hdr_encode(rgb + (size_t)x * 3, rgbe);
        for (u32 c = 0; c < RGBE; c++)
            stream->planes[runs ? (size_t)c * width + x : (size_t)x * RGBE + c] = rgbe[c];
    }
    if (!runs)
        return sink_write(stream->sink, stream->planes, (size_t)width * RGBE, error);
    memcpy(out, (u8[]){2, 2, (u8)(width >> 8), (u8)width}, RGBE);
    out += RGBE;
    for (u32 c = 0; c < RGBE; c++)
        out = encode_runs(stream->planes + (size_t)c * width, width, out);
    return sink_write(stream->sink, stream->bytes, (size_t)(out - stream->bytes), error);
}

void hdr_stream_destroy(HdrStream *stream)
{
    if (!stream)
        return;
    free(stream->planes);
    free(stream->bytes);
    free(stream);
}
