// Collapse of a two-way hierarchy to eight-way nodes.
#ifndef CLRT_ACCEL_COLLAPSE_H
#define CLRT_ACCEL_COLLAPSE_H

#include "accel/bvh.h"

// Two-way node: leaf where count > 0, of the primitives at places first .. first + count - 1; else its left
// child is the next node and right is the index of the other.
typedef struct BinaryNode {
    Box box;
    u32 first;
    u32 count;
    u32 right;
} BinaryNode;

// Half of the surface of box; 0 for an empty one.
f32 box_half_area(const Box *box);

// Fills bvh->nodes and bvh->node_count from the two-way hierarchy whose root is binary[0].
bool bvh_collapse(const BinaryNode *binary, u32 first_node, u32 first_primitive, Bvh *bvh, Error *error);

#endif
