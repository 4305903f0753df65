#include "rays.h"

#include <math.h>
#include <stdlib.h>

static const f64 TAU = 6.283185307179586;

const char *ray_kind_name(RayKind kind)
{
    static const char *const NAMES[RAY_KINDS] = {"camera",  "mirror",   "ao", "diffuse",
                                                 "bounce2", "shuffled", "sun"};
    return NAMES[kind];
}

RayKind ray_kind_source(RayKind kind)
{
    return kind == RAYS_BOUNCE2 || kind == RAYS_SHUFFLED ? RAYS_DIFFUSE : RAYS_CAMERA;
}

Vec3 ray_origin(const RaySet *rays, u32 i)
{
    const f32 *c = rays->columns + i + (size_t)RAY_ORG * rays->stride;
    return (Vec3){c[0], c[rays->stride], c[2 * (size_t)rays->stride]};
}

Vec3 ray_direction(const RaySet *rays, u32 i)
{
    const f32 *c = rays->columns + i + (size_t)RAY_DIR * rays->stride;
    return (Vec3){c[0], c[rays->stride], c[2 * (size_t)rays->stride]};
}

static u32 padded(u32 count)
{
    const u32 wanted = (count + RAYS_PADDING - 1) / RAYS_PADDING * RAYS_PADDING;
    return wanted ? wanted : RAYS_PADDING;
}

// Columns longer by a line of the cache than a power of two do not fall on each other in the cache.
static u32 stride_of(u32 count)
{
    return padded(count) + RAYS_PADDING;
}

static RaySet *allocate(RayKind kind, u32 room, Error *error)
{
    RaySet *rays = calloc(1, sizeof *rays);
    f32 *columns = rays ? calloc((size_t)RAY_COLUMNS * stride_of(room), sizeof *columns) : NULL;
    if (!columns) {
        free(rays);
        error_set(error, ERROR_MEMORY, "no memory for %u rays", room);
        return NULL;
    }
    *rays = (RaySet){.kind = kind, .any_hit = kind == RAYS_AO || kind == RAYS_SUN, .stride = stride_of(room),
                     .columns = columns};
    return rays;
}

void rays_destroy(RaySet *rays)
{
    if (!rays)
        return;
    free(rays->columns);
    free(rays);
}

static void put(RaySet *rays, u32 i, Vec3 org, Vec3 dir, f64 end)
{
    const f64 numbers[RAY_COLUMNS] = {org.x, org.y, org.z, dir.x, dir.y, dir.z, end};
    for (size_t c = 0; c < RAY_COLUMNS; c++)
        rays->columns[c * rays->stride + i] = (f32)numbers[c];
}

static void add(RaySet *rays, Vec3 org, Vec3 dir, f64 end)
{
    put(rays, rays->count++, org, dir, end);
}

static void pad(RaySet *rays)
{
    for (size_t c = 0; c < RAY_COLUMNS && rays->count > 0; c++) {
        f32 *column = rays->columns + c * rays->stride;
        for (u32 i = rays->count; i < rays->stride; i++)
            column[i] = column[rays->count - 1];
    }
}

// Every second bit of `bits`, from the lowest.
static u32 even_bits(u32 bits)
{
    return (bits & 1) | (bits >> 1 & 2) | (bits >> 2 & 4);
}

static void add_camera_rays(RaySet *rays, const BenchScene *scene, u32 size)
{
    const View *view = &scene->view;
    const Vec3 back = vec_normalize(vec_sub(view->eye, view->look_at));
    const Vec3 right = vec_normalize(vec_cross((Vec3){0, 1, 0}, back)), up = vec_cross(back, right);
    const f64 scale = tan(view->fov * TAU / 720) / (0.5 * size);
    const u32 tiles = (size + 7) / 8;
    for (u64 i = 0; i < (u64)tiles * tiles * 64; i++) {
        const u32 tile = (u32)(i / 64), within = i % 64;
        const u32 x = tile % tiles * 8 + even_bits(within), y = tile / tiles * 8 + even_bits(within >> 1);
        if (x >= size || y >= size)
            continue;
        const f64 sx = (x + 0.5 - 0.5 * size) * scale, sy = (0.5 * size - y - 0.5) * scale;
        const Vec3 ahead = vec_sub(vec_add(vec_scale(right, sx), vec_scale(up, sy)), back);
        add(rays, view->eye, vec_normalize(ahead), INFINITY);
    }
}

// What a ray has met, in double.
typedef struct Meeting {
    Vec3 start;  // moved off the surface
    Vec3 normal; // unit, towards where the ray comes from
    Vec3 dir;    // of the ray
} Meeting;

static Meeting meeting_make(const BenchScene *scene, const RaySet *source, const RayHits *hits, u32 i)
{
    const Vec3 org = ray_origin(source, i), dir = ray_direction(source, i);
    const Vec3 p = vec_add(org, vec_scale(dir, hits->t[i]));
    const Vec3 n = bench_scene_normal(scene, hits->primitive[i], hits->instance[i], p);
    const Vec3 towards = vec_dot(n, dir) > 0 ? vec_scale(n, -1) : n;
    // Far above the error of t, so that neither tracer meets the surface again.
    const f64 off = 1e-5 * (vec_length(p) + hits->t[i]);
    return (Meeting){vec_add(p, vec_scale(towards, off)), towards, dir};
}

// By the cosine about n (Malley's method).
static Vec3 cosine_direction(Vec3 n, u64 index, u32 seed)
{
    const f64 turn = TAU * random_at(index, seed), square = random_at(index, seed + 1);
    const Vec3 other = fabs(n.x) < 0.6 ? (Vec3){1, 0, 0} : (Vec3){0, 1, 0};
    const Vec3 right = vec_normalize(vec_cross(other, n)), front = vec_cross(n, right);
    const f64 out = sqrt(square);
    const Vec3 flat = vec_add(vec_scale(right, out * cos(turn)), vec_scale(front, out * sin(turn)));
    return vec_normalize(vec_add(flat, vec_scale(n, sqrt(1 - square))));
}

static void add_secondary_rays(RaySet *rays, const BenchScene *scene, const RaySet *source,
                               const RayHits *hits)
{
    const Vec3 sun = vec_normalize(scene->view.sun);
    for (u32 i = 0; i < source->count; i++) {
        if (hits->primitive[i] == NO_PRIMITIVE)
            continue;
        const Meeting m = meeting_make(scene, source, hits, i);
        switch (rays->kind) {
        case RAYS_MIRROR:
            add(rays, m.start,
                vec_normalize(vec_sub(m.dir, vec_scale(m.normal, 2 * vec_dot(m.normal, m.dir)))), INFINITY);
            break;
        case RAYS_AO:
            add(rays, m.start, cosine_direction(m.normal, i, 101), 0.1 * scene->diagonal);
            break;
        case RAYS_SUN:
            if (vec_dot(m.normal, sun) > 0)
                add(rays, m.start, sun, INFINITY);
            break;
        default:
            add(rays, m.start, cosine_direction(m.normal, i, 103 + (u32)rays->kind), INFINITY);
            break;
        }
    }
}

// The rays of source in an order that depends on nothing but their number (Fisher and Yates).
static bool add_shuffled_rays(RaySet *rays, const RaySet *source)
{
    u32 *order = malloc((source->count + (size_t)1) * sizeof *order);
    if (!order)
        return false;
    for (u32 i = 0; i < source->count; i++) {
        const u32 k = (u32)(random_at(i, 107) * (i + 1.0));
        order[i] = order[k];
        order[k] = i;
    }
    for (u32 i = 0; i < source->count; i++)
        for (size_t c = 0; c < RAY_COLUMNS; c++)
            rays->columns[c * rays->stride + i] = source->columns[c * source->stride + order[i]];
    rays->count = source->count;
    free(order);
    return true;
}

RaySet *rays_create(RayKind kind, const BenchScene *scene, u32 size, const RaySet *source,
                    const RayHits *hits, Error *error)
{
    RaySet *rays = allocate(kind, kind == RAYS_CAMERA ? size * size : source->count, error);
    if (!rays)
        return NULL;
    if (kind == RAYS_CAMERA) {
        add_camera_rays(rays, scene, size);
    } else if (kind != RAYS_SHUFFLED) {
        add_secondary_rays(rays, scene, source, hits);
    } else if (!add_shuffled_rays(rays, source)) {
        error_set(error, ERROR_MEMORY, "no memory to shuffle %u rays", source->count);
        rays_destroy(rays);
        return NULL;
    }
    pad(rays);
    return rays;
}

RayHits *ray_hits_create(u32 count, Error *error)
{
    const size_t stride = stride_of(count);
    RayHits *hits = calloc(1, sizeof *hits);
    f32 *reals = calloc(3 * stride, sizeof *reals);
    u32 *wholes = calloc(2 * stride, sizeof *wholes);
    if (!hits || !reals || !wholes) {
        free(hits);
        free(reals);
        free(wholes);
        error_set(error, ERROR_MEMORY, "no memory for %u hits", count);
        return NULL;
    }
    *hits = (RayHits){.count = count, .stride = (u32)stride, .t = reals, .u = reals + stride,
                      .v = reals + 2 * stride, .primitive = wholes, .instance = wholes + stride};
    return hits;
}

void ray_hits_destroy(RayHits *hits)
{
    if (!hits)
        return;
    free(hits->t);
    free(hits->primitive);
    free(hits);
}
