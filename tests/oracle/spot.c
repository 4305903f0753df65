#include "spot.h"

Spot spot_at(const Scene *scene, const Ray *ray, const Hit *hit)
{
    Spot spot = {.scene = scene, .hit = hit, .look = look_at_hit(scene, hit), .d = ray->d};
    spot.entering = dot(ray->d, hit->normal) < 0;
    spot.geometric = spot.entering ? hit->normal : scaled(hit->normal, -1);
    spot.normal = spot.entering ? hit->shading : scaled(hit->shading, -1);
    spot.mirror = dot(spot.normal, ray->d) < 0 ? spot.normal : spot.geometric;
    return spot;
}

bool spot_sees(const Spot *spot, Vec direction)
{
    return dot(spot->normal, direction) > 0 && dot(spot->geometric, direction) > 0;
}

Ray spot_ray(const Spot *spot, Vec direction)
{
    return (Ray){spot->hit->point, direction, spot->hit->primitive, spot->hit->patch};
}

real fresnel_reflectance(real cosine, real eta)
{
    real sine2 = eta * eta * (1 - cosine * cosine);
    if (sine2 >= 1)
        return 1;
    real behind = sqrtl(1 - sine2);
    real s = (eta * cosine - behind) / (eta * cosine + behind);
    real p = (cosine - eta * behind) / (cosine + eta * behind);
    return (s * s + p * p) / 2;
}

/* The direction of the transmitted ray; false on total internal reflection. */
static bool refracted(const Spot *spot, real eta, Vec *through)
{
    real cosine = -dot(spot->d, spot->mirror);
    real k = 1 - eta * eta * (1 - cosine * cosine);
    *through = spot->d;
    if (k <= 0)
        return false;
    *through = add(scaled(spot->d, eta), scaled(spot->mirror, eta * cosine - sqrtl(k)));
    return true;
}

/* Weights of the rays of section 5 and the transmitted direction. */
static void split_pbr(const Spot *spot, Split *split)
{
    const Look *look = &spot->look;
    real cosine = -dot(spot->d, spot->mirror);
    real eta = spot->entering ? 1 / look->material->ior : look->material->ior;
    bool total = !refracted(spot, eta, &split->through);
    real fd = total ? 1 : fresnel_reflectance(cosine, eta);
    split->reflect = grey(look->m * fd);
    split->transmit = scaled(look->base, look->m * (1 - fd));
    if (look->roughness < MIRROR_ROUGHNESS) {
        Vec rest = scaled(sub(grey(1), look->f0), powl(1 - cosine, 5));
        split->reflect = add(split->reflect, scaled(add(look->f0, rest), 1 - look->m));
    }
}

/* w_r and w_t of section 4 and the transmitted direction. */
static void split_phong(const Spot *spot, Split *split)
{
    const Material *material = spot->look.material;
    bool opaque = largest(material->transmit) == 0;
    real eta = spot->entering || opaque ? 1 / material->ior : material->ior;
    real cosine = -dot(spot->d, spot->mirror);
    bool total = !refracted(spot, eta, &split->through);
    split->reflect = material->reflect;
    split->transmit = material->transmit;
    if (total) {
        split->transmit = grey(0);
        if (material->fresnel)
            split->reflect = vec(fmaxl(material->reflect.x, material->transmit.x),
                                 fmaxl(material->reflect.y, material->transmit.y),
                                 fmaxl(material->reflect.z, material->transmit.z));
        else
            split->reflect = add(material->reflect, material->transmit);
    } else if (material->fresnel) {
        real f = fresnel_reflectance(cosine, eta);
        split->reflect = scaled(material->reflect, f);
        split->transmit = scaled(material->transmit, 1 - f);
    }
}

Split spot_split(const Spot *spot)
{
    Split split;
    if (spot->look.material->pbr)
        split_pbr(spot, &split);
    else
        split_phong(spot, &split);
    split.mirrored = sub(spot->d, scaled(spot->mirror, 2 * dot(spot->d, spot->mirror)));
    if (dot(split.mirrored, spot->geometric) < 0)
        split.reflect = grey(0);
    if (dot(split.through, spot->geometric) > 0)
        split.transmit = grey(0);
    return split;
}
