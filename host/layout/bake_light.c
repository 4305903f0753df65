#include "layout/bake.h"

#include <float.h>
#include <math.h>

// A parallelogram as RECTANGLE. Bounds are widened by what rounding can move, as those of other shapes.
static bool bake_rectangle(const Light *light, const Affine *to_space, Primitive *out, BakedBounds *bounds,
                           Error *error)
{
    const Vec3 a = affine_direction(*to_space, vec_scale(light->edge1, 0.5));
    const Vec3 b = affine_direction(*to_space, vec_scale(light->edge2, 0.5));
    const Vec3 corner = affine_point(*to_space, light->position), c = vec_add(corner, vec_add(a, b));
    const Vec3 n = vec_normalize(vec_cross(vec_normalize(a), vec_normalize(b)));
    const Affine map = { .row = { { a.x, b.x, n.x }, { a.y, b.y, n.y }, { a.z, b.z, n.z } },
                         .translation = c };
    const Affine inverse = affine_inverse(map);
    const Vec3 extent = { fabs(a.x) + fabs(b.x), fabs(a.y) + fabs(b.y), fabs(a.z) + fabs(b.z) };
    const f64 size = vec_length(c) + 4 * vec_length(extent);
    const Vec3 pad = { 8 * FLT_EPSILON * size, 8 * FLT_EPSILON * size, 8 * FLT_EPSILON * size };
    const Vec3 rows[2] = { inverse.row[0], inverse.row[1] };
    *out = (Primitive){ .kind = PRIMITIVE_RECTANGLE };
    out->row0 = (f32x4){ (f32)rows[0].x, (f32)rows[0].y, (f32)rows[0].z, (f32)c.x };
    out->row1 = (f32x4){ (f32)rows[1].x, (f32)rows[1].y, (f32)rows[1].z, (f32)c.y };
    out->row2 = (f32x4){ (f32)n.x, (f32)n.y, (f32)n.z, (f32)c.z };
    out->p0 = (f32)vec_dot(n, c);
    bounds->min = vec_sub(vec_sub(c, extent), pad);
    bounds->max = vec_add(vec_add(c, extent), pad);
    const f64 lengths[] = { vec_length(rows[0]), vec_length(rows[1]), vec_length(c) + vec_length(extent) };
    for (int k = 0; k < 3; k++)
        if (!(lengths[k] <= FLT_MAX) || (k < 2 && lengths[k] < FLT_MIN))
            return error_set(error, ERROR_SCENE, BAKE_OUT_OF_RANGE);
    return true;
}

bool bake_light(const Light *light, const Affine *to_space, Primitive *out, BakedBounds *bounds, Error *error)
{
    if (light->kind == LIGHT_RECTANGLE)
        return bake_rectangle(light, to_space, out, bounds, error);
    const Shape sphere = { .kind = SHAPE_SPHERE, .as.sphere = { light->position, light->radius } };
    return bake_shape(&sphere, to_space, out, bounds, error);
}
