// The readers of bitmap_decode, a file each. Each is given all bytes of a file that begins as its format
// does, and a zeroed *bitmap; it may fail with the bitmap created, which the caller then destroys. Of errors
// as bitmap_read.
#ifndef CLRT_IMAGE_BITMAP_FORMATS_H
#define CLRT_IMAGE_BITMAP_FORMATS_H

#include "image/bitmap.h"

bool bitmap_decode_png(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error);
bool bitmap_decode_jpeg(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error);
bool bitmap_decode_exr(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error);

// Radiance HDR. What its header says: the picture, and how the file walks over it.
typedef struct HdrHeader {
    u32 width, height;
    bool by_columns;              // a scanline of the file is a column of the picture
    bool from_bottom, from_right; // where the walk begins
    size_t bytes;                 // of the header, its last line feed included
} HdrHeader;

bool hdr_read_header(const u8 *bytes, size_t size, HdrHeader *header, Error *error);
bool bitmap_decode_hdr(const u8 *bytes, size_t size, Bitmap *bitmap, Error *error);

#endif
