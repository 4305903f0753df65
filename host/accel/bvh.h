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

typedef struct Bvh {
    BvhNode *nodes; // [0] is the root
    u32 node_count;
    u32 *order; // order[i]: index in the input of the primitive that stands at place i of the leaves
    u32 count;
} Bvh;

// Builds over count >= 1 boxes. References in the nodes are absolute: node indices start at first_node,
// primitive places at first_primitive. The same input gives the same tree for any number of threads.
// *bvh is the caller's to destroy; untouched on failure (ERROR_MEMORY).
bool bvh_build(const Box *boxes, u32 count, u32 first_node, u32 first_primitive, Bvh *bvh, Error *error);

// Frees what bvh_build made; a zeroed Bvh is fine.
void bvh_destroy(Bvh *bvh);

#endif
