// The wavefront of one tile. A work-group owns a tile and walks its queues through the stages
//
//   camera rays -> [ intersect_closest -> shade_hits -> intersect_shadow -> advance ]*  -> film
//
// once for every round of samples. Queues and state stay in the cache of the core (about 60 KB a
// tile); nothing goes back to the host in between. kernels/README.md has the measurement behind this.
#include "stages/shade.h"
#include "stages/trace.h"

#include "stages/film.h"
#if HAS_PATH
#define RAY_COUNTS PATH_RAYS_KINDS
#else
#define RAY_COUNTS RAYS_KINDS
#endif
// A program of its own for properties of first hits; nothing is changed in others.
#ifndef AOV
#define AOV 0
#endif
#if AOV
#include "stages/aov.h"
#endif

// Queues the slots of samples begin .. end - 1 of the tile's pixels, with their camera rays; returns how many.
OUTLINE uint start_samples(const State *s, constant RenderParams *params, global const f32 *quantiles,
                           const Tile *tile, uint begin, uint end, local uint *scratch, uint *rays)
{
    global int *queue = s->ints + QUEUE * TILE_SLOTS;
    global int *all = s->ints + QUEUE_NEXT * TILE_SLOTS;
    global int *flags = s->ints + FLAGS * TILE_SLOTS;
    const uint log2 = params->slots_log2;
    for (uint i = GROUP_ITEM; i < TILE_SLOTS; i += GROUP) {
        const uint pixel = i >> log2, sample = i & ((1u << log2) - 1);
        all[i] = (int)i;
        flags[i] = pixel_x(pixel) < tile->width && pixel_y(pixel) < tile->height && sample < end - begin;
    }
    const uint count = queue_compact(s, all, TILE_SLOTS, 1, queue, scratch);
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
        camera_ray(s, params, quantiles, tile->image_left, tile->image_top, &slots, begin);
        rays[RAYS_CAMERA] += popcount(vm_bits(slots.valid));
#if HAS_BRANCHING
        state_store_int(s, PENDING_COUNT, &slots, (vi)(0), slots.valid);
#endif
    }
    GROUP_BARRIER();
    return count;
}

#if HAS_PATH
#include "stages/path.h"
#else
// Puts the next ray in flight in each slot of the queue, the one that follows or a parked one; returns the
// length of the queue of those that have one.
OUTLINE uint advance(const State *s, uint count, local uint *scratch)
{
    global int *queue = s->ints + QUEUE * TILE_SLOTS;
    global int *next_queue = s->ints + QUEUE_NEXT * TILE_SLOTS;
#if HAS_BRANCHING
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
        const vi flags = state_load_int(s, FLAGS, &slots);
        const vm parked = slots.valid & ((flags & FLAG_NEXT) == (vi)(0)) &
                          (state_load_int(s, PENDING_COUNT, &slots) > (vi)(0));
        if (vm_any(parked)) {
            unpark_ray(s, &slots, parked);
            state_store_int(s, FLAGS, &slots, (vi)(FLAG_NEXT), parked);
        }
    }
#endif
    const uint left = queue_compact(s, queue, count, FLAG_NEXT, next_queue, scratch);
    const uint padded = (left + QUEUE_PADDING - 1) / QUEUE_PADDING * QUEUE_PADDING;
    for (uint i = GROUP_ITEM; i < padded; i += GROUP)
        queue[i] = next_queue[i];
    GROUP_BARRIER();
    return left;
}

#if !HAS_SURFACES
static inline void miss_all(const State *s, uint count)
{
    for (uint i = GROUP_ITEM; i < count; i += GROUP)
        s->reals[RAY_T * TILE_SLOTS + s->ints[QUEUE * TILE_SLOTS + i]] = INFINITY;
}
#endif

// Traces and shades everything in flight until nothing is.
static inline void drain_queue(const State *s, const Hierarchy *scene, const Shading *shading,
                               global const LightRecord *lights, constant RenderParams *params, uint count,
                               local uint *scratch, uint *rays)
{
    while (count > 0) {
#if HAS_SURFACES
        intersect_closest(s, scene, count);
#else
        miss_all(s, count);
#endif
        GROUP_BARRIER();
#if AOV
        shade_aov(s, scene, shading, params, count);
#else
        LightPass pass;
        pass.first = 0;
        do {
            pass.last = min(pass.first + params->lights_per_pass, params->light_count);
            pass.opening = pass.first == 0;
            pass.closing = pass.last == params->light_count;
            shade_hits(s, scene, shading, lights, params, &pass, count, rays);
#if HAS_SHADOWS
            GROUP_BARRIER();
            intersect_shadow(s, scene, shading, lights + pass.first, pass.last - pass.first, count,
                             &rays[RAYS_SHADOW]);
            GROUP_BARRIER();
#endif
            pass.first = pass.last;
        } while (!pass.closing);
#endif
        GROUP_BARRIER();
        count = advance(s, count, scratch);
    }
}

#endif

// Renders samples sample_begin .. sample_end - 1 of the band of band_rows rows of the crop from row band_top
// on. Group g does tiles g, g + groups, ... of the band, counted row by row. scratch: GROUP numbers; an
// argument, because PoCL 3.1 lets groups that run side by side share a local array of the kernel itself.
kernel void render_tiles(constant RenderParams *params,
#if HAS_SURFACES
                         global const Primitive *primitives, global const PrimitiveInfo *infos,
                         global const MaterialRecord *materials,
#endif
#if HAS_BVH
                         global const BvhNode *nodes,
#endif
#if HAS_CHECKER || HAS_CHECKER3D || HAS_IMAGE
                         global const TextureRecord *textures,
#endif
#if HAS_IMAGE
                         global const uchar *texels,
#endif
#if HAS_CHECKER3D
                         global const ObjectFrame *frames,
#endif
#if HAS_TRIANGLE_EXTRA
                         global const TriangleExtra *extras,
#endif
#if HAS_MESH
                         global const TriangleBlock *blocks, global const MeshRun *mesh_runs,
#endif
#if HAS_MESH_NORMALS || HAS_MESH_UVS
                         global const int *mesh_indices,
#endif
#if HAS_MESH_NORMALS
                         global const f32 *mesh_normals,
#endif
#if HAS_MESH_UVS
                         global const f32 *mesh_uvs,
#endif
#if HAS_LIGHTS
                         global const LightRecord *lights,
#endif
#if HAS_ENVIRONMENT
                         global const EnvironmentRecord *environment, global const f32 *environment_texels,
#endif
#if HAS_ENVIRONMENT_LIGHT
                         global const uint *environment_cdf, global const f32 *environment_edges,
#endif
#if HAS_ENVIRONMENT_LIGHT && HAS_PATH
                         global const int *environment_guides, f32 environment_floor,
#endif
#if HAS_PREFILTERED
                         global const f32 *environment_levels,
#endif
#if HAS_FILTER_TABLE
                         global const f32 *quantiles,
#endif
#if HAS_MANY_LIGHTS
                         global const LightTableEntry *light_table,
#endif
#if HAS_PATH
                         uint path_techniques, uint path_light_choices, uint path_area_materials,
#endif
#if HAS_SAMPLES
                         global f32 *film_low, global f32 *film_m2,
#endif
#if HAS_CLAMP
                         global f32 *film_clamped, f32 clamp_limit,
#endif
                         global real *state_reals, global int *state_ints, global f32 *film,
                         global uint *ray_counts, uint state_real_fields, uint state_int_fields,
                         uint pending_reals, uint band_top, uint band_rows, uint sample_begin,
                         uint sample_end, local uint *scratch)
{
#if HAS_PATH
    const uint group = get_group_id(0);
#else
    const uint group = get_group_id(0), groups = get_num_groups(0);
#endif
    const uint side = TILE_SIDE >> params->slots_log2 / 2;
    const uint columns = (params->crop_width + side - 1) / side;
    const uint tiles = columns * ((band_rows + side - 1) / side);
#if HAS_PATH
    uint rays[RAY_COUNTS] = { 0, 0, 0, 0, 0 };
#else
    uint rays[RAYS_KINDS] = { 0, 0, 0, 0 };
#endif
    State s;
    Hierarchy scene;
    Shading shading;
    s.reals = state_reals + (size_t)group * state_real_fields * TILE_SLOTS;
    s.ints = state_ints + (size_t)group * state_int_fields * TILE_SLOTS;
    s.pending_reals = pending_reals;
#if HAS_SURFACES
    scene.primitives = primitives;
    scene.infos = infos;
    shading.materials = materials;
    scene.plane_count = params->plane_count;
    scene.root = params->root;
#endif
#if HAS_BVH
    scene.nodes = nodes;
#endif
#if HAS_MESH
    scene.blocks = blocks;
    scene.mesh_runs = mesh_runs;
    scene.mesh_run_count = params->mesh_run_count;
#endif
#if HAS_MESH_NORMALS || HAS_MESH_UVS
    shading.mesh_indices = mesh_indices;
#endif
#if HAS_MESH_NORMALS
    shading.mesh_normals = mesh_normals;
#endif
#if HAS_MESH_UVS
    shading.mesh_uvs = mesh_uvs;
#endif
#if HAS_TEXTURES
    shading.textures.records = textures;
#endif
#if HAS_IMAGE
    shading.textures.texels = texels;
#endif
#if HAS_CHECKER3D
    shading.frames = frames;
#endif
#if HAS_TRIANGLE_EXTRA
    shading.extras = extras;
#endif
#if HAS_ENVIRONMENT
    shading.environment.record = environment;
    shading.environment.map = environment_texels;
#endif
#if HAS_ENVIRONMENT_LIGHT
    shading.environment.cdf = environment_cdf;
    shading.environment.edges = environment_edges;
#if HAS_PATH
    shading.environment.guides = environment_guides;
    shading.environment.floor = environment_floor;
#endif
#endif
#if HAS_PREFILTERED
    shading.environment.levels = environment_levels;
#endif
#if !HAS_LIGHTS
    global const LightRecord *lights = 0;
#endif
#if !HAS_FILTER_TABLE
    global const f32 *quantiles = 0;
#endif
#if !HAS_SAMPLES
    global f32 *film_low = 0, *film_m2 = 0;
#endif
#if HAS_PATH
    PathWave wave;
    wave.s = wave.pool = s;
    wave.pool.reals += POOL_REALS * TILE_SLOTS;
    wave.pool.ints += POOL_INTS * TILE_SLOTS;
    wave.scene = &scene;
    wave.shading = &shading;
    wave.lights = lights;
    wave.params = params;
    wave.quantiles = quantiles;
    wave.film = film;
    wave.film_low = film_low;
    wave.film_m2 = film_m2;
#if HAS_CLAMP
    wave.film_clamped = film_clamped;
    wave.clamp_limit = clamp_limit;
#endif
    wave.settings.techniques = path_techniques;
    wave.settings.light_choices = path_light_choices;
    wave.settings.area_materials = path_area_materials;
#if HAS_MANY_LIGHTS
    wave.settings.table = light_table;
    wave.settings.light_count = params->light_count;
#endif
    wave.scratch = scratch;
    wave.rays = rays;
    wave.tile = group;
    wave.tiles = tiles;
    wave.band_top = band_top;
    wave.band_rows = band_rows;
    wave.sample = wave.sample_begin = sample_begin;
    wave.sample_end = sample_end;
    path_trace(&wave);
#else
    for (uint t = group; t < tiles; t += groups) {
        Tile tile;
        tile.left = t % columns * side;
        tile.top = t / columns * side;
        tile.width = min(params->crop_width - tile.left, side);
        tile.height = min(band_rows - tile.top, side);
        tile.image_left = (int)(params->left + tile.left);
        tile.image_top = (int)(params->top + band_top + tile.top);
        for (uint begin = sample_begin; begin < sample_end; begin += 1u << params->slots_log2) {
            const uint end = min(begin + (1u << params->slots_log2), sample_end);
#if HAS_HIT_RANDOM
            s.sample_begin = (int)begin;
            s.sample_mask = (1 << params->slots_log2) - 1;
#endif
            const uint count = start_samples(&s, params, quantiles, &tile, begin, end, scratch, rays);
            drain_queue(&s, &scene, &shading, lights, params, count, scratch, rays);
#if HAS_CLAMP
            clamp_samples(&s, RADIANCE, clamp_limit);
#endif
#if HAS_FILTER_LOBES
            weigh_samples(&s, params, quantiles, tile.image_left, tile.image_top, begin);
#endif
            film_add(&s, params, film, film_low, film_m2, &tile, begin, end);
#if HAS_CLAMP
            film_add_clamped(&s, params, film_clamped, &tile, begin, end);
#endif
            GROUP_BARRIER();
        }
    }
#endif
    for (uint k = 0; k < RAY_COUNTS; k++)
        ray_counts[get_global_id(0) * RAY_COUNTS + k] = rays[k];
}
