// Closed surfaces.
#include "mesh_support.h"

#include <math.h>
#include <stdlib.h>

TriangleList triangles_bumpy(u32 levels)
{
    TriangleList list = triangles_icosphere(levels);
    for (u32 i = 0; i < 3 * list.count; i++) {
        Vec3 *v = &list.vertices[i];
        *v = vec_scale(*v, 1 + 0.3 * sin(9 * v->x) * cos(11 * v->y) + 0.2 * sin(13 * v->z + v->x));
    }
    return list;
}

TriangleList triangles_cube(void)
{
    static const f64 turns[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    TriangleList list = {.vertices = NULL};
    for (int side = 0; side < 6; side++) {
        const int axis = side / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
        Vec3 p[4];
        for (int k = 0; k < 4; k++) {
            f64 corner[3];
            corner[axis] = side % 2 ? 1 : -1;
            corner[u] = turns[side % 2 ? k : 3 - k][0];
            corner[v] = turns[side % 2 ? k : 3 - k][1];
            p[k] = (Vec3){corner[0], corner[1], corner[2]};
        }
        triangles_add(&list, p[0], p[1], p[2]);
        triangles_add(&list, p[0], p[2], p[3]);
    }
    return list;
}

TriangleList triangles_spindle(u32 slices, u32 rings)
{
    const f64 pi = acos(-1);
    TriangleList list = {.vertices = NULL};
    Vec3 *points = malloc((size_t)(rings + 1) * slices * sizeof *points);
    assert_non_null(points);
    for (u32 i = 0; i < (rings + 1) * slices; i++) {
        const u32 ring = i / slices;
        const f64 up = pi * ring / rings, around = 2 * pi * (i % slices) / slices;
        // One point at each end, whatever rounding says.
        const f64 radius = ring == 0 || ring == rings ? 0 : sin(up);
        points[i] = (Vec3){radius * cos(around), -cos(up), radius * sin(around)};
    }
    for (u32 i = 0; i < rings * slices; i++) {
        const u32 next = i % slices + 1 == slices ? i + 1 - slices : i + 1;
        const Vec3 a = points[i], b = points[next], c = points[next + slices], d = points[i + slices];
        if (i / slices > 0)
            triangles_add(&list, a, c, b);
        if (i / slices + 1 < rings)
            triangles_add(&list, a, d, c);
    }
    free(points);
    return list;
}
