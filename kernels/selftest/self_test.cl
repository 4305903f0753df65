// The program of the self-test: the functions of a render, given numbers and rays whose answers the host
// knows. Built with most features on and otherwise as renders are.
#include "base/features.h"

#include "selftest/rays.h"

kernel void self_test_numbers(global const f32 *numbers_in, global f32 *numbers_out, uint function,
                              uint stride, uint count)
{
    const uint i = (uint)get_global_id(0) * LANES;
    global const f32 *in = numbers_in + i;
    if (i >= count)
        return;
    if (function == FUNCTION_MEAN)
        VF_STORE(mean_of_samples(VF_LOAD(in), VF_LOAD(in + stride)), numbers_out + i);
    else
        store_column3(apply_function(function, in, stride), numbers_out + i, stride);
}

// count: a multiple of BATCH. steps: of PROBE_HIERARCHY, at least 1. shade: not 0 where more than t is asked.
kernel void self_test_rays(global const Primitive *primitives, global const PrimitiveInfo *infos,
                           global const BvhNode *nodes, global const TriangleBlock *blocks,
                           global const MeshRun *mesh_runs, global const MaterialRecord *materials,
                           global const TextureRecord *textures, global const ObjectFrame *frames,
                           global const LightRecord *lights, uint primitive_count, uint block_count,
                           uint mesh_run_count, uint plane_count, uint light_count, uint root,
                           global const f32 *ray_reals, global const int *ray_ints, global f32 *hit_reals,
                           global int *hit_ints, uint stride, uint count, uint mode, uint steps, uint shade)
{
    const uint i = (uint)get_global_id(0) * BATCH;
    if (i >= count)
        return;
    Hierarchy scene;
    scene.primitives = primitives;
    scene.infos = infos;
    scene.nodes = nodes;
    scene.blocks = blocks;
    scene.mesh_runs = mesh_runs;
    scene.mesh_run_count = mesh_run_count;
    scene.plane_count = plane_count;
    scene.root = root;
    BatchRays rays;
    BatchHits hits;
    int crossings[BATCH];
    for (int k = 0; k < BATCH; k++)
        crossings[k] = 0;
    probe_load(ray_reals + i, ray_ints + i, stride, &rays, &hits);
    if (mode == PROBE_HIERARCHY)
        probe_walk(&scene, &rays, &hits, steps, crossings);
    else if (mode == PROBE_EACH)
        probe_each(&scene, primitive_count, block_count, &rays, &hits);
    else
        probe_own(&scene, ray_ints + PROBE_PRIMITIVE * stride + i, ray_ints + PROBE_INSTANCE * stride + i,
                  &rays, &hits);
    for (int k = 0; k < BATCH; k++) {
        if (hits.primitive[k] == NO_HIT)
            hits.tfar[k] = INFINITY;
        hit_reals[PROBE_T * stride + i + k] = hits.tfar[k];
        hit_ints[PROBE_FOUND * stride + i + k] = probe_number(&scene, hits.primitive[k]);
        hit_ints[PROBE_CROSSINGS * stride + i + k] = crossings[k];
    }
    if (!shade)
        return;
    Shading shading;
    shading.materials = materials;
    shading.textures.records = textures;
    shading.frames = frames;
    for (int k = 0; k < BATCH; k += LANES)
        probe_shade(&scene, &shading, lights, light_count, &rays, &hits, k, hit_reals + i + k, stride);
}
