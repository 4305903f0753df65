#include "grow.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

f64 random_at(u64 index, u32 seed)
{
    // Finalizer of SplitMix64 (Steele, Lea, Flood, "Fast splittable pseudorandom number generators", 2014).
    u64 x = (index + 1) * 0x9e3779b97f4a7c15u + (u64)seed * 0xd1342543de82ef95u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    x ^= x >> 31;
    return (f64)(x >> 11) * 0x1p-53;
}

// What the corner (x, y, z) of the lattice adds at the offset (dx, dy, dz) from it.
static f64 corner_gradient(i64 x, i64 y, i64 z, f64 dx, f64 dy, f64 dz, u32 seed)
{
    const u64 index = (u64)x * 73856093u ^ (u64)y * 19349663u ^ (u64)z * 83492791u;
    const u32 bits = (u32)(random_at(index, seed) * 16);
    const f64 a = bits & 8 ? dx : dy, b = bits & 4 ? dz : (bits & 8 ? dy : dx);
    return (bits & 1 ? a : -a) + (bits & 2 ? b : -b);
}

static f64 fade(f64 t)
{
    return t * t * t * (t * (t * 6 - 15) + 10);
}

f64 noise_at(Vec3 p, u32 seed)
{
    const f64 x = floor(p.x), y = floor(p.y), z = floor(p.z);
    const f64 dx = p.x - x, dy = p.y - y, dz = p.z - z;
    f64 sum = 0;
    for (int corner = 0; corner < 8; corner++) {
        const int cx = corner & 1, cy = corner >> 1 & 1, cz = corner >> 2;
        const f64 weight = fade(cx ? dx : 1 - dx) * fade(cy ? dy : 1 - dy) * fade(cz ? dz : 1 - dz);
        sum += weight * corner_gradient((i64)x + cx, (i64)y + cy, (i64)z + cz, dx - cx, dy - cy, dz - cz,
                                        seed);
    }
    return sum > 1 ? 1 : sum < -1 ? -1 : sum;
}

// Room for `more` elements of size bytes in an array.
static void *make_room(void *array, size_t count, size_t *room, size_t more, size_t size, bool *failed)
{
    if (count + more <= *room)
        return array;
    const size_t wanted = 2 * *room > count + more ? 2 * *room : count + more + 64;
    void *grown = wanted < SIZE_MAX / size ? realloc(array, wanted * size) : NULL;
    *failed |= !grown;
    *room = grown ? wanted : *room;
    return grown ? grown : array;
}

static bool room_for(Grower *grower, size_t positions, size_t faces)
{
    if (grower->failed)
        return false;
    grower->positions = make_room(grower->positions, grower->position_count, &grower->position_room,
                                  positions, sizeof *grower->positions, &grower->failed);
    grower->faces = make_room(grower->faces, grower->face_count, &grower->face_room, faces,
                              sizeof *grower->faces, &grower->failed);
    return !grower->failed;
}

u32 grower_vertex(Grower *grower, Vec3 position)
{
    if (!room_for(grower, 1, 0))
        return 0;
    grower->positions[grower->position_count] = position;
    return (u32)grower->position_count++;
}

void grower_face(Grower *grower, u32 a, u32 b, u32 c)
{
    if (!room_for(grower, 0, 1))
        return;
    u32 *face = grower->faces[grower->face_count++];
    face[0] = a;
    face[1] = b;
    face[2] = c;
}

void grower_quad(Grower *grower, Vec3 a, Vec3 b, Vec3 c, Vec3 d)
{
    const u32 ia = grower_vertex(grower, a), ib = grower_vertex(grower, b);
    const u32 ic = grower_vertex(grower, c), id = grower_vertex(grower, d);
    grower_face(grower, ia, ib, ic);
    grower_face(grower, ia, ic, id);
}

void grower_surface(Grower *grower, u32 columns, u32 rows, bool wrap, SurfacePoint at, const void *context)
{
    const u32 across = wrap ? columns : columns + 1;
    const u32 base = (u32)grower->position_count;
    for (u32 j = 0; j <= rows; j++)
        for (u32 i = 0; i < across; i++)
            grower_vertex(grower, at((f64)i / columns, (f64)j / rows, context));
    for (u32 j = 0; j < rows; j++) {
        for (u32 i = 0; i < columns; i++) {
            const u32 next = i + 1 < across ? i + 1 : 0;
            const u32 a = base + j * across + i, b = base + j * across + next;
            const u32 c = a + across, d = b + across;
            grower_face(grower, a, b, d);
            grower_face(grower, a, d, c);
        }
    }
}

static const f64 GOLDEN = 1.6180339887498949;

// Corners 0..11 of the icosahedron that is subdivided.
static Vec3 icosahedron_corner(u32 corner)
{
    const f64 one = corner & 1 ? -1 : 1, golden = corner & 2 ? -GOLDEN : GOLDEN;
    const Vec3 corners[3] = {{0, one, golden}, {one, golden, 0}, {golden, 0, one}};
    return vec_normalize(corners[corner >> 2]);
}

// Vertices of a sphere in hand: corners first, then those within edges, then those within faces.
typedef struct Geodesic {
    u32 base, frequency;
    u32 edges[12][12]; // number of the edge between two corners
    u8 faces[20][3];   // corners, counterclockwise from outside
} Geodesic;

static bool is_edge(u32 a, u32 b)
{
    return vec_dot(icosahedron_corner(a), icosahedron_corner(b)) > 0.3; // 0.447; others are negative
}

static Geodesic geodesic_make(u32 base, u32 frequency)
{
    Geodesic g = {.base = base, .frequency = frequency};
    u32 edges = 0, faces = 0;
    for (u32 a = 0; a < 12; a++) {
        for (u32 b = a + 1; b < 12; b++) {
            if (!is_edge(a, b))
                continue;
            g.edges[a][b] = g.edges[b][a] = edges++;
            for (u32 c = b + 1; c < 12; c++) {
                if (!is_edge(a, c) || !is_edge(b, c))
                    continue;
                const Vec3 normal = vec_cross(icosahedron_corner(a), icosahedron_corner(b));
                const bool outward = vec_dot(normal, icosahedron_corner(c)) > 0;
                g.faces[faces][0] = (u8)a;
                g.faces[faces][1] = (u8)(outward ? b : c);
                g.faces[faces++][2] = (u8)(outward ? c : b);
            }
        }
    }
    return g;
}

static u32 edge_vertex(const Geodesic *g, u32 a, u32 b, u32 step)
{
    const u32 along = a < b ? step : g->frequency - step;
    return g->base + 12 + g->edges[a][b] * (g->frequency - 1) + along - 1;
}

// The vertex of face f that lies i steps towards its second corner and j towards its third.
static u32 face_vertex(const Geodesic *g, u32 f, u32 i, u32 j)
{
    const u32 n = g->frequency, a = g->faces[f][0], b = g->faces[f][1], c = g->faces[f][2];
    if (i == 0 && j == 0)
        return g->base + a;
    if (i == n)
        return g->base + b;
    if (j == n)
        return g->base + c;
    if (j == 0)
        return edge_vertex(g, a, b, i);
    if (i == 0)
        return edge_vertex(g, a, c, j);
    if (i + j == n)
        return edge_vertex(g, b, c, j);
    const u32 within = (n - 1) * (n - 2) / 2;
    // Rows of j = 1, 2, ... have n - 1 - j vertices each.
    const u32 rows_before = (j - 1) * (n - 1) - j * (j - 1) / 2;
    return g->base + 12 + 30 * (n - 1) + f * within + rows_before + i - 1;
}

static Vec3 blob_point(Vec3 direction, Vec3 center, f64 radius, f64 depth, u32 seed)
{
    f64 sum = 0, size = 0.6, scale = 1.7;
    for (u32 layer = 0; layer < 5; layer++, size *= 0.45, scale *= 2.1)
        sum += size * noise_at(vec_scale(direction, scale), seed + layer);
    return vec_add(center, vec_scale(direction, radius * (1 + depth * sum)));
}

void grower_blob(Grower *grower, Vec3 center, f64 radius, f64 depth, u32 triangles, u32 seed)
{
    const f64 wanted = floor(sqrt(triangles / 20.0) + 0.5);
    const u32 n = wanted < 1 ? 1 : (u32)wanted;
    const size_t vertices = 10 * (size_t)n * n + 2;
    const Geodesic g = geodesic_make((u32)grower->position_count, n);
    if (!room_for(grower, vertices, 20 * (size_t)n * n))
        return;
    grower->position_count += vertices;
    for (u32 f = 0; f < 20; f++) {
        const Vec3 a = icosahedron_corner(g.faces[f][0]), b = icosahedron_corner(g.faces[f][1]);
        const Vec3 c = icosahedron_corner(g.faces[f][2]);
        for (u32 j = 0; j <= n; j++) {
            for (u32 i = 0; i + j <= n; i++) {
                const Vec3 ab = vec_add(vec_scale(a, (f64)(n - i - j)), vec_scale(b, i));
                const Vec3 at = vec_normalize(vec_add(ab, vec_scale(c, j)));
                grower->positions[face_vertex(&g, f, i, j)] = blob_point(at, center, radius, depth, seed);
                if (i + j == n)
                    continue;
                const u32 here = face_vertex(&g, f, i, j), right = face_vertex(&g, f, i + 1, j);
                const u32 up = face_vertex(&g, f, i, j + 1);
                grower_face(grower, here, right, up);
                if (i + j + 1 < n)
                    grower_face(grower, right, face_vertex(&g, f, i + 1, j + 1), up);
            }
        }
    }
}

static bool has_area(const Vec3 *positions, const u32 face[3])
{
    const Vec3 a = positions[face[0]];
    const Vec3 n = vec_cross(vec_sub(positions[face[1]], a), vec_sub(positions[face[2]], a));
    return n.x != 0 || n.y != 0 || n.z != 0;
}

// volatile: GCC 12 with -O2 leaves the rounding out where it works on two numbers at once.
static f64 through_float(f64 x)
{
    volatile f32 nearest = (f32)x;
    return nearest;
}

Vec3 rounded_to_float(Vec3 p)
{
    return (Vec3){through_float(p.x), through_float(p.y), through_float(p.z)};
}

bool grower_finish(Grower *grower, Vec3 origin, Mesh *mesh)
{
    size_t kept = 0;
    for (size_t i = 0; i < grower->position_count; i++)
        grower->positions[i] = rounded_to_float(vec_sub(grower->positions[i], origin));
    for (size_t i = 0; i < grower->face_count; i++)
        if (has_area(grower->positions, grower->faces[i]))
            memmove(grower->faces[kept++], grower->faces[i], sizeof *grower->faces);
    *mesh = (Mesh){.positions = grower->positions,
                   .position_count = (u32)grower->position_count,
                   .faces = grower->faces,
                   .face_count = (u32)kept,
                   .parts = malloc(sizeof *mesh->parts),
                   .part_count = 1};
    const bool ok = mesh->parts && !grower->failed && kept > 0 && kept <= 1u << 30;
    *grower = (Grower){.positions = NULL};
    if (ok)
        mesh->parts[0] = (MeshPart){.first = 0, .material = -1};
    else
        mesh_destroy(mesh);
    return ok;
}
