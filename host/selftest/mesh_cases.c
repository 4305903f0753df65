// Closed meshes: no ray slips through an edge or a vertex, and none counts one twice, at any size and place.
#include <math.h>
#include <stdio.h>

#include "selftest/random.h"
#include "selftest/run.h"

enum { CROSSINGS = 32 };

static const char MESH_SCENE[] = "mesh { file \"self-test.obj\" }";

// Vertex `corner` of the face at a slot of the layout's blocks; false where the slot is empty.
static bool slot_vertex(const Layout *layout, u32 slot, u32 corner, f32 vertex[3])
{
    const TriangleBlock *block = &layout->blocks[slot / BLOCK_WIDTH];
    for (u32 axis = 0; axis < 3; axis++)
        vertex[axis] = block->vertex[corner][axis][slot % BLOCK_WIDTH];
    return block->face[slot % BLOCK_WIDTH] != NO_INDEX;
}

// A ray from near the centre at a point of an edge, or at a vertex, of the mesh as it was rounded.
static bool add_ray_at_edge(RayTable *table, const Layout *layout, Vec3 center, f64 spread, u64 *random)
{
    const u32 i = table->count, slot = (u32)(random_unit(random) * layout->block_count * BLOCK_WIDTH);
    const u32 from = (u32)(random_unit(random) * 3);
    const f32 share = i % 4 == 0 ? 0 : i % 4 == 1 ? 0.5F : (f32)random_unit(random);
    const f64 middle[3] = {center.x, center.y, center.z};
    f32 a[3], b[3], o[3], d[3], length = 0;
    if (!slot_vertex(layout, slot, from, a) || !slot_vertex(layout, slot, (from + 1) % 3, b))
        return false;
    for (u32 k = 0; k < 3; k++) {
        o[k] = (f32)(middle[k] + (i % 3 ? random_in(random, -spread, spread) : 0));
        d[k] = a[k] + share * (b[k] - a[k]) - o[k];
        length += d[k] * d[k];
    }
    length = sqrtf(length);
    for (u32 k = 0; k < 3 && i % 2; k++)
        d[k] /= length;
    ray_table_add(table, 0, o, d);
    return true;
}

// Leaks: rays that meet nothing, or a closed surface an even number of times.
static bool count_leaks(Run *run, const Layout *layout, RayTable *table, Score *leaks)
{
    const ProbeHow how = {.mode = PROBE_HIERARCHY, .steps = CROSSINGS};
    if (!probe_rays(run->probe, layout, how, table, run->error))
        return false;
    for (u32 i = 0; i < table->count; i++)
        score_wrong(leaks, found_number(table, i, PROBE_CROSSINGS) % 2 == 0);
    return true;
}

static bool judge_ball(Run *run, const TriangleList *ball, Vec3 center, f64 radius, u32 rays, Score *leaks)
{
    char text[256];
    snprintf(text, sizeof text, "mesh { file \"self-test.obj\" scale %.17g translate %.17g %.17g %.17g }",
             radius, center.x, center.y, center.z);
    RayTable *table = run_rays(run, rays);
    Layout *layout = table ? run_layout(run, text, ball) : NULL;
    u64 random = 13;
    while (layout && table->count < rays)
        (void)add_ray_at_edge(table, layout, center, 0.3 * radius, &random);
    const bool ok = layout && count_leaks(run, layout, table, leaks);
    layout_destroy(layout);
    return ok;
}

static bool balls(Run *run)
{
    static const struct {
        f64 radius;
        Vec3 center;
        u32 rays;
    } PLACES[] = {
        {1, {0, 0, 0}, 1 << 16},       {1e-4, {0, 0, 0}, 1 << 15},
        {1e6, {0, 0, 0}, 1 << 15},     {1, {1e3, 0, -1e3}, 1 << 15},
        {100, {148376, 1234, -223423}, 1 << 15}, {1, {1e6, 0, 1e6}, 1 << 10},
    };
    TriangleList ball = triangles_icosphere(3);
    Score here = {0}, scaled = {0}, moved = {0};
    bool ok = !ball.failed || error_set(run->error, ERROR_MEMORY, "no memory for a mesh of the self-test");
    for (u32 i = 0; ok && i < sizeof PLACES / sizeof PLACES[0]; i++)
        ok = judge_ball(run, &ball, PLACES[i].center, PLACES[i].radius, PLACES[i].rays,
                        i == 0 ? &here : i < 3 ? &scaled : &moved);
    triangles_destroy(&ball);
    if (!ok)
        return false;
    run_add(run, "C13", "1280 triangles, at edges and vertices from inside", "closed surface", UNIT_LEAKS, 0,
            &here);
    run_add(run, "C15", "the same with radius 1e-4 and 1e6", "closed surface", UNIT_LEAKS, 0, &scaled);
    run_add(run, "C15", "at (1e3, 0, -1e3), (148376, 1234, -223423), (1e6, 0, 1e6)", "closed surface",
            UNIT_LEAKS, 0, &moved);
    const Score all = {.answers = here.answers + scaled.answers + moved.answers,
                       .worst = here.worst + scaled.worst + moved.worst};
    run_add(run, "C14", "all three by kernels compiled as renders are", "closed surface", UNIT_LEAKS, 0,
            &all);
    return true;
}

// The same by triangles that the scene file writes out.
static bool ball_of_triangles(Run *run)
{
    enum { RAYS = 1 << 14, BYTES = 1 << 17 };
    TriangleList ball = triangles_icosphere(2);
    char *text = run_alloc(run, BYTES, 1);
    RayTable *table = run_rays(run, RAYS);
    size_t used = 0;
    for (u32 i = 0; text && i < ball.count; i++) {
        const Vec3 *v = ball.vertices + 3 * (size_t)i;
        used += (size_t)snprintf(text + used, BYTES - used,
                                 "triangle { vertices %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g %.9g }\n",
                                 v[0].x, v[0].y, v[0].z, v[1].x, v[1].y, v[1].z, v[2].x, v[2].y, v[2].z);
    }
    u64 random = 14;
    for (u32 i = 0; table && i < RAYS && ball.count > 0; i++) {
        const Vec3 *v = ball.vertices + 3 * (size_t)(random_unit(&random) * ball.count);
        const Vec3 o = i % 3 ? random_point(&random, 0.3) : (Vec3){0, 0, 0};
        const f64 share = i % 4 ? random_unit(&random) : 0;
        ray_table_add_vec(table, 0, o, vec_sub(vec_add(v[0], vec_scale(vec_sub(v[1], v[0]), share)), o));
    }
    triangles_destroy(&ball);
    Layout *layout = text && table ? run_layout(run, text, NULL) : NULL;
    Score leaks = {0};
    const bool ok = layout && count_leaks(run, layout, table, &leaks);
    layout_destroy(layout);
    if (ok)
        run_add(run, "C13", "320 triangles of their own, the same", "closed surface", UNIT_LEAKS, 0, &leaks);
    return ok;
}

// Rays along the axes within a solid of cells of a grid, many of them in its planes, edges and corners.
static bool grids(Run *run)
{
    enum { RAYS = 1 << 13 };
    static const f64 CELLS[] = {1, 0.1, 0x1p-20, 1e5};
    Score leaks = {0};
    bool ok = true;
    for (u32 c = 0; ok && c < sizeof CELLS / sizeof CELLS[0]; c++) {
        TriangleList voxels = triangles_voxels(6, CELLS[c]);
        RayTable *table = run_rays(run, RAYS);
        Layout *layout = table && !voxels.failed ? run_layout(run, MESH_SCENE, &voxels) : NULL;
        u64 random = c;
        for (u32 i = 0; layout && i < RAYS; i++) {
            f32 o[3], d[3] = {0, 0, 0};
            const u32 axis = i % 3;
            d[(axis + 1) % 3] = i % 2 ? 0.0F : -0.0F;
            d[axis] = (f32)((i / 3 % 2 ? 1 : -1) * (i % 7 ? 1 : 0.3));
            for (u32 k = 0; k < 3; k++)
                o[k] = (f32)((floor(random_in(&random, -3, 3)) + (random_unit(&random) < 0.4 ? 0.37 : 0)) *
                             CELLS[c]);
            ray_table_add(table, 0, o, d);
        }
        ok = layout && count_leaks(run, layout, table, &leaks);
        layout_destroy(layout);
        triangles_destroy(&voxels);
    }
    if (ok)
        run_add(run, "C17", "quantised mesh, rays in its planes along the axes", "closed surface", UNIT_LEAKS,
                0, &leaks);
    return ok;
}

bool mesh_cases(Run *run)
{
    return balls(run) && ball_of_triangles(run) && grids(run);
}
