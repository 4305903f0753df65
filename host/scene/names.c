#include "scene/names.h"

#include <string.h>

// FNV-1a.
static u32 hash_of(const char *text, size_t length)
{
    u32 hash = 2166136261u;
    for (size_t i = 0; i < length; ++i)
        hash = (hash ^ (unsigned char)text[i]) * 16777619u;
    return hash;
}

i32 names_find(const Names *names, const char *text, size_t length)
{
    if (names->capacity == 0)
        return -1;
    const u32 hash = hash_of(text, length), mask = names->capacity - 1;
    for (u32 slot = hash & mask; names->slots[slot] != 0; slot = (slot + 1) & mask) {
        const u32 index = names->slots[slot] - 1;
        const Name *name = &names->entries[index];
        if (name->hash == hash && name->length == length && memcmp(name->text, text, length) == 0)
            return (i32)index;
    }
    return -1;
}

static void put(Names *names, u32 index)
{
    const u32 mask = names->capacity - 1;
    u32 slot = names->entries[index].hash & mask;
    while (names->slots[slot] != 0)
        slot = (slot + 1) & mask;
    names->slots[slot] = index + 1;
}

bool names_add(Names *names, Arena *arena, const char *text, size_t length)
{
    Name *entries = arena_grow(arena, names->entries, names->count, sizeof *entries);
    if (!entries)
        return false;
    names->entries = entries;
    if (2 * (u64)names->count >= names->capacity) { // half full at most
        const u32 capacity = names->capacity ? 2 * names->capacity : 32;
        u32 *slots = arena_alloc(arena, capacity, sizeof *slots);
        if (!slots)
            return false;
        names->slots = slots;
        names->capacity = capacity;
        for (u32 i = 0; i < names->count; ++i)
            put(names, i);
    }
    entries[names->count] = (Name){text, (u32)length, hash_of(text, length)};
    put(names, names->count++);
    return true;
}

void names_suggest(const Names *names, Suggestion *suggestion)
{
    for (u32 i = 0; i < names->count; ++i)
        suggest_offer(suggestion, names->entries[i].text, names->entries[i].length);
}
