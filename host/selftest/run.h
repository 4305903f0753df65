// Run: what the groups of cases share: the probe, memory for one group, the report; and sheets, tables of
// rays whose distances are known. Private to this module.
#ifndef CLRT_SELFTEST_RUN_H
#define CLRT_SELFTEST_RUN_H

#include "base/vec.h"
#include "selftest/probe.h"
#include "selftest/selftest.h"
#include "selftest/surfaces.h"

typedef struct Run {
    Probe *probe;
    u32 inputs; // random ones of each case about arithmetic and functions
    Arena *arena; // of the group at hand
    SelfTestReport *report;
    Error *error;
} Run;

// Groups of cases. Each returns false, with run->error set, where a case could not be run.
bool arithmetic_cases(Run *run); // these three need the small program only
bool division_cases(Run *run);   // and what is meant to divide exactly
bool function_cases(Run *run);
bool agreed_cases(Run *run);
bool film_cases(Run *run);
bool sphere_cases(Run *run);
bool flat_cases(Run *run);
bool round_cases(Run *run);
bool origin_cases(Run *run);
bool rim_cases(Run *run);
bool transform_cases(Run *run);
bool mesh_cases(Run *run);
bool triangle_cases(Run *run);
bool garbage_cases(Run *run);
bool shading_cases(Run *run);
bool texture_cases(Run *run);
bool color_cases(Run *run);

void run_add(Run *run, const char *id, const char *what, const char *against, Unit unit, f64 bar,
             const Score *score);

// Of zeros from run->arena; NULL, with the error set, where memory is exhausted.
void *run_alloc(Run *run, size_t count, size_t size);
RayTable *run_rays(Run *run, u32 capacity);
NumberTable *run_numbers(Run *run, u32 count, u32 columns);

// bake_shape, with the error in the run.
bool run_bake(Run *run, const Shape *shape, const Affine *to_space, Primitive *out);

// Traces the rays of the table at primitives[PROBE_PRIMITIVE] of each ray, with all that shading knows.
bool run_own(Run *run, const Primitive *primitives, u32 count, RayTable *table);

// The layout of a scene of the language, which must be without errors. With `mesh`, the file of its only mesh
// statement is these triangles. NULL, with the error set, where it cannot be made; the caller's to destroy.
Layout *run_layout(Run *run, const char *text, const TriangleList *mesh);

// Traces the rays of the table through such a scene, with all that shading knows.
bool run_scene(Run *run, const char *text, RayTable *table);

// ---- sheets -----------------------------------------------------------------------------------

enum { SHEET_ROWS = 192, SHEET_CASES = 16 };

typedef struct SheetCase {
    const char *id, *what, *against;
    Unit unit;
    f64 bar;
} SheetCase;

// Rays, each at a primitive of its own, and the distance at which it must meet it.
typedef struct Sheet {
    Run *run;
    bool failed; // a shape could not be baked; the error is set
    SheetCase cases[SHEET_CASES];
    u32 case_count;
    Primitive primitive; // of the rays to come
    Primitive primitives[SHEET_ROWS];
    u32 row_case[SHEET_ROWS];
    f64 exact[SHEET_ROWS];
    RayTable *table;
} Sheet;

// NULL, with the error set, where memory is exhausted.
Sheet *sheet_create(Run *run);
// The rays that follow belong to this case. unit: UNIT_ULP, UNIT_RELATIVE, or UNIT_WRONG: only whether
// there is a hit counts.
void sheet_case(Sheet *sheet, const char *id, const char *what, const char *against, Unit unit, f64 bar);
// The rays that follow are at this primitive, or this shape baked under the map.
void sheet_primitive(Sheet *sheet, Primitive primitive);
void sheet_shape(Sheet *sheet, const Shape *shape, Affine map);
// exact INFINITY: no hit.
void sheet_ray(Sheet *sheet, Vec3 org, Vec3 dir, f64 exact);
// Traces the rays and adds the cases to the report; sheet->table holds all that they met.
bool sheet_run(Sheet *sheet);

#endif
