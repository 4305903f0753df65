#include "assets/finish.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#ifdef _OPENMP
#include <omp.h>
#endif

// ---- faces without area ---------------------------------------------------------------------

// Normal of the face times twice its area. Written out, because it is asked once a face.
static Vec3 face_cross(const Mesh *mesh, const u32 face[3])
{
    const Vec3 *a = &mesh->positions[face[0]], *b = &mesh->positions[face[1]], *c = &mesh->positions[face[2]];
    const Vec3 u = {b->x - a->x, b->y - a->y, b->z - a->z}, v = {c->x - a->x, c->y - a->y, c->z - a->z};
    return (Vec3){u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
}

static bool has_area(const Mesh *mesh, const u32 face[3])
{
    if (face[0] == face[1] || face[1] == face[2] || face[2] == face[0])
        return false;
    const Vec3 cross = face_cross(mesh, face);
    return !(cross.x == 0 && cross.y == 0 && cross.z == 0);
}

static u32 count_without_area(const Mesh *mesh)
{
    const u32 count = mesh->face_count;
    u32 empty = 0;
#pragma omp parallel for schedule(static) reduction(+ : empty)
    for (u32 i = 0; i < count; ++i)
        empty += !has_area(mesh, mesh->faces[i]);
    return empty;
}

static void move_face(u32 (*faces)[3], u32 to, u32 from)
{
    if (faces)
        memmove(faces[to], faces[from], sizeof faces[to]);
}

static void drop_without_area(Mesh *mesh)
{
    u32 kept = 0, parts = 0;
    for (u32 p = 0; p < mesh->part_count; ++p) {
        const i32 material = mesh->parts[p].material;
        const u32 first = kept;
        const u32 end = p + 1 < mesh->part_count ? mesh->parts[p + 1].first : mesh->face_count;
        for (u32 i = mesh->parts[p].first; i < end; ++i) {
            if (!has_area(mesh, mesh->faces[i]))
                continue;
            move_face(mesh->faces, kept, i);
            move_face(mesh->face_normals, kept, i);
            move_face(mesh->face_uvs, kept, i);
            ++kept;
        }
        if (kept > first && (parts == 0 || mesh->parts[parts - 1].material != material))
            mesh->parts[parts++] = (MeshPart){.first = first, .material = material};
    }
    mesh->face_count = kept;
    mesh->part_count = parts;
}

static u32 count_indexed(u32 (*faces)[3], u32 count)
{
    u32 indexed = 0;
    if (!faces)
        return 0;
#pragma omp parallel for schedule(static) reduction(+ : indexed)
    for (u32 i = 0; i < count; ++i)
        indexed += faces[i][0] != MESH_NO_INDEX;
    return indexed;
}

static void drop_unused(Mesh *mesh)
{
    if (count_indexed(mesh->face_normals, mesh->face_count) == 0) {
        free(mesh->normals);
        free(mesh->face_normals);
        mesh->normals = NULL;
        mesh->face_normals = NULL;
        mesh->normal_count = 0;
    }
    if (count_indexed(mesh->face_uvs, mesh->face_count) == 0) {
        free(mesh->uvs);
        free(mesh->face_uvs);
        mesh->uvs = NULL;
        mesh->face_uvs = NULL;
        mesh->uv_count = 0;
    }
}

bool mesh_finish(Mesh *mesh, Error *error)
{
    if (mesh->face_count == 0)
        return error_set(error, ERROR_SCENE, "it has no faces");
    const u32 empty = count_without_area(mesh);
    if (empty == mesh->face_count)
        return error_set(error, ERROR_SCENE, "none of its faces has an area");
    if (empty > 0)
        drop_without_area(mesh);
    drop_unused(mesh);
    return true;
}

// ---- normals --------------------------------------------------------------------------------

bool mesh_lacks_normals(const Mesh *mesh)
{
    return count_indexed(mesh->face_normals, mesh->face_count) < mesh->face_count;
}

// About one position.
typedef struct Around {
    Vec3 sum;   // of the faces' cross products
    f64 weight; // of their magnitudes
} Around;

static void add_face(Around *around, const Vec3 *cross, f64 weight)
{
    around->sum.x += cross->x;
    around->sum.y += cross->y;
    around->sum.z += cross->z;
    around->weight += weight;
}

// Adds up the faces about the positions from first to end, each in the order of the faces.
static void add_faces(const Mesh *mesh, u32 first, u32 end, Around *around)
{
    const u32 size = end - first;
    for (u32 i = 0; i < mesh->face_count; ++i) {
        const u32 *face = mesh->faces[i];
        const bool a = face[0] - first < size, b = face[1] - first < size, c = face[2] - first < size;
        if (!(a | b | c))
            continue;
        const Vec3 cross = face_cross(mesh, face);
        const f64 weight = fabs(cross.x) + fabs(cross.y) + fabs(cross.z);
        if (a)
            add_face(&around[face[0]], &cross, weight);
        if (b)
            add_face(&around[face[1]], &cross, weight);
        if (c)
            add_face(&around[face[2]], &cross, weight);
    }
}

// Each thread has positions of its own, so that every sum has one writer and one order.
static void add_all_faces(const Mesh *mesh, Around *around)
{
#ifdef _OPENMP
    const u32 threads = (u32)omp_get_max_threads();
#else
    const u32 threads = 1;
#endif
#pragma omp parallel for schedule(static, 1)
    for (u32 t = 0; t < threads; ++t) {
        const u64 count = mesh->position_count;
        add_faces(mesh, (u32)(count * t / threads), (u32)(count * (t + 1) / threads), around);
    }
}

// What rounding leaves of normals that cancel out is no direction.
static bool cancels(const Around *around)
{
    const Vec3 *s = &around->sum;
    return !(fabs(s->x) + fabs(s->y) + fabs(s->z) > 1e-9 * around->weight);
}

static void unit_normal(const Around *around, f32 normal[3])
{
    const bool lost = cancels(around);
    const Vec3 n = lost ? (Vec3){0, 0, 1} : vec_normalize(around->sum);
    normal[0] = (f32)n.x;
    normal[1] = (f32)n.y;
    normal[2] = (f32)n.z;
}

// Gives the flat faces the normals that begin at base, one a position.
static void index_normals(Mesh *mesh, u32 base, const Around *around)
{
    const u32 count = mesh->face_count;
#pragma omp parallel for schedule(static)
    for (u32 i = 0; i < count; ++i) {
        const u32 *face = mesh->faces[i];
        u32 *normals = mesh->face_normals[i];
        if (normals[0] != MESH_NO_INDEX || cancels(&around[face[0]]) || cancels(&around[face[1]]) ||
            cancels(&around[face[2]]))
            continue;
        for (u32 k = 0; k < 3; ++k)
            normals[k] = base + face[k];
    }
}

// Room for one normal a position, and indices for each face.
static bool grow_normals(Mesh *mesh, Error *error)
{
    const u64 total = (u64)mesh->normal_count + mesh->position_count;
    if (total >= MESH_NO_INDEX)
        return error_set(error, ERROR_SCENE, "it has too many normals");
    f32(*normals)[3] = realloc(mesh->normals, (size_t)total * sizeof *normals);
    if (!normals)
        return error_set(error, ERROR_MEMORY, "no memory for the normals");
    mesh->normals = normals;
    if (mesh->face_normals)
        return true;
    const size_t bytes = (size_t)mesh->face_count * sizeof *mesh->face_normals;
    mesh->face_normals = malloc(bytes);
    if (!mesh->face_normals)
        return error_set(error, ERROR_MEMORY, "no memory for the normals");
    memset(mesh->face_normals, 0xff, bytes); // MESH_NO_INDEX
    return true;
}

bool mesh_make_normals(Mesh *mesh, Error *error)
{
    if (!mesh_lacks_normals(mesh))
        return true;
    Around *around = calloc(mesh->position_count, sizeof *around);
    if (!around || !grow_normals(mesh, error)) {
        free(around);
        return around ? false : error_set(error, ERROR_MEMORY, "no memory for the normals");
    }
    add_all_faces(mesh, around);
    const u32 base = mesh->normal_count, count = mesh->position_count;
    f32(*made)[3] = mesh->normals + base;
#pragma omp parallel for schedule(static)
    for (u32 i = 0; i < count; ++i)
        unit_normal(&around[i], made[i]);
    mesh->normal_count = base + count;
    index_normals(mesh, base, around);
    free(around);
    drop_unused(mesh);
    return true;
}

// ---- copies ---------------------------------------------------------------------------------

// A copy of count elements, also of none; NULL stays NULL. *ok becomes false where there is no memory.
static void *copy_array(const void *array, size_t count, size_t size, bool *ok)
{
    if (!array)
        return NULL;
    void *copy = malloc(count ? count * size : 1); // it is as large as what is there
    if (copy)
        memcpy(copy, array, count * size);
    *ok &= copy != NULL;
    return copy;
}

bool mesh_copy(const Mesh *mesh, Mesh *copy, Error *error)
{
    bool ok = true;
    *copy = *mesh;
    copy->positions = copy_array(mesh->positions, mesh->position_count, sizeof *mesh->positions, &ok);
    copy->normals = copy_array(mesh->normals, mesh->normal_count, sizeof *mesh->normals, &ok);
    copy->uvs = copy_array(mesh->uvs, mesh->uv_count, sizeof *mesh->uvs, &ok);
    copy->faces = copy_array(mesh->faces, mesh->face_count, sizeof *mesh->faces, &ok);
    copy->face_normals = copy_array(mesh->face_normals, mesh->face_count, sizeof *mesh->face_normals, &ok);
    copy->face_uvs = copy_array(mesh->face_uvs, mesh->face_count, sizeof *mesh->face_uvs, &ok);
    copy->parts = copy_array(mesh->parts, mesh->part_count, sizeof *mesh->parts, &ok);
    if (!ok)
        mesh_destroy(copy);
    return ok || error_set(error, ERROR_MEMORY, "no memory for a mesh");
}
