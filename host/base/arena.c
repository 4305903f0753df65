#include "base/arena.h"

#include <stdalign.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

enum { BLOCK_BYTES = 64 * 1024 };

typedef struct Block Block;
struct Block {
    Block *next;
    size_t used;
    size_t capacity;
    alignas(max_align_t) unsigned char bytes[];
};

struct Arena {
    Block *blocks; // the one being filled first
};

Arena *arena_create(void)
{
    return calloc(1, sizeof(Arena));
}

void arena_destroy(Arena *arena)
{
    if (!arena)
        return;
    for (Block *block = arena->blocks; block;) {
        Block *next = block->next;
        free(block);
        block = next;
    }
    free(arena);
}

// Bytes that count elements of size take in a block; false where they are more than memory can hold.
static bool padded_bytes(size_t count, size_t size, size_t *bytes)
{
    if (__builtin_mul_overflow(count, size, bytes) || *bytes > SIZE_MAX / 2)
        return false;
    const size_t align = alignof(max_align_t);
    *bytes = (*bytes + align - 1) / align * align;
    return true;
}

void *arena_alloc(Arena *arena, size_t count, size_t size)
{
    size_t bytes;
    if (!padded_bytes(count, size, &bytes))
        return NULL;
    Block *block = arena->blocks;
    if (!block || block->capacity - block->used < bytes) {
        const size_t capacity = bytes > BLOCK_BYTES ? bytes : BLOCK_BYTES;
        block = calloc(1, sizeof *block + capacity);
        if (!block)
            return NULL;
        block->capacity = capacity;
        block->next = arena->blocks;
        arena->blocks = block;
    }
    void *memory = block->bytes + block->used;
    block->used += bytes;
    return memory;
}

void *arena_resize(Arena *arena, void *memory, size_t old_count, size_t new_count, size_t size)
{
    size_t old_bytes, new_bytes;
    if (!padded_bytes(old_count, size, &old_bytes) || !padded_bytes(new_count, size, &new_bytes))
        return NULL;
    if (memory && old_bytes > BLOCK_BYTES) {
        Block **link = &arena->blocks;
        while ((void *)(*link)->bytes != memory)
            link = &(*link)->next;
        Block *block = realloc(*link, sizeof *block + new_bytes);
        if (!block)
            return NULL;
        block->used = block->capacity = new_bytes;
        *link = block;
        return block->bytes;
    }
    void *moved = arena_alloc(arena, new_count, size);
    if (moved && memory)
        memcpy(moved, memory, old_count * size);
    return moved;
}

void *arena_grow(Arena *arena, void *array, size_t count, size_t size)
{
    enum { FIRST = 8 };
    if (count == 0)
        return arena_alloc(arena, FIRST, size);
    // The capacity is the power of two at or above count, so that it need not be stored.
    const bool full = count >= FIRST && (count & (count - 1)) == 0;
    return full ? arena_resize(arena, array, count, 2 * count, size) : array;
}

char *arena_copy_text(Arena *arena, const char *text, size_t length)
{
    char *copy = arena_alloc(arena, length + 1, 1);
    if (copy)
        memcpy(copy, text, length);
    return copy;
}
