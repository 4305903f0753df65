#include "light.h"

static real spot_factor(const Light *light, Vec to_light)
{
    real c = -dot(light->direction, to_light);
    if (light->cos_inner == light->cos_outer)
        return c >= light->cos_outer ? 1 : 0;
    real t = (c - light->cos_outer) / (light->cos_inner - light->cos_outer);
    t = fminl(1, fmaxl(0, t));
    return t * t * (3 - 2 * t);
}

bool light_is_area(const Light *light)
{
    return light->kind == LIGHT_SPHERE || light->kind == LIGHT_RECTANGLE;
}

/* Uniform in solid angle over the cone that the sphere fills. */
static bool sphere_arrives(const Light *light, Vec p, Square s, Arrival *arrival)
{
    Vec way = sub(light->position, p);
    real d = length(way);
    if (d <= light->radius)
        return false;
    real ratio = light->radius / d;
    real narrowest = sqrtl(1 - ratio * ratio);
    arrival->direction = around(scaled(way, 1 / d), 1 - s.x * (1 - narrowest), s.y);
    real along = dot(way, arrival->direction);
    real inside = light->radius * light->radius - (d * d - along * along);
    arrival->distance = along - sqrtl(fmaxl(0, inside));
    arrival->intensity = scaled(light->intensity, 2 * PI * (1 - narrowest));
    return true;
}

/* Uniform over the area. */
static bool rectangle_arrives(const Light *light, Vec p, Square s, Arrival *arrival)
{
    Vec on_light = add(light->position, add(scaled(light->edges[0], s.x), scaled(light->edges[1], s.y)));
    Vec way = sub(on_light, p);
    real d = length(way);
    Vec normal = cross(light->edges[0], light->edges[1]);
    if (d == 0 || dot(way, normal) >= 0)
        return false;
    arrival->direction = scaled(way, 1 / d);
    arrival->distance = d;
    /* The normal's length is the area. */
    arrival->intensity = scaled(light->intensity, -dot(arrival->direction, normal) / (d * d));
    return true;
}

real light_density(const Light *light, Vec p, Vec l)
{
    if (light->kind == LIGHT_SPHERE) {
        Vec way = sub(light->position, p);
        real d = length(way);
        if (d <= light->radius)
            return 0;
        real ratio = light->radius / d;
        real narrowest = sqrtl(1 - ratio * ratio);
        return dot(way, l) >= d * narrowest ? 1 / (2 * PI * (1 - narrowest)) : 0;
    }
    /* Where the ray meets the plane, in shares of the edges; the normal's length is the area. */
    Vec normal = cross(light->edges[0], light->edges[1]);
    real facing = -dot(l, normal);
    real t = dot(sub(p, light->position), normal) / facing;
    if (!(facing > 0 && t > 0))
        return 0;
    Vec across = sub(add(p, scaled(l, t)), light->position);
    real x = dot(cross(across, light->edges[1]), normal) / dot(normal, normal);
    real y = dot(cross(light->edges[0], across), normal) / dot(normal, normal);
    return x >= 0 && x <= 1 && y >= 0 && y <= 1 ? t * t / facing : 0;
}

Vec light_seen(const Light *light, Vec d, Vec normal)
{
    return dot(d, normal) < 0 ? light->intensity : grey(0);
}

bool light_arrives(const Light *light, Vec p, Square s, Arrival *arrival)
{
    if (light->kind == LIGHT_SPHERE)
        return sphere_arrives(light, p, s, arrival);
    if (light->kind == LIGHT_RECTANGLE)
        return rectangle_arrives(light, p, s, arrival);
    if (light->kind == LIGHT_DIRECTIONAL) {
        *arrival = (Arrival){scaled(light->direction, -1), INFINITY, light->intensity};
        return true;
    }
    Vec way = sub(light->position, p);
    real d = length(way);
    if (d == 0)
        return false;
    arrival->direction = scaled(way, 1 / d);
    arrival->distance = d;
    const real *k = light->attenuation;
    real factor = light->kind == LIGHT_SPOT ? spot_factor(light, arrival->direction) : 1;
    arrival->intensity = scaled(light->intensity, factor / (k[0] + k[1] * d + k[2] * d * d));
    return largest(arrival->intensity) > 0;
}
