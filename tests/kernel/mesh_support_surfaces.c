// Closed surfaces.
#include "mesh_support.h"

#include <math.h>
#include <stdlib.h>

void triangles_add(TriangleList *list, Vec3 a, Vec3 b, Vec3 c)
{
    if (list->count == list->capacity) {
        list->capacity = list->capacity ? 2 * list->capacity : 64;
        list->vertices = realloc(list->vertices, 3 * (size_t)list->capacity * sizeof *list->vertices);
        assert_non_null(list->vertices);
    }
    Vec3 *v = list->vertices + 3 * (size_t)list->count++;
    v[0] = a;
    v[1] = b;
    v[2] = c;
}

void triangles_destroy(TriangleList *list)
{
    free(list->vertices);
}

static void split(TriangleList *list, Vec3 a, Vec3 b, Vec3 c, int levels)
{
    if (levels == 0) {
        triangles_add(list, a, b, c);
        return;
    }
    const Vec3 ab = vec_normalize(vec_add(a, b)), bc = vec_normalize(vec_add(b, c));
    const Vec3 ca = vec_normalize(vec_add(c, a));
    split(list, a, ab, ca, levels - 1);
    split(list, ab, b, bc, levels - 1);
    split(list, ca, bc, c, levels - 1);
    split(list, ab, bc, ca, levels - 1);
}

TriangleList triangles_icosphere(int levels)
{
    static const int faces[20][3] = {
        {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
    };
    const f64 g = (1 + sqrt(5)) / 2;
    const Vec3 v[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    TriangleList list = {NULL, 0, 0};
    for (int i = 0; i < 20; i++)
        split(&list, vec_normalize(v[faces[i][0]]), vec_normalize(v[faces[i][1]]),
              vec_normalize(v[faces[i][2]]), levels);
    return list;
}

TriangleList triangles_bumpy(int levels)
{
    TriangleList list = triangles_icosphere(levels);
    for (u32 i = 0; i < 3 * list.count; i++) {
        Vec3 *v = &list.vertices[i];
        *v = vec_scale(*v, 1 + 0.3 * sin(9 * v->x) * cos(11 * v->y) + 0.2 * sin(13 * v->z + v->x));
    }
    return list;
}

static void add_quad(TriangleList *list, Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    triangles_add(list, a, b, c);
    triangles_add(list, a, c, d);
}

// The face of [low, low + size]^3 on the upper or lower side of an axis, seen from outside.
static void add_side(TriangleList *list, const f64 low[3], const f64 high[3], int axis, bool upper)
{
    f64 corner[4][3];
    static const int turns[4][2] = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    for (int k = 0; k < 4; k++) {
        const int *turn = turns[upper ? k : 3 - k];
        const int u = (axis + 1) % 3, v = (axis + 2) % 3;
        corner[k][axis] = upper ? high[axis] : low[axis];
        corner[k][u] = turn[0] ? high[u] : low[u];
        corner[k][v] = turn[1] ? high[v] : low[v];
    }
    Vec3 p[4];
    for (int k = 0; k < 4; k++)
        p[k] = (Vec3){corner[k][0], corner[k][1], corner[k][2]};
    add_quad(list, p[0], p[1], p[2], p[3]);
}

TriangleList triangles_cube(void)
{
    const f64 low[3] = {-1, -1, -1}, high[3] = {1, 1, 1};
    TriangleList list = {NULL, 0, 0};
    for (int side = 0; side < 6; side++)
        add_side(&list, low, high, side / 2, side % 2);
    return list;
}

TriangleList triangles_spindle(u32 slices, u32 rings)
{
    const f64 pi = acos(-1);
    TriangleList list = {NULL, 0, 0};
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

static bool is_solid(int x, int y, int z, int radius)
{
    // Twice the distance of the cell's centre from the origin, squared.
    const int a = 2 * x + 1, b = 2 * y + 1, c = 2 * z + 1;
    return a * a + b * b + c * c < 4 * radius * radius;
}

TriangleList triangles_voxels(int radius, f64 cell)
{
    TriangleList list = {NULL, 0, 0};
    const int side = 2 * radius;
    for (int i = 0; i < side * side * side; i++) {
        const int at[3] = {i % side - radius, i / side % side - radius, i / side / side - radius};
        if (!is_solid(at[0], at[1], at[2], radius))
            continue;
        f64 low[3], high[3];
        for (int k = 0; k < 3; k++) {
            low[k] = at[k] * cell;
            high[k] = (at[k] + 1) * cell;
        }
        for (int face = 0; face < 6; face++) {
            int beside[3] = {at[0], at[1], at[2]};
            beside[face / 2] += face % 2 ? 1 : -1;
            if (!is_solid(beside[0], beside[1], beside[2], radius))
                add_side(&list, low, high, face / 2, face % 2);
        }
    }
    return list;
}
