// Faces without area go, the others keep their order; normals are means by area, the same for any number of
// threads.
#include "assets_fixture.h"

#include <math.h>

#include "assets/finish.h"

#ifdef _OPENMP
#include <omp.h>
#endif

static void *copy_of(const void *array, size_t bytes)
{
    void *copy = malloc(bytes);
    assert_non_null(copy);
    memcpy(copy, array, bytes);
    return copy;
}

// A mesh of one part without material.
static Mesh mesh_of(const Vec3 *positions, u32 position_count, u32 (*faces)[3], u32 face_count)
{
    static const MeshPart whole = {0, -1};
    return (Mesh){
        .positions = copy_of(positions, position_count * sizeof *positions),
        .position_count = position_count,
        .faces = copy_of(faces, face_count * sizeof *faces),
        .face_count = face_count,
        .parts = copy_of(&whole, sizeof whole),
        .part_count = 1,
    };
}

static const Vec3 SQUARE[] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 2, 0}, {0, 0, 0}};

static void test_areas(void **state)
{
    (void)state;
    // sound; a corner twice; on a line; sound; two corners in one place; sound
    u32 faces[][3] = {{0, 1, 2}, {1, 1, 2}, {0, 2, 4}, {0, 2, 3}, {0, 5, 1}, {1, 2, 3}};
    u32 normals[][3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {4, 4, 4}, {5, 5, 5}};
    const f32 up[6][3] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
    const f32 uvs[1][2] = {{0.5f, 0.5f}};
    u32 face_uvs[6][3];
    memset(face_uvs, 0xff, sizeof face_uvs);
    const MeshPart parts[] = {{0, 7}, {1, 8}, {3, 9}, {4, 9}, {5, 9}};
    Mesh mesh = mesh_of(SQUARE, 6, faces, 6);
    free(mesh.parts);
    mesh.parts = copy_of(parts, sizeof parts);
    mesh.part_count = 5;
    mesh.normals = copy_of(up, sizeof up);
    mesh.normal_count = 6;
    mesh.face_normals = copy_of(normals, sizeof normals);
    mesh.uvs = copy_of(uvs, sizeof uvs);
    mesh.uv_count = 1;
    mesh.face_uvs = copy_of(face_uvs, sizeof face_uvs);
    Error error;
    assert_true(mesh_finish(&mesh, &error));
    assert_sound(&mesh);
    assert_int_equal(mesh.face_count, 3);
    assert_face(mesh.faces, 0, 0, 1, 2);
    assert_face(mesh.faces, 1, 0, 2, 3);
    assert_face(mesh.faces, 2, 1, 2, 3);
    assert_face(mesh.face_normals, 1, 3, 3, 3);
    assert_face(mesh.face_normals, 2, 5, 5, 5);
    // No face uses the uv.
    assert_null(mesh.uvs);
    assert_null(mesh.face_uvs);
    assert_int_equal(mesh.uv_count, 0);
    assert_int_equal(mesh.part_count, 2);
    assert_int_equal(mesh.parts[0].material, 7);
    assert_int_equal(mesh.parts[1].first, 1);
    assert_int_equal(mesh.parts[1].material, 9);
    mesh_destroy(&mesh);
}

// An area that a float could not hold is one all the same.
static void test_small_area(void **state)
{
    (void)state;
    const Vec3 tiny[] = {{0, 0, 0}, {1e-40, 0, 0}, {0, 1e-40, 0}};
    u32 faces[][3] = {{0, 1, 2}};
    Mesh mesh = mesh_of(tiny, 3, faces, 1);
    Error error;
    assert_true(mesh_finish(&mesh, &error));
    assert_int_equal(mesh.face_count, 1);
    assert_true(mesh_make_normals(&mesh, &error));
    assert_normal(&mesh, 0, 0, 0, 1);
    mesh_destroy(&mesh);
}

static void test_nothing_left(void **state)
{
    (void)state;
    u32 faces[][3] = {{0, 2, 4}, {3, 3, 3}};
    Mesh mesh = mesh_of(SQUARE, 6, faces, 2);
    Error error;
    assert_false(mesh_finish(&mesh, &error));
    assert_int_equal(error.code, ERROR_SCENE);
    assert_string_equal(error.text, "none of its faces has an area");
    mesh.face_count = 0;
    assert_false(mesh_finish(&mesh, &error));
    assert_string_equal(error.text, "it has no faces");
    mesh_destroy(&mesh);
}

// Two faces about the edge from 0 to 1, of areas 1/2 and 3/2, at a right angle.
static void test_weights(void **state)
{
    (void)state;
    const Vec3 points[] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -3}, {9, 9, 9}};
    u32 faces[][3] = {{0, 1, 2}, {0, 1, 3}};
    Mesh mesh = mesh_of(points, 5, faces, 2);
    Error error;
    assert_true(mesh_finish(&mesh, &error));
    assert_true(mesh_lacks_normals(&mesh));
    assert_true(mesh_make_normals(&mesh, &error));
    assert_false(mesh_lacks_normals(&mesh));
    assert_sound(&mesh);
    const f64 length = sqrt(10);
    assert_normal(&mesh, mesh.face_normals[0][0], 0, 3 / length, 1 / length);
    assert_normal(&mesh, mesh.face_normals[1][1], 0, 3 / length, 1 / length);
    assert_normal(&mesh, mesh.face_normals[0][2], 0, 0, 1);
    assert_normal(&mesh, mesh.face_normals[1][2], 0, 1, 0);
    assert_int_equal(mesh.face_normals[0][0], mesh.face_normals[1][0]);
    mesh_destroy(&mesh);
}

// The file's normals stay; only faces without get some.
static void test_mixed(void **state)
{
    (void)state;
    u32 faces[][3] = {{0, 1, 2}, {0, 2, 3}};
    u32 indices[][3] = {{0, 0, 1}, {MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX}};
    const f32 normals[2][3] = {{1, 0, 0}, {0, 1, 0}};
    Mesh mesh = mesh_of(SQUARE, 6, faces, 2);
    mesh.normals = copy_of(normals, sizeof normals);
    mesh.normal_count = 2;
    mesh.face_normals = copy_of(indices, sizeof indices);
    Error error;
    assert_true(mesh_finish(&mesh, &error));
    assert_true(mesh_lacks_normals(&mesh));
    assert_true(mesh_make_normals(&mesh, &error));
    assert_sound(&mesh);
    assert_face(mesh.face_normals, 0, 0, 0, 1);
    assert_normal(&mesh, 0, 1, 0, 0);
    assert_normal(&mesh, 1, 0, 1, 0);
    for (u32 k = 0; k < 3; ++k)
        assert_normal(&mesh, mesh.face_normals[1][k], 0, 0, 1);
    mesh_destroy(&mesh);
}

// A sheet with two sides has no normals at its vertices, however its corners begin; the rest has.
static void test_cancelling(void **state)
{
    (void)state;
    const Vec3 points[] = {{0.1, 0.2, 0.3}, {1.7, 0.3, 0.1}, {0.4, 1.1, 0.7},
                           {5, 0, 0},       {6, 0, 0},       {5, 1, 0}};
    u32 faces[][3] = {{0, 1, 2}, {2, 1, 0}, {3, 4, 5}};
    Mesh mesh = mesh_of(points, 6, faces, 3);
    Error error;
    assert_true(mesh_make_normals(&mesh, &error));
    assert_sound(&mesh);
    assert_face(mesh.face_normals, 0, MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX);
    assert_face(mesh.face_normals, 1, MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX);
    assert_normal(&mesh, mesh.face_normals[2][0], 0, 0, 1);
    mesh.face_count = 2;
    free(mesh.normals);
    free(mesh.face_normals);
    mesh.normals = NULL;
    mesh.face_normals = NULL;
    mesh.normal_count = 0;
    assert_true(mesh_make_normals(&mesh, &error));
    assert_null(mesh.normals); // nothing is left of them
    mesh_destroy(&mesh);
}

// A bumpy sheet of side x side squares.
static Mesh sheet(u32 side)
{
    const u32 row = side + 1;
    Vec3 *positions = malloc((size_t)row * row * sizeof *positions);
    u32(*faces)[3] = malloc((size_t)2 * side * side * sizeof *faces);
    assert_true(positions && faces);
    for (u32 i = 0; i < row * row; ++i) {
        const f64 x = i % row, y = (f64)(i / row);
        positions[i] = (Vec3){x, y, sin(0.7 * x) * cos(0.3 * y)};
    }
    for (u32 i = 0; i < side * side; ++i) {
        const u32 a = i / side * row + i % side;
        const u32 two[2][3] = {{a, a + 1, a + row + 1}, {a, a + row + 1, a + row}};
        memcpy(faces[2 * i], two, sizeof two);
    }
    Mesh mesh = mesh_of(positions, row * row, faces, 2 * side * side);
    free(positions);
    free(faces);
    return mesh;
}

static void test_threads(void **state)
{
    (void)state;
    Mesh first = sheet(60);
    Error error;
    assert_true(mesh_finish(&first, &error) && mesh_make_normals(&first, &error));
    assert_sound(&first);
#ifdef _OPENMP
    const int before = omp_get_max_threads();
    for (int threads = 1; threads <= 7; threads += 3) {
        Mesh mesh = sheet(60);
        omp_set_num_threads(threads);
        assert_true(mesh_finish(&mesh, &error) && mesh_make_normals(&mesh, &error));
        assert_int_equal(mesh.normal_count, first.normal_count);
        assert_memory_equal(mesh.normals, first.normals, first.normal_count * sizeof *first.normals);
        assert_memory_equal(mesh.face_normals, first.face_normals,
                            first.face_count * sizeof *first.face_normals);
        mesh_destroy(&mesh);
    }
    omp_set_num_threads(before);
#endif
    mesh_destroy(&first);
}

static void test_copy(void **state)
{
    (void)state;
    Mesh mesh = sheet(3), copy;
    Error error;
    assert_true(mesh_copy(&mesh, &copy, &error));
    assert_true(mesh_make_normals(&copy, &error));
    assert_null(mesh.normals);
    assert_null(mesh.face_normals);
    assert_int_equal(copy.face_count, mesh.face_count);
    assert_memory_equal(copy.faces, mesh.faces, mesh.face_count * sizeof *mesh.faces);
    assert_memory_equal(copy.positions, mesh.positions, mesh.position_count * sizeof *mesh.positions);
    assert_true(copy.faces != mesh.faces && copy.parts != mesh.parts);
    mesh_destroy(&mesh);
    assert_sound(&copy);
    mesh_destroy(&copy);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_areas),   cmocka_unit_test(test_small_area),
        cmocka_unit_test(test_nothing_left), cmocka_unit_test(test_weights),
        cmocka_unit_test(test_mixed),   cmocka_unit_test(test_cancelling),
        cmocka_unit_test(test_threads), cmocka_unit_test(test_copy),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
