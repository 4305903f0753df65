// Rays that are none: NaN or infinity among their numbers.
#include <math.h>

#include "selftest/random.h"
#include "selftest/run.h"

static const char MESH_SCENE[] = "mesh { file \"self-test.obj\" }";

static const f32 BAD[] = {NAN, INFINITY, -INFINITY};

static bool at_shapes(Run *run)
{
    enum { KINDS = 10, RAYS = 6 * 3 * 16 };
    const Vec3 z = {0, 0, 0}, y = {0, 1, 0}, low = {0, -1, 0};
    const Shape shapes[KINDS] = {
        {.kind = SHAPE_SPHERE, .as.sphere = {z, 1}},
        {.kind = SHAPE_SPHERE, .as.sphere = {{0, -1000, 0}, 1000}},
        {.kind = SHAPE_PLANE, .as.plane = {low, y}},
        {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
        {.kind = SHAPE_DISK, .as.disk = {low, y, 2}},
        {.kind = SHAPE_CYLINDER, .as.cylinder = {low, y, 1, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, y, 1, 0, true}},
        {.kind = SHAPE_TORUS, .as.torus = {z, y, 1, 0.4}},
        {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {{-2, -1, -2}, {2, -1, -2}, {0, -1, 3}}}},
    };
    const Affine identity = affine_identity();
    Primitive primitives[KINDS];
    RayTable *table = run_rays(run, KINDS * RAYS);
    u64 random = 30;
    for (u32 k = 0; k < KINDS; k++)
        if (!run_bake(run, &shapes[k], &identity, &primitives[k]))
            return false;
    for (u32 i = 0; table && i < KINDS * RAYS; i++) {
        const Vec3 d = random_direction(&random);
        f32 ray[6] = {0, 0, 0, (f32)d.x, (f32)d.y, (f32)d.z};
        if (i % 16 < 2)
            ray[3] = ray[5] = 0; // zeros beside infinities
        ray[i % RAYS / 16 % 6] = BAD[i % RAYS / 96];
        ray_table_add(table, i / RAYS, ray, ray + 3);
    }
    if (!table || !run_own(run, primitives, KINDS, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < table->count; i++)
        score_wrong(&score, hit_number(table, i, PROBE_T) != INFINITY);
    run_add(run, "C30", "rays with NaN or infinity at every shape", "no hit", UNIT_WRONG, 0, &score);
    return true;
}

// Every second ray is none; the others, which share batches with them, go on as before.
static bool at_a_mesh(Run *run)
{
    enum { RAYS = 4096 };
    TriangleList ball = triangles_icosphere(3);
    RayTable *clean = run_rays(run, RAYS), *dirty = run_rays(run, RAYS);
    Layout *layout = clean && dirty && !ball.failed ? run_layout(run, MESH_SCENE, &ball) : NULL;
    triangles_destroy(&ball);
    u64 random = 31;
    for (u32 i = 0; layout && i < RAYS; i++) {
        const Vec3 o = random_point(&random, 2), d = vec_sub(random_point(&random, 0.5), o);
        f32 ray[6] = {(f32)o.x, (f32)o.y, (f32)o.z, (f32)d.x, (f32)d.y, (f32)d.z};
        const u32 what = (u32)(random_unit(&random) * 7);
        ray_table_add(clean, 0, ray, ray + 3);
        for (u32 k = 3; k < 6 && what == 6 && i % 2 == 0; k++)
            ray[k] = 0;
        if (what < 6 && i % 2 == 0)
            ray[what] = BAD[i / 2 % 3];
        ray_table_add(dirty, 0, ray, ray + 3);
    }
    const ProbeHow how = {.mode = PROBE_HIERARCHY, .steps = 1};
    const bool ok = layout && probe_rays(run->probe, layout, how, clean, run->error) &&
                    probe_rays(run->probe, layout, how, dirty, run->error);
    layout_destroy(layout);
    Score score = {0};
    for (u32 i = 0; ok && i < RAYS; i++)
        score_wrong(&score, hit_number(dirty, i, PROBE_T) !=
                                (i % 2 ? hit_number(clean, i, PROBE_T) : (f32)INFINITY));
    if (ok)
        run_add(run, "C30", "half of the rays at a mesh are none", "the others as before", UNIT_WRONG, 0,
                &score);
    return ok;
}

bool garbage_cases(Run *run)
{
    return at_shapes(run) && at_a_mesh(run);
}
