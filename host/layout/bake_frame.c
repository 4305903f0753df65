#include "layout/bake.h"

#include <math.h>

void bake_split_whole(f64 x, f32 *whole, f32 *rest)
{
    *whole = (f32)round(x);
    *rest = (f32)(x - *whole);
}

static f64 largest(Vec3 a)
{
    return fmax(fabs(a.x), fmax(fabs(a.y), fabs(a.z)));
}

static f32x4 row_of(Vec3 a, f32 w)
{
    return (f32x4){(f32)a.x, (f32)a.y, (f32)a.z, w};
}

static bool row_regular(f32x4 row)
{
    return isfinite(row.x) && isfinite(row.y) && isfinite(row.z) && isfinite(row.w) &&
           (row.x != 0 || row.y != 0 || row.z != 0);
}

bool bake_object_frame(const Affine *to_space, ObjectFrame *out, Error *error)
{
    const Affine inverse = affine_inverse(*to_space);
    const Vec3 t = inverse.translation;
    f32 whole[3], rest[3];
    bake_split_whole(t.x, &whole[0], &rest[0]);
    bake_split_whole(t.y, &whole[1], &rest[1]);
    bake_split_whole(t.z, &whole[2], &rest[2]);
    out->row0 = row_of(inverse.row[0], whole[0]);
    out->row1 = row_of(inverse.row[1], whole[1]);
    out->row2 = row_of(inverse.row[2], whole[2]);
    // Normals go back by the transpose of the way there; its size does not matter.
    const Vec3 *m = to_space->row;
    const f64 size = fmax(largest(m[0]), fmax(largest(m[1]), largest(m[2])));
    out->normal0 = row_of((Vec3){m[0].x / size, m[1].x / size, m[2].x / size}, rest[0]);
    out->normal1 = row_of((Vec3){m[0].y / size, m[1].y / size, m[2].y / size}, rest[1]);
    out->normal2 = row_of((Vec3){m[0].z / size, m[1].z / size, m[2].z / size}, rest[2]);
    const bool in_range = row_regular(out->row0) && row_regular(out->row1) && row_regular(out->row2);
    return in_range || error_set(error, ERROR_SCENE, BAKE_OUT_OF_RANGE);
}
