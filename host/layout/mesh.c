#include "layout/mesh.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "accel/quad.h"
#include "base/memory.h"
#include "layout/bake.h"

static const u32 FACES_MAX = 1u << 30;

// In units of 2^-24 of the largest coordinate: the 8 that are promised, one that rounding the sum may take
// back, and half a one for the rounding of the product.
static const f32 PAD = 9.5f / 16777216;

bool mesh_list_add(MeshList *list, const PlacedMesh *mesh, Error *error)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    if (data->face_count > FACES_MAX - list->face_count)
        return error_set(error, ERROR_MEMORY, "more than %u triangles in one hierarchy", FACES_MAX);
    if (list->count == list->capacity) {
        const u32 capacity = list->capacity ? 2 * list->capacity : 1;
        PlacedMesh *meshes = realloc(list->meshes, capacity * sizeof *meshes);
        if (!meshes)
            return error_set(error, ERROR_MEMORY, "no memory for %u meshes", capacity);
        list->meshes = meshes;
        list->capacity = capacity;
    }
    PlacedMesh *added = &list->meshes[list->count++];
    *added = *mesh;
    added->first_face = list->face_count;
    added->first_vertex = list->vertex_count;
    list->face_count += data->face_count;
    list->vertex_count += data->position_count;
    return true;
}

bool mesh_list_reserve_vertices(MeshList *list, Error *error)
{
    list->vertices = page_alloc((list->vertex_count + 1) * sizeof *list->vertices);
    return list->vertices ||
           error_set(error, ERROR_MEMORY, "no memory for the %llu vertices of meshes",
                     (unsigned long long)list->vertex_count);
}

// Written out, because a call for each vertex would take longer than the work.
static void carry_vertices(const Vec3 *from, u32 count, const Affine *map, f32 (*to)[3])
{
    const Vec3 x = map->row[0], y = map->row[1], z = map->row[2], t = map->translation;
#pragma omp parallel for if (count >= MESH_PARALLEL)
    for (u32 i = 0; i < count; i++) {
        const Vec3 p = from[i];
        to[i][0] = (f32)(x.x * p.x + x.y * p.y + x.z * p.z + t.x);
        to[i][1] = (f32)(y.x * p.x + y.y * p.y + y.z * p.z + t.y);
        to[i][2] = (f32)(z.x * p.x + z.y * p.y + z.z * p.z + t.z);
    }
}

// What is found while the boxes of some faces are made; the fourth lanes mean nothing.
typedef struct Extent {
    Quad low, high; // of the boxes
    Quad finite;    // 0, or no number where a coordinate is not finite
} Extent;

static Extent extent_of(const Box *bounds)
{
    const Box b = *bounds;
    const f32 low[4] = { b.min[0], b.min[1], b.min[2] }, high[4] = { b.max[0], b.max[1], b.max[2] };
    return (Extent){ quad_load(low), quad_load(high), quad_all(0) };
}

static void extent_widen(Extent *extent, const Extent *other)
{
    extent->low = quad_min(extent->low, other->low);
    extent->high = quad_max(extent->high, other->high);
    extent->finite = quad_add(extent->finite, other->finite);
}

// Reads one number behind each vertex.
static inline void face_box(const f32 *vertex_a, const f32 *vertex_b, const f32 *vertex_c, Box *box,
                            Extent *extent)
{
    const Quad a = quad_load(vertex_a), b = quad_load(vertex_b), c = quad_load(vertex_c);
    const Quad low = quad_min(a, quad_min(b, c)), high = quad_max(a, quad_max(b, c));
    const Quad own = quad_max(quad_sub(quad_all(0), low), high), turned = quad_yzx(own);
    const Quad largest = quad_max(own, quad_max(turned, quad_yzx(turned)));
    // FLT_MIN is more than enough where the product would be subnormal.
    const Quad pad = quad_add(quad_mul(largest, quad_all(PAD)), quad_all(FLT_MIN));
    const Quad min = quad_max(quad_sub(low, pad), quad_all(-FLT_MAX));
    const Quad max = quad_min(quad_add(high, pad), quad_all(FLT_MAX));
    f32 six[8];
    quad_store(six, min);
    quad_store(six + 3, max);
    memcpy(box, six, sizeof *box);
    const Quad nothing = quad_add(quad_add(quad_sub(a, a), quad_sub(b, b)), quad_sub(c, c));
    extent_widen(extent, &(Extent){ min, max, nothing });
}

bool mesh_carry(PlacedMesh *mesh, MeshList *list, Box *boxes, Box *bounds, Error *error)
{
    const Mesh *data = mesh->shape->as.mesh.mesh;
    f32(*const vertices)[3] = list->vertices + mesh->first_vertex;
    u32(*const faces)[3] = data->faces;
    const u32 count = data->face_count;
    Extent all = extent_of(bounds);
    carry_vertices(data->positions, data->position_count, &mesh->to_space, vertices);
    mesh->vertices = (const f32(*)[3])vertices;
#pragma omp parallel if (count >= MESH_PARALLEL)
    {
        Extent some = extent_of(bounds);
#pragma omp for nowait
        for (u32 f = 0; f < count; f++)
            face_box(vertices[faces[f][0]], vertices[faces[f][1]], vertices[faces[f][2]], &boxes[f], &some);
#pragma omp critical(mesh_extent)
        extent_widen(&all, &some);
    }
    f32 low[4], high[4], finite[4];
    quad_store(low, all.low);
    quad_store(high, all.high);
    quad_store(finite, all.finite);
    memcpy(bounds->min, low, sizeof bounds->min);
    memcpy(bounds->max, high, sizeof bounds->max);
    return (finite[0] == 0 && finite[1] == 0 && finite[2] == 0) ||
           error_set(error, ERROR_SCENE, BAKE_OUT_OF_RANGE);
}

void mesh_list_drop_vertices(MeshList *list)
{
    page_free(list->vertices, (list->vertex_count + 1) * sizeof *list->vertices);
    list->vertices = NULL;
}

void mesh_list_destroy(MeshList *list)
{
    mesh_list_drop_vertices(list);
    free(list->meshes);
    memset(list, 0, sizeof *list);
}
