// BVH build: binned surface-area heuristic (Wald, "On fast construction of SAH-based bounding volume
// hierarchies", 2007), two-way, then collapsed to eight-way nodes at the least cost (Ylitie, Karras, Laine,
// "Efficient incoherent ray traversal on GPUs through compressed wide BVHs", 2017). Every input is in one
// leaf: large triangles cut into several boxes before the build cost up to twice the nodes a ray in a hall or
// a stadium, and only heaps of long needles aslant gained. Sees boxes, knows no shapes and no device.
//
// Memory of a build, beside the boxes: 32 bytes an input, and about 13 a triangle or 100 a single for the
// two-way hierarchy; the result is about 11 a triangle or 45 a single.
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
