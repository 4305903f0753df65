// The wave of paths of a group: its state, how it stays dense, and the ring in which radiance of samples waits until all
// of their round are done and enters the film in the order of rounds: so the film sees the samples of a pixel in their
// order.
#ifndef CLRT_KERNELS_STAGES_PATH_WAVE_H
#define CLRT_KERNELS_STAGES_PATH_WAVE_H

#include "stages/film.h"
#include "stages/path_light.h"

// A round of samples of a tile.
typedef struct {
    Tile tile;
    uint begin, end; // samples
} PathRound;

// What a group works on.
typedef struct {
    State s, pool; // of the slots, and of camera rays that wait
    const Hierarchy *scene;
    const Shading *shading;
    global const LightRecord *lights;
    constant RenderParams *params;
    global const f32 *quantiles;
    global f32 *film, *film_low, *film_m2;
#if HAS_CLAMP
    global f32 *film_clamped;
    f32 clamp_limit;
#endif
    PathSettings settings;
    PathRound ring[PATH_ROUNDS];
    uint tile, tiles;  // the next one, of all of the band
    uint band_top, band_rows;
    uint sample, sample_begin, sample_end; // the next one of the tile's pixels, of those of the launch
    uint begun, done;  // number of the youngest round, and of the first that is not in the film, from 1
    uint waiting, started; // camera rays of the youngest round, and those that have a slot or had one
    uint count;        // slots with a path; the first of the queue
    local uint *scratch;
    uint *rays;
} PathWave;

// The queue has the slots in their order for good: paths move to the first of them.
static inline void path_wave_clear(PathWave *w)
{
    global int *ints = w->s.ints;
    w->begun = w->waiting = w->started = w->count = 0;
    w->done = 1;
    for (uint i = GROUP_ITEM; i < TILE_SLOTS; i += GROUP)
        ints[QUEUE * TILE_SLOTS + i] = (int)i;
    GROUP_BARRIER();
}

// Brings the radiance of the paths that have ended into the ring.
OUTLINE void path_finish(const State *s, uint count)
{
    global real *ring = s->reals + RING_REALS * TILE_SLOTS;
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(s->ints + QUEUE * TILE_SLOTS, i, count);
        const vm ended = slots.valid & ((state_load_int(s, FLAGS, &slots) & FLAG_NEXT) == (vi)(0));
        if (!vm_any(ended))
            continue;
        const vi job = state_load_int(s, JOB, &slots);
        const vi place = ((job / TILE_SLOTS) & (PATH_ROUNDS - 1)) * (3 * TILE_SLOTS) + (job & (TILE_SLOTS - 1));
        const v3 radiance = state_load3(s, RADIANCE, &slots);
        vf_scatter(ring, place, radiance.x, ended);
        vf_scatter(ring, place + TILE_SLOTS, radiance.y, ended);
        vf_scatter(ring, place + 2 * TILE_SLOTS, radiance.z, ended);
    }
}

// What a path takes along to its next stage.
typedef struct {
    v3 org, dir, throughput, radiance;
    vf density, t;
    vi self, primitive, depth, path, job, sample;
#if HAS_INSTANCES
    vi self_instance, instance;
#endif
} PathCargo;

static inline PathCargo path_take(const State *s, const Slots *slots)
{
    PathCargo p;
    p.org = state_load3(s, RAY_ORG, slots);
    p.dir = state_load3(s, RAY_DIR, slots);
    p.throughput = state_load3(s, THROUGHPUT, slots);
    p.radiance = state_load3(s, RADIANCE, slots);
    p.density = state_load(s, DENSITY, slots);
    p.t = state_load(s, RAY_T, slots);
    p.self = state_load_int(s, SELF, slots);
    p.primitive = state_load_int(s, PRIMITIVE, slots);
    p.depth = state_load_int(s, DEPTH, slots);
    p.path = state_load_int(s, PATH, slots);
    p.job = state_load_int(s, JOB, slots);
    p.sample = state_load_int(s, SAMPLE, slots);
#if HAS_INSTANCES
    p.self_instance = state_load_int(s, SELF_INSTANCE, slots);
    p.instance = state_load_int(s, INSTANCE, slots);
#endif
    return p;
}

// Into LANES slots that follow each other.
static inline void path_put(const State *s, const Slots *slots, const PathCargo *p)
{
    state_store3(s, RAY_ORG, slots, p->org, slots->valid);
    state_store3(s, RAY_DIR, slots, p->dir, slots->valid);
    state_store3(s, THROUGHPUT, slots, p->throughput, slots->valid);
    state_store3(s, RADIANCE, slots, p->radiance, slots->valid);
    state_store(s, DENSITY, slots, p->density, slots->valid);
    state_store(s, RAY_T, slots, p->t, slots->valid);
    state_store_int(s, SELF, slots, p->self, slots->valid);
    state_store_int(s, PRIMITIVE, slots, p->primitive, slots->valid);
    state_store_int(s, DEPTH, slots, p->depth, slots->valid);
    state_store_int(s, PATH, slots, p->path, slots->valid);
    state_store_int(s, JOB, slots, p->job, slots->valid);
    state_store_int(s, SAMPLE, slots, p->sample, slots->valid);
#if HAS_INSTANCES
    state_store_int(s, SELF_INSTANCE, slots, p->self_instance, slots->valid);
    state_store_int(s, INSTANCE, slots, p->instance, slots->valid);
#endif
}

// Moves the paths that go on to the first slots, in their order: what follows each other is loaded and stored at once.
// No slot is written before it has been read, since all move down.
OUTLINE void path_advance(PathWave *w)
{
    const State *s = &w->s;
    global const int *next = s->ints + QUEUE_NEXT * TILE_SLOTS;
    const uint left = queue_compact(s, s->ints + QUEUE * TILE_SLOTS, w->count, FLAG_NEXT,
                                    s->ints + QUEUE_NEXT * TILE_SLOTS, w->scratch);
    for (uint base = 0; base < left; base += GROUP * LANES) {
        const uint i = base + GROUP_ITEM * LANES;
        const bool some = i < left;
        const Slots from = slots_make(next, some ? i : 0, left), to = slots_all(some ? i : 0);
        const bool moves = some && !(from.consecutive && from.first == to.first);
        PathCargo cargo;
        if (moves)
            cargo = path_take(s, &from);
        GROUP_BARRIER();
        if (moves)
            path_put(s, &to, &cargo);
    }
    w->count = left;
    GROUP_BARRIER();
}

// The first round that has a path in flight or a camera ray that waits: all before it are in the ring.
OUTLINE uint path_first_round(const PathWave *w)
{
    global const int *jobs = w->s.ints + JOB * TILE_SLOTS;
    uint first = w->begun + (w->started == w->waiting ? 1 : 0);
    for (uint i = GROUP_ITEM; i < w->count; i += GROUP)
        first = min(first, (uint)jobs[i] / TILE_SLOTS);
#if GROUP > 1
    w->scratch[GROUP_ITEM] = first;
    GROUP_BARRIER();
    for (uint k = 0; k < GROUP; k++)
        first = min(first, w->scratch[k]);
#endif
    return first;
}

// Takes the rounds before number `end`, which are complete, into the film.
OUTLINE void path_film(PathWave *w, uint end)
{
    for (; w->done < end; w->done++) {
        const uint place = w->done % PATH_ROUNDS;
        const PathRound *round = &w->ring[place];
        const State *samples = &w->pool; // where nothing waits but rays
        global const real *from = w->s.reals + (RING_REALS + 3 * place) * TILE_SLOTS;
        global real *to = samples->reals + RADIANCE * TILE_SLOTS;
        for (uint i = GROUP_ITEM; i < 3 * TILE_SLOTS; i += GROUP)
            to[i] = from[i];
        GROUP_BARRIER();
#if HAS_CLAMP
        clamp_samples(samples, RADIANCE, w->clamp_limit);
#endif
#if HAS_FILTER_LOBES
        weigh_samples(samples, w->params, w->quantiles, round->tile.image_left, round->tile.image_top,
                      round->begin);
#endif
        film_add(samples, w->params, w->film, w->film_low, w->film_m2, &round->tile, round->begin, round->end);
#if HAS_CLAMP
        film_add_clamped(samples, w->params, w->film_clamped, &round->tile, round->begin, round->end);
#endif
        GROUP_BARRIER();
    }
}

#endif
