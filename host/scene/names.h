// Names: what one namespace of a scene has defined, found by hash, in the order of definition.
#ifndef CLRT_SCENE_NAMES_H
#define CLRT_SCENE_NAMES_H

#include "base/arena.h"
#include "scene/suggest.h"

typedef struct Name {
    const char *text; // length bytes and a terminating 0
    u32 length;
    u32 hash;
} Name;

// Zero-initialised it is an empty namespace. The index of a name is that of its definition.
typedef struct Names {
    Name *entries;
    u32 count;
    u32 *slots; // index + 1 of an entry, 0: free
    u32 capacity; // of slots, a power of two
} Names;

// Index of the name, -1 where it is not defined.
i32 names_find(const Names *names, const char *text, size_t length);

// Adds a name that is not defined yet; text is kept and must outlive names. False when memory is
// exhausted.
bool names_add(Names *names, Arena *arena, const char *text, size_t length);

void names_suggest(const Names *names, Suggestion *suggestion);

#endif
