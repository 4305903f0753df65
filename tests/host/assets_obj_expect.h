// What the tests of the OBJ reader share: text in, what the reader makes of it out, for many divisions of the
// file.
#ifndef CLRT_TESTS_ASSETS_OBJ_EXPECT_H
#define CLRT_TESTS_ASSETS_OBJ_EXPECT_H

#include "assets_obj_fixture.h"

#include "assets/obj.h"
#include "assets/obj_internal.h"

static inline void print_index(FILE *stream, u32 (*indices)[3], u32 face, int corner)
{
    if (!indices || indices[face][corner] == MESH_NO_INDEX)
        fputc('-', stream);
    else
        fprintf(stream, "%u", indices[face][corner]);
}

// All of obj, a line each thing: "v 1 2 3", "f 0/-/2 ..." with indices of position, uv and normal from 0,
// "part FIRST MATERIAL", "material NAME LINE", "library NAME LINE".
static inline char *describe(const ObjFile *obj)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_text(&text, &size);
    const Mesh *mesh = &obj->mesh;
    for (u32 i = 0; i < mesh->position_count; ++i) {
        const Vec3 p = mesh->positions[i];
        fprintf(stream, "v %.17g %.17g %.17g\n", p.x, p.y, p.z);
    }
    for (u32 i = 0; i < mesh->uv_count; ++i)
        fprintf(stream, "vt %.9g %.9g\n", (f64)mesh->uvs[i][0], (f64)mesh->uvs[i][1]);
    for (u32 i = 0; i < mesh->normal_count; ++i) {
        const f32 *n = mesh->normals[i];
        fprintf(stream, "vn %.9g %.9g %.9g\n", (f64)n[0], (f64)n[1], (f64)n[2]);
    }
    for (u32 i = 0; i < mesh->face_count; ++i) {
        fputs("f", stream);
        for (int k = 0; k < 3; ++k) {
            fprintf(stream, " %u/", mesh->faces[i][k]);
            print_index(stream, mesh->face_uvs, i, k);
            fputc('/', stream);
            print_index(stream, mesh->face_normals, i, k);
        }
        fputs("\n", stream);
    }
    for (u32 i = 0; i < mesh->part_count; ++i)
        fprintf(stream, "part %u %d\n", mesh->parts[i].first, mesh->parts[i].material);
    for (u32 i = 0; i < obj->material_count; ++i)
        fprintf(stream, "material %s %u\n", obj->material_names[i], obj->material_lines[i]);
    for (u32 i = 0; i < obj->library_count; ++i)
        fprintf(stream, "library %s %u\n", obj->libraries[i], obj->library_lines[i]);
    fclose(stream);
    return text;
}

// What the reader makes of the file, and then what it says.
static inline char *read_file(const char *path, size_t piece_bytes)
{
    Diagnostics *diagnostics = diagnostics_create();
    assert_non_null(diagnostics);
    ObjFile obj;
    Error error;
    if (!obj_read_in_pieces(path, piece_bytes, diagnostics, &obj, &error))
        fail_msg("%s: %s", path, error.text);
    char *messages = printed(diagnostics);
    char *description = diagnostics_error_count(diagnostics) > 0 ? strdup("") : describe(&obj);
    if (diagnostics_error_count(diagnostics) > 0) {
        assert_null(obj.mesh.positions);
        assert_int_equal(obj.mesh.face_count, 0);
    }
    obj_destroy(&obj);
    diagnostics_destroy(diagnostics);
    const size_t length = strlen(description) + strlen(messages) + 1;
    char *both = malloc(length);
    assert_non_null(both);
    snprintf(both, length, "%s%s", description, messages);
    free(messages);
    free(description);
    return both;
}

static inline void expect_bytes(const char *bytes, size_t length, const char *expected)
{
    write_bytes("t.obj", bytes, length);
    static const size_t pieces[] = { 1 << 20, 1, 2, 3, 5, 8, 16, 33, 64 };
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; ++i) {
        char *got = read_file("t.obj", pieces[i]);
        if (strcmp(got, expected) != 0)
            fail_msg("pieces of %zu bytes of\n%s\ngive\n%s\nexpected\n%s", pieces[i], bytes, got, expected);
        free(got);
    }
    unlink("t.obj");
}

static inline void expect(const char *text, const char *expected)
{
    expect_bytes(text, strlen(text), expected);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define TRIANGLE_READ "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

#endif
