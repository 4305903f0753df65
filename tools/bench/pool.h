// Pool: the threads of the host that trace with Embree. They sleep between runs, so that a contender's turn
// is not spent beside threads of another one that wait in a loop, as OpenMP's do.
#ifndef CLRT_BENCH_POOL_H
#define CLRT_BENCH_POOL_H

#include "base/error.h"
#include "base/types.h"

typedef struct Pool Pool;
// Does items begin .. end - 1.
typedef void (*PoolWork)(void *context, u32 begin, u32 end);

// threads: at least 1, the calling one among them. Fails with ERROR_MEMORY.
Pool *pool_create(u32 threads, Error *error);
void pool_destroy(Pool *pool);

// Hands count items out in chunks, and returns when all are done.
void pool_run(Pool *pool, PoolWork work, void *context, u32 count, u32 chunk);

#endif
