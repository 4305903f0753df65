#include "scatter.h"

#include "environment.h"
#include "light.h"

bool scatter_has(const Spot *spot, int way)
{
    const Look *look = &spot->look;
    if (way == WAY_COSINE)
        return true;
    if (way == WAY_MAP)
        return spot->scene->environment.image != NULL;
    if (way == WAY_LOBE && look->material->pbr)
        return look->roughness >= MIRROR_ROUGHNESS;
    if (way == WAY_LOBE)
        return largest(look->material->specular) > 0;
    return light_is_area(&spot->scene->lights[way - WAY_LIGHTS]);
}

/* The other side of the ray that came by a mirror of normal h. */
static Vec by_half(const Spot *spot, Vec h)
{
    real v_h = -dot(spot->d, h);
    return v_h > 0 ? add(spot->d, scaled(h, 2 * v_h)) : grey(0);
}

static Vec choose_lobe(const Spot *spot, Square s)
{
    const Look *look = &spot->look;
    if (look->material->pbr) {
        /* H by D (N.H): tan^2 = a^2 x / (1 - x). */
        real a = look->roughness * look->roughness;
        return by_half(spot, around(spot->normal, sqrtl((1 - s.x) / (1 - s.x + a * a * s.x)), s.y));
    }
    real cosine = powl(s.x, 1 / (look->material->shininess + 1));
    if (look->material->blinn)
        return by_half(spot, around(spot->normal, cosine, s.y));
    return around(sub(spot->d, scaled(spot->normal, 2 * dot(spot->d, spot->normal))), cosine, s.y);
}

static real lobe_density(const Spot *spot, Vec l)
{
    const Look *look = &spot->look;
    Vec to_eye = scaled(spot->d, -1);
    real power = (look->material->shininess + 1) / (2 * PI);
    if (!look->material->pbr && !look->material->blinn) {
        /* Only the hemisphere about the mirror direction is chosen from. */
        Vec back = sub(scaled(spot->normal, 2 * dot(spot->normal, l)), l);
        return dot(back, to_eye) > 0
                   ? power * specular_term(false, look->material->shininess, spot->normal, l, to_eye) : 0;
    }
    Vec h = normalized(add(l, to_eye));
    real v_h = dot(to_eye, h);
    real n_h = dot(spot->normal, h);
    /* No H below the surface is chosen. */
    if (!(n_h > 0 && v_h > 0))
        return 0;
    real half = look->material->pbr ? ggx_density(look->roughness * look->roughness, n_h) * n_h
                                    : power * powl(n_h, look->material->shininess);
    return half / (4 * v_h);
}

Vec scatter_choose(const Spot *spot, int way, Square s)
{
    if (way == WAY_COSINE)
        return cosine_direction(spot->normal, s);
    if (way == WAY_MAP)
        return environment_choose(&spot->scene->environment, s);
    if (way == WAY_LOBE)
        return choose_lobe(spot, s);
    Arrival arrival;
    return light_arrives(&spot->scene->lights[way - WAY_LIGHTS], spot->hit->point, s, &arrival)
               ? arrival.direction : grey(0);
}

real scatter_density(const Spot *spot, int way, Vec l)
{
    if (way == WAY_COSINE)
        return dot(spot->normal, l) / PI;
    if (way == WAY_MAP)
        return environment_density(&spot->scene->environment, l);
    if (way == WAY_LOBE)
        return lobe_density(spot, l);
    return light_density(&spot->scene->lights[way - WAY_LIGHTS], spot->hit->point, l);
}
