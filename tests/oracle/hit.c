#include "hit.h"

#include "texture.h"

/* What rounding can make of a distance from the primitive's surface along this ray. */
static real tolerance(const Primitive *primitive, const Ray *ray)
{
    Vec o = ray->o;
    return primitive->unit * (primitive->magnitude + fmaxl(fabsl(o.x), fmaxl(fabsl(o.y), fabsl(o.z))));
}

/* Whether the ray may meet what is within the sphere. */
static bool may_meet(Vec center, real radius, real magnitude, const Ray *ray)
{
    Vec f = sub(center, ray->o);
    real along = dot(f, ray->d);
    Vec off = sub(f, scaled(ray->d, along));
    radius += 1e-9L * magnitude;
    return dot(off, off) <= radius * radius && along + radius >= 0;
}

static bool run_is_missed(const Run *run, const Ray *ray)
{
    return run->bounded && !may_meet(run->center, run->radius, run->magnitude, ray);
}

/* All crossings with one primitive ahead of the ray's start; `local` becomes the ray in the shape's space. */
static int crossings_ahead(const Primitive *primitive, const Ray *ray, Line *local, Crossing *out)
{
    if (primitive->bounded &&
        !may_meet(primitive->bound_center, primitive->bound_radius, primitive->magnitude, ray))
        return 0;
    local->o = transform_point(&primitive->to_local, ray->o);
    local->d = transform_vector(&primitive->to_local, ray->d);
    Crossing all[CROSSINGS_MAX];
    int found = shape_crossings(primitive->shape, local, all);
    real rounding = tolerance(primitive, ray);
    int count = 0;
    for (int i = 0; i < found; i++) {
        const Crossing *c = &all[i];
        if (!(c->t > 0))
            continue;
        bool same_patch = ray->from == primitive && ray->patch == c->patch;
        if (same_patch && shape_patch_is_flat(primitive->shape, c->patch))
            continue;
        /* A start on this surface, or on one that coincides with it: t is 0 but for rounding. What counts is
         * the distance along the normal, since t itself is vague for a grazing ray. */
        if (c->t < 1e8L * rounding) {
            Vec p = add(local->o, scaled(local->d, c->t));
            Surface surface = shape_surface(primitive->shape, p, c->patch);
            Vec normal = transform_normal(&primitive->to_local, surface.normal);
            if (c->t * fabsl(dot(ray->d, normal)) <= rounding)
                continue;
        }
        out[count++] = *c;
    }
    return count;
}

static void fill_hit(const Scene *scene, const Ray *ray, const Line *local, const Crossing *crossing,
                     Hit *hit)
{
    const Transform *to_local = &hit->primitive->to_local;
    hit->t = crossing->t;
    hit->patch = crossing->patch;
    hit->point = add(ray->o, scaled(ray->d, hit->t));
    hit->local = add(local->o, scaled(local->d, hit->t));
    hit->surface = shape_surface(hit->primitive->shape, hit->local, hit->patch);
    hit->normal = transform_normal(to_local, hit->surface.normal);
    hit->shading = transform_normal(to_local, hit->surface.shading);
    hit->shading = mapped_normal(scene, hit->primitive, hit->local, &hit->surface, hit->shading);
    if (dot(hit->shading, hit->normal) < 0)
        hit->shading = scaled(hit->shading, -1);
}

/* The closest hit so far. */
typedef struct Best {
    const Primitive *primitive;
    Line local;
    Crossing crossing;
} Best;

static void keep_closer(const Primitive *primitive, const Ray *ray, Best *best)
{
    Line local;
    Crossing crossings[CROSSINGS_MAX];
    int count = crossings_ahead(primitive, ray, &local, crossings);
    for (int k = 0; k < count; k++) {
        /* Equal but for rounding is a tie, and the earlier primitive keeps it. */
        real tie = best->primitive == primitive ? 0 : tolerance(primitive, ray) + 1e-15L * crossings[k].t;
        if (!(crossings[k].t + tie < best->crossing.t))
            continue;
        *best = (Best){primitive, local, crossings[k]};
    }
}

bool hit_closest(const Scene *scene, const Ray *ray, Hit *hit)
{
    Best best = {.primitive = NULL, .crossing.t = INFINITY};
    for (size_t run = 0; run < scene->run_count; run++) {
        if (run_is_missed(&scene->runs[run], ray))
            continue;
        for (size_t i = scene->runs[run].first; i < scene->runs[run].end; i++)
            keep_closer(&scene->primitives[i], ray, &best);
    }
    hit->primitive = best.primitive;
    if (hit->primitive == NULL)
        return false;
    fill_hit(scene, ray, &best.local, &best.crossing, hit);
    return true;
}

/* Triangles whose shared edge the ray went through. */
typedef struct EdgeList {
    struct {
        const Primitive *primitive;
        real t;
    } items[32];
    int count;
} EdgeList;

static bool same_point(Vec a, Vec b)
{
    return length(sub(a, b)) <= 1e-14L * (length(a) + length(b));
}

static int shared_vertices(const Primitive *a, const Primitive *b)
{
    int shared = 0;
    for (int i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            shared += same_point(transform_point(&a->to_world, a->shape->vertices[i]),
                                 transform_point(&b->to_world, b->shape->vertices[k]));
    return shared;
}

/* Whether this crossing of an edge has been counted for the neighbour; else it is noted. */
static bool already_crossed(EdgeList *edges, const Primitive *primitive, const Crossing *crossing)
{
    if (!crossing->on_edge)
        return false;
    for (int i = 0; i < edges->count; i++) {
        bool same_t = fabsl(edges->items[i].t - crossing->t) <= 1e-12L * crossing->t;
        int shared = same_t ? shared_vertices(edges->items[i].primitive, primitive) : 0;
        if (shared == 1 || shared == 2)
            return true;
    }
    if (edges->count < 32) {
        edges->items[edges->count].primitive = primitive;
        edges->items[edges->count++].t = crossing->t;
    }
    return false;
}

/* The product of k_t over the crossings with one primitive. */
static Vec primitive_transmittance(const Scene *scene, const Primitive *primitive, const Ray *ray,
                                   real distance, EdgeList *edges)
{
    Vec product = grey(1);
    Line local;
    Crossing crossings[CROSSINGS_MAX];
    int count = crossings_ahead(primitive, ray, &local, crossings);
    for (int k = 0; k < count; k++) {
        if (crossings[k].t >= distance - tolerance(primitive, ray))
            continue;
        if (already_crossed(edges, primitive, &crossings[k]))
            continue;
        Vec p = add(local.o, scaled(local.d, crossings[k].t));
        Surface surface = {0};
        if (primitive->material->pbr)
            surface = shape_surface(primitive->shape, p, crossings[k].patch);
        product = times(product, shadow_transmit(scene, primitive, p, &surface));
    }
    return product;
}

Vec hit_transmittance(const Scene *scene, const Ray *ray, real distance, int light)
{
    Vec product = grey(1);
    EdgeList edges = {.count = 0};
    for (size_t run = 0; run < scene->run_count; run++) {
        if (run_is_missed(&scene->runs[run], ray))
            continue;
        for (size_t i = scene->runs[run].first; i < scene->runs[run].end && largest(product) > 0; i++)
            if (light < 0 || scene->primitives[i].light != light)
                product = times(product, primitive_transmittance(scene, &scene->primitives[i], ray, distance,
                                                                 &edges));
    }
    return product;
}

bool hit_any(const Scene *scene, const Ray *ray, real distance)
{
    for (size_t run = 0; run < scene->run_count; run++) {
        if (run_is_missed(&scene->runs[run], ray))
            continue;
        for (size_t i = scene->runs[run].first; i < scene->runs[run].end; i++) {
            Line local;
            Crossing crossings[CROSSINGS_MAX];
            int count = crossings_ahead(&scene->primitives[i], ray, &local, crossings);
            for (int k = 0; k < count; k++)
                if (crossings[k].t <= distance)
                    return true;
        }
    }
    return false;
}
