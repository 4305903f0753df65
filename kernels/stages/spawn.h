// The rays that follow a hit: mirrored and transmitted, at most two.
#ifndef CLRT_KERNELS_STAGES_SPAWN_H
#define CLRT_KERNELS_STAGES_SPAWN_H

#if HAS_REFLECT || HAS_TRANSMIT || HAS_PATH

// A ray that follows, where m is true.
typedef struct {
    v3 org, dir, throughput;
    vi self; // as BatchHits.self
    vm m;
#if HAS_HIT_RANDOM
    vi path; // as HitRandom.path
#endif
} NextRay;

#if HAS_REFLECT || HAS_TRANSMIT
// Weights and directions of the two rays (scene language, section 4).
typedef struct {
    v3 reflect_dir, reflect_weight;
    v3 transmit_dir, transmit_weight;
} Scatter;

#if HAS_PBR
// Weights of pbr lanes: the mirror of smooth surfaces, and clear transmission by Fresnel's equations.
static inline void scatter_pbr(const Hit *hit, v3 n, Scatter *s)
{
    const PbrLanes *m = &hit->pbr;
    const vm pbr = hit_is_pbr(hit), smooth = m->roughness < (vf)(PBR_MIRROR);
    const vf cosine = vf_clamp(-v3_dot(n, hit->dir), 0.0f, 1.0f), through = pbr_through(m);
    const v3 mirror = v3_scale(pbr_schlick(pbr_f0(m), 1.0f - cosine), 1.0f - through);
    v3 reflect = v3_select(smooth, mirror, v3_splat(0.0f)), transmit = v3_splat(0.0f);
#if HAS_TRANSMIT
    const vm leaves = hit->inside;
    const vf eta = leaves ? row_real(&hit->material, MATERIAL_IOR) : row_real(&hit->material, MATERIAL_INVERSE_IOR);
    const vf rest = leaves ? row_real(&hit->material, MATERIAL_ETA_OUT_REST)
                           : row_real(&hit->material, MATERIAL_ETA_IN_REST);
    const Refraction r = refract_cosines(cosine, eta, rest);
    const vf f = fresnel_dielectric(&r, eta);
    reflect = v3_add(reflect, v3_scale(v3_splat(1.0f), through * f));
    transmit = v3_scale(m->base_color, through * (1.0f - f));
#endif
    s->reflect_weight = v3_select(pbr, reflect, s->reflect_weight);
    s->transmit_weight = v3_select(pbr, transmit, s->transmit_weight);
}
#endif

OUTLINE Scatter scatter_make(const Hit *hit)
{
    Scatter s;
    const vf cos_ns = -v3_dot(hit->ns, hit->dir);
    const v3 n = v3_select(cos_ns > (vf)(0.0f), hit->ns, hit->ng);
    s.reflect_dir = v3_normalize(reflect_about(hit->dir, n));
    s.reflect_weight = row_real3(&hit->material, MATERIAL_REFLECT);
    s.transmit_dir = hit->dir;
    s.transmit_weight = v3_splat(0.0f);
#if HAS_TRANSMIT || HAS_FRESNEL
    const v3 k_t = row_real3(&hit->material, MATERIAL_TRANSMIT);
    const vm opaque = (k_t.x == (vf)(0.0f)) & (k_t.y == (vf)(0.0f)) & (k_t.z == (vf)(0.0f));
    const vm leaves = hit->inside & !opaque;
    const vf eta = leaves ? row_real(&hit->material, MATERIAL_IOR)
                          : row_real(&hit->material, MATERIAL_INVERSE_IOR);
    const vf rest = leaves ? row_real(&hit->material, MATERIAL_ETA_OUT_REST)
                           : row_real(&hit->material, MATERIAL_ETA_IN_REST);
    const Refraction r = refract_cosines(vf_min(-v3_dot(n, hit->dir), (vf)(1.0f)), eta, rest);
    const v3 k_r = s.reflect_weight;
    s.transmit_weight = v3_select(r.total, v3_splat(0.0f), k_t);
    s.reflect_weight = v3_select(r.total, v3_add(k_r, k_t), k_r);
#if HAS_FRESNEL
    const vm fresnel = (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_FRESNEL) != (vi)(0);
    const vf f = fresnel_dielectric(&r, eta);
    const v3 larger = v3_make(vf_max(k_r.x, k_t.x), vf_max(k_r.y, k_t.y), vf_max(k_r.z, k_t.z));
    const v3 reflected = v3_select(r.total, larger, v3_scale(k_r, f));
    s.reflect_weight = v3_select(fresnel, reflected, s.reflect_weight);
    s.transmit_weight = v3_select(fresnel, v3_scale(s.transmit_weight, 1.0f - f), s.transmit_weight);
#endif
    const vf along = fma(eta, r.cos_in, -r.cos_out);
    s.transmit_dir = v3_normalize(v3_fma(n, along, v3_scale(hit->dir, eta)));
#endif
#if HAS_PBR
    scatter_pbr(hit, n, &s);
#endif
    return s;
}

#endif

#if !HAS_PATH
// The ray in direction dir with weight, where it has enough left to be traced.
static inline NextRay next_ray(const Hit *hit, v3 dir, v3 weight, v3 throughput, vm through, real min_weight,
                               vm m)
{
    NextRay next;
    const v3 side = v3_select(through, v3_neg(hit->ng), hit->ng);
    next.dir = dir;
    next.throughput = v3_mul(throughput, weight);
    next.org = offset_origin(hit->point, hit->error, hit->ng, side);
    const vm inward = through != hit->inside;
    next.self = hit->primitive * 2 + (inward ? (vi)(1) : (vi)(0));
    const vm enough = (next.throughput.x >= (vf)(min_weight)) | (next.throughput.y >= (vf)(min_weight)) |
                      (next.throughput.z >= (vf)(min_weight));
    const vm some = (weight.x > (vf)(0.0f)) | (weight.y > (vf)(0.0f)) | (weight.z > (vf)(0.0f));
    next.m = m & enough & some & (v3_dot(dir, side) > (vf)(0.0f));
#if HAS_HIT_RANDOM
    next.path = path_follow(&hit->random, through);
#endif
    return next;
}

#endif

static inline void store_ray(const State *s, const Slots *slots, const NextRay *ray, vi depth, vi instance,
                             vm m)
{
    state_store3(s, RAY_ORG, slots, ray->org, m);
    state_store3(s, RAY_DIR, slots, ray->dir, m);
    state_store3(s, THROUGHPUT, slots, ray->throughput, m);
    state_store_int(s, SELF, slots, ray->self, m);
    state_store_int(s, DEPTH, slots, depth, m);
#if HAS_HIT_RANDOM
    state_store_int(s, PATH, slots, ray->path, m);
#endif
#if HAS_INSTANCES
    state_store_int(s, SELF_INSTANCE, slots, instance, m);
#endif
}

#if HAS_BRANCHING
// Place of the parked ray on top of each slot's stack, for gather and scatter.
static inline vi pending_place(const Slots *slots, vi entry, int fields)
{
    return entry * (fields * TILE_SLOTS) + slots->index;
}

OUTLINE void park_ray(const State *s, const Slots *slots, const NextRay *ray, vi depth, vi instance, vm m)
{
    const vi count = state_load_int(s, PENDING_COUNT, slots);
    global real *reals = s->reals + s->pending_reals * TILE_SLOTS;
    global int *ints = s->ints + INT_FIELDS * TILE_SLOTS;
    const vi place = pending_place(slots, count, PENDING_REALS);
    const v3 parts[3] = { ray->org, ray->dir, ray->throughput };
    for (int k = 0; k < 3; k++) {
        vf_scatter(reals + 3 * k * TILE_SLOTS, place, parts[k].x, m);
        vf_scatter(reals + (3 * k + 1) * TILE_SLOTS, place, parts[k].y, m);
        vf_scatter(reals + (3 * k + 2) * TILE_SLOTS, place, parts[k].z, m);
    }
    const vi int_place = pending_place(slots, count, PENDING_INTS(HAS_INSTANCES, HAS_HIT_RANDOM));
    vi_scatter(ints, int_place, ray->self, m);
    vi_scatter(ints + TILE_SLOTS, int_place, depth, m);
#if HAS_INSTANCES
    vi_scatter(ints + 2 * TILE_SLOTS, int_place, instance, m);
#endif
#if HAS_HIT_RANDOM
    vi_scatter(ints + (2 + HAS_INSTANCES) * TILE_SLOTS, int_place, ray->path, m);
#endif
    state_store_int(s, PENDING_COUNT, slots, count + 1, m);
}

// Makes the youngest parked ray the one in flight, in the lanes of m, which have one.
OUTLINE void unpark_ray(const State *s, const Slots *slots, vm m)
{
    const vi count = state_load_int(s, PENDING_COUNT, slots);
    const vi entry = m ? count - 1 : (vi)(0);
    global const real *reals = s->reals + s->pending_reals * TILE_SLOTS;
    global const int *ints = s->ints + INT_FIELDS * TILE_SLOTS;
    const vi place = pending_place(slots, entry, PENDING_REALS);
    NextRay ray;
    v3 *parts[3] = { &ray.org, &ray.dir, &ray.throughput };
    for (int k = 0; k < 3; k++)
        *parts[k] = v3_make(real_gather(reals + 3 * k * TILE_SLOTS, place),
                            real_gather(reals + (3 * k + 1) * TILE_SLOTS, place),
                            real_gather(reals + (3 * k + 2) * TILE_SLOTS, place));
    const vi int_place = pending_place(slots, entry, PENDING_INTS(HAS_INSTANCES, HAS_HIT_RANDOM));
    vi instance = (vi)(NO_HIT);
    ray.self = vi_gather(ints, int_place);
    const vi depth = vi_gather(ints + TILE_SLOTS, int_place);
#if HAS_INSTANCES
    instance = vi_gather(ints + 2 * TILE_SLOTS, int_place);
#endif
#if HAS_HIT_RANDOM
    ray.path = vi_gather(ints + (2 + HAS_INSTANCES) * TILE_SLOTS, int_place);
#endif
    store_ray(s, slots, &ray, depth, instance, m);
    state_store_int(s, PENDING_COUNT, slots, entry, m);
}
#endif

#if !HAS_PATH
// Puts the first of the rays that follow in flight and parks the second; returns FLAG_NEXT where there is
// one.
OUTLINE vi spawn_rays(const State *s, const Slots *slots, const Hit *hit, constant RenderParams *params,
                            v3 throughput, vi instance, vm shaded, uint *rays)
{
    const vi depth = state_load_int(s, DEPTH, slots) + 1;
    const vm deeper = shaded & (depth <= (vi)((int)params->max_depth));
    if (!vm_any(deeper))
        return (vi)(0);
    const Scatter scatter = scatter_make(hit);
    const NextRay mirrored = next_ray(hit, scatter.reflect_dir, scatter.reflect_weight, throughput, (vm)(0),
                                      params->min_weight, deeper);
    NextRay first = mirrored;
    rays[RAYS_REFLECTED] += popcount(vm_bits(mirrored.m));
#if HAS_TRANSMIT
    const NextRay through = next_ray(hit, scatter.transmit_dir, scatter.transmit_weight, throughput,
                                     vm_from_bits(~0u), params->min_weight, deeper);
    rays[RAYS_TRANSMITTED] += popcount(vm_bits(through.m));
#if HAS_BRANCHING
    const vm both = through.m & mirrored.m;
    if (vm_any(both))
        park_ray(s, slots, &through, depth, instance, both);
#endif
    first.org = v3_select(mirrored.m, mirrored.org, through.org);
    first.dir = v3_select(mirrored.m, mirrored.dir, through.dir);
    first.throughput = v3_select(mirrored.m, mirrored.throughput, through.throughput);
    first.self = mirrored.m ? mirrored.self : through.self;
    first.m = mirrored.m | through.m;
#if HAS_HIT_RANDOM
    first.path = mirrored.m ? mirrored.path : through.path;
#endif
#endif
    // What the other slots had in flight is done with: all may be overwritten.
    store_ray(s, slots, &first, depth, instance, slots->valid);
    return first.m ? (vi)(FLAG_NEXT) : (vi)(0);
}

#endif

#endif
#endif
