#include <string.h>

#include "base/file.h"
#include "image/bitmap_formats.h"

typedef struct Format {
    const char *magic; // the first bytes
    size_t magic_bytes;
    bool (*decode)(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error);
} Format;

static const Format FORMATS[] = {
    {"\x89PNG\r\n\x1a\n", 8, bitmap_decode_png},
    {"\xff\xd8\xff", 3, bitmap_decode_jpeg},
    {"#?", 2, bitmap_decode_hdr},
    {"\x76\x2f\x31\x01", 4, bitmap_decode_exr},
};

bool bitmap_decode(const void *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    memset(bitmap, 0, sizeof *bitmap);
    for (size_t i = 0; i < sizeof FORMATS / sizeof *FORMATS; i++) {
        const Format *format = &FORMATS[i];
        if (size < format->magic_bytes || memcmp(bytes, format->magic, format->magic_bytes) != 0)
            continue;
        if (format->decode(bytes, size, bitmap, error))
            return true;
        bitmap_destroy(bitmap);
        return false;
    }
    return error_set(error, ERROR_SCENE, "not a PNG, JPEG, Radiance HDR or OpenEXR file");
}

bool bitmap_read(const char *path, Bitmap *bitmap, Error *error)
{
    memset(bitmap, 0, sizeof *bitmap);
    Arena *arena = arena_create();
    if (!arena)
        return error_set(error, ERROR_MEMORY, "out of memory");
    FileContent content;
    const bool done = file_read(path, true, arena, &content, error) &&
                      bitmap_decode(content.text, content.length, bitmap, error);
    arena_destroy(arena);
    return done;
}
