// The path integrator: a wave of paths that stays full. Each slot follows one path; where it ends the next camera ray
// takes its place.
#ifndef CLRT_KERNELS_STAGES_PATH_H
#define CLRT_KERNELS_STAGES_PATH_H

#include "stages/path_shade.h"
#include "stages/trace.h"

// Between stages in which another work-item takes over a slot.
#if BATCH > LANES
#define STAGE_BARRIER() GROUP_BARRIER()
#else
#define STAGE_BARRIER()
#endif

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
