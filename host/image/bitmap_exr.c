#include "image/bitmap_formats.h"

#ifdef CLRT_EXR

#include <openexr.h>
#include <stdio.h>
#include <string.h>

typedef struct Reader {
    const u8 *bytes;
    size_t size;
    exr_context_t context;
    exr_decode_pipeline_t pipeline;
    bool pipeline_ready;
    Bitmap *bitmap;
    exr_attr_box2i_t window;
    const char *names[3]; // of the channels that are read, as many as the bitmap has
    u32 name_count;
    char message[256]; // the library's last
    Error *error;
} Reader;

static void on_error(exr_const_context_t context, exr_result_t code, const char *message)
{
    (void)code;
    void *user = NULL;
    if (exr_get_user_data(context, &user) == EXR_ERR_SUCCESS && user) {
        Reader *reader = user;
        snprintf(reader->message, sizeof reader->message, "%s", message);
    }
}

// Fewer bytes where the file ends; the library, which reads ahead, knows how many it needs.
static int64_t on_read(exr_const_context_t context, void *user, void *buffer, uint64_t bytes, uint64_t offset,
                       exr_stream_error_func_ptr_t on_stream_error)
{
    (void)context;
    (void)on_stream_error;
    const Reader *reader = user;
    const u64 left = offset < reader->size ? reader->size - offset : 0;
    const u64 given = bytes < left ? bytes : left;
    if (given > 0)
        memcpy(buffer, reader->bytes + offset, given);
    return (int64_t)given;
}

static int64_t on_size(exr_const_context_t context, void *user)
{
    (void)context;
    const Reader *reader = user;
    return (int64_t)reader->size;
}

// Turns a result of the library into an Error.
static bool check(Reader *reader, exr_result_t result)
{
    if (result == EXR_ERR_SUCCESS)
        return true;
    const ErrorCode code = result == EXR_ERR_OUT_OF_MEMORY ? ERROR_MEMORY : ERROR_SCENE;
    return error_set(reader->error, code, "%s",
                     reader->message[0] ? reader->message : exr_get_default_error_message(result));
}

static bool refuse(Reader *reader, const char *what)
{
    return error_set(reader->error, ERROR_SCENE, "%s", what);
}

// ---- header ---------------------------------------------------------------------------------

static const exr_attr_chlist_entry_t *find_channel(const exr_attr_chlist_t *channels, const char *prefix,
                                                   size_t prefix_length, const char *name)
{
    for (int i = 0; i < channels->num_channels; i++) {
        const char *entry = channels->entries[i].name.str;
        if (strncmp(entry, prefix, prefix_length) == 0 && strcmp(entry + prefix_length, name) == 0)
            return &channels->entries[i];
    }
    return NULL;
}

// R, G and B of the layer that the prefix names.
static bool take_rgb(const exr_attr_chlist_t *channels, const char *prefix, size_t prefix_length,
                     const exr_attr_chlist_entry_t *taken[3])
{
    static const char *const NAMES[] = {"R", "G", "B"};
    for (int i = 0; i < 3; i++) {
        taken[i] = find_channel(channels, prefix, prefix_length, NAMES[i]);
        if (!taken[i])
            return false;
    }
    return true;
}

// R, G and B; else Y; else those of the first layer that has them; else the only channel beside alpha.
static u32 take_channels(const exr_attr_chlist_t *channels, const exr_attr_chlist_entry_t *taken[3])
{
    if (take_rgb(channels, "", 0, taken))
        return 3;
    taken[0] = find_channel(channels, "", 0, "Y");
    if (taken[0])
        return 1;
    u32 others = 0;
    for (int i = 0; i < channels->num_channels; i++) {
        const exr_attr_chlist_entry_t *entry = &channels->entries[i];
        const char *dot = strrchr(entry->name.str, '.');
        if (dot && take_rgb(channels, entry->name.str, (size_t)(dot + 1 - entry->name.str), taken))
            return 3;
    }
    for (int i = 0; i < channels->num_channels; i++) {
        if (strcmp(channels->entries[i].name.str, "A") == 0)
            continue;
        taken[0] = &channels->entries[i];
        others++;
    }
    return others == 1;
}

static bool choose_channels(Reader *reader, BitmapType *type)
{
    const exr_attr_chlist_t *channels = NULL;
    const exr_attr_chlist_entry_t *taken[3];
    if (!check(reader, exr_get_channels(reader->context, 0, &channels)))
        return false;
    if (find_channel(channels, "", 0, "RY") || find_channel(channels, "", 0, "BY"))
        return refuse(reader, "an EXR of luminance and chroma; its channels must be R, G and B, or Y alone");
    reader->name_count = take_channels(channels, taken);
    if (reader->name_count == 0)
        return refuse(reader, "an EXR without channels R, G and B, and without Y");
    *type = BITMAP_HALF;
    for (u32 i = 0; i < reader->name_count; i++) {
        if (taken[i]->x_sampling != 1 || taken[i]->y_sampling != 1)
            return refuse(reader, "an EXR with a channel that is stored at a lower resolution");
        if (taken[i]->pixel_type != EXR_PIXEL_HALF)
            *type = BITMAP_FLOAT;
        reader->names[i] = taken[i]->name.str;
    }
    return true;
}

// ---- pixels ---------------------------------------------------------------------------------

// Has the pipeline store its chunk with the top left pixel at x, y of the bitmap.
static bool aim(Reader *reader, u32 x, u32 y)
{
    const Bitmap *bitmap = reader->bitmap;
    const size_t bytes = bitmap_type_bytes(bitmap->type);
    exr_decode_pipeline_t *pipeline = &reader->pipeline;
    for (int i = 0; i < pipeline->channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline->channels[i];
        channel->decode_to_ptr = NULL;
        for (u32 k = 0; k < reader->name_count; k++) {
            if (strcmp(channel->channel_name, reader->names[k]) != 0)
                continue;
            if (channel->width < 0 || channel->height < 0 || (u32)channel->width > bitmap->width - x ||
                (u32)channel->height > bitmap->height - y)
                return refuse(reader, "a part of the picture that reaches beyond it");
            channel->decode_to_ptr =
                (u8 *)bitmap_row(bitmap, y) + ((size_t)x * bitmap->channels + k) * bytes;
            channel->user_bytes_per_element = (int16_t)bytes;
            channel->user_data_type = bytes == 2 ? EXR_PIXEL_HALF : EXR_PIXEL_FLOAT;
            channel->user_pixel_stride = (int32_t)(bitmap->channels * bytes);
            channel->user_line_stride = (int32_t)(bitmap->width * bitmap->channels * bytes);
        }
    }
    return true;
}

static bool decode_chunk(Reader *reader, const exr_chunk_info_t *chunk, u32 x, u32 y)
{
    exr_decode_pipeline_t *pipeline = &reader->pipeline;
    const exr_const_context_t context = reader->context;
    const bool first = !reader->pipeline_ready;
    if (!check(reader, first ? exr_decoding_initialize(context, 0, chunk, pipeline)
                             : exr_decoding_update(context, 0, chunk, pipeline)))
        return false;
    reader->pipeline_ready = true;
    return aim(reader, x, y) &&
           (!first || check(reader, exr_decoding_choose_default_routines(context, 0, pipeline))) &&
           check(reader, exr_decoding_run(context, 0, pipeline));
}

static bool read_scanlines(Reader *reader)
{
    int32_t lines = 0;
    if (!check(reader, exr_get_scanlines_per_chunk(reader->context, 0, &lines)))
        return false;
    for (i64 y = reader->window.min.y; y <= reader->window.max.y; y += lines) {
        exr_chunk_info_t chunk = {0};
        if (!check(reader, exr_read_scanline_chunk_info(reader->context, 0, (int)y, &chunk)) ||
            !decode_chunk(reader, &chunk, 0, (u32)(y - reader->window.min.y)))
            return false;
    }
    return true;
}

// The level of full resolution.
static bool read_tiles(Reader *reader)
{
    int32_t width = 0, height = 0;
    if (!check(reader, exr_get_tile_sizes(reader->context, 0, 0, 0, &width, &height)))
        return false;
    if (width <= 0 || height <= 0)
        return refuse(reader, "tiles without a size");
    int row = 0;
    for (u32 y = 0; y < reader->bitmap->height; y += (u32)height, row++) {
        int column = 0;
        for (u32 x = 0; x < reader->bitmap->width; x += (u32)width, column++) {
            exr_chunk_info_t chunk = {0};
            if (!check(reader, exr_read_tile_chunk_info(reader->context, 0, column, row, 0, 0, &chunk)) ||
                !decode_chunk(reader, &chunk, x, y))
                return false;
        }
    }
    return true;
}

static bool read_image(Reader *reader)
{
    BitmapType type = BITMAP_FLOAT;
    exr_storage_t storage;
    if (!check(reader, exr_get_storage(reader->context, 0, &storage)))
        return false;
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        return refuse(reader, "a deep EXR, which is not read");
    if (!check(reader, exr_get_data_window(reader->context, 0, &reader->window)) ||
        !choose_channels(reader, &type))
        return false;
    const exr_attr_box2i_t *window = &reader->window;
    const i64 width = (i64)window->max.x - window->min.x + 1, height = (i64)window->max.y - window->min.y + 1;
    if (width <= 0 || height <= 0 || width > UINT32_MAX || height > UINT32_MAX)
        return refuse(reader, "an EXR with an empty data window");
    if (!bitmap_create(reader->bitmap, (u32)width, (u32)height, reader->name_count, type, reader->error))
        return false;
    return storage == EXR_STORAGE_TILED ? read_tiles(reader) : read_scanlines(reader);
}

bool bitmap_decode_exr(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    Reader reader = {.bytes = bytes, .size = size, .bitmap = bitmap, .error = error};
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = on_error;
    start.user_data = &reader;
    start.read_fn = on_read;
    start.size_fn = on_size;
    const bool done =
        check(&reader, exr_start_read(&reader.context, "picture", &start)) && read_image(&reader);
    if (reader.pipeline_ready)
        exr_decoding_destroy(reader.context, &reader.pipeline);
    if (reader.context)
        exr_finish(&reader.context);
    return done;
}

#else

bool bitmap_decode_exr(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    (void)bytes;
    (void)size;
    (void)bitmap;
    return error_set(error, ERROR_SCENE,
                     "this build reads no OpenEXR; OpenEXRCore was not there when it was made");
}

#endif
