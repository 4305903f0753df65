#include "texture.h"

static bool is_odd(real cell)
{
    return fmodl(fabsl(cell), 2) == 1;
}

static Vec image_value(const Texture *texture, bool linear, const Surface *surface)
{
    const Image *image = texture->image;
    const Vec *values = texture->srgb && !linear ? image->decoded : image->values;
    real x = surface->u * texture->scale[0] * image->width;
    real y = (1 - surface->v * texture->scale[1]) * image->height;
    return texture->nearest ? image_nearest(image, values, x, y) : image_bilinear(image, values, x, y, true);
}

static Vec texture_value(const Texture *texture, bool linear, Vec p, const Surface *surface)
{
    if (texture->kind == TEXTURE_IMAGE)
        return image_value(texture, linear, surface);
    if (texture->kind == TEXTURE_CHECKER) {
        real cells = floorl(surface->u * texture->scale[0]) + floorl(surface->v * texture->scale[1]);
        return texture->colors[is_odd(cells)];
    }
    real scale = texture->scale[0];
    Vec inside = scaled(sub(p, scaled(surface->normal, 1e-4L / scale)), scale);
    return texture->colors[is_odd(floorl(inside.x) + floorl(inside.y) + floorl(inside.z))];
}

Vec paint_color(const Scene *scene, const Paint *paint, Vec p, const Surface *surface)
{
    if (paint->texture < 0)
        return paint->color;
    return times(paint->color, texture_value(&scene->textures[paint->texture], false, p, surface));
}

real paint_number(const Scene *scene, const Paint *paint, Vec p, const Surface *surface)
{
    if (paint->texture < 0)
        return paint->color.x;
    return paint->color.x * texture_value(&scene->textures[paint->texture], true, p, surface).x;
}

Vec mapped_normal(const Scene *scene, const Primitive *primitive, Vec p, const Surface *surface, Vec shading)
{
    int texture = primitive->material->normal_map;
    if (texture < 0)
        return shading;
    Vec color = texture_value(&scene->textures[texture], true, p, surface);
    Vec du = transform_vector(&primitive->to_world, surface->du);
    Vec dv = transform_vector(&primitive->to_world, surface->dv);
    Vec tangent = sub(du, scaled(shading, dot(du, shading)));
    if (length(tangent) == 0)
        return shading;
    tangent = normalized(tangent);
    Vec bitangent = cross(shading, tangent);
    if (dot(bitangent, dv) < 0)
        bitangent = scaled(bitangent, -1);
    Vec mapped = add(add(scaled(tangent, 2 * color.x - 1), scaled(bitangent, 2 * color.y - 1)),
                     scaled(shading, 2 * color.z - 1));
    return length(mapped) > 0 ? normalized(mapped) : shading;
}

Vec shadow_transmit(const Scene *scene, const Primitive *primitive, Vec p, const Surface *surface)
{
    const Material *material = primitive->material;
    if (primitive->light >= 0)
        return grey(0);
    if (!material->pbr)
        return material->transmit;
    if (material->share_transmitted == 0)
        return grey(0);
    real m = material->share_transmitted * (1 - paint_number(scene, &material->metallic, p, surface));
    return scaled(paint_color(scene, &material->base_color, p, surface), m);
}
