#include "pool.h"

#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>

struct Pool {
    pthread_t *threads;
    u32 started;
    pthread_mutex_t mutex;
    pthread_cond_t wake, done;
    u32 run;  // number of the run in hand
    u32 busy; // threads that are at it
    bool leave;
    PoolWork work;
    void *context;
    u32 count, chunk;
    _Atomic u32 next;
};

static void work_on(Pool *pool)
{
    for (;;) {
        const u32 begin = atomic_fetch_add(&pool->next, pool->chunk);
        if (begin >= pool->count)
            return;
        const u32 left = pool->count - begin;
        pool->work(pool->context, begin, begin + (left < pool->chunk ? left : pool->chunk));
    }
}

static void *serve(void *context)
{
    Pool *pool = context;
    u32 seen = 0;
    pthread_mutex_lock(&pool->mutex);
    for (;;) {
        while (pool->run == seen && !pool->leave)
            pthread_cond_wait(&pool->wake, &pool->mutex);
        if (pool->leave)
            break;
        seen = pool->run;
        pthread_mutex_unlock(&pool->mutex);
        work_on(pool);
        pthread_mutex_lock(&pool->mutex);
        if (--pool->busy == 0)
            pthread_cond_signal(&pool->done);
    }
    pthread_mutex_unlock(&pool->mutex);
    return NULL;
}

Pool *pool_create(u32 threads, Error *error)
{
    Pool *pool = calloc(1, sizeof *pool);
    if (pool && !(pool->threads = calloc(threads, sizeof *pool->threads))) {
        free(pool);
        pool = NULL;
    }
    if (!pool) {
        error_set(error, ERROR_MEMORY, "no memory for %u threads", threads);
        return NULL;
    }
    pthread_mutex_init(&pool->mutex, NULL);
    pthread_cond_init(&pool->wake, NULL);
    pthread_cond_init(&pool->done, NULL);
    while (pool->started + 1 < threads) {
        if (pthread_create(&pool->threads[pool->started], NULL, serve, pool) != 0) {
            error_set(error, ERROR_MEMORY, "the system starts no more than %u threads", pool->started + 1);
            pool_destroy(pool);
            return NULL;
        }
        pool->started++;
    }
    return pool;
}

void pool_destroy(Pool *pool)
{
    if (!pool)
        return;
    pthread_mutex_lock(&pool->mutex);
    pool->leave = true;
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
    for (u32 i = 0; i < pool->started; i++)
        pthread_join(pool->threads[i], NULL);
    pthread_cond_destroy(&pool->wake);
    pthread_cond_destroy(&pool->done);
    pthread_mutex_destroy(&pool->mutex);
    free(pool->threads);
    free(pool);
}

void pool_run(Pool *pool, PoolWork work, void *context, u32 count, u32 chunk)
{
    pthread_mutex_lock(&pool->mutex);
    pool->work = work;
    pool->context = context;
    pool->count = count;
    pool->chunk = chunk;
    atomic_store(&pool->next, 0);
    pool->busy = pool->started;
    pool->run++;
    pthread_cond_broadcast(&pool->wake);
    pthread_mutex_unlock(&pool->mutex);
    work_on(pool);
    pthread_mutex_lock(&pool->mutex);
    while (pool->busy > 0)
        pthread_cond_wait(&pool->done, &pool->mutex);
    pthread_mutex_unlock(&pool->mutex);
}
