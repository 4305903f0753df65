// Rays at triangles of any kind.
#include "mesh_support.h"

#include <math.h>

void rays_aim_at_soup(Rays *rays, const FaceTable *faces, f64 size, Vec3 center, u64 *random)
{
    for (u32 i = 0; i < rays->count; i++) {
        f32 (*v)[3] = faces->vertices[(u32)(random_unit(random) * faces->count)];
        const f64 b = random_unit(random), c = i % 3 ? random_unit(random) * (1 - b) : 0;
        const Vec3 from = vec_add(center, random_point(random, i % 5 ? 2 * size : 0.5 * size));
        const f64 start[3] = {from.x, from.y, from.z}, length = i % 2 ? 1 : pow(10, random_in(random, -3, 3));
        f32 o[3], d[3];
        for (int k = 0; k < 3; k++) {
            o[k] = (f32)start[k];
            const f64 target = (f64)v[0][k] * (1 - b - c) + (f64)v[1][k] * b + (f64)v[2][k] * c;
            d[k] = (f32)((target - (f64)o[k]) * length);
        }
        if (i % 11 == 0) // along an axis, with zeros of either sign
            d[i % 3] = i % 2 ? 0.0F : -0.0F;
        if (i % 22 == 0)
            d[(i + 1) % 3] = 0;
        rays_set(rays, i, o, d);
    }
}
