#include "image/bitmap_formats.h"

#ifdef CLRT_JPEG

#include <setjmp.h>
#include <stdio.h>

#include <jpeglib.h>

#include <jerror.h>

// A progressive picture in more scans than this is made to keep its readers busy.
enum { SCANS_MAX = 500 };

// Everything that lives across libjpeg's errors stands here and not in locals.
typedef struct Reader {
    struct jpeg_decompress_struct jpeg;
    struct jpeg_error_mgr errors;
    struct jpeg_progress_mgr progress;
    jmp_buf jump;
    Bitmap *bitmap;
    Error *error;
} Reader;

static Reader *reader_of(j_common_ptr jpeg)
{
    return jpeg->client_data;
}

static void on_error(j_common_ptr jpeg)
{
    Reader *reader = reader_of(jpeg);
    char message[JMSG_LENGTH_MAX];
    jpeg->err->format_message(jpeg, message);
    const bool memory = jpeg->err->msg_code == JERR_OUT_OF_MEMORY;
    error_set(reader->error, memory ? ERROR_MEMORY : ERROR_SCENE, "%s", message);
    longjmp(reader->jump, 1);
}

// Warnings say that pixels were made up, but for a few about what stands beside them.
static void on_message(j_common_ptr jpeg, int level)
{
    if (level >= 0)
        return;
    switch (jpeg->err->msg_code) {
    case JWRN_ADOBE_XFORM:
    case JWRN_EXTRANEOUS_DATA:
    case JWRN_JFIF_MAJOR:
        return;
    case JWRN_JPEG_EOF:
        error_set(reader_of(jpeg)->error, ERROR_SCENE, "the file ends too early");
        longjmp(reader_of(jpeg)->jump, 1);
    default:
        on_error(jpeg);
    }
}

static void on_progress(j_common_ptr jpeg)
{
    Reader *reader = reader_of(jpeg);
    if (reader->jpeg.input_scan_number <= SCANS_MAX)
        return;
    error_set(reader->error, ERROR_SCENE, "a JPEG of more than %d scans", SCANS_MAX);
    longjmp(reader->jump, 1);
}

static bool choose_colors(Reader *reader)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    switch (jpeg->jpeg_color_space) {
    case JCS_GRAYSCALE:
        jpeg->out_color_space = JCS_GRAYSCALE;
        return true;
    case JCS_RGB:
    case JCS_YCbCr:
        jpeg->out_color_space = JCS_RGB;
        return true;
    case JCS_CMYK:
    case JCS_YCCK:
        return error_set(reader->error, ERROR_SCENE, "a CMYK picture; it must be RGB or grey");
    default:
        return error_set(reader->error, ERROR_SCENE, "a JPEG of %d components, neither RGB nor grey",
                         jpeg->num_components);
    }
}

static bool read_image(Reader *reader, const u8 *bytes, size_t size)
{
    struct jpeg_decompress_struct *jpeg = &reader->jpeg;
    jpeg->err = jpeg_std_error(&reader->errors);
    jpeg->client_data = reader;
    reader->errors.error_exit = on_error;
    reader->errors.emit_message = on_message;
    if (setjmp(reader->jump))
        return false;
    jpeg_create_decompress(jpeg);
    reader->progress.progress_monitor = on_progress;
    jpeg->progress = &reader->progress;
    jpeg_mem_src(jpeg, bytes, (unsigned long)size);
    jpeg_read_header(jpeg, TRUE);
    const bool grey = jpeg->jpeg_color_space == JCS_GRAYSCALE;
    if (!choose_colors(reader) || !bitmap_create(reader->bitmap, jpeg->image_width, jpeg->image_height,
                                                 grey ? 1 : 3, BITMAP_U8, reader->error))
        return false;
    jpeg_start_decompress(jpeg);
    while (jpeg->output_scanline < jpeg->output_height) {
        JSAMPROW row = bitmap_row(reader->bitmap, jpeg->output_scanline);
        jpeg_read_scanlines(jpeg, &row, 1);
    }
    jpeg_finish_decompress(jpeg);
    return true;
}

bool bitmap_decode_jpeg(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    Reader reader = {.bitmap = bitmap, .error = error};
    const bool done = read_image(&reader, bytes, size);
    jpeg_destroy_decompress(&reader.jpeg); // also where it was not created: all of it is 0 then
    return done;
}

#else

bool bitmap_decode_jpeg(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    (void)bytes;
    (void)size;
    (void)bitmap;
    return error_set(error, ERROR_SCENE, "this build reads no JPEG; libjpeg was not there when it was made");
}

#endif
