// A table of hashes with linear probing; the order of the points alone decides what comes out.
#include "assets/weld.h"

#include <stdlib.h>
#include <string.h>

#include "scene/mesh.h"

static u64 mix(u64 hash, f64 value)
{
    const f64 positive = value + 0.0; // -0 becomes 0
    u64 bits;
    memcpy(&bits, &positive, sizeof bits);
    hash = (hash ^ bits) * 0x9e3779b97f4a7c15u;
    return hash ^ (hash >> 29);
}

static bool equal(Vec3 a, Vec3 b)
{
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

u32 weld_points(Vec3 *points, u32 count, u32 *map)
{
    size_t capacity = 16;
    while (capacity < 2 * (size_t)count)
        capacity *= 2;
    u32 *slots = malloc(capacity * sizeof *slots); // indices of points that are kept
    if (!slots)
        return MESH_NO_INDEX;
    memset(slots, 0xff, capacity * sizeof *slots);
    u32 kept = 0;
    for (u32 i = 0; i < count; ++i) {
        const Vec3 p = points[i];
        size_t slot = (size_t)mix(mix(mix(0, p.x), p.y), p.z) & (capacity - 1);
        while (slots[slot] != MESH_NO_INDEX && !equal(points[slots[slot]], p))
            slot = (slot + 1) & (capacity - 1);
        if (slots[slot] == MESH_NO_INDEX) {
            points[kept] = p;
            slots[slot] = kept++;
        }
        map[i] = slots[slot];
    }
    free(slots);
    return kept;
}
