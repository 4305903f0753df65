#include "output/exr_stream.h"

#ifdef CLRT_EXR

#include <assert.h>
#include <openexr.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// Of zlib. The low bits of radiance are noise, on which more effort is wasted: KiB of a picture of 590 x 332
// with such bits at levels 1, 2, 4, 6: 1709, 1687, 1666, 1651.
enum { ZIP_LEVEL = 1, CHANNELS = 3 };

struct ExrStream {
    Sink *sink;
    u64 position; // of the sink
    exr_context_t context;
    exr_encode_pipeline_t pipeline;
    bool pipeline_ready;
    u32 width, height;
    u32 chunk_rows; // that are compressed together
    u32 row;        // the next
    f32 *chunk;     // the rows of the chunk under way
    char message[256]; // the library's last
    Error *error;      // of the call under way
};

static void on_error(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)code;
    void *user = NULL;
    if (exr_get_user_data(context, &user) == EXR_ERR_SUCCESS && user) {
        ExrStream *stream = user;
        snprintf(stream->message, sizeof stream->message, "%s", message);
    }
}

static int64_t on_write(exr_const_context_t context, void *user, const void *bytes, uint64_t length,
                        uint64_t offset, exr_stream_error_func_ptr_t on_stream_error)
{
    (void)context;
    (void)on_stream_error;
    ExrStream *stream = user;
    if (offset != stream->position && !sink_seek(stream->sink, offset, stream->error))
        return -1;
    if (!sink_write(stream->sink, bytes, length, stream->error))
        return -1;
    stream->position = offset + length;
    return (int64_t)length;
}

// Every call starts with *error cleared, so that what the sink says is not replaced.
static void begin_call(ExrStream *stream, Error *error)
{
    stream->error = error;
    stream->message[0] = 0;
    error->code = ERROR_NONE;
}

static bool check(ExrStream *stream, exr_result_t result)
{
    if (result == EXR_ERR_SUCCESS)
        return true;
    if (stream->error->code != ERROR_NONE)
        return false;
    return error_set(stream->error, result == EXR_ERR_OUT_OF_MEMORY ? ERROR_MEMORY : ERROR_IO, "OpenEXR: %s",
                     stream->message[0] ? stream->message : exr_get_default_error_message(result));
}

// ---- header ---------------------------------------------------------------------------------

static bool set_texts(ExrStream *stream, const OutputOptions *options)
{
    for (size_t i = 0; i < options->text_count; i++) {
        const OutputText *text = &options->texts[i];
        if (!check(stream, exr_attr_set_string(stream->context, 0, text->key, text->text)))
            return false;
    }
    return true;
}

static bool write_header(ExrStream *stream, const OutputOptions *options)
{
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = on_error;
    start.user_data = stream;
    start.write_fn = on_write;
    start.zip_level = ZIP_LEVEL;
    int part;
    if (!check(stream, exr_start_write(&stream->context, "picture", EXR_WRITE_FILE_DIRECTLY, &start)) ||
        !check(stream, exr_set_longname_support(stream->context, 1)) ||
        !check(stream, exr_add_part(stream->context, NULL, EXR_STORAGE_SCANLINE, &part)) ||
        !check(stream, exr_initialize_required_attr_simple(stream->context, part, (i32)stream->width,
                                                           (i32)stream->height, EXR_COMPRESSION_ZIP)))
        return false;
    static const char *const NAMES[CHANNELS] = {"B", "G", "R"};
    for (int i = 0; i < CHANNELS; i++) {
        if (!check(stream, exr_add_channel(stream->context, part, NAMES[i], EXR_PIXEL_FLOAT,
                                           EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1)))
            return false;
    }
    i32 rows = 0;
    if (!set_texts(stream, options) || !check(stream, exr_write_header(stream->context)) ||
        !check(stream, exr_get_scanlines_per_chunk(stream->context, part, &rows)))
        return false;
    stream->chunk_rows = (u32)rows;
    return true;
}

bool exr_stream_available(void)
{
    return true;
}

ExrStream *exr_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    ExrStream *stream = calloc(1, sizeof *stream);
    if (!stream) {
        error_set(error, ERROR_MEMORY, "no memory to write an EXR");
        return NULL;
    }
    begin_call(stream, error);
    stream->sink = sink;
    stream->width = width;
    stream->height = height;
    bool done = write_header(stream, options);
    if (done) {
        stream->chunk = calloc((size_t)width * stream->chunk_rows, CHANNELS * sizeof(f32));
        done = stream->chunk || error_set(error, ERROR_MEMORY, "no memory to write an EXR");
    }
    if (!done) {
        exr_stream_destroy(stream);
        return NULL;
    }
    return stream;
}

// ---- rows -----------------------------------------------------------------------------------

// Channels are in the order of their names, B G R; the rows have R G B side by side.
static void aim(ExrStream *stream)
{
    for (int i = 0; i < CHANNELS; i++) {
        exr_coding_channel_info_t *channel = &stream->pipeline.channels[i];
        channel->encode_from_ptr = (const u8 *)(stream->chunk + (CHANNELS - 1 - i));
        channel->user_bytes_per_element = sizeof(f32);
        channel->user_data_type = EXR_PIXEL_FLOAT;
        channel->user_pixel_stride = CHANNELS * sizeof(f32);
        channel->user_line_stride = (i32)(stream->width * CHANNELS * sizeof(f32));
    }
}

// Writes the chunk whose first row is y.
static bool write_chunk(ExrStream *stream, u32 y)
{
    exr_chunk_info_t chunk = {0};
    const exr_context_t context = stream->context;
    const bool first = !stream->pipeline_ready;
    if (!check(stream, exr_write_scanline_chunk_info(context, 0, (i32)y, &chunk)) ||
        !check(stream, first ? exr_encoding_initialize(context, 0, &chunk, &stream->pipeline)
                             : exr_encoding_update(context, 0, &chunk, &stream->pipeline)))
        return false;
    stream->pipeline_ready = true;
    aim(stream);
    return (!first || check(stream, exr_encoding_choose_default_routines(context, 0, &stream->pipeline))) &&
           check(stream, exr_encoding_run(context, 0, &stream->pipeline));
}

bool exr_stream_write_row(ExrStream *stream, const f32 *rgb, Error *error)
{
    assert(stream->row < stream->height);
    begin_call(stream, error);
    const size_t count = (size_t)stream->width * CHANNELS;
    const u32 row = stream->row % stream->chunk_rows;
    memcpy(stream->chunk + row * count, rgb, count * sizeof(f32));
    stream->row++;
    const bool full = row + 1 == stream->chunk_rows || stream->row == stream->height;
    return !full || write_chunk(stream, stream->row - 1 - row);
}

bool exr_stream_finish(ExrStream *stream, Error *error)
{
    assert(stream->row == stream->height);
    begin_call(stream, error);
    if (stream->pipeline_ready)
        exr_encoding_destroy(stream->context, &stream->pipeline);
    stream->pipeline_ready = false;
    return check(stream, exr_finish(&stream->context)); // writes where the chunks are
}

void exr_stream_destroy(ExrStream *stream)
{
    if (!stream)
        return;
    Error ignored; // of a file that is given up
    begin_call(stream, &ignored);
    if (stream->pipeline_ready)
        exr_encoding_destroy(stream->context, &stream->pipeline);
    if (stream->context)
        exr_finish(&stream->context);
    free(stream->chunk);
    free(stream);
}

#else

bool exr_stream_available(void)
{
    return false;
}

ExrStream *exr_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    (void)sink;
    (void)options;
    (void)width;
    (void)height;
    error_set(error, ERROR_USAGE, "this build writes no OpenEXR; OpenEXRCore was not there when it was made");
    return NULL;
}

bool exr_stream_write_row(ExrStream *stream, const f32 *rgb, Error *error)
{
    (void)stream;
    (void)rgb;
    return error_set(error, ERROR_USAGE, "this build writes no OpenEXR");
}

bool exr_stream_finish(ExrStream *stream, Error *error)
{
    (void)stream;
    return error_set(error, ERROR_USAGE, "this build writes no OpenEXR");
}

void exr_stream_destroy(ExrStream *stream)
{
    (void)stream;
}

#endif
