#include "base/hash.h"

#include <string.h>

static const u64 PRIME1 = 0x9E3779B185EBCA87u, PRIME2 = 0xC2B2AE3D27D4EB4Fu, PRIME3 = 0x165667B19E3779F9u,
                 PRIME4 = 0x85EBCA77C2B2AE63u, PRIME5 = 0x27D4EB2F165667C5u;

static u64 rotate(u64 x, u32 bits)
{
    return x << bits | x >> (64 - bits);
}

// Numbers are read with their low byte first, on every machine.
static u64 read64(const u8 *bytes)
{
    u64 value = 0;
    for (u32 i = 0; i < 8; i++)
        value |= (u64)bytes[i] << 8 * i;
    return value;
}

static u64 read32(const u8 *bytes)
{
    return (u64)bytes[0] | (u64)bytes[1] << 8 | (u64)bytes[2] << 16 | (u64)bytes[3] << 24;
}

static u64 round_lane(u64 lane, u64 input)
{
    return rotate(lane + input * PRIME2, 31) * PRIME1;
}

static void add_block(Hash *hash, const u8 *block)
{
    for (u32 i = 0; i < 4; i++)
        hash->lanes[i] = round_lane(hash->lanes[i], read64(block + 8 * i));
}

Hash hash_start(void)
{
    return (Hash){.lanes = {PRIME1 + PRIME2, PRIME2, 0, 0 - PRIME1}};
}

void hash_add(Hash *hash, const void *bytes, size_t length)
{
    const u8 *next = bytes;
    const size_t kept = hash->length % sizeof hash->rest;
    hash->length += length;
    if (kept > 0 && kept + length >= sizeof hash->rest) {
        const size_t missing = sizeof hash->rest - kept;
        memcpy(hash->rest + kept, next, missing);
        add_block(hash, hash->rest);
        next += missing;
        length -= missing;
    } else if (kept > 0) {
        memcpy(hash->rest + kept, next, length);
        return;
    }
    for (; length >= sizeof hash->rest; length -= sizeof hash->rest, next += sizeof hash->rest)
        add_block(hash, next);
    if (length > 0)
        memcpy(hash->rest, next, length);
}

static u64 mix_rest(u64 value, const u8 *rest, size_t length)
{
    for (; length >= 8; length -= 8, rest += 8)
        value = rotate(value ^ round_lane(0, read64(rest)), 27) * PRIME1 + PRIME4;
    for (; length >= 4; length -= 4, rest += 4)
        value = rotate(value ^ read32(rest) * PRIME1, 23) * PRIME2 + PRIME3;
    for (; length > 0; length--, rest++)
        value = rotate(value ^ *rest * PRIME5, 11) * PRIME1;
    return value;
}

u64 hash_value(const Hash *hash)
{
    const u64 *lanes = hash->lanes;
    u64 value = PRIME5;
    if (hash->length >= sizeof hash->rest) {
        value = rotate(lanes[0], 1) + rotate(lanes[1], 7) + rotate(lanes[2], 12) + rotate(lanes[3], 18);
        for (u32 i = 0; i < 4; i++)
            value = (value ^ round_lane(0, lanes[i])) * PRIME1 + PRIME4;
    }
    value = mix_rest(value + hash->length, hash->rest, hash->length % sizeof hash->rest);
    value = (value ^ value >> 33) * PRIME2;
    value = (value ^ value >> 29) * PRIME3;
    return value ^ value >> 32;
}
