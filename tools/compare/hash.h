// Hash: one number for the pixels of a file, whatever compression and metadata are around them.
#ifndef CLRT_COMPARE_HASH_H
#define CLRT_COMPARE_HASH_H

#include "image/image.h"

// FNV-1a of 64 bits (Fowler, Noll, Vo), continued over `count` more bytes.
static const u64 HASH_START = 0xCBF29CE484222325u;
u64 hash_bytes(u64 hash, const void *bytes, size_t count);

// Over width, height, channels and bytes_per_value, each of 4 bytes, then the values, top row first, each of
// 1 or 2 bytes (levels) or 4 (a float's bits); all little-endian.
u64 hash_image(const Image *image, u32 bytes_per_value);

#endif
