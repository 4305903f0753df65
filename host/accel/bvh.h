// BVH build: binned surface-area heuristic (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007), two-way, then collapsed to eight-way nodes by opening the largest child first
// (Wald, Benthin, Boulos, "Getting rid of packets", 2008). Sees boxes, knows no shapes and no device.
#ifndef CLRT_ACCEL_BVH_H
#define CLRT_ACCEL_BVH_H

#include "base/error.h"
#include "base/types.h"
#include "shared/bvh.h"

typedef struct Box {
    f32 min[3], max[3]; // finite, min <= max
} Box;

// What is built over. The first `singles` boxes are primitives that take a leaf each; the others are
// triangles, of which up to eight share a leaf, one block.
typedef struct BvhInput {
    const Box *boxes;
    u32 count;   // 1 .. 2^30
    u32 singles; // 0 .. count
    u32 first_node, first_single, first_block; // where the results will stand in arrays of their kinds
} BvhInput;

typedef struct Bvh {
    BvhNode *nodes; // [0] is the root
    u32 node_count;
    u32 *singles; // singles[i]: index in the input of the primitive that leaf index first_single + i means
    u32 single_count;
    u32 *blocks; // blocks[8 b + k]: index in the input of triangle k of leaf index first_block + b; the
    u32 block_count; // unused ones, last, are 0xffffffff
} Bvh;

// References in the nodes are absolute: they count from first_node, first_single and first_block. The same
// input gives the same tree for any number of threads. *bvh is the caller's to destroy; untouched on failure
// (ERROR_MEMORY).
bool bvh_build(const BvhInput *input, Bvh *bvh, Error *error);

// Frees what bvh_build made; a zeroed Bvh is fine.
void bvh_destroy(Bvh *bvh);

#endif
