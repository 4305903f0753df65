// Whether hits are right: against those of another tracer, and against all primitives one by one in double.
#ifndef CLRT_BENCH_CHECK_H
#define CLRT_BENCH_CHECK_H

#include "pool.h"
#include "rays.h"

typedef struct Mismatch {
    u32 hit_miss; // one hits, the other misses
    u32 other;    // both hit, another primitive at another t (by more than 1e-6 of it)
    f64 t_error;  // largest |difference| / t where both hit
} Mismatch;

// Both are of the same rays.
Mismatch hits_compare(const RaySet *rays, const RayHits *a, const RayHits *b);

typedef struct Verdict {
    u32 checked;
    u32 wrong; // outside the band that the rounding to float blurs about edges, silhouettes and t
} Verdict;

// The verdict on hits where those of another tracer differ from them, as hits_compare counts it; a few rays.
Verdict hits_arbitrate(const BenchScene *scene, Pool *pool, const RaySet *rays, const RayHits *hits,
                       const RayHits *others);

// Searches all primitives for rays spread over the set, as many as some hundred million tests allow.
Verdict hits_check(const BenchScene *scene, Pool *pool, const RaySet *rays, const RayHits *hits);

#endif
