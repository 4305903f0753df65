#include "trace.h"

#include "environment.h"
#include "gather.h"
#include "light.h"

Camera camera_make(const Scene *scene)
{
    Camera camera = {.position = scene->camera_position, .width = scene->width, .height = scene->height};
    camera.w = normalized(sub(scene->camera_position, scene->camera_look_at));
    camera.u = normalized(cross(scene->camera_up, camera.w));
    camera.v = cross(camera.w, camera.u);
    camera.orthographic = scene->orthographic > 0;
    camera.aperture = scene->aperture;
    camera.focus = scene->focus_distance;
    if (camera.focus == 0)
        camera.focus = length(sub(scene->camera_position, scene->camera_look_at));
    camera.k = camera.orthographic ? scene->orthographic / 2 : tanl(scene->fov * PI / 360);
    return camera;
}

Ray camera_ray(const Camera *camera, real px, real py, Vec lens)
{
    real width = camera->width;
    real height = camera->height;
    real x = (2 * px / width - 1) * (width / height) * camera->k;
    real y = (1 - 2 * py / height) * camera->k;
    Vec offset = add(scaled(camera->u, x), scaled(camera->v, y));
    if (camera->orthographic)
        return (Ray){add(camera->position, offset), scaled(camera->w, -1), NULL, 0};
    if (camera->aperture == 0)
        return (Ray){camera->position, normalized(sub(offset, camera->w)), NULL, 0};
    lens = scaled(lens, camera->aperture);
    Vec start = add(scaled(camera->u, lens.x), scaled(camera->v, lens.y));
    Vec through = scaled(sub(offset, camera->w), camera->focus);
    return (Ray){add(camera->position, start), normalized(sub(through, start)), NULL, 0};
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
static void split_pbr(const Spot *spot, Vec *reflect, Vec *transmit, Vec *through)
{
    const Look *look = &spot->look;
    real cosine = -dot(spot->d, spot->mirror);
    real eta = spot->entering ? 1 / look->material->ior : look->material->ior;
    bool total = !refracted(spot, eta, through);
    real fd = total ? 1 : fresnel_reflectance(cosine, eta);
    *reflect = grey(look->m * fd);
    *transmit = scaled(look->base, look->m * (1 - fd));
    if (look->roughness < MIRROR_ROUGHNESS) {
        Vec rest = scaled(sub(grey(1), look->f0), powl(1 - cosine, 5));
        *reflect = add(*reflect, scaled(add(look->f0, rest), 1 - look->m));
    }
}

/* w_r and w_t of section 4 and the transmitted direction. */
static void split_phong(const Spot *spot, Vec *reflect, Vec *transmit, Vec *through)
{
    const Material *material = spot->look.material;
    bool opaque = largest(material->transmit) == 0;
    real eta = spot->entering || opaque ? 1 / material->ior : material->ior;
    real cosine = -dot(spot->d, spot->mirror);
    bool total = !refracted(spot, eta, through);
    *reflect = material->reflect;
    *transmit = material->transmit;
    if (total) {
        *transmit = grey(0);
        if (material->fresnel)
            *reflect = vec(fmaxl(material->reflect.x, material->transmit.x),
                           fmaxl(material->reflect.y, material->transmit.y),
                           fmaxl(material->reflect.z, material->transmit.z));
        else
            *reflect = add(material->reflect, material->transmit);
    } else if (material->fresnel) {
        real f = fresnel_reflectance(cosine, eta);
        *reflect = scaled(material->reflect, f);
        *transmit = scaled(material->transmit, 1 - f);
    }
}

static Vec radiance(const Scene *scene, const Ray *ray, int depth, Vec throughput);

static Vec branch(const Spot *spot, Vec direction, Vec weight, int depth, Vec throughput)
{
    Vec next = times(throughput, weight);
    if (depth >= spot->scene->max_depth || largest(next) < spot->scene->min_weight || largest(weight) == 0)
        return grey(0);
    Ray ray = {spot->hit->point, normalized(direction), spot->hit->primitive, spot->hit->patch};
    return times(weight, radiance(spot->scene, &ray, depth + 1, next));
}

static Vec radiance(const Scene *scene, const Ray *ray, int depth, Vec throughput)
{
    Hit hit;
    const Environment *environment = &scene->environment;
    if (!hit_closest(scene, ray, &hit))
        return environment->image != NULL ? environment_radiance(environment, ray->d) : scene->background;
    if (hit.primitive->light >= 0)
        return light_seen(&scene->lights[hit.primitive->light], ray->d, hit.normal);
    Spot spot = {.scene = scene, .hit = &hit, .look = look_at_hit(scene, &hit), .d = ray->d};
    spot.entering = dot(ray->d, hit.normal) < 0;
    spot.geometric = spot.entering ? hit.normal : scaled(hit.normal, -1);
    spot.normal = spot.entering ? hit.shading : scaled(hit.shading, -1);
    spot.mirror = dot(spot.normal, ray->d) < 0 ? spot.normal : spot.geometric;

    bool pbr = spot.look.material->pbr;
    Vec sum = add(spot.look.emission, gather_lights(&spot));
    if (pbr && environment->image != NULL)
        sum = add(sum, gather_environment(&spot));
    else
        sum = add(sum, scaled(times(spot.look.ambient, scene->ambient), gather_openness(&spot)));

    Vec reflect, transmit, through;
    if (pbr)
        split_pbr(&spot, &reflect, &transmit, &through);
    else
        split_phong(&spot, &reflect, &transmit, &through);
    Vec mirrored = sub(ray->d, scaled(spot.mirror, 2 * dot(ray->d, spot.mirror)));
    if (dot(mirrored, spot.geometric) >= 0)
        sum = add(sum, branch(&spot, mirrored, reflect, depth, throughput));
    if (dot(through, spot.geometric) <= 0)
        sum = add(sum, branch(&spot, through, transmit, depth, throughput));
    return sum;
}

Vec trace_radiance(const Scene *scene, const Ray *ray)
{
    return radiance(scene, ray, 0, grey(1));
}
