#include "selftest/surfaces.h"

#include <math.h>
#include <stdlib.h>

#include "selftest/random.h"

void triangles_add(TriangleList *list, Vec3 a, Vec3 b, Vec3 c)
{
    if (list->count == list->capacity) {
        const u32 capacity = list->capacity ? 2 * list->capacity : 64;
        Vec3 *vertices = realloc(list->vertices, 3 * (size_t)capacity * sizeof *vertices);
        if (!vertices) {
            list->failed = true;
            return;
        }
        list->vertices = vertices;
        list->capacity = capacity;
    }
    Vec3 *v = list->vertices + 3 * (size_t)list->count++;
    v[0] = a;
    v[1] = b;
    v[2] = c;
}

void triangles_destroy(TriangleList *list)
{
    free(list->vertices);
    *list = (TriangleList){.vertices = NULL};
}

static void split(TriangleList *list, Vec3 a, Vec3 b, Vec3 c, u32 levels)
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

TriangleList triangles_icosphere(u32 levels)
{
    static const u8 FACES[20][3] = {
        {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1},
    };
    const f64 g = (1 + sqrt(5)) / 2;
    const Vec3 v[12] = {{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                        {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    TriangleList list = {.vertices = NULL};
    for (u32 i = 0; i < 20; i++)
        split(&list, vec_normalize(v[FACES[i][0]]), vec_normalize(v[FACES[i][1]]),
              vec_normalize(v[FACES[i][2]]), levels);
    return list;
}

// The face of [low, high] on the upper or lower side of an axis, seen from outside.
static void add_side(TriangleList *list, const f64 low[3], const f64 high[3], u32 axis, bool upper)
{
    static const bool TURNS[4][2] = {{false, false}, {true, false}, {true, true}, {false, true}};
    const u32 u = (axis + 1) % 3, v = (axis + 2) % 3;
    Vec3 p[4];
    for (u32 k = 0; k < 4; k++) {
        const bool *turn = TURNS[upper ? k : 3 - k];
        f64 corner[3];
        corner[axis] = upper ? high[axis] : low[axis];
        corner[u] = turn[0] ? high[u] : low[u];
        corner[v] = turn[1] ? high[v] : low[v];
        p[k] = (Vec3){corner[0], corner[1], corner[2]};
    }
    triangles_add(list, p[0], p[1], p[2]);
    triangles_add(list, p[0], p[2], p[3]);
}

static bool is_solid(i32 x, i32 y, i32 z, i32 radius)
{
    // Twice the distance of the cell's centre from the origin, squared.
    const i32 a = 2 * x + 1, b = 2 * y + 1, c = 2 * z + 1;
    return a * a + b * b + c * c < 4 * radius * radius;
}

TriangleList triangles_voxels(i32 radius, f64 cell)
{
    TriangleList list = {.vertices = NULL};
    const i32 side = 2 * radius;
    for (i32 i = 0; i < side * side * side; i++) {
        const i32 at[3] = {i % side - radius, i / side % side - radius, i / side / side - radius};
        if (!is_solid(at[0], at[1], at[2], radius))
            continue;
        f64 low[3], high[3];
        for (u32 k = 0; k < 3; k++) {
            low[k] = at[k] * cell;
            high[k] = (at[k] + 1) * cell;
        }
        for (u32 face = 0; face < 6; face++) {
            i32 beside[3] = {at[0], at[1], at[2]};
            beside[face / 2] += face % 2 ? 1 : -1;
            if (!is_solid(beside[0], beside[1], beside[2], radius))
                add_side(&list, low, high, face / 2, face % 2);
        }
    }
    return list;
}

TriangleList triangles_soup(u32 count, bool thin, u64 *random)
{
    TriangleList list = {.vertices = NULL};
    for (u32 i = 0; i < count; i++) {
        const Vec3 a = random_point(random, 1), side = random_point(random, 1);
        const f64 size = random_scale(random, -3, 0.3);
        const Vec3 b = vec_add(a, vec_scale(random_point(random, 1), size));
        Vec3 c = vec_add(a, vec_scale(side, size));
        if (thin)
            c = vec_add(a, vec_add(vec_scale(vec_sub(b, a), random_unit(random)),
                                   vec_scale(side, size * random_scale(random, -7, -2))));
        triangles_add(&list, a, b, c);
    }
    return list;
}
