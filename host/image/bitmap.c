#include "image/bitmap.h"

#include <assert.h>
#include <float.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/memory.h"

// An allocation may succeed beyond what is there, and end the program when it is written to.
static u64 memory_bytes(void)
{
#ifdef _SC_PHYS_PAGES
    const long pages = sysconf(_SC_PHYS_PAGES), bytes = sysconf(_SC_PAGESIZE);
    if (pages > 0 && bytes > 0)
        return (u64)pages * (u64)bytes;
#endif
    return SIZE_MAX;
}

bool bitmap_create(Bitmap *bitmap, u32 width, u32 height, u32 channels, BitmapType type, Error *error)
{
    assert(channels == 1 || channels == 3);
    memset(bitmap, 0, sizeof *bitmap);
    if (width == 0 || height == 0)
        return error_set(error, ERROR_SCENE, "a size of %u x %u", width, height);
    if (width > BITMAP_SIDE_MAX || height > BITMAP_SIDE_MAX)
        return error_set(error, ERROR_SCENE, "a size of %u x %u; a side may have %d", width, height,
                         BITMAP_SIDE_MAX);
    const Bitmap sized = {.width = width, .height = height, .channels = channels, .type = type};
    const u64 bytes = bitmap_bytes(&sized);
    void *texels = bytes <= memory_bytes() ? page_alloc(bytes) : NULL;
    if (!texels)
        return error_set(error, ERROR_MEMORY, "no memory for %u x %u texels of %zu bytes", width, height,
                         channels * bitmap_type_bytes(type));
    *bitmap = sized;
    bitmap->texels = texels;
    return true;
}

void bitmap_destroy(Bitmap *bitmap)
{
    page_free(bitmap->texels, bitmap_bytes(bitmap));
    memset(bitmap, 0, sizeof *bitmap);
}

size_t bitmap_type_bytes(BitmapType type)
{
    return type == BITMAP_U8 ? 1 : type == BITMAP_FLOAT ? 4 : 2;
}

// At most 2^24 x 2^24 x 12, which cannot overflow.
u64 bitmap_bytes(const Bitmap *bitmap)
{
    return (u64)bitmap->width * bitmap->height * bitmap->channels * bitmap_type_bytes(bitmap->type);
}

void *bitmap_row(const Bitmap *bitmap, u32 y)
{
    const size_t row_bytes = (size_t)bitmap->width * bitmap->channels * bitmap_type_bytes(bitmap->type);
    return (u8 *)bitmap->texels + y * row_bytes;
}

f64 bitmap_value(const Bitmap *bitmap, u32 x, u32 y, u32 channel)
{
    assert(x < bitmap->width && y < bitmap->height && channel < bitmap->channels);
    const void *row = bitmap_row(bitmap, y);
    const size_t i = (size_t)x * bitmap->channels + channel;
    switch (bitmap->type) {
    case BITMAP_U8:
        return ((const u8 *)row)[i] / 255.0;
    case BITMAP_U16:
        return ((const u16 *)row)[i] / 65535.0;
    case BITMAP_HALF:
        return (f64)half_value(((const u16 *)row)[i]);
    default:
        return (f64)((const f32 *)row)[i];
    }
}

enum { HALF_SIGN = 0x8000, HALF_INFINITY = 0x7c00, HALF_LARGEST = 0x7bff };

f32 half_value(u16 half)
{
    const int exponent = half >> 10 & 31, mantissa = half & 0x3ff;
    const f32 size = exponent == 31 ? (mantissa ? NAN : INFINITY)
                     : exponent     ? ldexpf((f32)(mantissa | 0x400), exponent - 25)
                                    : ldexpf((f32)mantissa, -24);
    return half & HALF_SIGN ? -size : size;
}

static u64 repair_halves(u16 *values, u64 count)
{
    u64 bad = 0;
    for (u64 i = 0; i < count; i++) {
        const u16 value = values[i];
        if (value < HALF_INFINITY)
            continue;
        bad += value != HALF_SIGN;
        values[i] = value == HALF_INFINITY ? HALF_LARGEST : 0;
    }
    return bad;
}

static u64 repair_floats(f32 *values, u64 count)
{
    u64 bad = 0;
    for (u64 i = 0; i < count; i++) {
        const f32 value = values[i];
        if (value <= FLT_MAX && !signbit(value))
            continue;
        bad += value != 0;
        values[i] = value > 0 ? FLT_MAX : 0;
    }
    return bad;
}

u64 bitmap_repair(Bitmap *bitmap)
{
    const u64 count = (u64)bitmap->width * bitmap->height * bitmap->channels;
    if (bitmap->type == BITMAP_HALF)
        return repair_halves(bitmap->texels, count);
    return bitmap->type == BITMAP_FLOAT ? repair_floats(bitmap->texels, count) : 0;
}
