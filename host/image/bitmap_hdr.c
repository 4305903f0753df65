// Radiance HDR after Ward, "Real Pixels", Graphics Gems II, and the reader of Radiance (color.c, resolu.c):
// flat pixels, runs of whole pixels (the old way) and runs by component (the new way).
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "image/bitmap_formats.h"

typedef struct Bytes {
    const u8 *next, *end;
} Bytes;

enum {
    LINE_MAX_BYTES = 256,
    RGBE = 4,
    EXPONENT_BIAS = 8 + 128, // m/256 2^(e-128) is m 2^(e-136)
    NEW_MIN = 8,             // scanlines that are shorter or longer are never in the new way
    NEW_MAX = 0x7fff,
};

static bool ends_early(Error *error)
{
    return error_set(error, ERROR_SCENE, "the file ends too early");
}

// ---- header ---------------------------------------------------------------------------------

// The next line without its line feed, cut where it is long; false where the file ends in it.
static bool read_line(Bytes *bytes, char line[LINE_MAX_BYTES])
{
    const u8 *feed = memchr(bytes->next, '\n', (size_t)(bytes->end - bytes->next));
    if (!feed)
        return false;
    size_t length = (size_t)(feed - bytes->next);
    if (length > 0 && feed[-1] == '\r')
        length--;
    if (length > LINE_MAX_BYTES - 1)
        length = LINE_MAX_BYTES - 1;
    memcpy(line, bytes->next, length);
    line[length] = 0;
    bytes->next = feed + 1;
    return true;
}

// "-Y 480" at *text: the axis, whether it is walked downwards, how far; *text is moved on.
static bool read_axis(const char **text, char *axis, bool *minus, u32 *length)
{
    const char *c = *text;
    if ((c[0] != '-' && c[0] != '+') || (c[1] != 'X' && c[1] != 'Y') || c[2] != ' ')
        return false;
    *minus = c[0] == '-';
    *axis = c[1];
    c = text_read_whole(c + 2 + strspn(c + 2, " "), length);
    if (!c || (*c && *c != ' '))
        return false;
    *text = c + strspn(c, " ");
    return true;
}

// The first axis named is that from scanline to scanline. Y points up, X to the right.
static bool read_walk(const char *line, HdrHeader *header)
{
    char axes[2];
    bool minus[2];
    u32 lengths[2];
    if (!read_axis(&line, &axes[0], &minus[0], &lengths[0]) ||
        !read_axis(&line, &axes[1], &minus[1], &lengths[1]) || *line || axes[0] == axes[1])
        return false;
    const int x = axes[0] == 'Y', y = !x; // which of the two is X, which Y
    header->by_columns = axes[0] == 'X';
    header->width = lengths[x];
    header->height = lengths[y];
    header->from_right = minus[x];
    header->from_bottom = !minus[y];
    return true;
}

bool hdr_read_header(const u8 *bytes, size_t size, HdrHeader *header, Error *error)
{
    Bytes rest = {bytes, bytes + size};
    char line[LINE_MAX_BYTES];
    do {
        if (!read_line(&rest, line))
            return ends_early(error);
        if (strncmp(line, "FORMAT=", 7) == 0 && strcmp(line + 7, "32-bit_rle_rgbe") != 0)
            return error_set(error, ERROR_SCENE, "its FORMAT must be 32-bit_rle_rgbe");
    } while (line[0]);
    if (!read_line(&rest, line))
        return ends_early(error);
    if (!read_walk(line, header))
        return error_set(error, ERROR_SCENE, "its size must stand in a line like '-Y 512 +X 1024'");
    header->bytes = (size_t)(rest.next - bytes);
    return true;
}

// ---- scanlines ------------------------------------------------------------------------------

// The components of a scanline by runs: above 128 a run of that many less 128, else so many as they are.
static bool read_components(Bytes *bytes, u8 (*pixels)[RGBE], u32 count, Error *error)
{
    for (int component = 0; component < RGBE; component++) {
        for (u32 x = 0; x < count;) {
            if (bytes->end - bytes->next < 2)
                return ends_early(error);
            const u8 code = *bytes->next++;
            const u32 length = code > 128 ? code - 128u : code;
            if (length == 0 || length > count - x)
                return error_set(error, ERROR_SCENE, "a run that does not fit its scanline");
            const bool run = code > 128;
            const u32 stored = run ? 1 : length;
            if ((size_t)(bytes->end - bytes->next) < stored)
                return ends_early(error);
            for (u32 i = 0; i < length; i++)
                pixels[x++][component] = bytes->next[run ? 0 : i];
            bytes->next += stored;
        }
    }
    return true;
}

// Whole pixels; 1 1 1 n stands for n more of the one before, n 256 right after such a one, and so on.
static bool read_pixels(Bytes *bytes, u8 (*pixels)[RGBE], u32 count, Error *error)
{
    u32 shift = 0;
    for (u32 x = 0; x < count;) {
        if (bytes->end - bytes->next < RGBE)
            return ends_early(error);
        const u8 *pixel = bytes->next;
        bytes->next += RGBE;
        if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
            memcpy(pixels[x++], pixel, RGBE);
            shift = 0;
            continue;
        }
        const u64 length = (u64)pixel[3] << shift;
        if (x == 0 || length > count - x)
            return error_set(error, ERROR_SCENE, "a run that does not fit its scanline");
        for (u64 i = 0; i < length; i++, x++)
            memcpy(pixels[x], pixels[x - 1], RGBE);
        shift = shift < 24 ? shift + 8 : 24; // a fifth is beyond any scanline, unless it is of nothing
    }
    return true;
}

static bool read_scanline(Bytes *bytes, u8 (*pixels)[RGBE], u32 count, Error *error)
{
    const u8 *head = bytes->next;
    const bool whole = count < NEW_MIN || count > NEW_MAX || bytes->end - head < RGBE || head[0] != 2 ||
                       head[1] != 2 || head[2] >= 128;
    if (whole)
        return read_pixels(bytes, pixels, count, error);
    if (((u32)head[2] << 8 | head[3]) != count)
        return error_set(error, ERROR_SCENE, "a scanline of another length than the header says");
    bytes->next += RGBE;
    return read_components(bytes, pixels, count, error);
}

// ---- picture --------------------------------------------------------------------------------

typedef struct Picture {
    const HdrHeader *header;
    Bitmap *bitmap;
    f32 scales[256]; // what a mantissa is multiplied by, exactly, for each exponent
} Picture;

// Puts the pixel that is the i-th of a scanline where it belongs.
static void store_pixel(const Picture *picture, u32 line, u32 i, const u8 pixel[RGBE])
{
    const HdrHeader *header = picture->header;
    const u32 column = header->by_columns ? line : i, row = header->by_columns ? i : line;
    const u32 x = header->from_right ? header->width - 1 - column : column;
    const u32 y = header->from_bottom ? header->height - 1 - row : row;
    f32 *texel = (f32 *)bitmap_row(picture->bitmap, y) + 3 * (size_t)x;
    for (int c = 0; c < 3; c++)
        texel[c] = pixel[c] * picture->scales[pixel[3]];
}

static bool read_scanlines(Bytes *bytes, const Picture *picture, u8 (*pixels)[RGBE], Error *error)
{
    const HdrHeader *header = picture->header;
    const u32 lines = header->by_columns ? header->width : header->height;
    const u32 length = header->by_columns ? header->height : header->width;
    for (u32 line = 0; line < lines; line++) {
        if (!read_scanline(bytes, pixels, length, error))
            return false;
        for (u32 i = 0; i < length; i++)
            store_pixel(picture, line, i, pixels[i]);
    }
    return true;
}

bool bitmap_decode_hdr(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error)
{
    HdrHeader header;
    if (!hdr_read_header(bytes, size, &header, error) ||
        !bitmap_create(bitmap, header.width, header.height, 3, BITMAP_FLOAT, error))
        return false;
    Bytes rest = {bytes + header.bytes, bytes + size};
    u8(*pixels)[RGBE] = malloc(sizeof(*pixels) * (header.by_columns ? header.height : header.width));
    if (!pixels)
        return error_set(error, ERROR_MEMORY, "no memory for a scanline");
    Picture picture = {.header = &header, .bitmap = bitmap};
    for (int e = 0; e < 256; e++)
        picture.scales[e] = ldexpf(1, e - EXPONENT_BIAS);
    const bool done = read_scanlines(&rest, &picture, pixels, error);
    free(pixels);
    return done;
}
