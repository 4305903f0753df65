// PLY, STL and glTF through assimp: the files are written here, byte for byte.
#include "assets_fixture.h"

#include <math.h>

#include "assets/import.h"
#include "assets/weld.h"

static ImportFile read_good(const char *name)
{
    ImportFile file;
    Error error = {0};
    if (!import_read(name, &file, &error))
        fail_msg("%s: %s", name, error.text);
    if (file.mesh.face_count > 0)
        assert_sound(&file.mesh);
    return file;
}

static void expect_failure(const char *name, const char *text)
{
    ImportFile file;
    Error error = {0};
    assert_false(import_read(name, &file, &error));
    assert_int_equal(error.code, ERROR_SCENE);
    if (!strstr(error.text, text))
        fail_msg("%s: '%s' does not say '%s'", name, error.text, text);
    assert_null(file.mesh.positions);
    assert_int_equal(file.material_count, 0);
}

// ---- bytes ----------------------------------------------------------------------------------

typedef struct Bytes {
    u8 data[8192];
    size_t length;
} Bytes;

static void put(Bytes *bytes, const void *data, size_t length)
{
    assert_true(bytes->length + length <= sizeof bytes->data);
    memcpy(bytes->data + bytes->length, data, length);
    bytes->length += length;
}

static void put_text(Bytes *bytes, const char *text)
{
    put(bytes, text, strlen(text));
}

// Little-endian, as all of these formats are.
static void put_u32(Bytes *bytes, u32 value)
{
    const u8 b[4] = {(u8)value, (u8)(value >> 8), (u8)(value >> 16), (u8)(value >> 24)};
    put(bytes, b, 4);
}

static void put_u16(Bytes *bytes, u32 value)
{
    const u8 b[2] = {(u8)value, (u8)(value >> 8)};
    put(bytes, b, 2);
}

static void put_f32(Bytes *bytes, f32 value)
{
    u32 bits;
    memcpy(&bits, &value, sizeof bits);
    put_u32(bytes, bits);
}

static void put_floats(Bytes *bytes, const f32 *values, u32 count)
{
    for (u32 i = 0; i < count; ++i)
        put_f32(bytes, values[i]);
}

// ---- PLY ------------------------------------------------------------------------------------

static const char PLY_HEAD[] = "element vertex 5\n"
                               "property float x\nproperty float y\nproperty float z\n"
                               "property float nx\nproperty float ny\nproperty float nz\n"
                               "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                               "element face 2\nproperty list uchar int vertex_indices\nend_header\n";

// A quadrilateral and a triangle that share the edge from 0 to 1; normals of other lengths than 1, one 0.
static const f32 PLY_VERTICES[5][6] = {{0, 0, 0, 0, 0, 2},
                                       {1, 0, 0, 0, 0, 2},
                                       {1, 1, 0, 0, 0, 0.5f},
                                       {0, 1, 0, 0, 3, 0},
                                       {0.5f, -1, 1, 0, 0, 0}};

static void check_ply(const char *name)
{
    ImportFile file = read_good(name);
    const Mesh *mesh = &file.mesh;
    assert_int_equal(mesh->position_count, 5);
    assert_int_equal(mesh->face_count, 3);
    assert_face(mesh->faces, 0, 0, 1, 2); // the fan
    assert_face(mesh->faces, 1, 0, 2, 3);
    assert_face(mesh->faces, 2, 1, 0, 4);
    assert_position(mesh, 4, 0.5, -1, 1, 0);
    assert_face(mesh->face_normals, 1, 0, 2, 3);
    assert_normal(mesh, 0, 0, 0, 1);
    assert_normal(mesh, 2, 0, 0, 1);
    assert_normal(mesh, 3, 0, 1, 0);
    // Where a normal is 0 the face is flat.
    assert_face(mesh->face_normals, 2, MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX);
    assert_null(mesh->uvs);
    assert_int_equal(mesh->part_count, 1);
    assert_int_equal(mesh->parts[0].material, -1);
    assert_int_equal(file.material_count, 0);
    import_destroy(&file);
}

static void test_ply(void **state)
{
    (void)state;
    Bytes text = {.length = 0}, binary = {.length = 0};
    put_text(&text, "ply\nformat ascii 1.0\n");
    put_text(&text, PLY_HEAD);
    put_text(&binary, "ply\nformat binary_little_endian 1.0\n");
    put_text(&binary, PLY_HEAD);
    for (u32 i = 0; i < 5; ++i) {
        char line[200];
        const f32 *v = PLY_VERTICES[i];
        snprintf(line, sizeof line, "%g %g %g %g %g %g 255 0 0\n", (f64)v[0], (f64)v[1], (f64)v[2],
                 (f64)v[3], (f64)v[4], (f64)v[5]);
        put_text(&text, line);
        put_floats(&binary, v, 6);
        put(&binary, "\xff\0\0", 3);
    }
    put_text(&text, "4 0 1 2 3\n3 1 0 4\n");
    const u32 corners[] = {0, 1, 2, 3, 1, 0, 4};
    for (u32 i = 0; i < 7; ++i) {
        if (i == 0 || i == 4)
            put(&binary, i ? "\x03" : "\x04", 1);
        put_u32(&binary, corners[i]);
    }
    write_bytes("text.ply", text.data, text.length);
    write_bytes("binary.ply", binary.data, binary.length);
    check_ply("text.ply");
    check_ply("binary.ply");
}

static void write_ply(const char *name, const char *vertices, const char *face)
{
    Bytes bytes = {.length = 0};
    put_text(&bytes, "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"
                     "end_header\n");
    put_text(&bytes, vertices);
    put_text(&bytes, face);
    write_bytes(name, bytes.data, bytes.length);
}

static void test_bad_ply(void **state)
{
    (void)state;
    write_ply("index.ply", "0 0 0\n1 0 0\n0 1 0\n", "3 0 1 7\n");
    expect_failure("index.ply", "names vertex 7 of 3");
    write_ply("nan.ply", "0 0 0\nnan 0 0\n0 1 0\n", "3 0 1 2\n");
    expect_failure("nan.ply", "not finite");
    write_text("junk.ply", "junk");
    expect_failure("junk.ply", "ply");
    write_text("head.ply", "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\ncomment end_header\n");
    expect_failure("head.ply", "no end_header");
    write_text("empty.ply", "");
    expect_failure("empty.ply", "empty");
    expect_failure("nowhere.ply", "nowhere.ply");
    write_text("unknown.xyzzy", "what");
    expect_failure("unknown.xyzzy", "format");
}

// ---- STL ------------------------------------------------------------------------------------

// The four faces of a tetrahedron, each with corners of its own, the facets' normals wrong.
static const f32 TETRAHEDRON[4][3][3] = {
    {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}},
    {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}},
    {{0, 0, 0}, {0, 0, 1}, {-0.0f, 1, 0}},
    {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},
};

static void check_stl(const char *name)
{
    ImportFile file = read_good(name);
    const Mesh *mesh = &file.mesh;
    assert_int_equal(mesh->face_count, 4);
    assert_int_equal(mesh->position_count, 4); // of twelve
    for (u32 i = 0; i < 4; ++i) {
        for (u32 k = 0; k < 3; ++k) {
            const f32 *p = TETRAHEDRON[i][k];
            assert_position(mesh, mesh->faces[i][k], (f64)p[0], (f64)p[1], (f64)p[2], 0);
        }
    }
    assert_face(mesh->faces, 3, 2, 1, 3);
    assert_null(mesh->normals);
    assert_int_equal(file.material_count, 0);
    import_destroy(&file);
}

static void test_stl(void **state)
{
    (void)state;
    Bytes text = {.length = 0}, binary = {.length = 0};
    const char header[80] = "binary";
    put_text(&text, "solid it\n");
    put(&binary, header, sizeof header);
    put_u32(&binary, 4);
    for (u32 i = 0; i < 4; ++i) {
        const f32 normal[3] = {1, 0, 0};
        put_text(&text, "facet normal 1 0 0\nouter loop\n");
        put_floats(&binary, normal, 3);
        for (u32 k = 0; k < 3; ++k) {
            char line[100];
            const f32 *p = TETRAHEDRON[i][k];
            snprintf(line, sizeof line, "vertex %g %g %g\n", (f64)p[0], (f64)p[1], (f64)p[2]);
            put_text(&text, line);
            put_floats(&binary, p, 3);
        }
        put_text(&text, "endloop\nendfacet\n");
        put_u16(&binary, 0);
    }
    put_text(&text, "endsolid it\n");
    write_bytes("text.stl", text.data, text.length);
    write_bytes("binary.stl", binary.data, binary.length);
    check_stl("text.stl");
    check_stl("binary.stl");
    write_bytes("cut.stl", binary.data, binary.length - 60);
    ImportFile file;
    Error error;
    if (import_read("cut.stl", &file, &error)) // what counts is that it is sound then
        import_destroy(&file);
    write_text("junk.stl", "junk");
    expect_failure("junk.stl", "small");
}

static void test_weld(void **state)
{
    (void)state;
    Vec3 points[200];
    u32 map[200];
    for (u32 i = 0; i < 200; ++i)
        points[i] = (Vec3){i * 7 % 40, i % 2 ? 0.0 : -0.0, i * 7 % 40 / 8};
    Vec3 before[200];
    memcpy(before, points, sizeof points);
    assert_int_equal(weld_points(points, 200, map), 40);
    for (u32 i = 0; i < 200; ++i) {
        assert_int_equal(map[i], i % 40);
        assert_true(points[map[i]].x == before[i].x && points[map[i]].z == before[i].z);
    }
    assert_int_equal(weld_points(points, 0, map), 0);
}

// ---- glTF -----------------------------------------------------------------------------------

static const char GLTF_NODES[] =
    "\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0,2]}],\"nodes\":["
    "{\"scale\":[-2,1,1],\"translation\":[5,0,0],\"children\":[1]},"
    "{\"mesh\":0,\"translation\":[0,0,3]},"
    "{\"mesh\":1}],"
    "\"materials\":[{\"name\":\"red\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,0.5,0.25,1]},"
    "\"emissiveFactor\":[0,0.5,0]}],"
    "\"meshes\":[{\"primitives\":["
    "{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"NORMAL\":2},\"indices\":3,\"material\":0},"
    "{\"attributes\":{\"POSITION\":0},\"indices\":3}]},"
    "{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"mode\":1},"
    "{\"attributes\":{\"POSITION\":0},\"mode\":0}]}],"
    "\"accessors\":["
    "{\"bufferView\":0,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\",\"min\":[0,0,0],\"max\":[1,1,0]},"
    "{\"bufferView\":1,\"componentType\":5126,\"count\":4,\"type\":\"VEC2\"},"
    "{\"bufferView\":2,\"componentType\":5126,\"count\":4,\"type\":\"VEC3\"},"
    "{\"bufferView\":3,\"componentType\":5123,\"count\":6,\"type\":\"SCALAR\"}],"
    "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":48,\"byteLength\":32},{\"buffer\":0,\"byteOffset\":80,\"byteLength\":48},"
    "{\"buffer\":0,\"byteOffset\":128,\"byteLength\":12}]";

// A square with slanted normals and uvs.
static Bytes gltf_data(void)
{
    static const f32 positions[] = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
    static const f32 uvs[] = {0, 0, 1, 0, 1, 1, 0, 0.25f};
    static const f32 normals[] = {0.6f, 0, 0.8f, 0, 0, 1, 0, 0, 1, 0, 0, 1};
    static const u32 indices[] = {0, 1, 2, 0, 2, 3};
    Bytes bytes = {.length = 0};
    put_floats(&bytes, positions, 12);
    put_floats(&bytes, uvs, 8);
    put_floats(&bytes, normals, 12);
    for (u32 i = 0; i < 6; ++i)
        put_u16(&bytes, indices[i]);
    return bytes;
}

static void check_gltf(const char *name)
{
    ImportFile file = read_good(name);
    const Mesh *mesh = &file.mesh;
    assert_int_equal(mesh->face_count, 4); // lines and points are none
    // The node mirrors: corners go round the other way, from the same first one.
    assert_face(mesh->faces, 0, 0, 2, 1);
    assert_face(mesh->faces, 1, 0, 3, 2);
    assert_position(mesh, 0, 5, 0, 3, 1e-6);
    assert_position(mesh, 1, 3, 0, 3, 1e-6);
    assert_position(mesh, 2, 3, 1, 3, 1e-6);
    // By the inverse transpose of a scale of -2 in x.
    const f64 length = sqrt(0.3 * 0.3 + 0.8 * 0.8);
    assert_face(mesh->face_normals, 0, 0, 2, 1);
    assert_normal(mesh, 0, -0.3 / length, 0, 0.8 / length);
    assert_normal(mesh, 1, 0, 0, 1);
    // v is 0 at the bottom here, and at the top in glTF.
    assert_face(mesh->face_uvs, 0, 0, 2, 1);
    assert_true(mesh->uvs[0][0] == 0 && mesh->uvs[0][1] == 1);
    assert_true(mesh->uvs[3][0] == 0 && mesh->uvs[3][1] == 0.75f);
    assert_face(mesh->face_normals, 2, MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX);
    assert_face(mesh->face_uvs, 3, MESH_NO_INDEX, MESH_NO_INDEX, MESH_NO_INDEX);
    assert_int_equal(mesh->part_count, 2);
    assert_int_equal(mesh->parts[0].material, 0);
    assert_int_equal(mesh->parts[1].first, 2);
    assert_int_equal(mesh->parts[1].material, -1);
    assert_int_equal(file.material_count, 1);
    const ImportMaterial *red = &file.materials[0];
    assert_string_equal(red->name, "red");
    assert_true(red->base_color.x == 1 && red->base_color.y == 0.5 && red->base_color.z == 0.25);
    assert_true(red->emission.x == 0 && red->emission.y == 0.5 && red->emission.z == 0);
    assert_true(red->metallic == 1 && red->roughness == 1 && red->transmit == 0 && red->ior == 1.5);
    for (u32 i = 0; i < IMPORT_MAPS; i++)
        assert_true(!red->maps[i].file && red->maps[i].image == -1);
    assert_int_equal(red->left_out, 0);
    import_destroy(&file);
}

static void test_gltf(void **state)
{
    (void)state;
    const Bytes data = gltf_data();
    write_bytes("square.bin", data.data, data.length);
    Bytes text = {.length = 0}, json = {.length = 0}, glb = {.length = 0};
    put_text(&text, "{");
    put_text(&text, GLTF_NODES);
    put_text(&text, ",\"buffers\":[{\"byteLength\":140,\"uri\":\"square.bin\"}]}");
    write_bytes("square.gltf", text.data, text.length);
    put_text(&json, "{");
    put_text(&json, GLTF_NODES);
    put_text(&json, ",\"buffers\":[{\"byteLength\":140}]}");
    while (json.length % 4)
        put_text(&json, " ");
    put_text(&glb, "glTF");
    put_u32(&glb, 2);
    put_u32(&glb, (u32)(12 + 8 + json.length + 8 + data.length));
    put_u32(&glb, (u32)json.length);
    put_text(&glb, "JSON");
    put(&glb, json.data, json.length);
    put_u32(&glb, (u32)data.length);
    put(&glb, "BIN\0", 4);
    put(&glb, data.data, data.length);
    write_bytes("square.glb", glb.data, glb.length);
    check_gltf("square.gltf");
    check_gltf("square.glb");
    write_bytes("cut.glb", glb.data, 30);
    expect_failure("cut.glb", "");
    unlink("square.bin");
    expect_failure("square.gltf", "");
}

// Only lines: there are no faces, which is no failure of the reader's.
static void test_lines(void **state)
{
    (void)state;
    Bytes bytes = {.length = 0};
    put_text(&bytes, "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n2 0 1\n");
    write_bytes("lines.ply", bytes.data, bytes.length);
    ImportFile file = read_good("lines.ply");
    assert_int_equal(file.mesh.face_count, 0);
    import_destroy(&file);
}

static void test_without(void **state)
{
    (void)state;
    write_text("any.ply", "ply\n");
    expect_failure("any.ply", "OBJ alone");
}

int main(void)
{
    char folder[FIXTURE_PATH_MAX];
    enter_folder(folder);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_ply),  cmocka_unit_test(test_bad_ply), cmocka_unit_test(test_stl),
        cmocka_unit_test(test_gltf), cmocka_unit_test(test_lines),   cmocka_unit_test(test_weld),
    };
    const struct CMUnitTest without[] = {cmocka_unit_test(test_without), cmocka_unit_test(test_weld)};
    const int failed = import_available() ? cmocka_run_group_tests(tests, NULL, NULL)
                                          : cmocka_run_group_tests(without, NULL, NULL);
    leave_folder(folder);
    return failed;
}
