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

static Vec radiance(const Scene *scene, const Ray *ray, int depth, Vec throughput);

static Vec branch(const Spot *spot, Vec direction, Vec weight, int depth, Vec throughput)
{
    Vec next = times(throughput, weight);
    if (depth >= spot->scene->max_depth || largest(next) < spot->scene->min_weight || largest(weight) == 0)
        return grey(0);
    Ray ray = spot_ray(spot, normalized(direction));
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
    Spot spot = spot_at(scene, ray, &hit);
    bool pbr = spot.look.material->pbr;
    Vec sum = add(spot.look.emission, gather_lights(&spot));
    if (pbr && environment->image != NULL)
        sum = add(sum, gather_environment(&spot));
    else
        sum = add(sum, scaled(times(spot.look.ambient, scene->ambient), gather_openness(&spot)));

    Split split = spot_split(&spot);
    sum = add(sum, branch(&spot, split.mirrored, split.reflect, depth, throughput));
    return add(sum, branch(&spot, split.through, split.transmit, depth, throughput));
}

Vec trace_radiance(const Scene *scene, const Ray *ray)
{
    return radiance(scene, ray, 0, grey(1));
}
