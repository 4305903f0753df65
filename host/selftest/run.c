#include "selftest/run.h"

#include <math.h>
#include <string.h>

#include "layout/bake.h"
#include "scene/parse.h"

void run_add(Run *run, const char *id, const char *what, const char *against, Unit unit, f64 bar,
             const Score *score)
{
    const SelfTestCase one = case_judge(id, what, against, unit, bar, score);
    selftest_add(run->report, &one);
}

static void *allocated(Run *run, void *memory)
{
    if (!memory)
        error_set(run->error, ERROR_MEMORY, "no memory for the self-test");
    return memory;
}

void *run_alloc(Run *run, size_t count, size_t size)
{
    return allocated(run, arena_alloc(run->arena, count, size));
}

RayTable *run_rays(Run *run, u32 capacity)
{
    return allocated(run, ray_table_create(run->arena, capacity));
}

NumberTable *run_numbers(Run *run, u32 count, u32 columns)
{
    return allocated(run, number_table_create(run->arena, count, columns));
}

bool run_bake(Run *run, const Shape *shape, const Affine *to_space, Primitive *out)
{
    BakedBounds bounds;
    return bake_shape(shape, to_space, out, &bounds, run->error);
}

bool run_own(Run *run, const Primitive *primitives, u32 count, RayTable *table)
{
    Layout *layout = probe_layout(primitives, count, NULL, run->error);
    const ProbeHow how = {.mode = PROBE_OWN, .shade = true};
    const bool ok = layout && probe_rays(run->probe, layout, how, table, run->error);
    layout_destroy(layout);
    return ok;
}

// A mesh of triangles with three positions of their own each; equal ones stay equal wherever it is placed.
static bool mesh_of(Run *run, const TriangleList *triangles, Mesh *mesh)
{
    const u32 n = triangles->count;
    *mesh = (Mesh){
        .positions = triangles->vertices, .position_count = 3 * n, .face_count = n, .part_count = 1};
    mesh->faces = run_alloc(run, n, sizeof *mesh->faces);
    mesh->parts = run_alloc(run, 1, sizeof *mesh->parts);
    if (!mesh->faces || !mesh->parts)
        return false;
    for (u32 i = 0; i < 3 * n; i++)
        mesh->faces[i / 3][i % 3] = i;
    mesh->parts[0].material = -1;
    return true;
}

Layout *run_layout(Run *run, const char *text, const TriangleList *mesh)
{
    Mesh own;
    Diagnostics *diagnostics = diagnostics_create();
    Scene *scene = NULL;
    if (allocated(run, diagnostics))
        scene = scene_parse_text("self-test", text, strlen(text), run->arena, diagnostics, run->error);
    bool ok = scene != NULL;
    if (ok && diagnostics_error_count(diagnostics) > 0)
        ok = error_set(run->error, ERROR_SELF_TEST, "a scene of the self-test has errors: %s", text);
    diagnostics_destroy(diagnostics);
    if (ok && mesh) {
        ok = mesh_of(run, mesh, &own);
        scene->meshes = &own;
        scene->mesh_count = 1;
        for (u32 i = 0; i < scene->shape_count; i++)
            if (scene->shapes[i].kind == SHAPE_MESH)
                scene->shapes[i].as.mesh.mesh = &own;
    }
    return ok ? layout_create(scene, run->error) : NULL;
}

bool run_scene(Run *run, const char *text, RayTable *table)
{
    Layout *layout = run_layout(run, text, NULL);
    const ProbeHow how = {.mode = PROBE_HIERARCHY, .steps = 1, .shade = true};
    const bool ok = layout && probe_rays(run->probe, layout, how, table, run->error);
    layout_destroy(layout);
    return ok;
}

Sheet *sheet_create(Run *run)
{
    Sheet *sheet = run_alloc(run, 1, sizeof *sheet);
    if (!sheet)
        return NULL;
    sheet->run = run;
    sheet->table = run_rays(run, SHEET_ROWS);
    return sheet->table ? sheet : NULL;
}

void sheet_case(Sheet *sheet, const char *id, const char *what, const char *against, Unit unit, f64 bar)
{
    sheet->cases[sheet->case_count++] = (SheetCase){id, what, against, unit, bar};
}

void sheet_primitive(Sheet *sheet, Primitive primitive)
{
    sheet->primitive = primitive;
}

void sheet_shape(Sheet *sheet, const Shape *shape, Affine map)
{
    if (!run_bake(sheet->run, shape, &map, &sheet->primitive))
        sheet->failed = true;
}

void sheet_ray(Sheet *sheet, Vec3 org, Vec3 dir, f64 exact)
{
    const u32 row = sheet->table->count;
    sheet->primitives[row] = sheet->primitive;
    sheet->row_case[row] = sheet->case_count - 1;
    sheet->exact[row] = exact;
    ray_table_add_vec(sheet->table, row, org, dir);
}

static void judge_row(Score *score, Unit unit, f64 exact, f64 t)
{
    if (unit == UNIT_ULP)
        score_ulps(score, exact, t);
    else if (unit == UNIT_RELATIVE)
        score_relative(score, exact, t);
    else if (isnan(t))
        score_value(score, t);
    else
        score_wrong(score, isinf(exact) ? !isinf(t) : isinf(t));
}

bool sheet_run(Sheet *sheet)
{
    Score scores[SHEET_CASES];
    memset(scores, 0, sizeof scores);
    if (sheet->failed || !run_own(sheet->run, sheet->primitives, sheet->table->count, sheet->table))
        return false;
    for (u32 row = 0; row < sheet->table->count; row++) {
        const u32 k = sheet->row_case[row];
        judge_row(&scores[k], sheet->cases[k].unit, sheet->exact[row],
                  hit_number(sheet->table, row, PROBE_T));
    }
    for (u32 k = 0; k < sheet->case_count; k++) {
        const SheetCase *c = &sheet->cases[k];
        run_add(sheet->run, c->id, c->what, c->against, c->unit, c->bar, &scores[k]);
    }
    return true;
}
