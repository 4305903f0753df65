// Arena: memory that lives and dies together. One arena a lifetime (run, scene, render).
#ifndef CLRT_BASE_ARENA_H
#define CLRT_BASE_ARENA_H

#include "base/types.h"

typedef struct Arena Arena;

// Returns NULL when memory is exhausted.
Arena *arena_create(void);

// Frees everything that came from the arena; takes NULL.
void arena_destroy(Arena *arena);

// count * size zeroed bytes, aligned for any type; NULL when the product overflows or memory is
// exhausted. A count of 0 gives a valid pointer to nothing.
void *arena_alloc(Arena *arena, size_t count, size_t size);

// Moves old_count elements of size bytes at memory (which came from this arena, or is NULL) to a place with
// room for new_count >= old_count; the new elements are not zeroed. NULL when memory is exhausted.
// An array above 64 KiB grows in place and leaves nothing behind.
void *arena_resize(Arena *arena, void *memory, size_t old_count, size_t new_count, size_t size);

// Room for one more element in an array of count elements that grows only by this function, by
// doubling; returns the array, perhaps elsewhere, or NULL when memory is exhausted.
void *arena_grow(Arena *arena, void *array, size_t count, size_t size);

// A copy of the length bytes at text with a terminating 0; NULL when memory is exhausted.
char *arena_copy_text(Arena *arena, const char *text, size_t length);

#endif
