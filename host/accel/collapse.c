#include "accel/collapse.h"

#include <math.h>

#include "base/memory.h"
#include "shared/mesh.h"

enum { TASK_LEAVES = 1024 }; // smaller subtrees are not worth a task

typedef struct Collapse {
    const BvhInput *input;
    const Item *items;
    Bvh *bvh;
} Collapse;

// Where the results of a subtree go.
typedef struct Places {
    u32 node, single, block;
} Places;

static bool is_leaf(const BinaryNode *node)
{
    return node->choices == 0;
}

static bool is_large(const BinaryNode *node)
{
    return !is_leaf(node) && node->singles + node->blocks >= TASK_LEAVES;
}

// Appends what fills `slots` slots, or as many as there can be, with what is below node.
static void gather_slots(BinaryNode *node, u32 slots, BinaryNode *children[BVH_WIDTH], u32 *count)
{
    while (slots > 1 && !is_leaf(node)) {
        const u32 left = binary_choice(node, slots);
        if (left > 0) {
            gather_slots(&node->children[0], left, children, count);
            node = &node->children[1];
            slots -= left;
        } else {
            slots--;
        }
    }
    children[(*count)++] = node;
}

// Sets the number of wide nodes of every two-way node from root on that becomes one.
static void count_nodes(BinaryNode *root)
{
    BinaryNode *children[BVH_WIDTH];
    u32 count = 0;
    gather_slots(root, BVH_WIDTH, children, &count);
    for (u32 i = 0; i < count; i++) {
        BinaryNode *child = children[i];
        if (is_large(child)) {
#pragma omp task default(none) firstprivate(child)
            count_nodes(child);
        } else if (!is_leaf(child)) {
            count_nodes(child);
        }
    }
    if (is_large(root)) {
#pragma omp taskwait
    }
    root->nodes = 1;
    for (u32 i = 0; i < count; i++)
        root->nodes += is_leaf(children[i]) ? 0 : children[i]->nodes;
}

static void set_slot(BvhNode *node, u32 slot, const Box *box, i32 child)
{
    node->lower_x[slot] = box->min[0];
    node->lower_y[slot] = box->min[1];
    node->lower_z[slot] = box->min[2];
    node->upper_x[slot] = box->max[0];
    node->upper_y[slot] = box->max[1];
    node->upper_z[slot] = box->max[2];
    node->child[slot] = child;
    node->padding[slot] = 0;
}

// Notes what is in the leaf; returns the reference to it.
static i32 write_leaf(const Collapse *collapse, const BinaryNode *leaf, Places places)
{
    const Item *items = collapse->items + leaf->first;
    if (leaf->singles) {
        collapse->bvh->singles[places.single] = items[0].index;
        return (i32)~((collapse->input->first_single + places.single) << 1);
    }
    u32 *block = collapse->bvh->blocks + (size_t)BLOCK_WIDTH * places.block;
    for (u32 i = 0; i < BLOCK_WIDTH; i++)
        block[i] = i < leaf->count ? items[i].index : UINT32_MAX;
    return (i32)~((collapse->input->first_block + places.block) << 1 | 1);
}

static f32 half_area(const Box *box)
{
    const f32 x = box->max[0] - box->min[0], y = box->max[1] - box->min[1], z = box->max[2] - box->min[2];
    return x * y + y * z + z * x;
}

// Largest first: the order in which rays that only ask whether anything is in their way try the children (Nah,
// Manocha, "SATO: surface area traversal order for shadow ray tracing", 2014).
static void sort_slots(BinaryNode *children[BVH_WIDTH], u32 count)
{
    for (u32 i = 1; i < count; i++) {
        BinaryNode *child = children[i];
        const f32 area = half_area(&child->box);
        u32 place = i;
        for (; place > 0 && area > half_area(&children[place - 1]->box); place--)
            children[place] = children[place - 1];
        children[place] = child;
    }
}

// Writes the wide node of root and all below it, depth first: the numbers follow from the tree alone.
static void write_nodes(const Collapse *collapse, BinaryNode *root, Places places)
{
    static const Box empty = { { INFINITY, INFINITY, INFINITY }, { -INFINITY, -INFINITY, -INFINITY } };
    BinaryNode *children[BVH_WIDTH];
    u32 count = 0;
    gather_slots(root, BVH_WIDTH, children, &count);
    sort_slots(children, count);
    BvhNode *node = &collapse->bvh->nodes[places.node++];
    for (u32 slot = 0; slot < count; slot++) {
        BinaryNode *child = children[slot];
        if (is_leaf(child)) {
            set_slot(node, slot, &child->box, write_leaf(collapse, child, places));
        } else {
            set_slot(node, slot, &child->box, (i32)(collapse->input->first_node + places.node));
#pragma omp task default(none) firstprivate(collapse, child, places) if (is_large(child))
            write_nodes(collapse, child, places);
            places.node += child->nodes;
        }
        places.single += child->singles;
        places.block += child->blocks;
    }
    for (u32 slot = count; slot < BVH_WIDTH; slot++)
        set_slot(node, slot, &empty, -1);
}

bool bvh_collapse(const BvhInput *input, const Item *items, Binary *binary, Bvh *bvh)
{
    BinaryNode *root = &binary->root;
    const Collapse collapse = { input, items, bvh };
    bvh->node_count = 1;
    bvh->single_count = root->singles;
    bvh->block_count = root->blocks;
    if (!is_leaf(root)) {
#pragma omp parallel default(none) shared(root) if (is_large(root))
#pragma omp single
        count_nodes(root);
        bvh->node_count = root->nodes;
    }
    bvh->nodes = page_alloc(sizeof(BvhNode) * (u64)bvh->node_count);
    bvh->singles = page_alloc(sizeof(u32) * (u64)bvh->single_count);
    bvh->blocks = page_alloc(sizeof(u32) * BLOCK_WIDTH * (u64)bvh->block_count);
    if (!bvh->nodes || (bvh->single_count && !bvh->singles) || (bvh->block_count && !bvh->blocks))
        return false;
#pragma omp parallel default(none) shared(collapse, root) if (is_large(root))
#pragma omp single
    write_nodes(&collapse, root, (Places){ 0, 0, 0 });
    return true;
}
