// Bitmap: a picture in memory in the precision of its file, for textures and environments. Its values are
// those stored: nothing is decoded from sRGB here, and nothing is known of how they are looked up.
#ifndef CLRT_IMAGE_BITMAP_H
#define CLRT_IMAGE_BITMAP_H

#include "base/error.h"
#include "base/types.h"

typedef enum BitmapType {
    BITMAP_U8,    // levels 0 .. 255 stand for 0 .. 1
    BITMAP_U16,   // levels 0 .. 65535 stand for 0 .. 1
    BITMAP_HALF,  // IEEE 754 binary16, as a u16
    BITMAP_FLOAT, // f32
} BitmapType;

// So that the coordinates of texels are exact in single precision.
enum { BITMAP_SIDE_MAX = 1 << 24 };

typedef struct Bitmap {
    u32 width, height; // 1 .. BITMAP_SIDE_MAX
    u32 channels;      // 1 grey, 3 RGB; there is no alpha
    BitmapType type;
    // From page_alloc, bitmap_bytes of them: the top row first, channels of a texel side by side, no padding,
    // in the byte order of this machine. Who takes them puts NULL here.
    void *texels;
} Bitmap;

// A bitmap of zeros. Fails, and leaves *bitmap zeroed, where a size is 0 or above BITMAP_SIDE_MAX
// (ERROR_SCENE) or the texels are more than this machine's memory (ERROR_MEMORY).
bool bitmap_create(Bitmap *bitmap, u32 width, u32 height, u32 channels, BitmapType type, Error *error);

// Frees the texels and zeroes *bitmap; a zeroed Bitmap is fine.
void bitmap_destroy(Bitmap *bitmap);

// Bytes of a channel of a texel, and of all texels.
size_t bitmap_type_bytes(BitmapType type);
u64 bitmap_bytes(const Bitmap *bitmap);

// The first texel of row y, counted from the top.
void *bitmap_row(const Bitmap *bitmap, u32 y);

// The value of one channel: levels as 0 .. 1, floats as they are; exact but for the division of levels.
f64 bitmap_value(const Bitmap *bitmap, u32 x, u32 y, u32 channel);

// Makes radiance of what is none: NaN and what is below 0 (-0 too) become 0, what is infinite the largest
// finite value of the type. The number of values that were not in order; -0 counts as in order, and so do all
// levels.
u64 bitmap_repair(Bitmap *bitmap);

// The value of a binary16, exactly.
f32 half_value(u16 half);

// Reads a PNG, JPEG, Radiance HDR or OpenEXR file; its first bytes tell which. Grey stays one channel,
// palettes become RGB, alpha is left out. 8 bits a channel and less give BITMAP_U8, 16 bits BITMAP_U16, an
// EXR of halves BITMAP_HALF, other EXRs and HDR (m/256 2^(e-128), exactly) BITMAP_FLOAT. Of an animated PNG
// the default image is read, of an EXR in parts the first. Fails, and leaves *bitmap zeroed, with ERROR_IO
// (the file cannot be read, or is above FILE_BYTES_MAX), ERROR_SCENE (it is no such picture, is damaged or
// cut short, or has what is not read: CMYK, deep and chroma-subsampled EXR, or a format that this build
// lacks) or ERROR_MEMORY; the text is the reason alone, without the path.
bool bitmap_read(const char *path, Bitmap *bitmap, Error *error);

// The same for the size bytes of a file that is in memory.
bool bitmap_decode(const void *bytes, size_t size, Bitmap *bitmap, Error *error);

#endif
