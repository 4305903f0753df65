// The two-way hierarchy that the wide one is made of.
#ifndef CLRT_ACCEL_BINARY_H
#define CLRT_ACCEL_BINARY_H

#include "accel/range.h"
#include "shared/bvh.h"

typedef struct BinaryNode BinaryNode;
struct BinaryNode {
    Box box;
    // Inner nodes: how to fill i = 2 .. 8 slots of a wide node with what is below this one: three bits each,
    // the slots that go to children[0], or 0: fill i - 1. Leaves: 0, which no inner node has.
    u32 choices;
    union {
        u32 count; // leaf: of its items
        u32 nodes; // inner: wide nodes below and with this one, where it is the root of one; set by collapse
    };
    union {
        u32 first;            // leaf: its first item
        BinaryNode *children; // inner: two
    };
    u32 singles, blocks; // leaves below, or itself, of each kind
};

typedef struct Binary {
    BinaryNode root;
    struct Pool *pools; // memory of the nodes, one a thread
    u32 pool_count;
} Binary;

// The slots of `slots` that go to the first child; 0: fill one slot less.
static inline u32 binary_choice(const BinaryNode *node, u32 slots)
{
    return node->choices >> (3 * (slots - 2)) & 7u;
}

// Sorts the items. False where there is no memory. *binary is the caller's to destroy either way.
bool binary_build(Item *items, const Range *range, Binary *binary);

void binary_destroy(Binary *binary);

#endif
