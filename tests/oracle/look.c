#include "look.h"

#include "texture.h"

static Vec mix(Vec a, Vec b, real share)
{
    return add(scaled(a, 1 - share), scaled(b, share));
}

Look look_at_hit(const Scene *scene, const Hit *hit)
{
    const Material *material = hit->primitive->material;
    const Surface *surface = &hit->surface;
    Look look = {.material = material};
    look.emission = paint_color(scene, &material->emission, hit->local, surface);
    if (!material->pbr) {
        look.diffuse = paint_color(scene, &material->diffuse, hit->local, surface);
        look.ambient = paint_color(scene, &material->ambient, hit->local, surface);
        return look;
    }
    look.base = paint_color(scene, &material->base_color, hit->local, surface);
    look.metallic = paint_number(scene, &material->metallic, hit->local, surface);
    look.roughness = paint_number(scene, &material->roughness, hit->local, surface);
    look.ambient = scaled(look.base, paint_number(scene, &material->occlusion, hit->local, surface));
    real root = (material->ior - 1) / (material->ior + 1);
    look.f0 = mix(grey(root * root), look.base, look.metallic);
    look.m = material->share_transmitted * (1 - look.metallic);
    return look;
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

real ggx_density(real a, real n_h)
{
    real below = n_h * n_h * (a * a - 1) + 1;
    return a * a / (PI * below * below);
}

real ggx_visibility(real a, real n_l, real n_v)
{
    real v = fmaxl(1e-4L, n_v);
    real k = 1 - a * a;
    return 0.5L / (n_l * sqrtl(a * a + k * v * v) + v * sqrtl(a * a + k * n_l * n_l));
}

Vec pbr_brdf(const Look *look, Vec n, Vec to_light, Vec to_eye)
{
    Vec middle = add(to_light, to_eye);
    if (length(middle) == 0)
        return grey(0);
    Vec h = normalized(middle);
    real a = look->roughness * look->roughness;
    Vec f = mix(look->f0, grey(1), powl(1 - fminl(1, dot(to_eye, h)), 5));
    real diffuse = (1 - look->metallic) * (1 - look->material->share_transmitted) / PI;
    Vec brdf = scaled(times(sub(grey(1), f), look->base), diffuse);
    if (look->roughness < MIRROR_ROUGHNESS)
        return brdf;
    real lobe = ggx_density(a, dot(n, h)) * ggx_visibility(a, dot(n, to_light), dot(n, to_eye));
    return add(brdf, scaled(f, (1 - look->m) * lobe));
}

Vec look_reflected(const Look *look, Vec n, Vec to_light, Vec to_eye)
{
    real cosine = dot(n, to_light);
    if (look->material->pbr)
        return scaled(pbr_brdf(look, n, to_light, to_eye), cosine);
    real s = specular_term(look->material->blinn, look->material->shininess, n, to_light, to_eye);
    return add(scaled(look->diffuse, cosine), scaled(look->material->specular, s));
}

Vec look_brdf(const Look *look, Vec n, Vec to_light, Vec to_eye)
{
    const Material *material = look->material;
    if (material->pbr)
        return pbr_brdf(look, n, to_light, to_eye);
    real norm = material->blinn ? (material->shininess + 8) / (8 * PI) : (material->shininess + 2) / (2 * PI);
    real s = specular_term(material->blinn, material->shininess, n, to_light, to_eye);
    return add(scaled(look->diffuse, 1 / PI), scaled(material->specular, norm * s));
}

bool look_scatters(const Look *look)
{
    if (!look->material->pbr)
        return largest(look->diffuse) > 0 || largest(look->material->specular) > 0;
    real diffuse = (1 - look->metallic) * (1 - look->material->share_transmitted) * largest(look->base);
    return diffuse > 0 || (look->roughness >= MIRROR_ROUGHNESS && look->m < 1);
}
