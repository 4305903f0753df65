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

bool light_arrives(const Light *light, Vec p, Arrival *arrival)
{
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
