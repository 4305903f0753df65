// BvhNode: eight children of a bounding volume hierarchy, planes side by side for one vector test.
#ifndef CLRT_SHARED_BVH_H
#define CLRT_SHARED_BVH_H

#include "shared/types.h"

#define BVH_WIDTH 8
// Deepest wide node is at most this many levels below its root; the builder keeps the promise and the
// traversal stack (BVH_WIDTH - 1 entries a level) relies on it.
#define BVH_MAX_DEPTH 48

// Lower and upper planes, in units of the space that the hierarchy lives in; an empty slot has
// lower +infinity and upper -infinity, which no ray hits. Filled slots come first,
// those of large boxes before small ones. child >= 0: index of a
// node; < 0: a leaf, ~(index << 1) of one primitive, or ~(index << 1 | 1) of one TriangleBlock.
typedef struct BvhNode {
    f32 lower_x[BVH_WIDTH];
    f32 lower_y[BVH_WIDTH];
    f32 lower_z[BVH_WIDTH];
    f32 upper_x[BVH_WIDTH];
    f32 upper_y[BVH_WIDTH];
    f32 upper_z[BVH_WIDTH];
    i32 child[BVH_WIDTH];
    u32 padding[BVH_WIDTH]; // to four cache lines
} BvhNode;
LAYOUT_SIZE(BvhNode, 256);
LAYOUT_OFFSET(BvhNode, upper_x, 96);
LAYOUT_OFFSET(BvhNode, child, 192);

#endif
