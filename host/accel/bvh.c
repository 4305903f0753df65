#include "accel/bvh.h"

#include <string.h>

#include "accel/binary.h"
#include "accel/collapse.h"
#include "base/memory.h"
#include "shared/mesh.h"

bool bvh_build(const BvhInput *input, Bvh *bvh, Error *error)
{
    const u64 bytes = sizeof(Item) * (u64)input->count;
    Item *items = page_alloc(bytes);
    Binary binary = { .pools = NULL };
    Bvh result = { .nodes = NULL };
    bool ok = items != NULL;
    if (ok) {
        const Range all = range_create(input, items);
        ok = binary_build(items, &all, &binary) && bvh_collapse(input, items, &binary, &result);
    }
    binary_destroy(&binary);
    page_free(items, bytes);
    if (!ok) {
        bvh_destroy(&result);
        return error_set(error, ERROR_MEMORY, "no memory for the hierarchy of %u primitives", input->count);
    }
    *bvh = result;
    return true;
}

void bvh_destroy(Bvh *bvh)
{
    page_free(bvh->nodes, sizeof(BvhNode) * (u64)bvh->node_count);
    page_free(bvh->singles, sizeof(u32) * (u64)bvh->single_count);
    page_free(bvh->blocks, sizeof(u32) * BLOCK_WIDTH * (u64)bvh->block_count);
    memset(bvh, 0, sizeof *bvh);
}
