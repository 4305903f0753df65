// Collapse of the two-way hierarchy to eight-way nodes.
#ifndef CLRT_ACCEL_COLLAPSE_H
#define CLRT_ACCEL_COLLAPSE_H

#include "accel/binary.h"
#include "accel/bvh.h"

// Fills *bvh, a zeroed one. False where there is no memory; what *bvh has then is the caller's to destroy.
bool bvh_collapse(const BvhInput *input, const Item *items, Binary *binary, Bvh *bvh);

#endif
