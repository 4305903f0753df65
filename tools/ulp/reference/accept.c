#include "reference/accept.h"

#include <math.h>

static bool starts_on_surface(const ShapeRay *ray, real grow)
{
    bool on_surface = false;
    for (int k = 0; k < reference_pieces(ray->shape); ++k) {
        real distance, uv[2];
        Real3 normal;
        on_surface |=
            reference_piece(ray->shape, k, ray->o, &distance, &normal, uv) && fabsl(distance) <= grow;
    }
    return on_surface;
}

bool reference_at_open_rim(const ShapeRay *ray, real t, real grow, bool may_miss)
{
    const Shape *s = ray->shape;
    const bool cone = s->kind == SHAPE_CONE;
    if ((!cone && s->kind != SHAPE_CYLINDER) || (cone ? s->as.cone.caps : s->as.cylinder.caps))
        return false;
    const double height = vec_length(cone ? vec_sub(s->as.cone.top, s->as.cone.base)
                                          : vec_sub(s->as.cylinder.top, s->as.cylinder.base));
    real distance, uv[2];
    Real3 normal;
    reference_piece(s, 0, real3_add(ray->o, real3_scale(ray->d, t)), &distance, &normal, uv);
    return fabsl(distance) <= grow && (may_miss || fminl(uv[1], 1 - uv[1]) * height <= 4 * grow);
}

bool reference_accepts(const ShapeRay *ray, real t, real grow, real slack)
{
    const Shape *shape = ray->shape;
    const bool flat =
        shape->kind == SHAPE_PLANE || shape->kind == SHAPE_DISK || shape->kind == SHAPE_TRIANGLE;
    real sideways = grow;
    if (flat) {
        // What moves a ray sideways moves its hit, and the edges as it sees them, by more than that.
        real distance, uv[2];
        Real3 normal;
        reference_piece(shape, 0, ray->o, &distance, &normal, uv);
        const real rate = fabsl(real3_dot(normal, ray->d));
        slack += grow / rate;
        sideways += grow / rate * real3_length(ray->d);
    }
    real low = INFINITY, high = 0;
    const bool ends = shape->kind == SHAPE_CYLINDER || shape->kind == SHAPE_CONE;
    for (int k = ends ? 0 : 3; k < (ends ? 9 : 6); ++k) { // only ends move on their own
        const real hit = reference_hit(shape, ray->o, ray->d, sideways * (k % 3 - 1), grow * (k / 3 - 1), 0);
        low = fminl(low, hit);
        high = fmaxl(high, hit);
    }
    const bool on_surface = starts_on_surface(ray, grow);
    if (isinf(t))
        return isinf(high) || (on_surface && flat);
    if (flat && isinf(low))
        return on_surface && t <= 2 * slack;
    if (t >= (on_surface ? 0 : low - slack) && t <= high + slack)
        return true;
    return reference_at_open_rim(ray, t, grow, isinf(high));
}
