#define _DEFAULT_SOURCE // madvise
#include "assets/obj_join.h"

#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

ObjCounts obj_sum(ObjPiece *pieces, size_t count)
{
    ObjCounts sum = { 0 };
    u64 lines = 0;
    for (size_t i = 0; i < count; ++i) {
        const ObjChunk *chunk = &pieces[i].chunk;
        pieces[i].before = sum;
        pieces[i].lines_before = lines;
        sum.positions += chunk->position_count;
        sum.normals += chunk->normal_count;
        sum.uvs += chunk->uv_count;
        sum.faces += chunk->face_count;
        lines += pieces[i].lines;
    }
    return sum;
}

// count elements that are about to be written; NULL where there are none or no memory.
static void *allocate(u64 count, size_t size)
{
    enum { HUGE_PAGE = 2 << 20 };
    const size_t bytes = (size_t)count * size; // at most 2^30 elements
    if (bytes < 2 * HUGE_PAGE)
        return bytes > 0 ? malloc(bytes) : NULL;
    void *memory = aligned_alloc(HUGE_PAGE, (bytes + HUGE_PAGE - 1) / HUGE_PAGE * HUGE_PAGE);
#ifdef MADV_HUGEPAGE
    if (memory)
        (void)madvise(memory, bytes, MADV_HUGEPAGE); // a page at a time costs as much as the copying
#endif
    return memory;
}

static bool allocate_mesh(const ObjPiece *pieces, size_t count, const ObjCounts *total, Mesh *mesh)
{
    bool normals = false, uvs = false;
    for (size_t i = 0; i < count; ++i) {
        normals |= pieces[i].chunk.face_normals != NULL;
        uvs |= pieces[i].chunk.face_uvs != NULL;
    }
    mesh->position_count = (u32)total->positions;
    mesh->face_count = (u32)total->faces;
    mesh->positions = allocate(total->positions, sizeof *mesh->positions);
    mesh->faces = allocate(total->faces, sizeof *mesh->faces);
    bool done = (mesh->positions || total->positions == 0) && (mesh->faces || total->faces == 0);
    // Where all faces refer to nothing, there is nothing: the index is wrong then, and the piece faulty.
    if (normals) {
        mesh->normal_count = (u32)total->normals;
        mesh->normals = allocate(total->normals + 1, sizeof *mesh->normals);
        mesh->face_normals = allocate(total->faces + 1, sizeof *mesh->face_normals);
        done &= mesh->normals && mesh->face_normals;
    }
    if (uvs) {
        mesh->uv_count = (u32)total->uvs;
        mesh->uvs = allocate(total->uvs + 1, sizeof *mesh->uvs);
        mesh->face_uvs = allocate(total->faces + 1, sizeof *mesh->face_uvs);
        done &= mesh->uvs && mesh->face_uvs;
    }
    return done;
}

// Copies count elements of size to those of the array from `at` on; all may be NULL where there are none.
static void copy(void *array, u64 at, const void *from, size_t count, size_t size)
{
    if (count > 0)
        memcpy((unsigned char *)array + at * size, from, count * size);
}

static void copy_elements(const ObjPiece *piece, Mesh *mesh)
{
    const ObjChunk *chunk = &piece->chunk;
    const ObjCounts *before = &piece->before;
    copy(mesh->positions, before->positions, chunk->positions, chunk->position_count,
         sizeof *mesh->positions);
    if (mesh->normals)
        copy(mesh->normals, before->normals, chunk->normals, chunk->normal_count, sizeof *mesh->normals);
    if (mesh->uvs)
        copy(mesh->uvs, before->uvs, chunk->uvs, chunk->uv_count, sizeof *mesh->uvs);
}

// Index of a code that is not 0, 2^30 or more where it lies before the first element.
static u32 decode(i32 code, u32 before)
{
    return code > 0 ? (u32)code - 1 : (u32)code + OBJ_COUNT_MAX + before;
}

// Decodes count indices that are not 0. Returns whether all refer to something.
static bool resolve_all(const i32 *codes, u32 *indices, size_t count, u64 before, u64 total)
{
    const u32 first = (u32)before, end = (u32)total;
    u32 wrong = 0;
#pragma omp simd reduction(| : wrong)
    for (size_t i = 0; i < count; ++i) {
        const u32 index = decode(codes[i], first);
        wrong |= index >= end;
        indices[i] = index;
    }
    return wrong == 0;
}

// Decodes indices that only some faces have; codes may be NULL.
static bool resolve_some(const i32 (*codes)[3], u32 (*indices)[3], size_t count, u64 before, u64 total)
{
    const u32 first = (u32)before, end = (u32)total;
    u32 wrong = 0;
    for (size_t i = 0; i < count; ++i) {
        u32 complete = codes != NULL;
        for (int k = 0; k < 3 && complete; ++k)
            complete = codes[i][k] != 0;
        for (int k = 0; k < 3; ++k) {
            const i32 code = codes ? codes[i][k] : 0;
            const u32 index = decode(code, first);
            wrong |= code != 0 && index >= end;
            indices[i][k] = complete ? index : MESH_NO_INDEX;
        }
    }
    return wrong == 0;
}

static bool is_zero(const f32 v[3])
{
    return v[0] == 0 && v[1] == 0 && v[2] == 0;
}

// Takes the normals from faces that have one of length 0. All indices are right.
static void drop_zero_normals(const Mesh *mesh, u32 (*indices)[3], size_t count)
{
    for (size_t i = 0; i < count; ++i) {
        bool zero = false;
        for (int k = 0; k < 3 && indices[i][k] != MESH_NO_INDEX; ++k)
            zero |= is_zero(mesh->normals[indices[i][k]]);
        for (int k = 0; k < 3 && zero; ++k)
            indices[i][k] = MESH_NO_INDEX;
    }
}

static void join_faces(ObjPiece *piece, const ObjCounts *total, bool zero_normals, Mesh *mesh)
{
    const ObjChunk *chunk = &piece->chunk;
    const ObjCounts *before = &piece->before;
    const size_t count = chunk->face_count;
    if (count == 0)
        return;
    bool right = resolve_all(chunk->faces[0], mesh->faces[before->faces], 3 * count, before->positions,
                             total->positions);
    if (mesh->face_uvs)
        right &= resolve_some((const i32(*)[3])chunk->face_uvs, mesh->face_uvs + before->faces, count,
                              before->uvs, total->uvs);
    if (mesh->face_normals) {
        u32(*indices)[3] = mesh->face_normals + before->faces;
        right &= resolve_some((const i32(*)[3])chunk->face_normals, indices, count, before->normals,
                              total->normals);
        if (right && zero_normals)
            drop_zero_normals(mesh, indices, count);
    }
    piece->faulty |= !right;
}

// No face has these any more, but whoever reads the array may expect unit vectors.
static void replace_zero_normals(Mesh *mesh)
{
    for (u32 i = 0; i < mesh->normal_count; ++i) {
        if (is_zero(mesh->normals[i]))
            mesh->normals[i][2] = 1;
    }
}

static void drop_chunk(ObjChunk *chunk)
{
    free(chunk->positions);
    *chunk = (ObjChunk){ 0 };
}

bool obj_join(ObjPiece *pieces, size_t count, const ObjCounts *total, const char *path, ObjFile *obj,
              Error *error)
{
    Mesh *mesh = &obj->mesh;
    if (!allocate_mesh(pieces, count, total, mesh))
        return error_set(error, ERROR_MEMORY, "out of memory");
    if (!obj_join_names(pieces, count, (u32)total->faces, path, obj, error))
        return false;
    bool zero_normals = false;
    for (size_t i = 0; i < count; ++i)
        zero_normals |= pieces[i].chunk.zero_normals;
#pragma omp parallel if (count > 1)
    {
#pragma omp for schedule(dynamic)
        for (size_t i = 0; i < count; ++i)
            copy_elements(&pieces[i], mesh);
#pragma omp for schedule(dynamic)
        for (size_t i = 0; i < count; ++i) {
            join_faces(&pieces[i], total, zero_normals, mesh);
            drop_chunk(&pieces[i].chunk);
        }
    }
    if (zero_normals && mesh->normals)
        replace_zero_normals(mesh);
    return true;
}
