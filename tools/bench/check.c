#include "check.h"

#include <math.h>
#include <stdatomic.h>

static const f64 SAME_T = 1e-6;
static const f64 UNIT = 0x1p-24; // half an ulp of 1
static const f64 TESTS_MAX = 3e8;
enum { ARBITRATED_MAX = 16 };

// How far apart two t are, relative to the larger one.
static f64 apart(const RayHits *a, const RayHits *b, u32 i)
{
    return fabs((f64)a->t[i] - b->t[i]) / fmax(a->t[i], b->t[i]);
}

static bool both_hit(const RayHits *a, const RayHits *b, u32 i)
{
    return a->primitive[i] != NO_PRIMITIVE && b->primitive[i] != NO_PRIMITIVE;
}

static bool differ_in_hitting(const RayHits *a, const RayHits *b, u32 i)
{
    return (a->primitive[i] != NO_PRIMITIVE) != (b->primitive[i] != NO_PRIMITIVE);
}

static u32 instance_of(const RayHits *hits, u32 i)
{
    return hits->instance[i] == NO_PRIMITIVE ? 0 : hits->instance[i];
}

static bool hit_others(const RaySet *rays, const RayHits *a, const RayHits *b, u32 i)
{
    return !rays->any_hit && both_hit(a, b, i) && apart(a, b, i) > SAME_T &&
           (a->primitive[i] != b->primitive[i] || instance_of(a, i) != instance_of(b, i));
}

Mismatch hits_compare(const RaySet *rays, const RayHits *a, const RayHits *b)
{
    Mismatch mismatch = {0, 0, 0};
    for (u32 i = 0; i < rays->count; i++) {
        mismatch.hit_miss += differ_in_hitting(a, b, i);
        mismatch.other += hit_others(rays, a, b, i);
        if (!rays->any_hit && both_hit(a, b, i))
            mismatch.t_error = fmax(mismatch.t_error, apart(a, b, i));
    }
    return mismatch;
}

// A primitive met by a line, as double sees it.
typedef struct Crossing {
    f64 t, t_error; // t_error: what the arithmetic in float may add to t
    f64 margin;     // how far inside the edge or silhouette, in multiples of what float may blur
} Crossing;

// A ray in the space of the primitives; reach: size of the numbers that went into it.
typedef struct Line {
    Vec3 org, dir;
    f64 reach;
} Line;

// Whether the line stays farther from the first corner than the rest of the face is, with what float may
// blur: a quick answer for almost all faces.
static bool passes_by(const Line *line, const Vec3 *corners)
{
    const Vec3 a = corners[0], b = corners[1], c = corners[2], d = line->dir;
    const f64 x = a.x - line->org.x, y = a.y - line->org.y, z = a.z - line->org.z;
    const f64 cx = y * d.z - z * d.y, cy = z * d.x - x * d.z, cz = x * d.y - y * d.x;
    const f64 away = sqrt((cx * cx + cy * cy + cz * cz) / (d.x * d.x + d.y * d.y + d.z * d.z));
    const f64 bx = b.x - a.x, by = b.y - a.y, bz = b.z - a.z;
    const f64 ex = c.x - a.x, ey = c.y - a.y, ez = c.z - a.z;
    const f64 edge = fmax(bx * bx + by * by + bz * bz, ex * ex + ey * ey + ez * ez);
    const f64 size = line->reach + fabs(x) + fabs(y) + fabs(z);
    return away > sqrt(edge) + 64 * UNIT * size;
}

// False where the line misses by far, or runs within the plane.
static bool cross_face(const Line *line, const Vec3 *corners, Crossing *crossing)
{
    if (passes_by(line, corners))
        return false;
    const Vec3 n = vec_cross(vec_sub(corners[1], corners[0]), vec_sub(corners[2], corners[0]));
    const f64 along = vec_dot(n, line->dir), area = vec_length(n), speed = vec_length(line->dir);
    if (along == 0)
        return false;
    const f64 t = vec_dot(n, vec_sub(corners[0], line->org)) / along;
    const f64 cosine = fabs(along) / (area * speed);
    const Vec3 p = vec_add(line->org, vec_scale(line->dir, t));
    const f64 size = line->reach + vec_length(p) + vec_length(corners[0]);
    const f64 blur = 32 * UNIT * size / cosine;
    f64 inside = INFINITY;
    for (int k = 0; k < 3; k++) {
        const Vec3 edge = vec_sub(corners[(k + 1) % 3], corners[k]);
        const f64 twice = vec_dot(vec_cross(edge, vec_sub(p, corners[k])), n);
        inside = fmin(inside, twice / (area * vec_length(edge)));
    }
    *crossing = (Crossing){t, blur / speed, inside / blur};
    return true;
}

// Both crossings of a sphere; where the line passes by, that of the nearest point, twice.
static void cross_sphere(const Line *line, const Shape *shape, Crossing crossings[2])
{
    const f64 r = shape->as.sphere.radius;
    const Vec3 from = vec_sub(shape->as.sphere.center, line->org);
    const f64 speed = vec_length(line->dir);
    const f64 middle = vec_dot(from, line->dir) / (speed * speed);
    const f64 off = vec_length(vec_sub(from, vec_scale(line->dir, middle)));
    const f64 blur = 32 * UNIT * (line->reach + vec_length(from) + r);
    const f64 half = off < r ? sqrt((r - off) * (r + off)) : 0;
    // Near the silhouette t moves faster than the ray.
    const f64 cosine = fmax(half / r, sqrt(blur / r));
    for (int k = 0; k < 2; k++)
        crossings[k] = (Crossing){middle + (k ? half : -half) / speed, 2 * blur / (cosine * speed),
                                  (r - off) / blur};
}

// What a ray should have found.
typedef struct Search {
    f64 end;        // of the ray
    f64 sure, slack; // nearest crossing that nothing blurs, and the error of its t
    f64 found;      // t that was reported, INFINITY where none was
    bool explained; // some crossing is at found, or, of any-hit rays, within the ray
    bool any_hit;
} Search;

static void consider(Search *search, const Crossing *crossing)
{
    const f64 t = crossing->t, error = crossing->t_error;
    if (crossing->margin > 1 && t > error && t < search->sure) {
        search->sure = t;
        search->slack = error;
    }
    if (crossing->margin < -1)
        return;
    if (search->any_hit)
        search->explained |= t > -error && t < search->end + error;
    else
        search->explained |= fabs(t - search->found) <= error;
}

static void search_instance(const BenchScene *scene, u32 instance, Vec3 org, Vec3 dir, Search *search)
{
    Line line = {org, dir, vec_length(org)};
    if (scene->instance_count > 0) {
        const Affine *map = &scene->to_object[instance];
        f64 scales[3];
        affine_singular_values(*map, scales);
        line.org = affine_point(*map, org);
        line.dir = affine_direction(*map, dir);
        line.reach = 4 * (scales[0] * vec_length(org) + vec_length(map->translation));
    }
    Crossing crossings[2];
    for (u32 i = 0; i < scene->primitive_count; i++) {
        if (scene->mesh) {
            const u32 *face = scene->mesh->faces[i];
            const Vec3 *at = scene->mesh->positions;
            const Vec3 corners[3] = {at[face[0]], at[face[1]], at[face[2]]};
            if (cross_face(&line, corners, &crossings[0]))
                consider(search, &crossings[0]);
            continue;
        }
        cross_sphere(&line, &scene->scene->shapes[i], crossings);
        consider(search, &crossings[0]);
        consider(search, &crossings[1]);
    }
}

// Whether the weights put the hit where the ray is at t.
static bool weights_agree(const BenchScene *scene, const RaySet *rays, const RayHits *hits, u32 i)
{
    Vec3 corners[3];
    if (!bench_scene_triangle(scene, hits->primitive[i], hits->instance[i], corners))
        return true;
    const Vec3 org = ray_origin(rays, i), dir = ray_direction(rays, i);
    const Vec3 n = vec_cross(vec_sub(corners[1], corners[0]), vec_sub(corners[2], corners[0]));
    const f64 cosine = fabs(vec_dot(n, dir)) / vec_length(n);
    const Vec3 p = vec_add(org, vec_scale(dir, hits->t[i]));
    const Vec3 ab = vec_scale(vec_sub(corners[1], corners[0]), hits->u[i]);
    const Vec3 ac = vec_scale(vec_sub(corners[2], corners[0]), hits->v[i]);
    const Vec3 q = vec_add(corners[0], vec_add(ab, ac));
    const f64 size = 2 * vec_length(org) + vec_length(p) + vec_length(corners[0]);
    return vec_length(vec_sub(p, q)) <= 128 * UNIT * size / fmax(cosine, UNIT);
}

typedef struct Job {
    const BenchScene *scene;
    const RaySet *rays;
    const RayHits *hits;
    const u32 *list; // the rays; NULL: every step-th
    u32 step;
    _Atomic u32 wrong;
} Job;

static bool is_right(const Job *job, u32 i)
{
    const RaySet *rays = job->rays;
    const bool hit = job->hits->primitive[i] != NO_PRIMITIVE;
    Search search = {.end = rays->columns[(size_t)RAY_FAR * rays->stride + i],
                     .sure = INFINITY,
                     .found = hit && !rays->any_hit ? job->hits->t[i] : INFINITY,
                     .any_hit = rays->any_hit};
    const u32 instances = job->scene->instance_count > 0 ? job->scene->instance_count : 1;
    for (u32 k = 0; k < instances; k++)
        search_instance(job->scene, k, ray_origin(rays, i), ray_direction(rays, i), &search);
    if (!hit)
        return search.sure + search.slack >= search.end;
    if (!search.explained)
        return false;
    return rays->any_hit || (search.found <= search.sure + search.slack &&
                             weights_agree(job->scene, rays, job->hits, i));
}

static void check_rays(void *context, u32 begin, u32 end)
{
    Job *job = context;
    for (u32 k = begin; k < end; k++)
        if (!is_right(job, job->list ? job->list[k] : k * job->step))
            atomic_fetch_add(&job->wrong, 1);
}

Verdict hits_arbitrate(const BenchScene *scene, Pool *pool, const RaySet *rays, const RayHits *hits,
                       const RayHits *others)
{
    u32 list[ARBITRATED_MAX], count = 0;
    for (u32 i = 0; i < rays->count && count < ARBITRATED_MAX; i++)
        if (differ_in_hitting(hits, others, i) || hit_others(rays, hits, others, i))
            list[count++] = i;
    Job job = {.scene = scene, .rays = rays, .hits = hits, .list = list};
    pool_run(pool, check_rays, &job, count, 1);
    return (Verdict){count, atomic_load(&job.wrong)};
}

Verdict hits_check(const BenchScene *scene, Pool *pool, const RaySet *rays, const RayHits *hits)
{
    const f64 instances = scene->instance_count > 0 ? scene->instance_count : 1;
    const f64 affordable = TESTS_MAX / (instances * scene->primitive_count);
    const u32 wanted = rays->count < affordable ? rays->count : affordable > 1 ? (u32)affordable : 1;
    Job job = {.scene = scene, .rays = rays, .hits = hits, .step = 1};
    if (rays->count == 0)
        return (Verdict){0, 0};
    job.step = rays->count / wanted;
    const u32 checked = (rays->count - 1) / job.step + 1;
    pool_run(pool, check_rays, &job, checked, 4);
    return (Verdict){checked, atomic_load(&job.wrong)};
}
