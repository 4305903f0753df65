#include "trace.h"

#include "light.h"
#include "texture.h"

Camera camera_make(const Scene *scene)
{
    Camera camera = {.position = scene->camera_position, .width = scene->width, .height = scene->height};
    camera.w = normalized(sub(scene->camera_position, scene->camera_look_at));
    camera.u = normalized(cross(scene->camera_up, camera.w));
    camera.v = cross(camera.w, camera.u);
    camera.orthographic = scene->orthographic > 0;
    camera.k = camera.orthographic ? scene->orthographic / 2 : tanl(scene->fov * PI / 360);
    return camera;
}

Ray camera_ray(const Camera *camera, real px, real py)
{
    real width = camera->width;
    real height = camera->height;
    real x = (2 * px / width - 1) * (width / height) * camera->k;
    real y = (1 - 2 * py / height) * camera->k;
    Vec offset = add(scaled(camera->u, x), scaled(camera->v, y));
    if (camera->orthographic)
        return (Ray){add(camera->position, offset), scaled(camera->w, -1), NULL, 0};
    return (Ray){camera->position, normalized(sub(offset, camera->w)), NULL, 0};
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

real specular_term(bool blinn, real shininess, Vec n, Vec to_light, Vec to_eye)
{
    real cosine;
    if (blinn)
        cosine = dot(n, normalized(add(to_light, to_eye)));
    else
        cosine = dot(sub(scaled(n, 2 * dot(n, to_light)), to_light), to_eye);
    return powl(fminl(1, fmaxl(0, cosine)), shininess);
}

/* A hit with its normals turned to the ray's origin. */
typedef struct Spot {
    const Scene *scene;
    const Hit *hit;
    const Material *material;
    Vec d;         /* of the ray that came */
    Vec geometric, normal;
    Vec mirror;    /* the normal of reflection, refraction and fresnel */
    bool entering;
} Spot;

static Vec direct_light(const Spot *spot, Vec diffuse)
{
    Vec sum = grey(0);
    Vec to_eye = scaled(spot->d, -1);
    for (size_t i = 0; i < spot->scene->light_count; i++) {
        Arrival light;
        if (!light_arrives(&spot->scene->lights[i], spot->hit->point, &light))
            continue;
        real cosine = dot(spot->normal, light.direction);
        if (!(cosine > 0) || !(dot(spot->geometric, light.direction) > 0))
            continue;
        const Material *material = spot->material;
        real s = specular_term(material->blinn, material->shininess, spot->normal, light.direction, to_eye);
        Vec share = times(light.intensity, add(scaled(diffuse, cosine), scaled(material->specular, s)));
        if (spot->scene->shadows && largest(share) > 0) {
            Ray ray = {spot->hit->point, light.direction, spot->hit->primitive, spot->hit->patch};
            share = times(share, hit_transmittance(spot->scene, &ray, light.distance));
        }
        sum = add(sum, share);
    }
    return sum;
}

/* w_r and w_t of section 4 and the transmitted direction. */
static void split(const Spot *spot, Vec *reflect, Vec *transmit, Vec *through)
{
    const Material *material = spot->material;
    bool opaque = largest(material->transmit) == 0;
    real eta = spot->entering || opaque ? 1 / material->ior : material->ior;
    real cosine = -dot(spot->d, spot->mirror);
    real k = 1 - eta * eta * (1 - cosine * cosine);
    bool total = k <= 0;
    *reflect = material->reflect;
    *transmit = material->transmit;
    *through = spot->d;
    if (!total)
        *through = add(scaled(spot->d, eta), scaled(spot->mirror, eta * cosine - sqrtl(k)));
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
    if (!hit_closest(scene, ray, &hit))
        return scene->background;
    Spot spot = {.scene = scene, .hit = &hit, .material = hit.primitive->material, .d = ray->d};
    spot.entering = dot(ray->d, hit.normal) < 0;
    spot.geometric = spot.entering ? hit.normal : scaled(hit.normal, -1);
    spot.normal = spot.entering ? hit.shading : scaled(hit.shading, -1);
    spot.mirror = dot(spot.normal, ray->d) < 0 ? spot.normal : spot.geometric;

    Vec diffuse = paint_color(scene, &spot.material->diffuse, hit.local, &hit.surface);
    Vec ambient = paint_color(scene, &spot.material->ambient, hit.local, &hit.surface);
    Vec sum = add(spot.material->emission, times(ambient, scene->ambient));
    sum = add(sum, direct_light(&spot, diffuse));

    Vec reflect, transmit, through;
    split(&spot, &reflect, &transmit, &through);
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
