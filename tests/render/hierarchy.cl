// For hierarchy_test.c: rays searched for their hits by the traversal, or without it by one test of every
// primitive and block of triangles after the other, and rays that start on the surfaces that were hit.
#include "base/features.h"

#include "stages/hit.h"
#include "stages/trace.h"

// Numbers of a ray, each a column of n.
enum { COLUMN_ORG, COLUMN_DIR = 3, COLUMN_END = 6 };

static inline v3 load3(global const real *from, uint n, uint column, uint at)
{
    return v3_make(VF_LOAD(from + column * n + at), VF_LOAD(from + (column + 1) * n + at),
                   VF_LOAD(from + (column + 2) * n + at));
}

// All primitives, and the first faces of all blocks, that rays can meet, each with the instance that it is
// seen through. Blocks are tested in the one way that does not go by the rays around.
static uint search_all(const Hierarchy *scene, global const int *pairs, uint pair_count,
                       const BatchRays *rays, BatchHits *hits, uint mask, bool any_hit, bool opaque_only)
{
    BatchRays inner;
    BatchSpace space, inner_space;
    int entered = NO_HIT;
    prepare_space(rays, batch_mask(BATCH), &space);
    for (uint i = 0; i < pair_count && mask; i++) {
        const int primitive = pairs[2 * i], instance = pairs[2 * i + 1];
        if (instance >= 0 && instance != entered) {
            const PrimitiveLanes map = primitive_splat(&scene->primitives[instance]);
            enter_instance(&map, rays, batch_mask(BATCH), &inner);
            prepare_space(&inner, batch_mask(BATCH), &inner_space);
            entered = instance;
        }
        uint found = 0;
        if (primitive & HIT_MESH)
            found = test_block_by_ray(scene, instance < 0 ? &space.shear : &inner_space.shear, hits, mask,
                                      (primitive & (HIT_MESH - 1)) / BLOCK_WIDTH, instance, opaque_only);
        else if (!opaque_only || (scene->primitives[primitive].kind & PRIMITIVE_OPAQUE))
            found = test_primitive(scene, instance < 0 ? rays : &inner, hits, mask, primitive, instance);
        if (any_hit)
            mask &= ~found;
    }
    return mask;
}

static Hierarchy scene_make(global const Primitive *primitives, global const PrimitiveInfo *infos,
                            global const TriangleBlock *blocks, global const MeshRun *mesh_runs,
                            uint mesh_run_count)
{
    Hierarchy scene;
    scene.primitives = primitives;
    scene.infos = infos;
    scene.blocks = blocks;
    scene.mesh_runs = mesh_runs;
    scene.mesh_run_count = mesh_run_count;
    return scene;
}

// n: a multiple of BATCH. pair_count 0: by the hierarchy. Step by step each ray goes on behind what it has
// met, as shadow rays do. found: primitive or face and instance of each step and ray.
kernel void search(global const Primitive *primitives, global const PrimitiveInfo *infos,
                   global const TriangleBlock *blocks, global const MeshRun *mesh_runs, uint mesh_run_count,
                   global const BvhNode *nodes, uint plane_count, uint root, global const int *pairs,
                   uint pair_count, global const real *rays_in, global const int *selves, uint n, uint steps,
                   uint any_hit, uint opaque_only, global real *t, global int *found)
{
    const uint begin = (uint)get_global_id(0) * BATCH;
    if (begin >= n)
        return;
    Hierarchy scene = scene_make(primitives, infos, blocks, mesh_runs, mesh_run_count);
    scene.nodes = nodes;
    scene.plane_count = plane_count;
    scene.root = root;
    BatchRays rays;
    BatchHits hits;
    for (uint k = 0; k < BATCH; k += LANES) {
        batch_start(&rays, &hits, (int)k, load3(rays_in, n, COLUMN_ORG, begin + k),
                    VI_LOAD(selves + begin + k), VI_LOAD(selves + n + begin + k));
        batch_aim(&rays, &hits, (int)k, load3(rays_in, n, COLUMN_DIR, begin + k),
                  VF_LOAD(rays_in + COLUMN_END * n + begin + k));
    }
    uint mask = batch_mask(BATCH);
    for (uint step = 0; step < steps; step++) {
        if (pair_count)
            search_all(&scene, pairs, pair_count, &rays, &hits, mask, any_hit, opaque_only);
        else
            traverse(&scene, &rays, &hits, mask, any_hit, opaque_only, 0);
        for (uint k = 0; k < BATCH; k++) {
            const uint place = step * n + begin + k;
            const int primitive = hits.primitive[k], instance = hits.instance[k];
            t[place] = hits.tfar[k];
            found[2 * place] = primitive;
            found[2 * place + 1] = instance;
            if (primitive == NO_HIT) {
                mask &= ~(1u << k);
                continue;
            }
            hits.last_primitive[k] = primitive;
            hits.last_instance[k] = instance;
            hits.primitive[k] = hits.instance[k] = NO_HIT;
            hits.tmin[k] = hits.tfar[k];
            hits.tfar[k] = rays_in[COLUMN_END * n + begin + k];
        }
    }
}

// Turns each ray that has met something (t and found of its first step) into one that starts there in the
// direction given, to either side of the surface, as the rays that follow a hit do.
kernel void bounce(global const Primitive *primitives, global const PrimitiveInfo *infos,
                   global const TriangleBlock *blocks, global const MeshRun *mesh_runs, uint mesh_run_count,
                   global const int *mesh_indices, global const real *mesh_normals,
                   global const MaterialRecord *materials, global const TriangleExtra *extras, uint n,
                   global const real *t, global const int *found, global const real *dirs,
                   global real *rays, global int *selves)
{
    const uint begin = (uint)get_global_id(0) * LANES;
    if (begin >= n)
        return;
    const Hierarchy scene = scene_make(primitives, infos, blocks, mesh_runs, mesh_run_count);
    Shading shading;
    shading.mesh_indices = mesh_indices;
    shading.mesh_normals = mesh_normals;
    shading.materials = materials;
    shading.extras = extras;
    LanesI primitive, instance;
    for (uint k = 0; k < LANES; k++) {
        primitive.s[k] = found[2 * (begin + k)];
        instance.s[k] = found[2 * (begin + k) + 1];
    }
    const v3 org = load3(rays, n, COLUMN_ORG, begin), old_dir = load3(rays, n, COLUMN_DIR, begin);
    const v3 dir = load3(dirs, n, 0, begin);
    const Hit hit = hit_make(&scene, &shading, org, old_dir, VF_LOAD(t + begin), primitive.v, instance.v);
    const vm through = v3_dot(dir, hit.ng) < (vf)(0.0f);
    const v3 side = v3_select(through, v3_neg(hit.ng), hit.ng);
    const vm met = primitive.v >= (vi)(0);
    const vi self = hit.primitive * 2 + ((through != hit.inside) ? (vi)(1) : (vi)(0));
    const v3 start = v3_select(met, offset_origin(hit.point, hit.error, hit.ng, side), org);
    const v3 ahead = v3_select(met, dir, old_dir);
    VF_STORE(start.x, rays + COLUMN_ORG * n + begin);
    VF_STORE(start.y, rays + (COLUMN_ORG + 1) * n + begin);
    VF_STORE(start.z, rays + (COLUMN_ORG + 2) * n + begin);
    VF_STORE(ahead.x, rays + COLUMN_DIR * n + begin);
    VF_STORE(ahead.y, rays + (COLUMN_DIR + 1) * n + begin);
    VF_STORE(ahead.z, rays + (COLUMN_DIR + 2) * n + begin);
    VI_STORE(met ? self : (vi)(-1), selves + begin);
    VI_STORE(met ? instance.v : (vi)(NO_HIT), selves + n + begin);
}
