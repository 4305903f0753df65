#include "accel/collapse.h"

#include <math.h>
#include <stdlib.h>

typedef struct Collapse {
    const BinaryNode *binary;
    BvhNode *nodes;
    u32 used, capacity;
    u32 first_node, first_primitive;
} Collapse;

// Opens the largest inner node among the children until eight are reached or only leaves are left.
static int gather_children(const BinaryNode *binary, u32 root, u32 children[BVH_WIDTH])
{
    int count = 1;
    children[0] = root;
    while (count < BVH_WIDTH) {
        int largest = -1;
        f32 largest_area = -1;
        for (int i = 0; i < count; i++) {
            const f32 area = box_half_area(&binary[children[i]].box);
            // Also where the area is no number (infinite times 0): the root at least must be opened.
            if (binary[children[i]].count == 0 && !(area <= largest_area)) {
                largest = i;
                largest_area = area;
            }
        }
        if (largest < 0)
            break;
        const u32 opened = children[largest];
        children[largest] = opened + 1;
        children[count++] = binary[opened].right;
    }
    return count;
}

static void set_slot(BvhNode *node, int slot, const Box *box, i32 child)
{
    node->lower_x[slot] = box->min[0];
    node->lower_y[slot] = box->min[1];
    node->lower_z[slot] = box->min[2];
    node->upper_x[slot] = box->max[0];
    node->upper_y[slot] = box->max[1];
    node->upper_z[slot] = box->max[2];
    node->child[slot] = child;
}

static bool reserve_node(Collapse *collapse)
{
    if (collapse->used < collapse->capacity)
        return true;
    const u32 capacity = collapse->capacity ? 2 * collapse->capacity : 16;
    BvhNode *nodes = aligned_alloc(64, capacity * sizeof *nodes);
    if (!nodes)
        return false;
    for (u32 i = 0; i < collapse->used; i++)
        nodes[i] = collapse->nodes[i];
    free(collapse->nodes);
    collapse->nodes = nodes;
    collapse->capacity = capacity;
    return true;
}

// Writes the wide node of binary node `root` and all below it; the recursion is as deep as the tree.
static bool collapse_node(Collapse *collapse, u32 root)
{
    static const Box empty = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    if (!reserve_node(collapse))
        return false;
    const u32 index = collapse->used++;
    u32 children[BVH_WIDTH];
    const int count = gather_children(collapse->binary, root, children);
    for (int slot = 0; slot < BVH_WIDTH; slot++)
        collapse->nodes[index].padding[slot] = 0;
    for (int slot = 0; slot < BVH_WIDTH; slot++) {
        if (slot >= count) {
            set_slot(&collapse->nodes[index], slot, &empty, -1);
            continue;
        }
        const BinaryNode *child = &collapse->binary[children[slot]];
        if (child->count > 0) {
            const u32 leaf = (collapse->first_primitive + child->first) << 4 | child->count;
            set_slot(&collapse->nodes[index], slot, &child->box, (i32)~leaf);
        } else {
            const u32 next = collapse->first_node + collapse->used;
            set_slot(&collapse->nodes[index], slot, &child->box, (i32)next);
            if (!collapse_node(collapse, children[slot]))
                return false;
        }
    }
    return true;
}

bool bvh_collapse(const BinaryNode *binary, u32 first_node, u32 first_primitive, Bvh *bvh, Error *error)
{
    Collapse collapse = { .binary = binary, .first_node = first_node, .first_primitive = first_primitive };
    if (!collapse_node(&collapse, 0)) {
        free(collapse.nodes);
        return error_set(error, ERROR_MEMORY, "no memory for the hierarchy of %u primitives", bvh->count);
    }
    bvh->nodes = collapse.nodes;
    bvh->node_count = collapse.used;
    return true;
}
