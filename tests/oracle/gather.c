#include "gather.h"

#include "environment.h"
#include "light.h"

static Ray ray_from(const Spot *spot, Vec direction)
{
    return (Ray){spot->hit->point, direction, spot->hit->primitive, spot->hit->patch};
}

static bool is_above(const Spot *spot, Vec direction)
{
    return dot(spot->normal, direction) > 0 && dot(spot->geometric, direction) > 0;
}

/* From one point of a light. */
static Vec light_share(const Spot *spot, int index, Square place)
{
    const Light *light = &spot->scene->lights[index];
    Arrival arrival;
    if (!light_arrives(light, spot->hit->point, place, &arrival) || !is_above(spot, arrival.direction))
        return grey(0);
    Vec intensity = arrival.intensity;
    if (light_is_area(light) && !spot->look.material->pbr)
        intensity = scaled(intensity, 1 / PI);
    Vec to_eye = scaled(spot->d, -1);
    Vec share = times(intensity, look_reflected(&spot->look, spot->normal, arrival.direction, to_eye));
    if (!spot->scene->shadows || largest(share) <= 0)
        return share;
    Ray ray = ray_from(spot, arrival.direction);
    return times(share, hit_transmittance(spot->scene, &ray, arrival.distance,
                                          light_is_area(light) ? index : -1));
}

Vec gather_lights(const Spot *spot)
{
    Vec sum = grey(0);
    for (int i = 0; i < (int)spot->scene->light_count; i++) {
        int count = light_is_area(&spot->scene->lights[i]) ? spot->scene->points : 1;
        Lattice lattice = lattice_at(count, spot->hit->point, i);
        Vec light = grey(0);
        for (int k = 0; k < count; k++)
            light = add(light, light_share(spot, i, lattice_point(&lattice, k)));
        sum = add(sum, scaled(light, 1 / (real)count));
    }
    return sum;
}

/* Ways to choose directions for the environment's light, each good where the others are not. */
typedef enum Way { WAY_COSINE, WAY_MAP, WAY_LOBE, WAYS } Way;

static bool has_lobe(const Spot *spot)
{
    return spot->look.roughness >= MIRROR_ROUGHNESS;
}

static Vec choose(const Spot *spot, Way way, Square s)
{
    if (way == WAY_COSINE)
        return cosine_direction(spot->normal, s);
    if (way == WAY_MAP)
        return environment_choose(&spot->scene->environment, s);
    /* H by D (N.H): tan^2 = a^2 x / (1 - x). */
    real a = spot->look.roughness * spot->look.roughness;
    Vec h = around(spot->normal, sqrtl((1 - s.x) / (1 - s.x + a * a * s.x)), s.y);
    return add(spot->d, scaled(h, -2 * dot(spot->d, h)));
}

/* Density of a direction by all ways together. */
static real density(const Spot *spot, Vec l)
{
    real sum = dot(spot->normal, l) / PI + environment_density(&spot->scene->environment, l);
    if (!has_lobe(spot))
        return sum;
    Vec h = normalized(sub(l, spot->d));
    real v_h = -dot(spot->d, h);
    real n_h = dot(spot->normal, h);
    real a = spot->look.roughness * spot->look.roughness;
    /* choose() never makes an H below the surface. */
    return n_h > 0 && v_h > 0 ? sum + ggx_density(a, n_h) * n_h / (4 * v_h) : sum;
}

Vec gather_environment(const Spot *spot)
{
    const Scene *scene = spot->scene;
    Vec sum = grey(0);
    for (int way = 0; way < WAYS; way++) {
        if (way == WAY_LOBE && !has_lobe(spot))
            continue;
        Lattice lattice = lattice_at(scene->points, spot->hit->point, -1 - way);
        for (int k = 0; k < scene->points; k++) {
            Vec l = choose(spot, (Way)way, lattice_point(&lattice, k));
            if (!is_above(spot, l))
                continue;
            Vec share = times(look_reflected(&spot->look, spot->normal, l, scaled(spot->d, -1)),
                              environment_radiance(&scene->environment, l));
            share = scaled(share, 1 / density(spot, l));
            Ray ray = ray_from(spot, l);
            if (scene->shadows && largest(share) > 0)
                share = times(share, hit_transmittance(scene, &ray, INFINITY, -1));
            sum = add(sum, share);
        }
    }
    return scaled(sum, 1 / (real)scene->points);
}

real gather_openness(const Spot *spot)
{
    const Scene *scene = spot->scene;
    if (scene->occlusion_distance == 0)
        return 1;
    Lattice lattice = lattice_at(scene->points, spot->hit->point, -1 - WAYS);
    int open = 0;
    for (int k = 0; k < scene->points; k++) {
        Vec direction = cosine_direction(spot->normal, lattice_point(&lattice, k));
        Ray ray = ray_from(spot, direction);
        open += is_above(spot, direction) && !hit_any(scene, &ray, scene->occlusion_distance);
    }
    return (real)open / scene->points;
}
