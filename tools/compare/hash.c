#include "hash.h"

#include <string.h>

u64 hash_bytes(u64 hash, const void *bytes, size_t count)
{
    const u8 *at = bytes;
    for (size_t i = 0; i < count; i++)
        hash = (hash ^ at[i]) * 0x100000001B3u;
    return hash;
}

static u64 hash_number(u64 hash, u32 number, u32 bytes)
{
    const u8 all[4] = {(u8)number, (u8)(number >> 8), (u8)(number >> 16), (u8)(number >> 24)};
    return hash_bytes(hash, all, bytes);
}

u64 hash_image(const Image *image, u32 bytes_per_value)
{
    const u32 head[4] = {image->width, image->height, image->channels, bytes_per_value};
    u64 hash = HASH_START;
    for (int i = 0; i < 4; i++)
        hash = hash_number(hash, head[i], 4);
    const size_t count = (size_t)image->width * image->height * image->channels;
    for (size_t i = 0; i < count; i++) {
        u32 bits;
        if (bytes_per_value == 4)
            memcpy(&bits, &image->values[i], sizeof bits);
        else
            bits = (u32)image->values[i];
        hash = hash_number(hash, bits, bytes_per_value);
    }
    return hash;
}
