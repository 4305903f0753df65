// Batch traversal: BATCH rays of one work-item walk an eight-way hierarchy together with one stack of
// (node, mask of rays). Loading, sorting and stack are shared by the batch; coherent rays test boxes and
// triangles as packets, others one ray against eight boxes or eight triangles at a time; when hardly a ray is
// left in a subtree it goes on by itself. BATCH is 1 where the hardware runs one ray a work-item (GPUs).
//
// Every way is the same arithmetic. Among hits the least t wins, ties go to the first-defined primitive, and
// no box hides a hit (accel/slabs.h), so the order of traversal never changes a hit.
#ifndef CLRT_KERNELS_ACCEL_BATCH_H
#define CLRT_KERNELS_ACCEL_BATCH_H

#include "accel/hits.h"
#include "shapes/shapes.h"

static inline PrimitiveLanes primitive_splat(global const Primitive *p)
{
    PrimitiveLanes lanes;
    const f32x4 row0 = p->row0, row1 = p->row1, row2 = p->row2;
    lanes.row0 = v3_make((vf)(row0.x), (vf)(row0.y), (vf)(row0.z));
    lanes.row1 = v3_make((vf)(row1.x), (vf)(row1.y), (vf)(row1.z));
    lanes.row2 = v3_make((vf)(row2.x), (vf)(row2.y), (vf)(row2.z));
    lanes.c = v3_make((vf)(row0.w), (vf)(row1.w), (vf)(row2.w));
    lanes.p0 = (vf)(p->p0);
    lanes.p1 = (vf)(p->p1);
    lanes.p2 = (vf)(p->p2);
    return lanes;
}

#if HAS_AREA_LIGHTS && HAS_PATH
// The rays for which the primitive is not there.
static inline uint rays_without(const BatchHits *hits, int primitive)
{
    uint without = 0;
    for (int first = 0; first < BATCH; first += LANES)
        without |= vm_bits(VI_LOAD(&hits->left_out[first]) == (vi)(primitive)) << first;
    return without;
}
#endif

// Tests one primitive against the rays of mask. Rays that it stops are reported in the result.
OUTLINE uint test_primitive(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask,
                                  int primitive, int instance)
{
#if HAS_AREA_LIGHTS && HAS_PATH
    mask &= ~rays_without(hits, primitive);
    if (!mask)
        return 0;
#elif HAS_AREA_LIGHTS
    if (primitive == hits->left_out)
        return 0;
#endif
    global const Primitive *record = &scene->primitives[primitive];
    const PrimitiveLanes lanes = primitive_splat(record);
    uint found = 0;
    for (int first = 0; first < BATCH; first += LANES) {
        const uint bits = mask >> first & ((1u << LANES) - 1u);
        if (!bits)
            continue;
        RayLanes ray;
        ray.org = v3_make(VF_LOAD(&rays->org_x[first]), VF_LOAD(&rays->org_y[first]),
                          VF_LOAD(&rays->org_z[first]));
        ray.dir = v3_make(VF_LOAD(&rays->dir_x[first]), VF_LOAD(&rays->dir_y[first]),
                          VF_LOAD(&rays->dir_z[first]));
        const vi self = VI_LOAD(&hits->self[first]);
        ray.self = (self >> 1) == (vi)(primitive);
        ray.inward = (self & 1) != (vi)(0);
#if HAS_INSTANCES
        ray.self = ray.self & (VI_LOAD(&hits->self_instance[first]) == (vi)(instance));
#endif
        ray.tmin = tmin_after_last(scene, hits, first, primitive, instance);
        const vf t = intersect_primitive(record->kind & PRIMITIVE_KIND_MASK, &lanes, &ray);
        found |= take_closer(scene, hits, first, vm_from_bits(bits), t, primitive, instance) << first;
    }
    return found;
}

#if HAS_BVH
#include "accel/traverse.h"
#endif

#if HAS_PLANE && HAS_PATH
static inline uint rays_without_plane(const BatchHits *hits, uint plane)
{
    uint without = 0;
    const vi bit = (vi)((int)(1u << plane));
    for (int first = 0; first < BATCH; first += LANES)
        without |= vm_bits((VI_LOAD(&hits->planes_out[first]) & bit) != (vi)(0)) << first;
    return without;
}
#endif

// Closest hits of the rays in mask (any_hit false), or any hit (true: then only the fact counts and tfar,
// primitive and instance of a ray that hit are those of some hit). opaque_only leaves out primitives that
// may let light through; bit k of planes_out leaves out plane k. tfar, tmin and self are set by the caller,
// primitive to NO_HIT.
OUTLINE void traverse(const Hierarchy *scene, const BatchRays *rays, BatchHits *hits, uint mask, bool any_hit,
                      bool opaque_only, uint planes_out)
{
#if HAS_PLANE
    for (uint i = 0; i < scene->plane_count && mask; i++) {
        if ((i < 32 && (planes_out >> i & 1u)) ||
            (opaque_only && !(scene->primitives[i].kind & PRIMITIVE_OPAQUE)))
            continue;
#if HAS_PATH
        const uint here = i < 32 ? mask & ~rays_without_plane(hits, i) : mask;
        const uint found = test_primitive(scene, rays, hits, here, (int)i, NO_HIT);
#else
        const uint found = test_primitive(scene, rays, hits, mask, (int)i, NO_HIT);
#endif
        if (any_hit)
            mask &= ~found;
    }
#endif
#if HAS_BVH
    mask = valid_rays(rays, mask);
    if (mask)
        traverse_scene(scene, rays, hits, mask, any_hit, opaque_only);
#endif
}

#endif
