#include "path.h"

#include "environment.h"
#include "light.h"
#include "scatter.h"

/* Below these depths a hit follows all ways to scatter and both rays of a split, later one of them. */
enum { ALL_WAYS_BELOW = 1, ALL_SPLITS_BELOW = 2 };

/* What counts of that which a ray meets, and how many times. */
typedef struct Counted {
    real lights; /* area lights and the sky */
    real surfaces;
} Counted;

static Vec arriving(const Scene *scene, const Ray *ray, int depth, Counted counted, Chance *chance);

static Vec sky(const Scene *scene, Vec d)
{
    const Environment *environment = &scene->environment;
    return environment->image != NULL ? environment_radiance(environment, d) : scene->background;
}

/* Of point, spot and directional lights. */
static Vec punctual(const Spot *spot)
{
    const Scene *scene = spot->scene;
    Vec sum = grey(0);
    for (size_t i = 0; i < scene->light_count; i++) {
        const Light *light = &scene->lights[i];
        Arrival arrival;
        if (light_is_area(light) || !light_arrives(light, spot->hit->point, (Square){0, 0}, &arrival) ||
            !spot_sees(spot, arrival.direction))
            continue;
        Ray ray = spot_ray(spot, arrival.direction);
        if (scene->shadows && hit_any(scene, &ray, arrival.distance))
            continue;
        /* I / attenuation on pbr, pi times as much on the others. */
        real factor = dot(spot->normal, arrival.direction) * (spot->look.material->pbr ? 1 : PI);
        Vec brdf = look_brdf(&spot->look, spot->normal, arrival.direction, scaled(spot->d, -1));
        sum = add(sum, scaled(times(brdf, arrival.intensity), factor));
    }
    return sum;
}

/* Without shadows: the sky and all lights in a direction, whatever stands before them. */
static Vec unshadowed(const Spot *spot, Vec l)
{
    Vec sum = sky(spot->scene, l);
    for (size_t i = 0; i < spot->scene->light_count; i++) {
        const Light *light = &spot->scene->lights[i];
        if (light_is_area(light) && light_density(light, spot->hit->point, l) > 0)
            sum = add(sum, light->intensity);
    }
    return sum;
}

/* The share of one direction in the integral of brdf, cosine and light; `surfaces` is how many directions it
 * stands for where it meets surfaces. */
static Vec scattered_along(const Spot *spot, Vec l, int depth, real surfaces, Chance *chance)
{
    const Scene *scene = spot->scene;
    if (!spot_sees(spot, l))
        return grey(0);
    real density = 0;
    for (int way = 0; way < WAY_LIGHTS + (int)scene->light_count; way++)
        if (scatter_has(spot, way))
            density += scatter_density(spot, way, l);
    Vec weight = scaled(look_brdf(&spot->look, spot->normal, l, scaled(spot->d, -1)),
                        dot(spot->normal, l) / density);
    if (largest(weight) <= 0)
        return grey(0);
    Ray ray = spot_ray(spot, l);
    Counted counted = {scene->shadows ? 1 : 0, depth < scene->max_depth ? surfaces : 0};
    Vec light = arriving(scene, &ray, depth + 1, counted, chance);
    return times(weight, scene->shadows ? light : add(light, unshadowed(spot, l)));
}

/* One direction of each way, for light that comes straight; one of these is followed to other surfaces. */
static Vec scattered(const Spot *spot, int depth, Chance *chance)
{
    int ways = WAY_LIGHTS + (int)spot->scene->light_count;
    int count = 0;
    for (int way = 0; way < ways; way++)
        count += scatter_has(spot, way);
    int followed = (int)(chance_draw(chance).x * count);
    Vec sum = grey(0);
    int index = 0;
    for (int way = 0; way < ways; way++) {
        if (!scatter_has(spot, way))
            continue;
        real surfaces = depth < ALL_WAYS_BELOW ? 1 : index == followed ? count : 0;
        Vec l = scatter_choose(spot, way, chance_draw(chance));
        sum = add(sum, scattered_along(spot, l, depth, surfaces, chance));
        index++;
    }
    return sum;
}

static Vec branch(const Spot *spot, Vec direction, Vec weight, int depth, Chance *chance)
{
    if (largest(weight) == 0 || depth >= spot->scene->max_depth)
        return grey(0);
    Ray ray = spot_ray(spot, normalized(direction));
    return times(weight, arriving(spot->scene, &ray, depth + 1, (Counted){1, 1}, chance));
}

/* By mirrors and smooth transmission. */
static Vec split(const Spot *spot, int depth, Chance *chance)
{
    Split rays = spot_split(spot);
    real share = largest(rays.reflect) / (largest(rays.reflect) + largest(rays.transmit));
    if (depth >= ALL_SPLITS_BELOW && share > 0 && share < 1) {
        if (chance_draw(chance).x < share)
            return branch(spot, rays.mirrored, scaled(rays.reflect, 1 / share), depth, chance);
        return branch(spot, rays.through, scaled(rays.transmit, 1 / (1 - share)), depth, chance);
    }
    return add(branch(spot, rays.mirrored, rays.reflect, depth, chance),
               branch(spot, rays.through, rays.transmit, depth, chance));
}

static Vec arriving(const Scene *scene, const Ray *ray, int depth, Counted counted, Chance *chance)
{
    Hit hit;
    if (!hit_closest(scene, ray, &hit))
        return scaled(sky(scene, ray->d), counted.lights);
    if (hit.primitive->light >= 0)
        return scaled(light_seen(&scene->lights[hit.primitive->light], ray->d, hit.normal), counted.lights);
    if (counted.surfaces == 0)
        return grey(0);
    Spot spot = spot_at(scene, ray, &hit);
    Vec sum = add(spot.look.emission, split(&spot, depth, chance));
    if (look_scatters(&spot.look))
        sum = add(sum, add(punctual(&spot), scattered(&spot, depth, chance)));
    return scaled(sum, counted.surfaces);
}

Vec path_radiance(const Scene *scene, const Ray *ray, Chance *chance)
{
    return arriving(scene, ray, 0, (Counted){1, 1}, chance);
}
