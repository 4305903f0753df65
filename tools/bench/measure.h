// Measuring: the hierarchies of a scene built in turns, then each ray set traced in rounds in which every
// contender has a turn, in an order that moves on by one from round to round.
#ifndef CLRT_BENCH_MEASURE_H
#define CLRT_BENCH_MEASURE_H

#include "check.h"
#include "device/device.h"
#include "options.h"
#include "trace.h"

enum { EMBREE_SCENES = 2, CONTENDERS_MAX = 1 + EMBREE_SCENES * EMBREE_MODES };

// Rates are in rays a second: wall: over time that passed; cpu: over time that processors spent, divided by
// the threads, which tells more on a machine that does other work too.
typedef enum Metric { METRIC_WALL, METRIC_CPU, METRICS } Metric;

typedef struct Contender {
    bool embree, robust; // of Embree's; clrt has one way only, which is robust
    EmbreeMode mode;
    u32 repeats;         // of the set in a turn
    f64 rates[METRICS][ROUNDS_MAX], medians[METRICS];
    Mismatch mismatch; // of clrt's hits and these
    Verdict arbitration; // on clrt's, where they differ
} Contender;

typedef struct SetResult {
    RayKind kind;
    u32 rays, rounds;
    Contender contenders[CONTENDERS_MAX]; // [0] is clrt
    u32 contender_count;
    f64 nodes, leaves; // visits a ray
    Verdict verdict;
} SetResult;

// clrt against the best of Embree's modes of one kind.
typedef struct Versus {
    u32 best; // index of the contender; 0: there is none
    f64 ratio;      // of the medians
    f64 of_rounds;  // median of the ratios of each round
} Versus;

typedef struct SceneResult {
    const char *name;
    u64 primitives, instances;
    f64 build_seconds, layout_seconds; // medians; of the hierarchies alone, and of layout_create
    f64 compile_seconds;
    u64 bytes; // nodes, leaves and what a leaf refers to
    u32 nodes, blocks;
    f64 embree_seconds[EMBREE_SCENES]; // [0] robust, [1] fast; 0: not built
    i64 embree_bytes[EMBREE_SCENES], embree_peak[EMBREE_SCENES];
    SetResult sets[RAY_KINDS];
    u32 set_count;
} SceneResult;

// What all scenes are measured with.
typedef struct Bench {
    const BenchOptions *options;
    Device *device;
    Pool *pool;
    u32 threads;
} Bench;

// Measures the scene that options names at this index, or, with triangles > 0, of that size. Says what it is
// at on stderr. *result is large.
bool measure_scene(const Bench *bench, const char *name, u32 triangles, SceneResult *result, Error *error);

Versus versus_embree(const SetResult *set, bool robust, Metric metric);
f64 median_of(const f64 *values, u32 count);

#endif
