// The kernels of clrt-bench: rays from memory through the traversal of renders, hits to memory. Columns lie
// side by side, `stride` numbers each. Built with COUNT_VISITS=1 they also say what each batch visited.
#include "base/features.h"

#include "stages/hit.h"
#include "stages/trace.h"

#if HAS_MESH
// Weights of the second and third corner of the faces that lanes of a batch hit, 0 elsewhere.
OUTLINE void weigh_hits(const Hierarchy *scene, const BatchRays *rays, const BatchHits *hits, int first,
                        global real *u, global real *v)
{
    const vi primitive = VI_LOAD(&hits->primitive[first]);
    const vm hit = (primitive >= (vi)(0)) & ((primitive & HIT_MESH) != (vi)(0));
    RayLanes ray;
    ray.org = v3_make(VF_LOAD(&rays->org_x[first]), VF_LOAD(&rays->org_y[first]),
                      VF_LOAD(&rays->org_z[first]));
    ray.dir = v3_make(VF_LOAD(&rays->dir_x[first]), VF_LOAD(&rays->dir_y[first]),
                      VF_LOAD(&rays->dir_z[first]));
#if HAS_INSTANCES
    const Placement placement = placement_make(scene, VI_LOAD(&hits->instance[first]));
    placement_enter(&placement, &ray);
#endif
    const FaceLanes face = face_gather(scene->blocks, hit ? primitive & (HIT_MESH - 1) : (vi)(0));
    const FaceWeights w = face_lanes_weights(&face, ray.org, ray.dir);
    VF_STORE(hit ? w.b1 / w.det : (vf)(0.0f), u);
    VF_STORE(hit ? w.b2 / w.det : (vf)(0.0f), v);
}
#endif

// What stands behind hits->primitive: the number of a face, or the index of a primitive; NO_HIT.
static inline int hit_number(const Hierarchy *scene, int primitive)
{
#if HAS_MESH
    if (primitive >= 0 && (primitive & HIT_MESH)) {
        const int slot = primitive & (HIT_MESH - 1);
        return (int)(scene->blocks[slot >> 3].face[slot & 7] & ~FACE_TRANSMITS);
    }
#endif
    return primitive;
}

static inline void load_batch(global const real *rays_in, uint stride, uint begin, BatchRays *rays,
                              BatchHits *hits)
{
    for (int k = 0; k < BATCH; k += LANES) {
        global const real *at = rays_in + begin + k;
        const v3 org = v3_make(VF_LOAD(at), VF_LOAD(at + stride), VF_LOAD(at + 2 * stride));
        const v3 dir = v3_make(VF_LOAD(at + 3 * stride), VF_LOAD(at + 4 * stride), VF_LOAD(at + 5 * stride));
        batch_start(rays, hits, k, org, (vi)(-1), (vi)(NO_HIT));
        batch_aim(rays, hits, k, dir, VF_LOAD(at + 6 * stride));
    }
#if COUNT_VISITS
    hits->nodes_visited = hits->leaves_visited = 0;
#endif
}

static inline Hierarchy make_hierarchy(global const Primitive *primitives, global const PrimitiveInfo *infos,
                                       uint plane_count, uint root)
{
    Hierarchy scene;
    scene.primitives = primitives;
    scene.infos = infos;
    scene.plane_count = plane_count;
    scene.root = root;
    return scene;
}

static inline void store_visits(global uint *visits, uint begin, const BatchHits *hits)
{
#if COUNT_VISITS
    visits[begin / BATCH * 2] = hits->nodes_visited;
    visits[begin / BATCH * 2 + 1] = hits->leaves_visited;
#endif
}

kernel void intersect_rays(global const Primitive *primitives, global const PrimitiveInfo *infos,
#if HAS_BVH
                           global const BvhNode *nodes,
#endif
#if HAS_MESH
                           global const TriangleBlock *blocks, global const MeshRun *mesh_runs,
                           uint mesh_run_count,
#endif
                           uint plane_count, uint root, global const real *rays_in, uint stride, uint count,
                           global real *reals, global int *wholes, global uint *visits)
{
    const uint begin = (uint)get_global_id(0) * BATCH;
    if (begin >= count)
        return;
    Hierarchy scene = make_hierarchy(primitives, infos, plane_count, root);
#if HAS_BVH
    scene.nodes = nodes;
#endif
#if HAS_MESH
    scene.blocks = blocks;
    scene.mesh_runs = mesh_runs;
    scene.mesh_run_count = mesh_run_count;
#endif
    BatchRays rays;
    BatchHits hits;
    load_batch(rays_in, stride, begin, &rays, &hits);
    traverse(&scene, &rays, &hits, batch_mask(count - begin), false, false, 0);
    for (int k = 0; k < BATCH; k += LANES) {
        global real *t = reals + begin + k;
        LanesI number;
        for (int lane = 0; lane < LANES; lane++)
            number.s[lane] = hit_number(&scene, hits.primitive[k + lane]);
        VF_STORE(VF_LOAD(&hits.tfar[k]), t);
        VI_STORE(number.v, wholes + begin + k);
#if HAS_MESH
        weigh_hits(&scene, &rays, &hits, k, t + stride, t + 2 * stride);
#else
        VF_STORE((vf)(0.0f), t + stride);
        VF_STORE((vf)(0.0f), t + 2 * stride);
#endif
#if HAS_INSTANCES
        VI_STORE(VI_LOAD(&hits.instance[k]), wholes + stride + begin + k);
#else
        VI_STORE((vi)(NO_HIT), wholes + stride + begin + k);
#endif
    }
    store_visits(visits, begin, &hits);
}

// Of each ray only whether it meets anything: 0, or NO_HIT.
kernel void occluded_rays(global const Primitive *primitives, global const PrimitiveInfo *infos,
#if HAS_BVH
                          global const BvhNode *nodes,
#endif
#if HAS_MESH
                          global const TriangleBlock *blocks, global const MeshRun *mesh_runs,
                          uint mesh_run_count,
#endif
                          uint plane_count, uint root, global const real *rays_in, uint stride, uint count,
                          global int *wholes, global uint *visits)
{
    const uint begin = (uint)get_global_id(0) * BATCH;
    if (begin >= count)
        return;
    Hierarchy scene = make_hierarchy(primitives, infos, plane_count, root);
#if HAS_BVH
    scene.nodes = nodes;
#endif
#if HAS_MESH
    scene.blocks = blocks;
    scene.mesh_runs = mesh_runs;
    scene.mesh_run_count = mesh_run_count;
#endif
    BatchRays rays;
    BatchHits hits;
    load_batch(rays_in, stride, begin, &rays, &hits);
    traverse(&scene, &rays, &hits, batch_mask(count - begin), true, false, 0);
    for (int k = 0; k < BATCH; k += LANES) {
        const vi hit = VI_LOAD(&hits.primitive[k]);
        VI_STORE(hit < (vi)(0) ? (vi)(NO_HIT) : (vi)(0), wholes + begin + k);
    }
    store_visits(visits, begin, &hits);
}
