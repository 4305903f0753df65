// Stages of paths: path_miss for the rays that have met nothing, path_shade for the others: light that arrives, the
// shadow ray, and the ray that follows.
#ifndef CLRT_KERNELS_STAGES_PATH_SHADE_H
#define CLRT_KERNELS_STAGES_PATH_SHADE_H

#include "stages/path_wave.h"

// Rays of this depth and deeper go on with a probability.
#define ROULETTE_DEPTH 4

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

#endif
