// Hash: XXH64 of a stream of bytes (Collet, "xxHash fast digest algorithm", version 0.1.1, seed 0): tells
// apart what differs by accident, not what somebody made alike. `xxhsum -H64` gives the same.
#ifndef CLRT_BASE_HASH_H
#define CLRT_BASE_HASH_H

#include "base/types.h"

typedef struct Hash {
    u64 lanes[4];
    u64 length; // bytes so far
    u8 rest[32]; // those of the last block that is not full
} Hash;

Hash hash_start(void);
void hash_add(Hash *hash, const void *bytes, size_t length);
// Of all that was added; more may follow.
u64 hash_value(const Hash *hash);

#endif
