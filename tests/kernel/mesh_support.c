#include "mesh_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "scene/parse.h"

const Variant mesh_variants[VARIANTS] = {{1, 1, 16}, {4, 32, 1}, {8, 32, 1}, {8, 8, 1}, {16, 32, 1}};

static const char source[] =
    "#include \"base/features.h\"\n"
    "#include \"accel/batch.h\"\n"
    "static void mesh_start(BatchRays *rays, BatchHits *hits, int k, global const real *numbers, uint n,\n"
    "                       uint at)\n"
    "{\n"
    "    rays->org_x[k] = numbers[at];\n"
    "    rays->org_y[k] = numbers[n + at];\n"
    "    rays->org_z[k] = numbers[2 * n + at];\n"
    "    rays->dir_x[k] = numbers[3 * n + at];\n"
    "    rays->dir_y[k] = numbers[4 * n + at];\n"
    "    rays->dir_z[k] = numbers[5 * n + at];\n"
    "    hits->tfar[k] = numbers[6 * n + at];\n"
    "    hits->tmin[k] = 0.0f;\n"
    "    hits->self[k] = -1;\n"
    "    hits->primitive[k] = hits->last_primitive[k] = hits->last_instance[k] = NO_HIT;\n"
    "#if HAS_INSTANCES\n"
    "    hits->self_instance[k] = hits->instance[k] = NO_HIT;\n"
    "#endif\n"
    "}\n"
    // On behind what ray k has met.
    "static void mesh_go_on(BatchHits *hits, int k, real end)\n"
    "{\n"
    "    hits->last_primitive[k] = hits->primitive[k];\n"
    "#if HAS_INSTANCES\n"
    "    hits->last_instance[k] = hits->instance[k];\n"
    "    hits->instance[k] = NO_HIT;\n"
    "#endif\n"
    "    hits->primitive[k] = NO_HIT;\n"
    "    hits->tmin[k] = hits->tfar[k];\n"
    "    hits->tfar[k] = end;\n"
    "}\n"
    "kernel void mesh_walk(global const Primitive *primitives, global const PrimitiveInfo *infos,\n"
    "                      global const BvhNode *nodes, global const TriangleBlock *blocks,\n"
    "                      global const MeshRun *runs, uint run_count, uint root,\n"
    "                      global const real *numbers, uint n, uint steps, global real *t,\n"
    "                      global uint *face, global uint *crossings)\n"
    "{\n"
    "    const uint begin = (uint)get_global_id(0) * BATCH;\n"
    "    Hierarchy scene;\n"
    "    scene.primitives = primitives;\n"
    "    scene.infos = infos;\n"
    "    scene.nodes = nodes;\n"
    "    scene.blocks = blocks;\n"
    "    scene.mesh_runs = runs;\n"
    "    scene.mesh_run_count = run_count;\n"
    "    scene.plane_count = 0;\n"
    "    scene.root = root;\n"
    "    BatchRays rays;\n"
    "    BatchHits hits;\n"
    "    for (int k = 0; k < BATCH; k++)\n"
    "        mesh_start(&rays, &hits, k, numbers, n, begin + k);\n"
    "    uint mask = batch_mask(BATCH);\n"
    "    for (uint step = 0; step < steps && mask; step++) {\n"
    "        traverse(&scene, &rays, &hits, mask, false, false, 0);\n"
    "        for (int k = 0; k < BATCH; k++) {\n"
    "            if (!(mask >> k & 1u))\n"
    "                continue;\n"
    "            if (hits.primitive[k] == NO_HIT) {\n"
    "                mask &= ~(1u << k);\n"
    "                continue;\n"
    "            }\n"
    "            if (step == 0) {\n"
    "                t[begin + k] = hits.tfar[k];\n"
    "                face[begin + k] = face_of_slot(&scene, hits.primitive[k] & (HIT_MESH - 1));\n"
    "            }\n"
    "            crossings[begin + k] = step + 1;\n"
    "            mesh_go_on(&hits, k, numbers[6 * n + begin + k]);\n"
    "        }\n"
    "    }\n"
    "}\n";

KernelProgram *walk_program(KernelDevice *device, Variant variant, bool instanced)
{
    char options[512];
    snprintf(options, sizeof options,
             "-w -DBATCH=%d -DGROUP=%d -DHAS_SURFACES=1 -DHAS_BVH=1 -DHAS_MESH=1 -DHAS_LIGHTS=1 "
             "-DHAS_SHADOWS=1 -DHAS_TRANSMITTANCE=1 -DHAS_INSTANCES=%d",
             variant.batch, variant.group, instanced);
    return kernel_program_create_with(device, source, variant.lanes, options);
}

double walk(KernelProgram *program, Variant variant, const Layout *layout, u32 steps, Rays *rays)
{
    const Primitive no_primitive = {.kind = 0};
    const PrimitiveInfo no_info = {.material = 0};
    const u32 count = layout->primitive_count, n = rays->count;
    for (u32 i = 0; i < n; i++) {
        rays->t[i] = -1;
        rays->face[i] = NO_INDEX;
        rays->crossings[i] = 0;
    }
    const KernelArg args[] = {
        count ? kernel_in(layout->primitives, count * sizeof no_primitive)
              : kernel_in(&no_primitive, sizeof no_primitive),
        count ? kernel_in(layout->infos, count * sizeof no_info) : kernel_in(&no_info, sizeof no_info),
        kernel_in(layout->nodes, layout->node_count * sizeof *layout->nodes),
        kernel_in(layout->blocks, layout->block_count * sizeof *layout->blocks),
        kernel_in(layout->mesh_runs, layout->mesh_run_count * sizeof *layout->mesh_runs),
        kernel_value(&layout->mesh_run_count, sizeof(u32)),
        kernel_value(&layout->root, sizeof(u32)),
        kernel_in(rays->numbers, RAY_COLUMNS * n * sizeof(f32)),
        kernel_value(&n, sizeof n),
        kernel_value(&steps, sizeof steps),
        kernel_out(rays->t, n * sizeof(f32)),
        kernel_out(rays->face, n * sizeof(u32)),
        kernel_out(rays->crossings, n * sizeof(u32)),
    };
    return kernel_run(program, "mesh_walk", n / (u32)variant.batch, args, sizeof args / sizeof *args);
}

// ---- layouts and rays -------------------------------------------------------------------------

static Mesh mesh_of(const TriangleList *triangles)
{
    const u32 n = triangles->count;
    Mesh mesh = {.position_count = 3 * n, .face_count = n, .part_count = 1};
    mesh.positions = malloc(3 * n * sizeof *mesh.positions);
    mesh.faces = malloc(n * sizeof *mesh.faces);
    mesh.parts = malloc(sizeof *mesh.parts);
    assert_true(mesh.positions && mesh.faces && mesh.parts);
    memcpy(mesh.positions, triangles->vertices, 3 * n * sizeof *mesh.positions);
    for (u32 i = 0; i < 3 * n; i++)
        mesh.faces[i / 3][i % 3] = i;
    mesh.parts[0] = (MeshPart){0, -1};
    return mesh;
}

Layout *mesh_layout(const TriangleList *triangles, const Affine *transform, bool instanced)
{
    const char *text = instanced ? "object o { mesh { file \"m.obj\" } }  instance o { }"
                                 : "mesh { file \"m.obj\" }";
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Error error = {0};
    Scene *scene = scene_parse_text("scene", text, strlen(text), arena, diagnostics, &error);
    assert_true(scene && diagnostics_error_count(diagnostics) == 0);
    Mesh mesh = mesh_of(triangles);
    scene->meshes = &mesh;
    scene->mesh_count = 1;
    assert_int_equal(scene->shapes[0].kind, SHAPE_MESH);
    scene->shapes[0].as.mesh.mesh = &mesh;
    *(instanced ? &scene->instances[0].transform : &scene->shapes[0].transform) = *transform;
    Layout *layout = layout_create(scene, &error);
    if (!layout)
        fail_msg("%s", error.text);
    mesh_destroy(&mesh);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return layout;
}

FaceTable face_table_create(const Layout *layout)
{
    FaceTable table = {NULL, 0};
    for (u32 i = 0; i < layout->block_count * BLOCK_WIDTH; i++)
        table.count += layout->blocks[i / BLOCK_WIDTH].face[i % BLOCK_WIDTH] != NO_INDEX;
    table.vertices = calloc(table.count, sizeof *table.vertices);
    assert_non_null(table.vertices);
    for (u32 i = 0; i < layout->block_count * BLOCK_WIDTH; i++) {
        const TriangleBlock *block = &layout->blocks[i / BLOCK_WIDTH];
        const u32 lane = i % BLOCK_WIDTH, face = block->face[lane] & ~FACE_TRANSMITS;
        if (block->face[lane] == NO_INDEX)
            continue;
        assert_true(face < table.count);
        for (int k = 0; k < 9; k++)
            table.vertices[face][k / 3][k % 3] = block->vertex[k / 3][k % 3][lane];
    }
    return table;
}

void face_table_destroy(FaceTable *table)
{
    free(table->vertices);
}

Rays rays_create(u32 count)
{
    Rays rays = {.count = (count + 31) / 32 * 32};
    rays.numbers = calloc((size_t)RAY_COLUMNS * rays.count, sizeof(f32));
    rays.t = calloc(rays.count, sizeof(f32));
    rays.face = calloc(rays.count, sizeof(u32));
    rays.crossings = calloc(rays.count, sizeof(u32));
    assert_true(rays.numbers && rays.t && rays.face && rays.crossings);
    return rays;
}

void rays_destroy(Rays *rays)
{
    free(rays->numbers);
    free(rays->t);
    free(rays->face);
    free(rays->crossings);
}

void rays_set(Rays *rays, u32 i, const f32 org[3], const f32 dir[3])
{
    for (u32 k = 0; k < 3; k++) {
        rays->numbers[(COLUMN_ORG + k) * rays->count + i] = org[k];
        rays->numbers[(COLUMN_DIR + k) * rays->count + i] = dir[k];
    }
    rays->numbers[COLUMN_END * rays->count + i] = INFINITY;
}

u32 leak_rays(u32 standard)
{
    const char *text = getenv("CLRT_LEAK_RAYS");
    char *end = NULL;
    const unsigned long wish = text && *text ? strtoul(text, &end, 10) : 0;
    if (!end)
        return standard;
    if (*end || wish < 1 || wish > 1000000000)
        fail_msg("CLRT_LEAK_RAYS=%s is not a number of rays", text);
    return (u32)wish;
}
