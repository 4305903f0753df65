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

// A copy of the length bytes at text with a terminating 0; NULL when memory is exhausted.
char *arena_copy_text(Arena *arena, const char *text, size_t length);

#endif
