// The path integrator: a wave of paths that stays full. Each slot follows one path; where it ends the next camera ray
// takes its place. Radiance of samples waits in a ring until all of their round are done, and then enters the film
// in the order of rounds: so the film sees the samples of a pixel in their order.
#ifndef CLRT_KERNELS_STAGES_PATH_H
#define CLRT_KERNELS_STAGES_PATH_H

#include "stages/film.h"
#include "stages/path_light.h"
#include "stages/trace.h"

// Between stages in which another work-item takes over a slot.
#if BATCH > LANES
#define STAGE_BARRIER() GROUP_BARRIER()
#else
#define STAGE_BARRIER()
#endif

// Rays of this depth and deeper go on with a probability.
#define ROULETTE_DEPTH 4

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

// The ray that follows, weighed by roulette. u decides. Returns what goes on.
static inline vm path_survives(v3 *throughput, vi depth, vf u)
{
    const vf most = vf_max(vf_max(throughput->x, throughput->y), throughput->z);
    const vf chance = depth >= (vi)(ROULETTE_DEPTH) ? vf_min(most, (vf)(1.0f)) : (vf)(1.0f);
    *throughput = v3_scale(*throughput, (vf)(1.0f) / (chance > (vf)(0.0f) ? chance : (vf)(1.0f)));
    return (u < chance) & (most > (vf)(0.0f));
}

// Puts the ray that follows the hit in flight; returns FLAG_NEXT where there is one.
OUTLINE vi path_spawn(const PathWave *w, const Slots *slots, const Hit *hit, const PathParts *parts, v3 throughput,
                      vi depth, vi instance, vf roulette, vm going)
{
    const State *s = &w->s;
    NextRay next;
    const SamplePoint point = sample_point(hit_random_pair(&hit->random, PAIR_SCATTER));
    const PathDraw drawn = path_draw(hit, parts, point);
    const v3 side = v3_select(drawn.through, v3_neg(hit->ng), hit->ng);
    next.throughput = v3_mul(throughput, drawn.weight);
    const vm survives = path_survives(&next.throughput, depth + 1, roulette);
    next.m = going & drawn.on & survives & (v3_dot(drawn.dir, side) > (vf)(0.0f));
    next.dir = drawn.dir;
    next.org = offset_origin(hit->point, hit->error, hit->ng, side);
    next.self = hit->primitive * 2 + (drawn.through != hit->inside ? (vi)(1) : (vi)(0));
    next.path = path_follow(&hit->random, (vm)(0));
    w->rays[RAYS_TRANSMITTED] += popcount(vm_bits(next.m & drawn.through));
    w->rays[RAYS_REFLECTED] += popcount(vm_bits(next.m & !drawn.through));
    store_ray(s, slots, &next, depth + 1, instance, slots->valid);
    state_store(s, DENSITY, slots, drawn.density, slots->valid);
    return next.m ? (vi)(FLAG_NEXT) : (vi)(0);
}

#if HAS_LIGHTS
// Light of the lights on the hit: queued as a shadow ray, or added at once where nothing casts shadows. Returns
// bit 0 of FLAGS.
OUTLINE vi path_lights(const PathWave *w, const Slots *slots, const Hit *hit, const PathParts *parts,
                       v3 throughput, vf choice, v3 *radiance, vm lit)
{
    const PathLightRay ray =
        path_light_ray(hit, w->shading, w->lights, &w->settings, parts, choice, lit);
    const v3 gain = v3_mul(throughput, ray.gain);
#if HAS_SHADOWS
    const State *s = &w->s;
    const vm arrives = lit & (brightness(gain) > (vf)(0.0f));
    const vi self = hit->primitive * 2 + (hit->inside ? (vi)(1) : (vi)(0));
    state_store_int(s, SHADOW_SELF, slots, self, slots->valid);
    state_store_int(s, SHADOW_LEFT_OUT, slots, ray.left_out, slots->valid);
    state_store_int(s, SHADOW_PLANES, slots, ray.planes, slots->valid);
    state_store3(s, SHADOW_ORG, slots, shadow_origin(hit), slots->valid);
    state_store3(s, SHADOW_LIGHTS + SHADOW_DIR, slots, ray.dir, slots->valid);
    state_store(s, SHADOW_LIGHTS + SHADOW_T, slots, ray.length, slots->valid);
    state_store3(s, SHADOW_LIGHTS + SHADOW_GAIN, slots, gain, slots->valid);
    return arrives ? (vi)(1) : (vi)(0);
#else
    *radiance = v3_select(lit, v3_add(*radiance, gain), *radiance);
    return (vi)(0);
#endif
}
#endif

// The rays of the queue that have met a surface, in the lanes of m. Returns FLAGS.
OUTLINE vi path_shade_hits(const PathWave *w, const Slots *slots, vf t, v3 throughput, v3 *radiance, vm m)
{
    const State *s = &w->s;
    const Shading *shading = w->shading;
    vi instance = (vi)(NO_HIT);
#if HAS_INSTANCES
    instance = state_load_int(s, INSTANCE, slots);
#endif
    const v3 org = state_load3(s, RAY_ORG, slots);
    Hit hit = hit_make(w->scene, shading, org, state_load3(s, RAY_DIR, slots), t,
                       state_load_int(s, PRIMITIVE, slots), instance);
    const vi depth = state_load_int(s, DEPTH, slots), most = (vi)((int)w->params->max_depth);
    hit.random = hit_random(s, slots);
#if HAS_PBR
    hit.pbr = hit_pbr(&hit, shading);
#endif
#if HAS_EMISSION
    const v3 shine = path_emission(&hit, shading, w->lights, &w->settings, org, t, state_load(s, DENSITY, slots),
                                   depth > most);
    *radiance = v3_select(m, v3_add(*radiance, v3_mul(throughput, shine)), *radiance);
#endif
    const vm going = m & (depth <= most);
    if (!vm_any(going))
        return (vi)(0);
    const SamplePoint choice = sample_point(hit_random_pair(&hit.random, PAIR_CHOICE));
    const PathParts parts = path_parts(&hit, shading, &w->settings, depth == most);
    vi flags = (vi)(0);
#if HAS_LIGHTS
    flags = path_lights(w, slots, &hit, &parts, throughput, choice.x, radiance, going);
#endif
    return flags | path_spawn(w, slots, &hit, &parts, throughput, depth, instance, choice.y, going);
}

// Paths that have met nothing take what the sky sends, and end; so do those that look for lights and meet something
// else.
OUTLINE void path_miss(const PathWave *w)
{
    const State *s = &w->s;
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint i = GROUP_ITEM * LANES; i < w->count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, w->count);
        const vm found = state_load(s, RAY_T, &slots) < (vf)(INFINITY);
        vm goes_on = found;
#if HAS_ENVIRONMENT
        if (!vm_all(found)) {
            const v3 throughput = state_load3(s, THROUGHPUT, &slots), radiance = state_load3(s, RADIANCE, &slots);
            const v3 sky = path_sky(w->shading, &w->settings, state_load3(s, RAY_DIR, &slots),
                                    state_load(s, DENSITY, &slots));
            state_store3(s, RADIANCE, &slots, v3_add(radiance, v3_mul(throughput, sky)), slots.valid & !found);
        }
#endif
#if !HAS_AREA_LIGHTS
        goes_on = goes_on & (state_load_int(s, DEPTH, &slots) <= (vi)((int)w->params->max_depth));
#endif
        state_store_int(s, FLAGS, &slots, goes_on ? (vi)(FLAG_NEXT) : (vi)(0), slots.valid);
    }
}

// The rays of the queue, which all have met a surface.
OUTLINE void path_shade(const PathWave *w)
{
    const State *s = &w->s;
    global const int *queue = s->ints + QUEUE * TILE_SLOTS;
    for (uint i = GROUP_ITEM * LANES; i < w->count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, w->count);
        v3 radiance = state_load3(s, RADIANCE, &slots);
        const vi flags = path_shade_hits(w, &slots, state_load(s, RAY_T, &slots), state_load3(s, THROUGHPUT, &slots),
                                         &radiance, slots.valid);
        state_store3(s, RADIANCE, &slots, radiance, slots.valid);
        state_store_int(s, FLAGS, &slots, flags, slots.valid);
    }
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

// One ray of every path of the wave. Those that end on the way make room at once, so that no vector is shaded for the
// sake of a few of its lanes.
OUTLINE void path_step(PathWave *w)
{
    w->rays[RAYS_LANES] += (w->count + GROUP * LANES - 1) / (GROUP * LANES) * LANES;
    for (uint stage = 0; stage < 2; stage++) {
        if (stage == 0) {
            intersect_closest(&w->s, w->scene, w->count);
            STAGE_BARRIER();
            path_miss(w);
        } else {
            path_shade(w);
#if HAS_SHADOWS
            STAGE_BARRIER();
            intersect_shadow(&w->s, w->scene, w->count, &w->rays[RAYS_SHADOW]);
#endif
        }
        STAGE_BARRIER();
        path_finish(&w->s, w->count);
        path_advance(w);
    }
    path_film(w, path_first_round(w));
}

// Starts the paths of the next `count` waiting camera rays in as many free slots.
OUTLINE void path_start(PathWave *w, uint count)
{
    const State *s = &w->s, *pool = &w->pool;
    const uint begin = w->ring[w->begun % PATH_ROUNDS].begin;
    global const int *slots_queue = s->ints + QUEUE * TILE_SLOTS + w->count;
    global const int *pool_queue = pool->ints + QUEUE * TILE_SLOTS + w->started;
    const int mask = (1 << w->params->slots_log2) - 1;
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(slots_queue, i, count), source = slots_make(pool_queue, i, count);
        const vm m = slots.valid;
        state_store3(s, RAY_ORG, &slots, state_load3(pool, RAY_ORG, &source), m);
        state_store3(s, RAY_DIR, &slots, state_load3(pool, RAY_DIR, &source), m);
        state_store3(s, THROUGHPUT, &slots, v3_splat(1.0f), m);
        state_store3(s, RADIANCE, &slots, v3_splat(0.0f), m);
        state_store(s, DENSITY, &slots, (vf)(0.0f), m);
        state_store_int(s, SELF, &slots, (vi)(-1), m);
#if HAS_INSTANCES
        state_store_int(s, SELF_INSTANCE, &slots, (vi)(NO_HIT), m);
#endif
        state_store_int(s, DEPTH, &slots, (vi)(0), m);
        state_store_int(s, PATH, &slots, state_load_int(pool, PATH, &source), m);
        state_store_int(s, JOB, &slots, source.index + (vi)((int)(w->begun * TILE_SLOTS)), m);
        state_store_int(s, SAMPLE, &slots, (source.index & mask) + (vi)((int)begin), m);
    }
    w->started += count;
    w->count += count;
    GROUP_BARRIER();
}

// Whether camera rays of a further round are wanted: no others wait, there is one, and room for its samples.
static inline bool path_wants_round(const PathWave *w)
{
    return w->started == w->waiting && w->tile < w->tiles && w->begun + 1 - w->done < PATH_ROUNDS;
}

// Queues the camera rays of the next round of the group's samples.
static inline void path_next_round(PathWave *w)
{
    constant RenderParams *params = w->params;
    const uint side = TILE_SIDE >> params->slots_log2 / 2, columns = (params->crop_width + side - 1) / side;
    PathRound *round = &w->ring[++w->begun % PATH_ROUNDS];
    round->tile.left = w->tile % columns * side;
    round->tile.top = w->tile / columns * side;
    round->tile.width = min(params->crop_width - round->tile.left, side);
    round->tile.height = min(w->band_rows - round->tile.top, side);
    round->tile.image_left = (int)(params->left + round->tile.left);
    round->tile.image_top = (int)(params->top + w->band_top + round->tile.top);
    round->begin = w->sample;
    round->end = min(w->sample + (1u << params->slots_log2), w->sample_end);
    w->waiting = start_samples(&w->pool, params, w->quantiles, &round->tile, round->begin, round->end, w->scratch,
                               w->rays);
    w->started = 0;
    const bool last = round->end >= w->sample_end;
    w->sample = last ? w->sample_begin : round->end;
    w->tile += last ? get_num_groups(0) : 0;
}

// Follows all paths of the group's samples: whenever slots are free camera rays take them. Barriers stand in loops,
// never behind conditions, which would let PoCL copy all that comes after them.
static inline void path_trace(PathWave *w)
{
    path_wave_clear(w);
    do {
        do {
            while (path_wants_round(w))
                path_next_round(w);
            path_start(w, min(w->waiting - w->started, TILE_SLOTS - w->count));
        } while (w->count < TILE_SLOTS && path_wants_round(w));
        path_step(w);
    } while (w->count > 0 || w->started < w->waiting || w->tile < w->tiles);
}

#endif
