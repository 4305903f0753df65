// The OBJ reader under a fuzzer: any bytes give a mesh or messages, and the same ones however the file is
// divided. Built with -fsanitize=fuzzer it is a libFuzzer target; without (no CLRT_FUZZ) it is a program that
// runs the files it is given.
#include "fuzz_file.h"

#include <string.h>

#include "assets/obj_internal.h"

typedef struct Result {
    ObjFile obj;
    Diagnostics *diagnostics;
    char *messages;
} Result;

static void check_indices(u32 (*indices)[3], u32 face_count, u32 count, bool optional)
{
    for (u32 i = 0; indices && i < face_count; ++i) {
        for (int k = 0; k < 3; ++k) {
            if (indices[i][k] >= count && !(optional && indices[i][k] == MESH_NO_INDEX))
                abort();
        }
    }
}

// What whoever holds the mesh relies on.
static void check_mesh(const ObjFile *obj)
{
    const Mesh *mesh = &obj->mesh;
    check_indices(mesh->faces, mesh->face_count, mesh->position_count, false);
    check_indices(mesh->face_normals, mesh->face_count, mesh->normal_count, true);
    check_indices(mesh->face_uvs, mesh->face_count, mesh->uv_count, true);
    if (mesh->part_count == 0 || mesh->parts[0].first != 0)
        abort();
    for (u32 i = 0; i < mesh->part_count; ++i) {
        if (mesh->parts[i].material < -1 || mesh->parts[i].material >= (i32)obj->material_count ||
            (i > 0 && mesh->parts[i].first <= mesh->parts[i - 1].first))
            abort();
    }
    for (u32 i = 0; i < mesh->normal_count; ++i) {
        const f32 *n = mesh->normals[i];
        const f32 square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
        if (!(square > 0.9999f && square < 1.0001f))
            abort();
    }
}

static Result read_in_pieces(const FuzzFile *file, size_t piece_bytes)
{
    Result result = { .diagnostics = diagnostics_create() };
    Error error;
    if (!result.diagnostics ||
        !obj_read_in_pieces(file->path, piece_bytes, result.diagnostics, &result.obj, &error))
        abort();
    if (diagnostics_error_count(result.diagnostics) == 0)
        check_mesh(&result.obj);
    result.messages = fuzz_print(result.diagnostics);
    return result;
}

static void result_end(Result *result)
{
    free(result->messages);
    obj_destroy(&result->obj);
    diagnostics_destroy(result->diagnostics);
}

static void check_same_bytes(const void *a, const void *b, size_t count, size_t size)
{
    if ((a == NULL) != (b == NULL) || (a && memcmp(a, b, count * size) != 0))
        abort();
}

static void check_same_names(char **a, char **b, const u32 *a_lines, const u32 *b_lines, u32 count)
{
    for (u32 i = 0; i < count; ++i) {
        if (strcmp(a[i], b[i]) != 0 || a_lines[i] != b_lines[i])
            abort();
    }
}

static void check_same(const Result *a, const Result *b)
{
    const u32 errors = diagnostics_error_count(a->diagnostics);
    if ((errors > 0) != (diagnostics_error_count(b->diagnostics) > 0))
        abort();
    // Where not all is shown, how much is looked at depends on the division.
    if (errors + diagnostics_warning_count(a->diagnostics) < DIAGNOSTICS_SHOWN_MAX &&
        strcmp(a->messages, b->messages) != 0)
        abort();
    const Mesh *m = &a->obj.mesh, *n = &b->obj.mesh;
    if (m->position_count != n->position_count || m->normal_count != n->normal_count ||
        m->uv_count != n->uv_count || m->face_count != n->face_count || m->part_count != n->part_count ||
        a->obj.material_count != b->obj.material_count || a->obj.library_count != b->obj.library_count)
        abort();
    check_same_bytes(m->positions, n->positions, m->position_count, sizeof *m->positions);
    check_same_bytes(m->normals, n->normals, m->normal_count, sizeof *m->normals);
    check_same_bytes(m->uvs, n->uvs, m->uv_count, sizeof *m->uvs);
    check_same_bytes(m->faces, n->faces, m->face_count, sizeof *m->faces);
    check_same_bytes(m->face_normals, n->face_normals, m->face_count, sizeof *m->faces);
    check_same_bytes(m->face_uvs, n->face_uvs, m->face_count, sizeof *m->faces);
    check_same_bytes(m->parts, n->parts, m->part_count, sizeof *m->parts);
    check_same_names(a->obj.material_names, b->obj.material_names, a->obj.material_lines,
                     b->obj.material_lines, a->obj.material_count);
    check_same_names(a->obj.libraries, b->obj.libraries, a->obj.library_lines, b->obj.library_lines,
                     a->obj.library_count);
}

int LLVMFuzzerTestOneInput(const u8 *data, size_t size)
{
    FuzzFile file = fuzz_file_begin(data, size);
    Result whole = read_in_pieces(&file, size + 1), divided = read_in_pieces(&file, 1 + size % 61);
    check_same(&whole, &divided);
    result_end(&whole);
    result_end(&divided);
    fuzz_file_end(&file);
    return 0;
}

#include "fuzz_main.h"
