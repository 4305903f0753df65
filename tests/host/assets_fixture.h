// What the tests of the assets share: a folder of files for the test, and looks at meshes.
#ifndef CLRT_TESTS_ASSETS_FIXTURE_H
#define CLRT_TESTS_ASSETS_FIXTURE_H

#include <dirent.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "base/types.h"
#include "scene/mesh.h"

enum { FIXTURE_PATH_MAX = 200 };

// A new folder, in which the test then stands.
static inline void enter_folder(char folder[FIXTURE_PATH_MAX])
{
    const char *base = getenv("TMPDIR");
    snprintf(folder, FIXTURE_PATH_MAX, "%s/clrt-assets-XXXXXX", base ? base : "/tmp");
    assert_non_null(mkdtemp(folder));
    assert_int_equal(chdir(folder), 0);
}

// Removes the folder and the files in it.
static inline void leave_folder(const char *folder)
{
    DIR *directory = opendir(folder);
    for (const struct dirent *entry; directory && (entry = readdir(directory));)
        unlink(entry->d_name);
    if (directory)
        closedir(directory);
    rmdir(folder);
}

static inline void write_bytes(const char *name, const void *bytes, size_t length)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, length, file), length);
    assert_int_equal(fclose(file), 0);
}

static inline void write_text(const char *name, const char *text)
{
    write_bytes(name, text, strlen(text));
}

static inline void assert_face(u32 (*faces)[3], u32 face, u32 a, u32 b, u32 c)
{
    assert_non_null(faces);
    if (faces[face][0] != a || faces[face][1] != b || faces[face][2] != c)
        fail_msg("face %u is %u %u %u, not %u %u %u", face, faces[face][0], faces[face][1], faces[face][2], a,
                 b, c);
}

static inline void assert_position(const Mesh *mesh, u32 i, f64 x, f64 y, f64 z, f64 tolerance)
{
    assert_true(i < mesh->position_count);
    const Vec3 *p = &mesh->positions[i];
    if (!(p->x >= x - tolerance && p->x <= x + tolerance && p->y >= y - tolerance && p->y <= y + tolerance &&
          p->z >= z - tolerance && p->z <= z + tolerance))
        fail_msg("position %u is %g %g %g, not %g %g %g", i, p->x, p->y, p->z, x, y, z);
}

static inline void assert_normal(const Mesh *mesh, u32 i, f64 x, f64 y, f64 z)
{
    assert_true(i < mesh->normal_count);
    const f32 *n = mesh->normals[i];
    const f64 dx = (f64)n[0] - x, dy = (f64)n[1] - y, dz = (f64)n[2] - z;
    if (!(dx * dx + dy * dy + dz * dz < 1e-12))
        fail_msg("normal %u is %g %g %g, not %g %g %g", i, (f64)n[0], (f64)n[1], (f64)n[2], x, y, z);
}

// What whoever holds a mesh relies on.
static inline void assert_sound(const Mesh *mesh)
{
    assert_true(mesh->face_count >= 1 && mesh->part_count >= 1);
    assert_int_equal(mesh->parts[0].first, 0);
    for (u32 i = 0; i < mesh->part_count; ++i)
        assert_true(mesh->parts[i].first < mesh->face_count &&
                    (i == 0 || mesh->parts[i - 1].first < mesh->parts[i].first));
    for (u32 i = 0; i < mesh->face_count; ++i) {
        const bool has_normals = mesh->face_normals && mesh->face_normals[i][0] != MESH_NO_INDEX;
        const bool has_uvs = mesh->face_uvs && mesh->face_uvs[i][0] != MESH_NO_INDEX;
        for (u32 k = 0; k < 3; ++k) {
            assert_true(mesh->faces[i][k] < mesh->position_count);
            if (mesh->face_normals)
                assert_true(has_normals ? mesh->face_normals[i][k] < mesh->normal_count
                                        : mesh->face_normals[i][k] == MESH_NO_INDEX);
            if (mesh->face_uvs)
                assert_true(has_uvs ? mesh->face_uvs[i][k] < mesh->uv_count
                                    : mesh->face_uvs[i][k] == MESH_NO_INDEX);
            if (has_normals) {
                const f32 *n = mesh->normals[mesh->face_normals[i][k]];
                const f32 square = n[0] * n[0] + n[1] * n[1] + n[2] * n[2];
                assert_true(square > 0.99999f && square < 1.00001f);
            }
        }
    }
}

#endif
