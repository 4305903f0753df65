#include "gather.h"

#include "environment.h"
#include "light.h"
#include "scatter.h"

/* From one point of a light. */
static Vec light_share(const Spot *spot, int index, Square place)
{
    const Light *light = &spot->scene->lights[index];
    Arrival arrival;
    if (!light_arrives(light, spot->hit->point, place, &arrival) || !spot_sees(spot, arrival.direction))
        return grey(0);
    Vec intensity = arrival.intensity;
    if (light_is_area(light) && !spot->look.material->pbr)
        intensity = scaled(intensity, 1 / PI);
    Vec to_eye = scaled(spot->d, -1);
    Vec share = times(intensity, look_reflected(&spot->look, spot->normal, arrival.direction, to_eye));
    if (!spot->scene->shadows || largest(share) <= 0)
        return share;
    Ray ray = spot_ray(spot, arrival.direction);
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

/* Density of a direction by all ways together. */
static real density(const Spot *spot, Vec l)
{
    real sum = 0;
    for (int way = 0; way < WAY_LIGHTS; way++)
        if (scatter_has(spot, way))
            sum += scatter_density(spot, way, l);
    return sum;
}

Vec gather_environment(const Spot *spot)
{
    const Scene *scene = spot->scene;
    Vec sum = grey(0);
    for (int way = 0; way < WAY_LIGHTS; way++) {
        if (!scatter_has(spot, way))
            continue;
        Lattice lattice = lattice_at(scene->points, spot->hit->point, -1 - way);
        for (int k = 0; k < scene->points; k++) {
            Vec l = scatter_choose(spot, way, lattice_point(&lattice, k));
            if (!spot_sees(spot, l))
                continue;
            Vec share = times(look_reflected(&spot->look, spot->normal, l, scaled(spot->d, -1)),
                              environment_radiance(&scene->environment, l));
            share = scaled(share, 1 / density(spot, l));
            Ray ray = spot_ray(spot, l);
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
    Lattice lattice = lattice_at(scene->points, spot->hit->point, -1 - WAY_LIGHTS);
    int open = 0;
    for (int k = 0; k < scene->points; k++) {
        Vec direction = cosine_direction(spot->normal, lattice_point(&lattice, k));
        Ray ray = spot_ray(spot, direction);
        open += spot_sees(spot, direction) && !hit_any(scene, &ray, scene->occlusion_distance);
    }
    return (real)open / scene->points;
}
