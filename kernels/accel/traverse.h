// The walk of a batch through one hierarchy, and through instances to a second one.
#ifndef CLRT_KERNELS_ACCEL_TRAVERSE_H
#define CLRT_KERNELS_ACCEL_TRAVERSE_H

#if HAS_MESH
#include "accel/block.h"
#endif

// Depth of the hierarchy times the siblings that a level can leave behind.
#define STACK_SIZE (BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1)

// From so many rays on a node's boxes are tested against a packet.
#define PACKET_RAYS 16

// The rays of a batch in one space, as boxes and triangles want them.
typedef struct {
    BatchSlabs slabs;
#if HAS_MESH
    BatchShear shear;
    bool one_axis; // all have the same main axis
#endif
#if LANES > 1
    PacketBounds bounds;
#endif
} BatchSpace;

typedef struct {
    int node[STACK_SIZE];
    uint mask[STACK_SIZE];
    real near[STACK_SIZE];
    int size;
} Stack;

// Where a walk stands: the node or leaf in hand and the rays that want it.
typedef struct {
    int node;
    uint mask;
} Visit;

// Rays with numbers that are not finite, or without a direction, meet nothing.
static inline uint valid_rays(const BatchRays *rays, uint mask)
{
    uint valid = 0;
    for (int k = 0; k < BATCH; k += LANES) {
        const v3 org = v3_make(VF_LOAD(&rays->org_x[k]), VF_LOAD(&rays->org_y[k]), VF_LOAD(&rays->org_z[k]));
        const v3 dir = v3_make(VF_LOAD(&rays->dir_x[k]), VF_LOAD(&rays->dir_y[k]), VF_LOAD(&rays->dir_z[k]));
        const v3 d = v3_abs(dir);
        const vf sum = (fabs(org.x) + fabs(org.y) + fabs(org.z)) + (d.x + d.y + d.z);
        valid |= vm_bits((sum < (vf)(INFINITY)) & (vf_max(d.x, vf_max(d.y, d.z)) > (vf)(0.0f))) << k;
    }
    return valid & mask;
}

OUTLINE void prepare_space(const BatchRays *rays, uint mask, BatchSpace *space)
{
    for (int k = 0; k < BATCH; k += LANES) {
        if (!(mask >> k & ((1u << LANES) - 1u)))
            continue;
        prepare_slabs(rays, k, &space->slabs);
#if HAS_MESH
        prepare_shear(rays, k, &space->shear);
#endif
    }
#if HAS_MESH
    uint other = 0;
    const int axis = space->shear.axis_z[lowest_bit(mask)];
    for (int k = 0; k < BATCH; k += LANES)
        other |= vm_bits(VI_LOAD(&space->shear.axis_z[k]) != (vi)(axis)) << k;
    space->one_axis = (other & mask) == 0;
#endif
#if LANES > 1
    space->bounds.usable = popcount(mask) >= PACKET_RAYS;
    if (space->bounds.usable)
        bound_packet(&space->slabs, mask, &space->bounds);
#endif
}

static inline void prefetch_lines(global const void *record, int lines)
{
#if BATCH > 1 && defined(__has_builtin)
    for (int i = 0; i < lines; i++)
        __builtin_prefetch((const void *)((size_t)record + 64 * (size_t)i));
#endif
}

// Starts to load what a child refers to, long before it is popped.
static inline void prefetch_child(const Hierarchy *scene, int child)
{
    if (child >= 0)
        prefetch_lines(&scene->nodes[child], sizeof(BvhNode) / 64);
#if HAS_MESH
    else if (!(child & 1))
        prefetch_lines(&scene->blocks[~(uint)child >> 1], sizeof(TriangleBlock) / 64);
#endif
}

// Children that only have to be tried: in the order of their slots, which have the largest boxes first.
#define UNSORTED 0x7fffffff

// The next of the slots in bits: the first one, or, to be pushed without sorting, the last.
static inline int next_slot(uint *bits, bool any_hit)
{
    const int slot = any_hit ? 31 - (int)clz(*bits) : lowest_bit(*bits);
    *bits &= ~(1u << slot);
    return slot;
}

// Puts a child on the stack, above those that are farther and stand after `bottom`.
static inline void push_sorted(const Hierarchy *scene, Stack *stack, int bottom, int node, uint mask, real near)
{
    prefetch_child(scene, node);
    int at = stack->size++;
    for (; at > bottom && stack->near[at - 1] < near; at--) {
        stack->node[at] = stack->node[at - 1];
        stack->mask[at] = stack->mask[at - 1];
        stack->near[at] = stack->near[at - 1];
    }
    stack->node[at] = node;
    stack->mask[at] = mask;
    stack->near[at] = near;
}

// The next entry that rays of alive still want.
static inline bool pop(Stack *stack, const BatchHits *hits, uint alive, Visit *visit)
{
    while (stack->size > 0) {
        visit->node = stack->node[--stack->size];
        visit->mask = stack->mask[stack->size] & alive;
#if BATCH == 1
        if (stack->near[stack->size] > hits->tfar[0] * BOX_SLACK)
            continue;
#endif
        if (visit->mask)
            return true;
    }
    return false;
}

// Pushes the children of a node, `enters` and `masks` by slot, of which `reached` are meant; on top is the
// nearest or, where any hit will do, the first.
static inline void push_children(const Hierarchy *scene, global const BvhNode *node, uint reached,
                                 const Int8 *masks, const Float8 *enters, Stack *stack, bool any_hit)
{
    const int bottom = any_hit ? UNSORTED : stack->size;
    while (reached) {
        const int slot = next_slot(&reached, any_hit);
        push_sorted(scene, stack, bottom, node->child[slot], (uint)masks->s[slot], enters->s[slot]);
    }
}

#if LANES > 1
static inline void descend_packet(const Hierarchy *scene, global const BvhNode *node, const BatchSpace *space,
                                  const BatchHits *hits, uint mask, Stack *stack, bool any_hit)
{
    Float8 enters;
    const int bottom = any_hit ? UNSORTED : stack->size;
    for (uint some = test_boxes_bounds(node, &space->bounds, &enters.v); some;) {
        const int slot = next_slot(&some, any_hit);
        const uint reached = test_box_packet(node, slot, &space->slabs, &space->bounds, hits->tfar, mask);
        if (reached)
            push_sorted(scene, stack, bottom, node->child[slot], reached, enters.s[slot]);
    }
}
#endif

// One ray after the other: what it costs goes with their number.
static inline void descend_rays(const Hierarchy *scene, global const BvhNode *node, const BatchSpace *space,
                                const BatchHits *hits, uint mask, Stack *stack, bool any_hit)
{
    Int8 masks;
    Float8 enters;
    masks.v = (int8)(0);
    enters.v = (float8)(INFINITY);
    for (uint rest = mask; rest; rest &= rest - 1) {
        const int k = lowest_bit(rest);
        float8 near;
        const int8 hit = test_boxes(node, &space->slabs, k, hits->tfar[k], &near);
        masks.v |= hit & (int8)((int)(1u << k));
        const float8 seen = hit ? near : (float8)(INFINITY);
        enters.v = seen < enters.v ? seen : enters.v;
    }
    push_children(scene, node, sign_bits8(masks.v != (int8)(0)), &masks, &enters, stack, any_hit);
}

// Pushes the children of a node that rays of mask reach.
static inline void descend(const Hierarchy *scene, global const BvhNode *node, const BatchSpace *space,
                           BatchHits *hits, uint mask, Stack *stack, bool any_hit)
{
    COUNT_NODE(hits, popcount(mask));
#if LANES > 1
    if (space->bounds.usable && popcount(mask) >= PACKET_RAYS)
        descend_packet(scene, node, space, hits, mask, stack, any_hit);
    else
#endif
        descend_rays(scene, node, space, hits, mask, stack, any_hit);
}

// What the rays of mask meet in a leaf; returns those that it stops.
static inline uint test_leaf(const Hierarchy *scene, const BatchRays *rays, const BatchSpace *space,
                             BatchHits *hits, Visit visit, int instance, bool opaque_only)
{
    const int index = (int)(~(uint)visit.node >> 1);
    COUNT_LEAF(hits, popcount(visit.mask));
#if HAS_MESH
    if (!(visit.node & 1))
        return test_block(scene, &space->shear, hits, visit.mask, index, instance, opaque_only, space->one_axis);
#endif
#if SHAPE_KINDS > HAS_PLANE
    if (!opaque_only || (scene->primitives[index].kind & PRIMITIVE_OPAQUE))
        return test_primitive(scene, rays, hits, visit.mask, index, instance);
#endif
    (void)index; // nothing can be hit where every feature of shapes is off
    return 0;
}

// The walk of a batch; returns the rays that were stopped, where any hit will do.
static inline uint walk(const Hierarchy *scene, const BatchRays *rays, const BatchSpace *space,
                        BatchHits *hits, uint mask, int root, int instance, bool any_hit, bool opaque_only)
{
    Stack stack;
    Visit visit;
    uint alive = mask;
    visit.node = root;
    visit.mask = mask;
    stack.size = 0;
    do {
        if (visit.node >= 0) {
            descend(scene, &scene->nodes[visit.node], space, hits, visit.mask, &stack, any_hit);
        } else {
            const uint found = test_leaf(scene, rays, space, hits, visit, instance, opaque_only);
            if (any_hit)
                alive &= ~found;
        }
    } while (pop(&stack, hits, alive, &visit));
    return mask & ~alive;
}

// Walks the hierarchy of one object, or of the whole scene where nothing is instanced. Returns the rays that
// were stopped, where any hit will do.
OUTLINE uint traverse_object(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                             int root, int instance, bool any_hit, bool opaque_only)
{
    BatchSpace space;
    prepare_space(rays, mask, &space);
    return walk(scene, rays, &space, hits, mask, root, instance, any_hit, opaque_only);
}

#if HAS_INSTANCES
// Rays of mask in the object space of the instance; t is the same number in both spaces.
static inline void enter_instance(const PrimitiveLanes *p, const BatchRays *rays, uint mask, BatchRays *inner)
{
    for (int first = 0; first < BATCH; first += LANES) {
        if (!(mask >> first & ((1u << LANES) - 1u)))
            continue;
        const v3 org = v3_make(VF_LOAD(&rays->org_x[first]), VF_LOAD(&rays->org_y[first]),
                               VF_LOAD(&rays->org_z[first]));
        const v3 dir = v3_make(VF_LOAD(&rays->dir_x[first]), VF_LOAD(&rays->dir_y[first]),
                               VF_LOAD(&rays->dir_z[first]));
        const v3 from = v3_sub(org, p->c);
        VF_STORE(v3_dot(p->row0, from), &inner->org_x[first]);
        VF_STORE(v3_dot(p->row1, from), &inner->org_y[first]);
        VF_STORE(v3_dot(p->row2, from), &inner->org_z[first]);
        VF_STORE(v3_dot(p->row0, dir), &inner->dir_x[first]);
        VF_STORE(v3_dot(p->row1, dir), &inner->dir_y[first]);
        VF_STORE(v3_dot(p->row2, dir), &inner->dir_z[first]);
    }
}

static inline uint traverse_instance(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                     int index, bool any_hit, bool opaque_only)
{
    BatchRays inner;
    const PrimitiveLanes map = primitive_splat(&scene->primitives[index]);
    enter_instance(&map, rays, mask, &inner);
    return traverse_object(scene, &inner, hits, mask, as_int(scene->primitives[index].p0), index, any_hit,
                           opaque_only);
}

// The top-level hierarchy, whose leaves hold instances of objects beside everything else.
static inline void traverse_scene(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  bool any_hit, bool opaque_only)
{
    BatchSpace space;
    Stack stack;
    Visit visit;
    uint alive = mask;
    prepare_space(rays, mask, &space);
    visit.node = (int)scene->root;
    visit.mask = mask;
    stack.size = 0;
    do {
        if (visit.node >= 0) {
            descend(scene, &scene->nodes[visit.node], &space, hits, visit.mask, &stack, any_hit);
            continue;
        }
        const uint leaf = ~(uint)visit.node;
        uint found;
        if (!(leaf & 1u) &&
            (scene->primitives[leaf >> 1].kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE)
            found = traverse_instance(scene, rays, hits, visit.mask, (int)(leaf >> 1), any_hit, opaque_only);
        else
            found = test_leaf(scene, rays, &space, hits, visit, NO_HIT, opaque_only);
        if (any_hit)
            alive &= ~found;
    } while (pop(&stack, hits, alive, &visit));
}
#else
static inline void traverse_scene(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  bool any_hit, bool opaque_only)
{
    traverse_object(scene, rays, hits, mask, (int)scene->root, NO_HIT, any_hit, opaque_only);
}
#endif

#endif
