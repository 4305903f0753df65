// EXR files made by the library for tests: one part of any kind, with the given channels.
#ifndef CLRT_TESTS_IMAGE_BITMAP_EXR_FIXTURE_H
#define CLRT_TESTS_IMAGE_BITMAP_EXR_FIXTURE_H

#include "image_bitmap_fixture.h"

#include <openexr.h>

enum { EXR_WIDTH = 75, EXR_HEIGHT = 53, EXR_CHANNELS_MAX = 6 };

typedef struct ExrCase {
    const char *names[EXR_CHANNELS_MAX]; // in alphabetical order
    exr_pixel_type_t types[EXR_CHANNELS_MAX];
    exr_compression_t compression;
    u32 tile;      // side; 0: scanlines
    bool mip_maps; // of tiles
    int left, top; // of the data window
    bool second_part;
} ExrCase;

// The value of a channel, told by its last letter; exact as a half and as a whole number.
static inline f32 exr_sample(u32 x, u32 y, const char *name)
{
    const char letter = name[strlen(name) - 1];
    return (f32)((x * 31 + y * 17 + (u32)letter * 7) % 1024);
}

static inline u16 exr_half(f32 value) // of a whole number below 2048
{
    int exponent = 0;
    u32 whole = (u32)value;
    if (whole == 0)
        return 0;
    while (whole >> (exponent + 1))
        exponent++;
    return (u16)((u32)(exponent + 15) << 10 | ((whole << (10 - exponent)) & 0x3ff));
}

static inline int64_t exr_on_write(exr_const_context_t context, void *user, const void *data, uint64_t size,
                                   uint64_t offset, exr_stream_error_func_ptr_t on_error)
{
    (void)context;
    (void)on_error;
    Bytes *bytes = user;
    assert_true(offset + size <= BYTES_MAX);
    memcpy(bytes->data + offset, data, size);
    if (bytes->size < offset + size)
        bytes->size = offset + size;
    return (int64_t)size;
}

static inline void exr_add_part_of(exr_context_t context, const ExrCase *c, const char *name)
{
    int part;
    const exr_storage_t storage = c->tile ? EXR_STORAGE_TILED : EXR_STORAGE_SCANLINE;
    assert_int_equal(exr_add_part(context, name, storage, &part), 0);
    const exr_attr_box2i_t data = {{.x = c->left, .y = c->top},
                                   {.x = c->left + EXR_WIDTH - 1, .y = c->top + EXR_HEIGHT - 1}};
    const exr_attr_v2f_t center = {.x = 0, .y = 0};
    assert_int_equal(exr_initialize_required_attr(context, part, &data, &data, 1, &center, 1,
                                                  EXR_LINEORDER_INCREASING_Y, c->compression), 0);
    if (c->tile)
        assert_int_equal(exr_set_tile_descriptor(context, part, c->tile, c->tile,
                                                 c->mip_maps ? EXR_TILE_MIPMAP_LEVELS : EXR_TILE_ONE_LEVEL,
                                                 EXR_TILE_ROUND_DOWN), 0);
    for (int i = 0; i < EXR_CHANNELS_MAX && c->names[i]; i++)
        assert_int_equal(exr_add_channel(context, part, c->names[i], c->types[i],
                                         EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1), 0);
}

// Encodes the chunk whose top left pixel is x, y of the picture (of a smaller level: what stands there).
static inline void exr_encode(exr_context_t context, int part, const exr_chunk_info_t *chunk, u32 x, u32 y)
{
    static u8 pixels[EXR_CHANNELS_MAX][EXR_WIDTH * EXR_HEIGHT * 4];
    exr_encode_pipeline_t pipeline = EXR_ENCODE_PIPELINE_INITIALIZER;
    assert_int_equal(exr_encoding_initialize(context, part, chunk, &pipeline), 0);
    for (int i = 0; i < pipeline.channel_count; i++) {
        exr_coding_channel_info_t *channel = &pipeline.channels[i];
        const u32 width = (u32)channel->width;
        for (u32 k = 0; k < width * (u32)channel->height; k++) {
            const f32 value = exr_sample(x + k % width, y + k / width, channel->channel_name);
            const u32 whole = (u32)value;
            const u16 half = exr_half(value);
            if (channel->data_type == EXR_PIXEL_HALF)
                memcpy(&pixels[i][2 * k], &half, 2);
            else if (channel->data_type == EXR_PIXEL_UINT)
                memcpy(&pixels[i][4 * k], &whole, 4);
            else
                memcpy(&pixels[i][4 * k], &value, 4);
        }
        channel->user_pixel_stride = channel->bytes_per_element;
        channel->user_line_stride = (int32_t)width * channel->bytes_per_element;
        channel->encode_from_ptr = pixels[i];
    }
    assert_int_equal(exr_encoding_choose_default_routines(context, part, &pipeline), 0);
    assert_int_equal(exr_encoding_run(context, part, &pipeline), 0);
    exr_encoding_destroy(context, &pipeline);
}

static inline void exr_write_tiles(exr_context_t context, int part, int level, u32 tile)
{
    int32_t width, height;
    assert_int_equal(exr_get_level_sizes(context, part, level, level, &width, &height), 0);
    for (int row = 0; row * (int)tile < height; row++) {
        for (int column = 0; column * (int)tile < width; column++) {
            exr_chunk_info_t chunk = {0};
            assert_int_equal(exr_write_tile_chunk_info(context, part, column, row, level, level, &chunk), 0);
            exr_encode(context, part, &chunk, (u32)column * tile, (u32)row * tile);
        }
    }
}

static inline void exr_write_scanlines(exr_context_t context, int part, const ExrCase *c)
{
    int32_t lines;
    assert_int_equal(exr_get_scanlines_per_chunk(context, part, &lines), 0);
    for (int y = 0; y < EXR_HEIGHT; y += lines) {
        exr_chunk_info_t chunk = {0};
        assert_int_equal(exr_write_scanline_chunk_info(context, part, c->top + y, &chunk), 0);
        exr_encode(context, part, &chunk, 0, (u32)y);
    }
}

static inline Bytes make_exr(const ExrCase *c)
{
    Bytes bytes = bytes_begin();
    exr_context_t context;
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.user_data = &bytes;
    start.write_fn = exr_on_write;
    assert_int_equal(exr_start_write(&context, "t", EXR_WRITE_FILE_DIRECTLY, &start), 0);
    exr_add_part_of(context, c, c->second_part ? "first" : NULL);
    if (c->second_part)
        exr_add_part_of(context, &(ExrCase){.names = {"Z"}, .types = {EXR_PIXEL_FLOAT}}, "second");
    assert_int_equal(exr_write_header(context), 0);
    for (int level = 0; c->tile && (level == 0 || (c->mip_maps && EXR_WIDTH >> level)); level++)
        exr_write_tiles(context, 0, level, c->tile);
    if (!c->tile)
        exr_write_scanlines(context, 0, c);
    if (c->second_part)
        exr_write_scanlines(context, 1, &(ExrCase){.names = {"Z"}});
    assert_int_equal(exr_finish(&context), 0);
    return bytes;
}

#endif
