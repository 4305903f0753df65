#include "budget/nearest.h"

#include <math.h>

// For rounding in the layout and on the device, relative to the coordinates.
#define SLACK 1e-5

enum { STACK_MAX = BVH_MAX_DEPTH * (BVH_WIDTH - 1) + 1 };

static f64 along(const f32x4 *row, Vec3 point)
{
    return (f64)row->x * point.x + (f64)row->y * point.y + (f64)row->z * point.z;
}

// Distance from x to the interval, 0 within.
static f64 outside(f64 x, f64 low, f64 high)
{
    return fmax(fmax(low - x, x - high), 0);
}

static f64 box_distance(const f64 low[3], const f64 high[3], Vec3 p)
{
    return hypot(hypot(outside(p.x, low[0], high[0]), outside(p.y, low[1], high[1])),
                 outside(p.z, low[2], high[2]));
}

static f64 slot_distance(const BvhNode *node, u32 slot, Vec3 p)
{
    const f64 low[3] = {node->lower_x[slot], node->lower_y[slot], node->lower_z[slot]};
    const f64 high[3] = {node->upper_x[slot], node->upper_y[slot], node->upper_z[slot]};
    return box_distance(low, high, p);
}

// From outside the distance is that to the box itself; from within, to the nearest face.
static f64 faces_distance(const Primitive *box, Vec3 p)
{
    const f64 s[3] = {along(&box->row0, p), along(&box->row1, p), along(&box->row2, p)};
    const f64 low[3] = {box->row0.w, box->row1.w, box->row2.w}, high[3] = {box->p0, box->p1, box->p2};
    f64 face = INFINITY;
    for (u32 i = 0; i < 3; i++)
        face = fmin(face, fmin(s[i] - low[i], high[i] - s[i]));
    return face > 0 ? face : box_distance(low, high, (Vec3){s[0], s[1], s[2]});
}

// At least so far; 0 where there is no rule.
static f64 primitive_distance(const Primitive *primitive, Vec3 p)
{
    const Vec3 last = {primitive->row0.w, primitive->row1.w, primitive->row2.w};
    switch (primitive->kind & PRIMITIVE_KIND_MASK) {
    case PRIMITIVE_PLANE:
    case PRIMITIVE_DISK:
        return fabs(along(&primitive->row2, p) - (f64)primitive->p0);
    case PRIMITIVE_SPHERE:
    case PRIMITIVE_GIANT_SPHERE:
        return fabs(hypot(hypot(p.x - last.x, p.y - last.y), p.z - last.z) - (f64)primitive->p0);
    case PRIMITIVE_BOX:
        return faces_distance(primitive, p);
    case PRIMITIVE_TRIANGLE:
        return fabs(last.x * p.x + last.y * p.y + last.z * p.z - (f64)primitive->p1);
    default:
        return 0;
    }
}

// Of the triangle's plane or of its box.
static f64 face_distance(const TriangleBlock *block, u32 lane, Vec3 p)
{
    f64 v[3][3], low[3], high[3];
    for (u32 axis = 0; axis < 3; axis++) {
        for (u32 corner = 0; corner < 3; corner++)
            v[corner][axis] = block->vertex[corner][axis][lane];
        low[axis] = fmin(v[0][axis], fmin(v[1][axis], v[2][axis]));
        high[axis] = fmax(v[0][axis], fmax(v[1][axis], v[2][axis]));
    }
    const f64 e[3] = {v[1][0] - v[0][0], v[1][1] - v[0][1], v[1][2] - v[0][2]};
    const f64 f[3] = {v[2][0] - v[0][0], v[2][1] - v[0][1], v[2][2] - v[0][2]};
    const f64 n[3] = {e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]};
    const f64 length = hypot(hypot(n[0], n[1]), n[2]);
    const f64 height = (p.x - v[0][0]) * n[0] + (p.y - v[0][1]) * n[1] + (p.z - v[0][2]) * n[2];
    return fmax(box_distance(low, high, p), length > 0 ? fabs(height) / length : 0);
}

static f64 leaf_distance(const Layout *layout, i32 child, Vec3 p)
{
    const u32 code = ~(u32)child, index = code >> 1;
    if (!(code & 1))
        return primitive_distance(&layout->primitives[index], p);
    const TriangleBlock *block = &layout->blocks[index];
    f64 nearest = INFINITY;
    for (u32 lane = 0; lane < BLOCK_WIDTH && block->face[lane] != NO_INDEX; lane++)
        nearest = fmin(nearest, face_distance(block, lane, p));
    return nearest;
}

static f64 nearest_in_hierarchy(const Layout *layout, Vec3 p, f64 nearest)
{
    u32 stack[STACK_MAX], count = 0;
    if (layout->root != NO_INDEX)
        stack[count++] = layout->root;
    while (count > 0) {
        const BvhNode *node = &layout->nodes[stack[--count]];
        for (u32 slot = 0; slot < BVH_WIDTH && node->lower_x[slot] <= node->upper_x[slot]; slot++) {
            const f64 box = slot_distance(node, slot, p);
            if (box >= nearest)
                continue;
            if (node->child[slot] < 0)
                nearest = fmin(nearest, fmax(box, leaf_distance(layout, node->child[slot], p)));
            else
                stack[count++] = (u32)node->child[slot];
        }
    }
    return nearest;
}

f64 nearest_surface(const Layout *layout, Vec3 point)
{
    f64 nearest = INFINITY;
    for (u32 i = 0; i < layout->plane_count; i++)
        nearest = fmin(nearest, primitive_distance(&layout->primitives[i], point));
    nearest = nearest_in_hierarchy(layout, point, nearest);
    const f64 reach = hypot(hypot(point.x, point.y), point.z) + (isfinite(nearest) ? nearest : 0);
    return fmax(nearest - SLACK * reach, 0);
}
