#include "measure.h"

#include <stdlib.h>
#include <string.h>

#include "mesh.h"
#include "selftest/random.h"

// Rays of a shape are traced together: a multiple of every batch. A mesh has a launch of its own.
enum { RAYS_SHAPE = 128, SHAPES_BATCH = 256, RAYS_MESH = 1024 };

Subject subject_at(u32 k)
{
    if (k < FAMILY_COUNT)
        return (Subject){.name = shape_families[k].name, .family = shape_families[k]};
    Subject mesh = {.name = "mesh triangle", .mesh = true};
    for (u32 i = 0; i < FAMILY_COUNT; i++)
        if (shape_families[i].kind == SHAPE_TRIANGLE)
            mesh.family = shape_families[i];
    return mesh;
}

typedef struct Batch {
    u32 shapes, rays; // rays of each shape
    Placed *placed;
    Primitive *primitives;
    RayTable *table;
} Batch;

static u64 seed_of(const Subject *subject, u64 shape)
{
    u64 seed = 1469598103934665603U;
    for (const char *c = subject->name; *c; c++)
        seed = (seed ^ (u8)*c) * 1099511628211U;
    return seed + shape * 0xd1342543de82ef95U;
}

// A shape and its rays, at their places of the table. Fails where the shape leaves the range of float.
static bool fill_shape(const Subject *subject, const Batch *batch, u32 shape, u64 number, Error *error)
{
    u64 random = seed_of(subject, number);
    Placed *placed = &batch->placed[shape];
    if (!random_placed(&subject->family, (Placing)(number % PLACING_COUNT), placed, &batch->primitives[shape],
                       &random, error))
        return false;
    RayTable *table = batch->table;
    const size_t n = table->stride;
    for (u32 k = 0; k < batch->rays; k++) {
        const size_t i = (size_t)shape * batch->rays + k;
        f32 org[3], dir[3];
        random_ray(placed, (RayKind)(k % RAY_KINDS), &random, org, dir);
        for (u32 axis = 0; axis < 3; axis++) {
            table->rays[(PROBE_ORG + axis) * n + i] = org[axis];
            table->rays[(PROBE_DIR + axis) * n + i] = dir[axis];
        }
        table->targets[PROBE_PRIMITIVE * n + i] = (i32)shape;
    }
    return true;
}

static bool fill(const Subject *subject, const Batch *batch, u64 first, Error *error)
{
    bool ok = true;
    const f32 nowhere[3] = {0, 0, 1};
    batch->table->count = 0;
    for (u32 i = 0; i < batch->shapes * batch->rays; i++)
        ray_table_add(batch->table, 0, nowhere, nowhere);
#pragma omp parallel for schedule(static)
    for (u32 i = 0; i < batch->shapes; i++) {
        Error own;
        if (!fill_shape(subject, batch, i, first + i, &own)) {
#pragma omp critical
            {
                ok = false;
                *error = own;
            }
        }
    }
    return ok;
}

static bool trace(Probe *probe, const Subject *subject, const Batch *batch, Error *error)
{
    Layout *layout = subject->mesh ? mesh_layout(&batch->placed[0], error)
                                   : probe_layout(batch->primitives, batch->shapes, NULL, error);
    const ProbeHow how = {.mode = subject->mesh ? PROBE_EACH : PROBE_OWN, .steps = 1};
    const bool ok = layout && probe_rays(probe, layout, how, batch->table, error);
    layout_destroy(layout);
    return ok;
}

static void judge(const Batch *batch, Tally *tally)
{
#pragma omp parallel
    {
        Tally own = {0};
#pragma omp for schedule(dynamic, 256)
        for (u32 i = 0; i < batch->table->count; i++) {
            f32 org[3], dir[3];
            for (u32 axis = 0; axis < 3; axis++) {
                org[axis] = ray_number(batch->table, i, PROBE_ORG + axis);
                dir[axis] = ray_number(batch->table, i, PROBE_DIR + axis);
            }
            const Judgement one = judge_distance(&batch->placed[i / batch->rays], org, dir,
                                                 hit_number(batch->table, i, PROBE_T));
            tally_add(&own, &one);
        }
#pragma omp critical
        tally_merge(tally, &own);
    }
}

static bool measure_batches(Probe *probe, const Subject *subject, const Batch *batch, u64 rays, Tally *tally,
                            Error *error)
{
    for (u64 first = 0; tally->rays < rays; first += batch->shapes) {
        if (!fill(subject, batch, first, error) || !trace(probe, subject, batch, error))
            return false;
        judge(batch, tally);
    }
    return true;
}

bool measure_subject(Probe *probe, const Subject *subject, u64 rays, Tally *tally, Error *error)
{
    Arena *arena = arena_create();
    Batch batch = {.shapes = subject->mesh ? 1 : SHAPES_BATCH,
                   .rays = subject->mesh ? RAYS_MESH : RAYS_SHAPE};
    *tally = (Tally){0};
    if (arena) {
        batch.placed = arena_alloc(arena, batch.shapes, sizeof *batch.placed);
        batch.primitives = arena_alloc(arena, batch.shapes, sizeof *batch.primitives);
        batch.table = ray_table_create(arena, batch.shapes * batch.rays);
    }
    const bool ok = batch.placed && batch.primitives && batch.table
                        ? measure_batches(probe, subject, &batch, rays, tally, error)
                        : error_set(error, ERROR_MEMORY, "no memory for the rays");
    arena_destroy(arena);
    return ok;
}
