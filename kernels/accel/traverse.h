// The walk of a batch through one hierarchy, and through instances to a second one.
#ifndef CLRT_KERNELS_ACCEL_TRAVERSE_H
#define CLRT_KERNELS_ACCEL_TRAVERSE_H

// Depth of the hierarchy times the siblings that a level can leave behind.
#define STACK_SIZE (BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1)

// From so many rays of a batch on it pays to test box by box.
#define PACKET_RAYS 20

typedef union { int8 v; int s[8]; } Int8;
typedef union { float8 v; float s[8]; } Float8;

// Numbers of a ray for the box test: reciprocal direction and, as offsets in bytes into a node, the planes
// that the ray meets first.
typedef struct {
    real inv_x[BATCH], inv_y[BATCH], inv_z[BATCH];
    uint near_x[BATCH], near_y[BATCH], near_z[BATCH];
} BatchSlabs;

typedef struct {
    int node[STACK_SIZE];
    uint mask[STACK_SIZE];
    float near[STACK_SIZE];
    int size;
} Stack;

static inline uint sign_bits8(int8 m)
{
#if defined(__AVX__) && defined(__has_builtin)
    return (uint)__builtin_ia32_movmskps256(as_float8(m));
#else
    // Bytes 0 or 255, gathered by a multiplication that moves bit 7k to bit 56 + k.
    const ulong bytes = as_ulong(convert_char8(m)) & 0x0101010101010101UL;
    return (uint)(bytes * 0x0102040810204080UL >> 56);
#endif
}

static inline void prepare_slabs(const BatchRays *rays, BatchSlabs *slabs)
{
    for (int first = 0; first < BATCH; first += LANES) {
        const vf x = (vf)(1.0f) / VF_LOAD(&rays->dir_x[first]);
        const vf y = (vf)(1.0f) / VF_LOAD(&rays->dir_y[first]);
        const vf z = (vf)(1.0f) / VF_LOAD(&rays->dir_z[first]);
        VF_STORE(x, &slabs->inv_x[first]);
        VF_STORE(y, &slabs->inv_y[first]);
        VF_STORE(z, &slabs->inv_z[first]);
        VU_STORE(x < (vf)(0.0f) ? (vu)(96u) : (vu)(0u), &slabs->near_x[first]);
        VU_STORE(y < (vf)(0.0f) ? (vu)(128u) : (vu)(32u), &slabs->near_y[first]);
        VU_STORE(z < (vf)(0.0f) ? (vu)(160u) : (vu)(64u), &slabs->near_z[first]);
    }
}

// Which rays of a batch reach which child of a node, and how near the nearest of them is to it.
typedef struct {
    Int8 mask;
    Float8 near;
} ChildHits;

// Eight planes of a node, those that start `offset` bytes into it.
static inline float8 planes_at(global const BvhNode *node, uint offset)
{
    return vload8(0, (global const float *)((global const char *)node + offset));
}

// One ray at a time against eight boxes: what it costs goes with the number of rays.
static inline void test_children_by_ray(global const BvhNode *node, const BatchRays *rays,
                                        const BatchSlabs *slabs, const BatchHits *hits, uint mask,
                                        ChildHits *children)
{
    children->mask.v = (int8)(0);
    children->near.v = (float8)(INFINITY);
    for (uint rest = mask; rest; rest &= rest - 1) {
        const int k = lowest_bit(rest);
        const uint x = slabs->near_x[k], y = slabs->near_y[k], z = slabs->near_z[k];
        const float8 near_x = (planes_at(node, x) - rays->org_x[k]) * slabs->inv_x[k];
        const float8 near_y = (planes_at(node, y) - rays->org_y[k]) * slabs->inv_y[k];
        const float8 near_z = (planes_at(node, z) - rays->org_z[k]) * slabs->inv_z[k];
        const float8 far_x = (planes_at(node, 96 - x) - rays->org_x[k]) * slabs->inv_x[k];
        const float8 far_y = (planes_at(node, 160 - y) - rays->org_y[k]) * slabs->inv_y[k];
        const float8 far_z = (planes_at(node, 224 - z) - rays->org_z[k]) * slabs->inv_z[k];
        float8 tnear = (float8)(0.0f), tfar = (float8)(hits->tfar[k]);
        tnear = near_x > tnear ? near_x : tnear;
        tnear = near_y > tnear ? near_y : tnear;
        tnear = near_z > tnear ? near_z : tnear;
        tfar = far_x < tfar ? far_x : tfar;
        tfar = far_y < tfar ? far_y : tfar;
        tfar = far_z < tfar ? far_z : tfar;
        const int8 hit = tnear <= tfar * BOX_SLACK;
        children->mask.v |= hit & (int8)((int)(1u << k));
        const float8 seen = hit ? tnear : (float8)(INFINITY);
        children->near.v = seen < children->near.v ? seen : children->near.v;
    }
}

#if LANES > 1
// One box at a time against LANES rays, the same arithmetic: what it costs goes with the number of children.
static inline void test_children_by_box(global const BvhNode *node, const BatchRays *rays,
                                        const BatchSlabs *slabs, const BatchHits *hits, uint mask,
                                        ChildHits *children)
{
    children->mask.v = (int8)(0);
    children->near.v = (float8)(INFINITY);
    for (int slot = 0; slot < BVH_WIDTH && node->lower_x[slot] <= node->upper_x[slot]; slot++) {
        uint reached = 0;
        vf near = (vf)(INFINITY);
        for (int first = 0; first < BATCH; first += LANES) {
            const vf org_x = VF_LOAD(&rays->org_x[first]), inv_x = VF_LOAD(&slabs->inv_x[first]);
            const vf org_y = VF_LOAD(&rays->org_y[first]), inv_y = VF_LOAD(&slabs->inv_y[first]);
            const vf org_z = VF_LOAD(&rays->org_z[first]), inv_z = VF_LOAD(&slabs->inv_z[first]);
            const vf low_x = (node->lower_x[slot] - org_x) * inv_x;
            const vf low_y = (node->lower_y[slot] - org_y) * inv_y;
            const vf low_z = (node->lower_z[slot] - org_z) * inv_z;
            const vf high_x = (node->upper_x[slot] - org_x) * inv_x;
            const vf high_y = (node->upper_y[slot] - org_y) * inv_y;
            const vf high_z = (node->upper_z[slot] - org_z) * inv_z;
            const vm back_x = inv_x < (vf)(0.0f), back_y = inv_y < (vf)(0.0f), back_z = inv_z < (vf)(0.0f);
            vf tnear = vf_max(back_x ? high_x : low_x, (vf)(0.0f));
            vf tfar = vf_min(back_x ? low_x : high_x, VF_LOAD(&hits->tfar[first]));
            tnear = vf_max(back_y ? high_y : low_y, tnear);
            tfar = vf_min(back_y ? low_y : high_y, tfar);
            tnear = vf_max(back_z ? high_z : low_z, tnear);
            tfar = vf_min(back_z ? low_z : high_z, tfar);
            const vm hit = tnear <= tfar * BOX_SLACK;
            reached |= vm_bits(hit) << first;
            near = vf_min(hit ? tnear : (vf)(INFINITY), near);
        }
        LanesF lanes;
        real nearest = INFINITY;
        lanes.v = near;
        for (int k = 0; k < LANES; k++)
            nearest = min(nearest, lanes.s[k]);
        children->mask.s[slot] = (int)(reached & mask);
        children->near.s[slot] = nearest;
    }
}
#endif

// Tests the children of a node for the rays of mask and pushes those that are hit, nearest on top.
// A NaN (a plane through the origin of a ray that runs within it) leaves its slab open on that side.
OUTLINE void push_children(global const BvhNode *node, const BatchRays *rays, const BatchSlabs *slabs,
                           const BatchHits *hits, uint mask, Stack *stack)
{
    ChildHits children;
#if LANES > 1
    if (popcount(mask) >= PACKET_RAYS)
        test_children_by_box(node, rays, slabs, hits, mask, &children);
    else
#endif
        test_children_by_ray(node, rays, slabs, hits, mask, &children);
    const int bottom = stack->size;
    for (uint rest = sign_bits8(children.mask.v != (int8)(0)); rest; rest &= rest - 1) {
        const int slot = lowest_bit(rest);
        const float near = children.near.s[slot];
        int at = stack->size++;
        for (; at > bottom && stack->near[at - 1] < near; at--) {
            stack->node[at] = stack->node[at - 1];
            stack->mask[at] = stack->mask[at - 1];
            stack->near[at] = stack->near[at - 1];
        }
        stack->node[at] = node->child[slot];
        stack->mask[at] = (uint)children.mask.s[slot];
        stack->near[at] = near;
    }
}

// Goes down to the next leaf that rays want: false where there is none any more. Places of its primitives are
// *first .. *end - 1; *wanted: the rays that reach it.
static inline bool next_leaf(const Hierarchy *scene, const BatchRays *rays, const BatchSlabs *slabs,
                             const BatchHits *hits, uint alive, Stack *stack, uint *wanted, uint *first,
                             uint *end)
{
    while (stack->size > 0) {
        const int node = stack->node[--stack->size];
        *wanted = stack->mask[stack->size] & alive;
        if (!*wanted)
            continue;
        if (node < 0) {
            const uint leaf = ~(uint)node;
            *first = leaf >> 4;
            *end = *first + (leaf & 15u);
            return true;
        }
        push_children(&scene->nodes[node], rays, slabs, hits, *wanted, stack);
    }
    return false;
}

// Walks the hierarchy of one object, or of the whole scene where nothing is instanced. Returns the rays that
// hit, where any hit will do.
static inline uint traverse_object(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                   int root, int instance, const bool any_hit, const bool opaque_only)
{
    BatchSlabs slabs;
    Stack stack;
    uint alive = mask, wanted, first, end;
    prepare_slabs(rays, &slabs);
    stack.size = 0;
    push_children(&scene->nodes[root], rays, &slabs, hits, mask, &stack);
    while (next_leaf(scene, rays, &slabs, hits, alive, &stack, &wanted, &first, &end)) {
        for (uint i = first; i < end; i++) {
            if (opaque_only && !(scene->primitives[i].kind & PRIMITIVE_OPAQUE))
                continue;
            const uint found = test_primitive(scene, rays, hits, wanted & alive, (int)i, instance);
            if (any_hit)
                alive &= ~found;
        }
    }
    return mask & ~alive;
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

// The top-level hierarchy, whose leaves hold primitives and instances of objects.
static inline void traverse_scene(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  const bool any_hit, const bool opaque_only)
{
    BatchSlabs slabs;
    BatchRays inner;
    Stack stack;
    uint alive = mask, wanted, first, end;
    prepare_slabs(rays, &slabs);
    stack.size = 0;
    push_children(&scene->nodes[scene->root], rays, &slabs, hits, mask, &stack);
    while (next_leaf(scene, rays, &slabs, hits, alive, &stack, &wanted, &first, &end)) {
        for (uint i = first; i < end && (wanted & alive); i++) {
            global const Primitive *p = &scene->primitives[i];
            uint found = 0;
            if ((p->kind & PRIMITIVE_KIND_MASK) == PRIMITIVE_INSTANCE) {
                const PrimitiveLanes map = primitive_splat(p);
                enter_instance(&map, rays, wanted & alive, &inner);
                found = traverse_object(scene, &inner, hits, wanted & alive, as_int(p->p0), (int)i, any_hit,
                                        opaque_only);
            } else if (!opaque_only || (p->kind & PRIMITIVE_OPAQUE)) {
                found = test_primitive(scene, rays, hits, wanted & alive, (int)i, NO_HIT);
            }
            if (any_hit)
                alive &= ~found;
        }
    }
}
#else
static inline void traverse_scene(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  const bool any_hit, const bool opaque_only)
{
    traverse_object(scene, rays, hits, mask, (int)scene->root, NO_HIT, any_hit, opaque_only);
}
#endif

#endif
