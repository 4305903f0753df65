// The wavefront of one tile. A work-group owns a tile and walks its queues through the stages
//
//   camera rays -> [ intersect_closest -> shade_hits -> intersect_shadow -> advance ]*  -> film
//
// until every sample of every pixel is done. Queues and state stay in the cache of the core (about 60 KB a
// tile); nothing goes back to the host in between. kernels/README.md has the measurement behind this.
#include "stages/film.h"
#include "stages/shade.h"
#include "stages/trace.h"

// Puts the next ray in flight in each slot of the queue: the one that follows, a parked one, or the camera
// ray of the next sample. Returns the length of the queue, compacted.
OUTLINE uint advance(const State *s, constant RenderParams *params, int left, int top, uint count,
                           uint sample_end, local uint *scratch, uint *rays)
{
    global int *queue = s->ints + QUEUE * TILE_PIXELS;
    global int *next_queue = s->ints + QUEUE_NEXT * TILE_PIXELS;
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
        vm flying = slots.valid & ((state_load_int(s, FLAGS, &slots) & FLAG_NEXT) != (vi)(0));
#if HAS_BRANCHING
        const vm parked = slots.valid & !flying & (state_load_int(s, PENDING_COUNT, &slots) > (vi)(0));
        if (vm_any(parked))
            unpark_ray(s, &slots, parked);
        flying = flying | parked;
#endif
        const vm done = slots.valid & !flying;
        if (vm_any(done)) {
            film_add(s, &slots, done);
            const vi sample = state_load_int(s, SAMPLE, &slots) + 1;
            const vm again = done & (sample < (vi)((int)sample_end));
            if (vm_any(again))
                camera_ray(s, params, left, top, &slots, sample, again);
            rays[RAYS_CAMERA] += popcount(vm_bits(again));
            flying = flying | again;
        }
        state_store_int(s, FLAGS, &slots, flying ? (vi)(1) : (vi)(0), slots.valid);
    }
    const uint left_over = queue_compact(s, queue, count, 1, next_queue, scratch);
    const uint padded = (left_over + QUEUE_PADDING - 1) / QUEUE_PADDING * QUEUE_PADDING;
    for (uint i = GROUP_ITEM; i < padded; i += GROUP)
        queue[i] = next_queue[i];
    GROUP_BARRIER();
    return left_over;
}

// Queues the slots whose pixels lie in the band and starts their first sample of this launch.
OUTLINE uint begin_tile(const State *s, constant RenderParams *params, global real *film,
                              global real *film_low, uint tile_left, uint tile_row, uint band_rows,
                              int image_top, uint sample_begin, local uint *scratch, uint *rays)
{
    global int *queue = s->ints + QUEUE * TILE_PIXELS;
    global int *all = s->ints + QUEUE_NEXT * TILE_PIXELS;
    global int *flags = s->ints + FLAGS * TILE_PIXELS;
    for (uint i = GROUP_ITEM; i < TILE_PIXELS; i += GROUP) {
        const uint x = tile_left + (uint)((i & 7) | (i >> 2 & 8));
        const uint y = tile_row + (uint)((i >> 3 & 3) | (i >> 4 & 12));
        all[i] = (int)i;
        flags[i] = x < params->crop_width && y < band_rows;
    }
    const uint count = queue_compact(s, all, TILE_PIXELS, 1, queue, scratch);
    for (uint i = GROUP_ITEM * LANES; i < count; i += GROUP * LANES) {
        const Slots slots = slots_make(queue, i, count);
        camera_ray(s, params, (int)(params->left + tile_left), image_top + (int)tile_row, &slots,
                   (vi)((int)sample_begin), slots.valid);
        rays[RAYS_CAMERA] += popcount(vm_bits(slots.valid));
#if HAS_BRANCHING
        state_store_int(s, PENDING_COUNT, &slots, (vi)(0), slots.valid);
#endif
    }
#if HAS_SAMPLES
    for (uint i = GROUP_ITEM; i < count; i += GROUP) {
        const uint place = film_place(params, queue[i], tile_left, tile_row);
        for (uint c = 0; c < 3; c++) {
            s->reals[(FILM + c) * TILE_PIXELS + queue[i]] = sample_begin ? film[place + c] : 0.0f;
            s->reals[(FILM_LOW + c) * TILE_PIXELS + queue[i]] = sample_begin ? film_low[place + c] : 0.0f;
        }
    }
#endif
    GROUP_BARRIER();
    return count;
}

// Writes the tile's sums, or their means after the last sample.
OUTLINE void end_tile(const State *s, constant RenderParams *params, global real *film,
                            global real *film_low, uint tile_left, uint tile_row, uint band_rows,
                            uint sample_end)
{
    GROUP_BARRIER();
    for (uint i = GROUP_ITEM; i < TILE_PIXELS; i += GROUP) {
        const uint x = tile_left + (uint)((i & 7) | (i >> 2 & 8));
        const uint y = tile_row + (uint)((i >> 3 & 3) | (i >> 4 & 12));
        if (x >= params->crop_width || y >= band_rows)
            continue;
        const uint place = 3 * (y * params->crop_width + x);
        for (uint c = 0; c < 3; c++) {
            const real sum = s->reals[(FILM + c) * TILE_PIXELS + i];
#if HAS_SAMPLES
            const real low = s->reals[(FILM_LOW + c) * TILE_PIXELS + i];
            film[place + c] = sample_end == params->samples ? (sum + low) / (real)params->samples : sum;
            film_low[place + c] = low;
#else
            film[place + c] = sum;
#endif
        }
    }
    GROUP_BARRIER();
}

#if !HAS_SURFACES
static inline void miss_all(const State *s, uint count)
{
    for (uint i = GROUP_ITEM; i < count; i += GROUP)
        s->reals[RAY_T * TILE_PIXELS + s->ints[QUEUE * TILE_PIXELS + i]] = INFINITY;
}
#endif

// Traces and shades everything in flight until the tile's samples up to sample_end are done.
static inline void render_tile(const State *s, const Hierarchy *scene, const Shading *shading,
                               global const LightRecord *lights, constant RenderParams *params, int left,
                               int top, uint count, uint sample_end, local uint *scratch, uint *rays)
{
    while (count > 0) {
#if HAS_SURFACES
        intersect_closest(s, scene, count);
#else
        miss_all(s, count);
#endif
        GROUP_BARRIER();
        LightPass pass;
        pass.first = 0;
        do {
            pass.last = min(pass.first + params->lights_per_pass, params->light_count);
            pass.opening = pass.first == 0;
            pass.closing = pass.last == params->light_count;
            shade_hits(s, scene, shading, lights, params, &pass, count, rays);
#if HAS_SHADOWS
            GROUP_BARRIER();
            intersect_shadow(s, scene, shading->materials, lights + pass.first, pass.last - pass.first, count,
                             &rays[RAYS_SHADOW]);
            GROUP_BARRIER();
#endif
            pass.first = pass.last;
        } while (!pass.closing);
        GROUP_BARRIER();
        count = advance(s, params, left, top, count, sample_end, scratch, rays);
    }
}

// Renders samples sample_begin .. sample_end - 1 of the band of band_rows rows of the crop from row band_top
// on. Group g does tiles g, g + groups, ... of the band, counted row by row.
kernel void render_tiles(constant RenderParams *params,
#if HAS_SURFACES
                         global const Primitive *primitives, global const PrimitiveInfo *infos,
                         global const MaterialRecord *materials,
#endif
#if HAS_BVH
                         global const BvhNode *nodes,
#endif
#if HAS_CHECKER || HAS_CHECKER3D
                         global const TextureRecord *textures,
#endif
#if HAS_CHECKER3D
                         global const ObjectFrame *frames,
#endif
#if HAS_TRIANGLE_EXTRA
                         global const TriangleExtra *extras,
#endif
#if HAS_LIGHTS
                         global const LightRecord *lights,
#endif
#if HAS_SAMPLES
                         global real *film_low,
#endif
                         global real *state_reals, global int *state_ints, global real *film,
                         global uint *ray_counts, uint state_real_fields, uint state_int_fields,
                         uint pending_reals, uint band_top, uint band_rows, uint sample_begin,
                         uint sample_end)
{
    local uint scratch[GROUP];
    const uint group = get_group_id(0), groups = get_num_groups(0);
    const uint columns = (params->crop_width + TILE_WIDTH - 1) / TILE_WIDTH;
    const uint tiles = columns * ((band_rows + TILE_HEIGHT - 1) / TILE_HEIGHT);
    uint rays[RAYS_KINDS] = { 0, 0, 0, 0 };
    State s;
    Hierarchy scene;
    Shading shading;
    s.reals = state_reals + (size_t)group * state_real_fields * TILE_PIXELS;
    s.ints = state_ints + (size_t)group * state_int_fields * TILE_PIXELS;
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
#if HAS_CHECKER || HAS_CHECKER3D
    shading.textures = textures;
#endif
#if HAS_CHECKER3D
    shading.frames = frames;
#endif
#if HAS_TRIANGLE_EXTRA
    shading.extras = extras;
#endif
#if !HAS_LIGHTS
    global const LightRecord *lights = 0;
#endif
#if !HAS_SAMPLES
    global real *film_low = 0;
#endif
    for (uint tile = group; tile < tiles; tile += groups) {
        const uint left = tile % columns * TILE_WIDTH, row = tile / columns * TILE_HEIGHT;
        const int image_left = (int)(params->left + left), image_top = (int)(params->top + band_top);
        const uint count = begin_tile(&s, params, film, film_low, left, row, band_rows, image_top,
                                      sample_begin, scratch, rays);
        render_tile(&s, &scene, &shading, lights, params, image_left, image_top + (int)row, count,
                    sample_end, scratch, rays);
        end_tile(&s, params, film, film_low, left, row, band_rows, sample_end);
    }
    for (uint k = 0; k < RAYS_KINDS; k++)
        ray_counts[get_global_id(0) * RAYS_KINDS + k] = rays[k];
}
