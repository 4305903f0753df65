// Embree's side of the bench: the same geometry, the same rays, the same record of a hit. Without the library
// (embree_none.c) embree_version is NULL and nothing else may be called.
#ifndef CLRT_BENCH_EMBREE_H
#define CLRT_BENCH_EMBREE_H

#include "pool.h"
#include "rays.h"
#include "scenes.h"

typedef enum EmbreeMode {
    EMBREE_1,
    EMBREE_8,
    EMBREE_16,
    EMBREE_16_COHERENT,
    EMBREE_STREAM,
    EMBREE_STREAM_COHERENT,
    EMBREE_MODES
} EmbreeMode;

typedef struct EmbreeScene EmbreeScene;

typedef struct EmbreeBuild {
    bool robust, high; // RTC_SCENE_FLAG_ROBUST, RTC_BUILD_QUALITY_HIGH (else medium)
    u32 threads;
} EmbreeBuild;

// "3.13.5"; NULL where the bench was built without Embree.
const char *embree_version(void);
// "1", "16 coherent", ...
const char *embree_mode_name(EmbreeMode mode);
// Whether the library has it: streams ended with version 3.
bool embree_has_mode(EmbreeMode mode);

// Fails with ERROR_MEMORY, or ERROR_DEVICE with what Embree says.
EmbreeScene *embree_scene_create(const BenchScene *scene, EmbreeBuild build, Error *error);
void embree_scene_destroy(EmbreeScene *scene);

f64 embree_build_seconds(const EmbreeScene *scene); // of rtcCommitScene, both levels
i64 embree_bytes(const EmbreeScene *scene);         // of what was built, without vertices and indices
i64 embree_bytes_peak(const EmbreeScene *scene);

// hits: as many as there are rays. Denormals are zero meanwhile, as Embree's manual wants it.
void embree_trace(const EmbreeScene *scene, Pool *pool, EmbreeMode mode, const RaySet *rays, RayHits *hits);

#endif
