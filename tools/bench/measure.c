#define _POSIX_C_SOURCE 200809L

#include "measure.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "base/clock.h"

// A scene in hand, with all who trace it.
typedef struct Stage {
    const Bench *bench;
    BenchScene *scene;
    Layout *layout;
    Tracer *tracer, *counter; // counter: NULL where visits are not counted
    EmbreeScene *embree[EMBREE_SCENES];
} Stage;

// Rays and clrt's hits, kept as long as other sets start from them.
typedef struct Traced {
    RaySet *rays;
    RayHits *hits;
} Traced;

static int compare_numbers(const void *a, const void *b)
{
    const f64 x = *(const f64 *)a, y = *(const f64 *)b;
    return x < y ? -1 : x > y;
}

f64 median_of(const f64 *values, u32 count)
{
    f64 sorted[ROUNDS_MAX];
    if (count == 0)
        return 0;
    memcpy(sorted, values, count * sizeof *sorted);
    qsort(sorted, count, sizeof *sorted, compare_numbers);
    return 0.5 * (sorted[(count - 1) / 2] + sorted[count / 2]);
}

static f64 cpu_seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
    return (f64)now.tv_sec + 1e-9 * (f64)now.tv_nsec;
}

// ---- building -------------------------------------------------------------------------------

static bool build_layout(Stage *stage, f64 *layout_seconds, f64 *build_seconds, Error *error)
{
    layout_destroy(stage->layout);
    const f64 start = clock_seconds();
    stage->layout = layout_create(stage->scene->scene, error);
    *layout_seconds = clock_seconds() - start;
    *build_seconds = stage->layout ? stage->layout->build_seconds : 0;
    return stage->layout != NULL;
}

static bool build_embree(Stage *stage, u32 k, f64 *seconds, Error *error)
{
    const Bench *bench = stage->bench;
    const EmbreeBuild build = {k == 0, bench->options->high, bench->threads};
    embree_scene_destroy(stage->embree[k]);
    stage->embree[k] = embree_scene_create(stage->scene, build, error);
    *seconds = stage->embree[k] ? embree_build_seconds(stage->embree[k]) : 0;
    return stage->embree[k] != NULL;
}

static void take_layout(const Layout *layout, SceneResult *result)
{
    result->nodes = layout->node_count;
    result->blocks = layout->block_count;
    result->bytes = layout->node_count * (u64)sizeof(BvhNode) +
                    layout->block_count * (u64)sizeof(TriangleBlock) +
                    layout->primitive_count * (u64)(sizeof(Primitive) + sizeof(PrimitiveInfo));
}

static bool build_all(Stage *stage, SceneResult *result, Error *error)
{
    const BenchOptions *options = stage->bench->options;
    const bool wanted[EMBREE_SCENES] = {options->embree && options->robust, options->embree && options->fast};
    f64 layout_seconds[ROUNDS_MAX], build_seconds[ROUNDS_MAX], embree_seconds[EMBREE_SCENES][ROUNDS_MAX];
    for (u32 round = 0; round < options->builds; round++) {
        if (!build_layout(stage, &layout_seconds[round], &build_seconds[round], error))
            return false;
        for (u32 k = 0; k < EMBREE_SCENES; k++)
            if (wanted[k] && !build_embree(stage, k, &embree_seconds[k][round], error))
                return false;
    }
    result->layout_seconds = median_of(layout_seconds, options->builds);
    result->build_seconds = median_of(build_seconds, options->builds);
    for (u32 k = 0; k < EMBREE_SCENES; k++) {
        if (!wanted[k])
            continue;
        result->embree_seconds[k] = median_of(embree_seconds[k], options->builds);
        result->embree_bytes[k] = embree_bytes(stage->embree[k]);
        result->embree_peak[k] = embree_bytes_peak(stage->embree[k]);
    }
    take_layout(stage->layout, result);
    return true;
}

// ---- tracing --------------------------------------------------------------------------------

static bool trace_once(const Stage *stage, const Contender *c, const RaySet *rays, RayHits *hits,
                       Error *error)
{
    if (!c->embree)
        return tracer_run(stage->tracer, error);
    embree_trace(stage->embree[c->robust ? 0 : 1], stage->bench->pool, c->mode, rays, hits);
    return true;
}

// As often as a turn is long.
static bool take_turn(const Stage *stage, Contender *c, u32 round, const RaySet *rays, RayHits *hits,
                      Error *error)
{
    const f64 cpu_start = cpu_seconds(), start = clock_seconds();
    for (u32 i = 0; i < c->repeats; i++)
        if (!trace_once(stage, c, rays, hits, error))
            return false;
    const f64 wall = clock_seconds() - start, cpu = cpu_seconds() - cpu_start;
    const f64 traced = (f64)rays->count * c->repeats;
    c->rates[METRIC_WALL][round] = wall > 0 ? traced / wall : 0;
    c->rates[METRIC_CPU][round] = cpu > 0 ? traced / (cpu / stage->bench->threads) : 0;
    return true;
}

// A first run, by which nothing is measured but how often to repeat.
static bool warm_up(const Stage *stage, Contender *c, const Traced *traced, RayHits *spare, Error *error)
{
    const f64 start = clock_seconds();
    if (!trace_once(stage, c, traced->rays, spare, error))
        return false;
    const f64 seconds = clock_seconds() - start;
    const f64 wanted = stage->bench->options->turn_seconds / (seconds > 1e-6 ? seconds : 1e-6);
    c->repeats = wanted > 10000 ? 10000 : wanted > 1 ? (u32)wanted + 1 : 1;
    if (c->embree) {
        c->mismatch = hits_compare(traced->rays, traced->hits, spare);
        c->arbitration =
            hits_arbitrate(stage->scene, stage->bench->pool, traced->rays, traced->hits, spare);
    }
    return true;
}

static void list_contenders(const Stage *stage, SetResult *set)
{
    set->contenders[set->contender_count++] = (Contender){.robust = true};
    for (u32 k = 0; k < EMBREE_SCENES; k++)
        for (int mode = 0; mode < EMBREE_MODES; mode++)
            if (stage->embree[k] && stage->bench->options->modes[mode])
                set->contenders[set->contender_count++] =
                    (Contender){.embree = true, .robust = k == 0, .mode = (EmbreeMode)mode};
}

static bool race(const Stage *stage, const Traced *traced, SetResult *set, Error *error)
{
    RayHits *spare = ray_hits_create(traced->rays->count, error);
    const u32 count = set->contender_count;
    bool ok = spare != NULL;
    for (u32 k = 0; ok && k < count; k++)
        ok = warm_up(stage, &set->contenders[k], traced, spare, error);
    for (u32 round = 0; ok && round < set->rounds; round++)
        for (u32 k = 0; ok && k < count; k++)
            ok = take_turn(stage, &set->contenders[(k + round) % count], round, traced->rays, spare, error);
    for (u32 k = 0; ok && k < count; k++)
        for (int metric = 0; metric < METRICS; metric++)
            set->contenders[k].medians[metric] = median_of(set->contenders[k].rates[metric], set->rounds);
    ray_hits_destroy(spare);
    return ok;
}

static bool count_visits(const Stage *stage, const RaySet *rays, SetResult *set, Error *error)
{
    Visits visits;
    if (!stage->counter)
        return true;
    if (!tracer_load(stage->counter, rays, error) || !tracer_run(stage->counter, error) ||
        !tracer_visits(stage->counter, &visits, error))
        return false;
    set->nodes = (f64)visits.nodes / rays->count;
    set->leaves = (f64)visits.leaves / rays->count;
    return true;
}

static bool measure_set(const Stage *stage, const Traced *traced, SceneResult *result, Error *error)
{
    const BenchOptions *options = stage->bench->options;
    SetResult *set = &result->sets[result->set_count++];
    *set = (SetResult){.kind = traced->rays->kind, .rays = traced->rays->count, .rounds = options->rounds};
    fprintf(stderr, "%s %s: %u rays%s\n", result->name, ray_kind_name(set->kind), set->rays,
            set->rays < RAYS_FEW ? ", too few to say much" : "");
    list_contenders(stage, set);
    if (set->rays == 0)
        return true;
    if (options->check)
        set->verdict = hits_check(stage->scene, stage->bench->pool, traced->rays, traced->hits);
    return race(stage, traced, set, error) && count_visits(stage, traced->rays, set, error);
}

// Makes the rays of a set, loads them into the tracer and traces them once.
static bool trace_set(const Stage *stage, RayKind kind, const Traced *source, Traced *traced, Error *error)
{
    traced->rays = rays_create(kind, stage->scene, stage->bench->options->size, source->rays, source->hits,
                               error);
    traced->hits = traced->rays ? ray_hits_create(traced->rays->count, error) : NULL;
    return traced->hits && tracer_load(stage->tracer, traced->rays, error) &&
           tracer_run(stage->tracer, error) && tracer_read(stage->tracer, traced->hits, error);
}

static bool needed(const bool *asked, RayKind kind)
{
    for (int other = 0; other < RAY_KINDS; other++)
        if (asked[other] && (other == (int)kind || ray_kind_source((RayKind)other) == kind))
            return true;
    return kind == RAYS_CAMERA;
}

// Sets come after those that they start from.
static bool measure_sets(const Stage *stage, SceneResult *result, Error *error)
{
    const bool *asked = stage->bench->options->rays;
    Traced all[RAY_KINDS] = {{NULL, NULL}};
    bool ok = true;
    // Diffuse hits are themselves a source, and stem from the camera's.
    for (int kind = 0; ok && kind < RAY_KINDS; kind++) {
        if (!needed(asked, (RayKind)kind))
            continue;
        Traced *traced = &all[kind];
        ok = trace_set(stage, (RayKind)kind, &all[ray_kind_source((RayKind)kind)], traced, error) &&
             (!asked[kind] || measure_set(stage, traced, result, error));
        if (kind != RAYS_CAMERA && kind != RAYS_DIFFUSE) {
            rays_destroy(traced->rays);
            ray_hits_destroy(traced->hits);
            *traced = (Traced){NULL, NULL};
        }
    }
    for (int kind = 0; kind < RAY_KINDS; kind++) {
        rays_destroy(all[kind].rays);
        ray_hits_destroy(all[kind].hits);
    }
    return ok;
}

static bool prepare(Stage *stage, const char *name, u32 triangles, SceneResult *result, Error *error)
{
    const Bench *bench = stage->bench;
    stage->scene = bench_scene_create(name, triangles, error);
    if (!stage->scene)
        return false;
    result->primitives = stage->scene->primitive_count;
    result->instances = stage->scene->instance_count;
    fprintf(stderr, "%s: %llu primitives\n", name, (unsigned long long)result->primitives);
    if (!build_all(stage, result, error))
        return false;
    stage->tracer = tracer_create(bench->device, stage->layout, false, error);
    if (!stage->tracer)
        return false;
    result->compile_seconds = tracer_compile_seconds(stage->tracer);
    if (bench->options->visits)
        stage->counter = tracer_create(bench->device, stage->layout, true, error);
    return stage->counter || !bench->options->visits;
}

bool measure_scene(const Bench *bench, const char *name, u32 triangles, SceneResult *result, Error *error)
{
    Stage stage = {.bench = bench};
    memset(result, 0, sizeof *result);
    result->name = name;
    const bool ok = prepare(&stage, name, triangles, result, error) && measure_sets(&stage, result, error);
    tracer_destroy(stage.tracer);
    tracer_destroy(stage.counter);
    for (u32 k = 0; k < EMBREE_SCENES; k++)
        embree_scene_destroy(stage.embree[k]);
    layout_destroy(stage.layout);
    bench_scene_destroy(stage.scene);
    return ok;
}

Versus versus_embree(const SetResult *set, bool robust, Metric metric)
{
    Versus versus = {0, 0, 0};
    f64 ratios[ROUNDS_MAX];
    const Contender *all = set->contenders;
    for (u32 k = 1; k < set->contender_count; k++)
        if (all[k].robust == robust &&
            (versus.best == 0 || all[k].medians[metric] > all[versus.best].medians[metric]))
            versus.best = k;
    if (versus.best == 0 || !(all[versus.best].medians[metric] > 0))
        return (Versus){0, 0, 0};
    const Contender *best = &all[versus.best];
    versus.ratio = all[0].medians[metric] / best->medians[metric];
    for (u32 round = 0; round < set->rounds; round++)
        ratios[round] = all[0].rates[metric][round] / best->rates[metric][round];
    versus.of_rounds = median_of(ratios, set->rounds);
    return versus;
}
