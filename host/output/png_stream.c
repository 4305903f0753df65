#include "output/png_stream.h"

#include <png.h>
#include <setjmp.h>
#include <stdlib.h>
#include <string.h>

struct PngStream {
    Sink *sink;
    png_structp png;
    png_infop info;
    Error *error; // of the call under way
};

// Level and filter, measured with libpng 1.6.39 and zlib 1.2.13 on one core of an EPYC on a ray-traced
// picture of three shapes on a checkered floor, 800 x 600, 8 bits (best of 4, milliseconds and KiB; the same
// picture antialiased gives the same order):
//   level 1: none 13 186, sub 13 144, up 18 150, average 15 157, Paeth 16 149, libpng's choice 28 149
//   level 2: sub 17 138; level 3: sub 24 127; level 6: sub 56 101; level 1, run lengths only: sub 13 138
enum { LEVEL = 1, FILTER = PNG_FILTER_SUB };

static void on_error(png_structp png, png_const_charp message)
{
    PngStream *stream = png_get_error_ptr(png);
    if (stream->error->code == ERROR_NONE)
        error_set(stream->error, ERROR_IO, "PNG: %s", message);
    png_longjmp(png, 1);
}

static void on_warning(png_structp png, png_const_charp message)
{
    (void)png;
    (void)message;
}

static void on_write(png_structp png, png_bytep bytes, size_t length)
{
    PngStream *stream = png_get_io_ptr(png);
    if (!sink_write(stream->sink, bytes, length, stream->error))
        png_longjmp(png, 1);
}

// The sink buffers and flushes.
static void on_flush(png_structp png)
{
    (void)png;
}

static bool is_ascii(const char *text)
{
    for (; *text; text++) {
        if ((unsigned char)*text >= 0x80)
            return false;
    }
    return true;
}

// tEXt is Latin-1; where UTF-8 says more than ASCII, it goes into iTXt.
static void set_texts(PngStream *stream, png_textp room, const OutputText *texts, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        // libpng copies both and writes to neither.
        room[i].key = (char *)(uintptr_t)texts[i].key;
        room[i].text = (char *)(uintptr_t)texts[i].text;
        room[i].compression = is_ascii(texts[i].text) ? PNG_TEXT_COMPRESSION_NONE : PNG_ITXT_COMPRESSION_NONE;
    }
    png_set_text(stream->png, stream->info, room, (int)count);
}

static bool write_header(PngStream *stream, png_textp texts, const OutputOptions *options, u32 width,
                         u32 height)
{
    png_structp png = stream->png;
    if (setjmp(png_jmpbuf(png)))
        return false;
    png_set_write_fn(png, stream, on_write, on_flush);
    png_set_IHDR(png, stream->info, width, height, (int)options->bits, PNG_COLOR_TYPE_RGB, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    if (options->settings.encoding == ENCODING_SRGB)
        png_set_sRGB(png, stream->info, PNG_sRGB_INTENT_PERCEPTUAL);
    else
        png_set_gAMA_fixed(png, stream->info, PNG_FP_1);
    set_texts(stream, texts, options->texts, options->text_count);
    png_set_compression_level(png, LEVEL);
    png_set_filter(png, PNG_FILTER_TYPE_BASE, FILTER);
    png_write_info(png, stream->info);
    return true;
}

PngStream *png_stream_create(Sink *sink, const OutputOptions *options, u32 width, u32 height, Error *error)
{
    error->code = ERROR_NONE;
    PngStream *stream = calloc(1, sizeof *stream);
    png_textp texts = calloc(options->text_count + 1, sizeof *texts);
    if (stream && texts) {
        stream->sink = sink;
        stream->error = error;
        stream->png = png_create_write_struct(PNG_LIBPNG_VER_STRING, stream, on_error, on_warning);
        stream->info = stream->png ? png_create_info_struct(stream->png) : NULL;
    }
    bool done = false;
    if (stream && stream->info)
        done = write_header(stream, texts, options, width, height);
    else
        error_set(error, ERROR_MEMORY, "no memory to write a PNG");
    free(texts);
    if (!done) {
        png_stream_destroy(stream);
        return NULL;
    }
    return stream;
}

bool png_stream_write_row(PngStream *stream, const u8 *levels, Error *error)
{
    stream->error = error;
    error->code = ERROR_NONE;
    if (setjmp(png_jmpbuf(stream->png)))
        return false;
    png_write_row(stream->png, levels);
    return true;
}

static bool keep_texts(PngStream *stream, png_textp room, const OutputText *texts, size_t count)
{
    if (setjmp(png_jmpbuf(stream->png)))
        return false;
    set_texts(stream, room, texts, count);
    return true;
}

bool png_stream_add_texts(PngStream *stream, const OutputText *texts, size_t count, Error *error)
{
    stream->error = error;
    error->code = ERROR_NONE;
    png_textp room = calloc(count + 1, sizeof *room);
    if (!room)
        return error_set(error, ERROR_MEMORY, "no memory to write a PNG");
    const bool done = keep_texts(stream, room, texts, count);
    free(room);
    return done;
}

bool png_stream_finish(PngStream *stream, Error *error)
{
    stream->error = error;
    error->code = ERROR_NONE;
    if (setjmp(png_jmpbuf(stream->png)))
        return false;
    png_write_end(stream->png, stream->info); // with the texts that are not written yet
    return true;
}

void png_stream_destroy(PngStream *stream)
{
    if (!stream)
        return;
    if (stream->png)
        png_destroy_write_struct(&stream->png, &stream->info);
    free(stream);
}
