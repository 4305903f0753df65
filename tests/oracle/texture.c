#include "texture.h"

static bool is_odd(real cell)
{
    return fmodl(fabsl(cell), 2) == 1;
}

Vec paint_color(const Scene *scene, const Paint *paint, Vec p, const Surface *surface)
{
    if (paint->texture < 0)
        return paint->color;
    const Texture *texture = &scene->textures[paint->texture];
    if (texture->kind == TEXTURE_CHECKER) {
        real cells = floorl(surface->u * texture->scale[0]) + floorl(surface->v * texture->scale[1]);
        return texture->colors[is_odd(cells)];
    }
    real scale = texture->scale[0];
    Vec inside = scaled(sub(p, scaled(surface->normal, 1e-4L / scale)), scale);
    return texture->colors[is_odd(floorl(inside.x) + floorl(inside.y) + floorl(inside.z))];
}
