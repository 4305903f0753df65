// The OBJ reader: every form of every statement, messages with their place, and the same for any division of
// the file into pieces.
#include "assets_obj_fixture.h"

#include <errno.h>
#include <float.h>
#include <locale.h>
#include <math.h>
#include <sys/stat.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "assets/obj.h"
#include "assets/obj_internal.h"

static void print_index(FILE *stream, u32 (*indices)[3], u32 face, int corner)
{
    if (!indices || indices[face][corner] == MESH_NO_INDEX)
        fputc('-', stream);
    else
        fprintf(stream, "%u", indices[face][corner]);
}

// All of obj, a line each thing: "v 1 2 3", "f 0/-/2 ..." with indices of position, uv and normal from 0, "part
// FIRST MATERIAL", "material NAME LINE", "library NAME LINE".
static char *describe(const ObjFile *obj)
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

// What the reader makes of the file t.obj, and then what it says.
static char *read_file(size_t piece_bytes)
{
    Diagnostics *diagnostics = diagnostics_create();
    assert_non_null(diagnostics);
    ObjFile obj;
    Error error;
    if (!obj_read_in_pieces("t.obj", piece_bytes, diagnostics, &obj, &error))
        fail_msg("%s", error.text);
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

static void expect_bytes(const char *bytes, size_t length, const char *expected)
{
    write_bytes("t.obj", bytes, length);
    static const size_t pieces[] = { 1 << 20, 1, 2, 3, 5, 8, 16, 33, 64 };
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; ++i) {
        char *got = read_file(pieces[i]);
        if (strcmp(got, expected) != 0)
            fail_msg("pieces of %zu bytes of\n%s\ngive\n%s\nexpected\n%s", pieces[i], bytes, got, expected);
        free(got);
    }
    unlink("t.obj");
}

static void expect(const char *text, const char *expected)
{
    expect_bytes(text, strlen(text), expected);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
#define TRIANGLE_READ "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void test_nothing(void **state)
{
    (void)state;
    expect("", "part 0 -1\n");
    expect("\n\n", "part 0 -1\n");
    expect("# only a comment", "part 0 -1\n");
    expect("v 1 2 3", "v 1 2 3\npart 0 -1\n");
    expect("\xEF\xBB\xBF", "part 0 -1\n");
}

static void test_vertices(void **state)
{
    (void)state;
    expect("v 1 2 3\n", "v 1 2 3\npart 0 -1\n");
    expect("v -1.5 +2 .25\nv 3. -.5 0001.500\n", "v -1.5 2 0.25\nv 3 -0.5 1.5\npart 0 -1\n");
    expect("v 1e3 1E-2 -2.5e+1\n", "v 1000 0.01 -25\npart 0 -1\n");
    expect("\tv\t1  2\t 3 \t\n  v 4 5 6\n", "v 1 2 3\nv 4 5 6\npart 0 -1\n");
    // weight; colour; both; with alpha
    expect("v 1 2 3 1\nv 4 5 6 0.5 0.5 0.5\nv 7 8 9 1 1 0 0\nv 1 1 1 1 0 0 0 1\n",
           "v 1 2 3\nv 4 5 6\nv 7 8 9\nv 1 1 1\npart 0 -1\n");
    expect("v 1 2 3# glued\nv 4 5 6 # not\n", "v 1 2 3\nv 4 5 6\npart 0 -1\n");
    expect("v 1 2 3 \v\f\nv 4\v5\f6\n", "v 1 2 3\nv 4 5 6\npart 0 -1\n");
}

static void test_lines(void **state)
{
    (void)state;
    const char *read = TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n";
    expect(TRIANGLE "f 1 2 3\n", read);
    expect(TRIANGLE "f 1 2 3", read);
    expect("v 0 0 0\r\nv 1 0 0\r\n\r\nv 0 1 0\r\nf 1 2 3\r\n", read);
    expect("v 0 0 0\rv 1 0 0\r\rv 0 1 0\rf 1 2 3\r", read);
    expect("v 0 0 0\rv 1 0 0\nv 0 1 0\r\nf 1 2 3", read);
    expect("\xEF\xBB\xBFv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", read);
    expect("v 0 \\\n0 0\nv 1 0\\\r\n0\nv \\\r0 1 0\nf 1 \\\n\\\n2 \\\n  3\\\n\n", read);
    expect("v\\\n 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2\\\n3\\", read);
    // A comment is not continued.
    expect("# folder\\\nv 0 0 0\nv 1 0 0 # a \\\nv 0 1 0\nf 1 2 3 #\\\n", read);
    // What is skipped is.
    expect("g a \\\nv 9 9 9\n" TRIANGLE "f 1 2 3\n", read);
}

static void test_faces(void **state)
{
    (void)state;
    expect(TRIANGLE "fo 1 2 3\n", TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
    // A fan from the first corner.
    expect(TRIANGLE "v 1 1 1\nv 2 2 2\nf 1 2 3 4 5\n",
           TRIANGLE_READ "v 1 1 1\nv 2 2 2\n"
                         "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 2/-/- 3/-/-\nf 0/-/- 3/-/- 4/-/-\npart 0 -1\n");
    // No area, but kept.
    expect(TRIANGLE "f 1 1 1\n", TRIANGLE_READ "f 0/-/- 0/-/- 0/-/-\npart 0 -1\n");
    // Of what follows.
    expect("f 1 2 3\n" TRIANGLE, TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
    expect(TRIANGLE "f 00000000001 +2 3\n", TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
}

#define PARTS "vt 0.5 0.25\nvt 1 1\nvn 0 0 2\nvn 0 3 4\n"
#define PARTS_READ "vt 0.5 0.25\nvt 1 1\nvn 0 0 1\nvn 0 0.600000024 0.800000012\n"

static void test_corners(void **state)
{
    (void)state;
    expect(TRIANGLE PARTS "f 1/1/1 2/2/2 3/1/2\n",
           TRIANGLE_READ PARTS_READ "f 0/0/0 1/1/1 2/0/1\npart 0 -1\n");
    expect(TRIANGLE "vt 0.5\nvt 1 2 3\nf 1/1 2/2 3/1\n",
           TRIANGLE_READ "vt 0.5 0\nvt 1 2\nf 0/0/- 1/1/- 2/0/-\npart 0 -1\n");
    expect(TRIANGLE "vn 1 0 0\nf 1//1 2//1 3//1\n",
           TRIANGLE_READ "vn 1 0 0\nf 0/-/0 1/-/0 2/-/0\npart 0 -1\n");
    expect(TRIANGLE "vt 0 0\nf 1/1/ 2/1/ 3/1/\n", TRIANGLE_READ "vt 0 0\nf 0/0/- 1/0/- 2/0/-\npart 0 -1\n");
    expect(TRIANGLE "f 1/ 2// 3\n", TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
    // Faces with and without, in every order.
    expect(TRIANGLE PARTS "f 1 2 3\nf 1//2 2//2 3//1\nf 1/2 2/2 3/2\nf 3 2 1\nf 1/1/1 2/1/1 3/1/1\n",
           TRIANGLE_READ PARTS_READ "f 0/-/- 1/-/- 2/-/-\nf 0/-/1 1/-/1 2/-/0\nf 0/1/- 1/1/- 2/1/-\n"
                                    "f 2/-/- 1/-/- 0/-/-\nf 0/0/0 1/0/0 2/0/0\npart 0 -1\n");
    // A corner that lacks one takes it from the triangle.
    expect(TRIANGLE PARTS "f 1/1/1 2/1 3/1/1\nf 1//1 2/1/1 3/2/2\n",
           TRIANGLE_READ PARTS_READ "f 0/0/- 1/0/- 2/0/-\nf 0/-/0 1/-/0 2/-/1\npart 0 -1\n");
    // What no face uses is left out.
    expect(TRIANGLE PARTS "f 1 2 3\n", TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
}

static void test_relative(void **state)
{
    (void)state;
    expect(TRIANGLE "f -3 -2 -1\nv 5 5 5\nf -1 1 -4\n",
           TRIANGLE_READ "v 5 5 5\nf 0/-/- 1/-/- 2/-/-\nf 3/-/- 0/-/- 0/-/-\npart 0 -1\n");
    expect("v 0 0 0\nvt 0 0\nvn 0 0 1\nf -1/-1/-1 -1/-1/-1 -1/-1/-1\nvt 1 1\nvn 0 1 0\nv 1 1 1\n"
           "f -1/-2/-1 -2/-1/-2 1/-1/-1\nf -2//-2 -1//-1 -1//1\n",
           "v 0 0 0\nv 1 1 1\nvt 0 0\nvt 1 1\nvn 0 0 1\nvn 0 1 0\n"
           "f 0/0/0 0/0/0 0/0/0\nf 1/0/1 0/1/0 0/1/1\nf 0/-/0 1/-/1 1/-/0\npart 0 -1\n");
}

static void test_normals(void **state)
{
    (void)state;
    // Of length 0: none.
    expect(TRIANGLE "vn 0 0 0\nvn 1 0 0\nf 1//1 2//2 3//2\nf 1//2 2//2 3//2\n",
           TRIANGLE_READ "vn 0 0 1\nvn 1 0 0\nf 0/-/- 1/-/- 2/-/-\nf 0/-/1 1/-/1 2/-/1\npart 0 -1\n");
    // Far from 1.
    expect(TRIANGLE "vn 3e38 0 -3e38\nvn 3e-200 4e-200 0\nf 1//1 2//2 3//2\n",
           TRIANGLE_READ "vn 0.707106769 0 -0.707106769\nvn 0.600000024 0.800000012 0\n"
                         "f 0/-/0 1/-/1 2/-/1\npart 0 -1\n");
}

static void test_materials(void **state)
{
    (void)state;
    expect("usemtl never\n" TRIANGLE "usemtl red one \nf 1 2 3\nf 1 2 3\nusemtl b#2\nusemtl red one\nf 1 2 3\n"
           "usemtl b#2\nf 1 2 3\nusemtl\nf 1 2 3\nusemtl red one\nf 1 2 3\nusemtl last\n",
           TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\n"
                         "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\n"
                         "part 0 0\npart 3 1\npart 4 -1\npart 5 0\nmaterial red one 5\nmaterial b#2 11\n");
    expect(TRIANGLE "f 1 2 3\nusemtl \ta\tb \\\n c\r\nf 1 2 3 3\n",
           TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\nf 0/-/- 2/-/- 2/-/-\n"
                         "part 0 -1\npart 1 0\nmaterial a\tb  c 5\n");
}

static void test_libraries(void **state)
{
    (void)state;
    expect("mtllib a.mtl\n\nmtllib b.mtl c.MTL\nmtllib a.mtl d.mtl\nmtllib\n",
           "part 0 -1\nlibrary a.mtl 1\nlibrary b.mtl 3\nlibrary c.MTL 3\nlibrary d.mtl 4\n");
    // No such files, so a name ends where the words say it.
    expect("mtllib my colours.mtl other.mtl\nmtllib x y\n",
           "part 0 -1\nlibrary my colours.mtl 1\nlibrary other.mtl 1\nlibrary x 2\nlibrary y 2\n");
    expect("mtllib a.mtl \\\n b.mtl\n", "part 0 -1\nlibrary a.mtl 1\nlibrary b.mtl 1\n");
    // One name, because there is such a file.
    write_bytes("a.mtl b", "", 0);
    expect("mtllib a.mtl b\nmtllib a.mtl\n", "part 0 -1\nlibrary a.mtl b 1\nlibrary a.mtl 2\n");
    unlink("a.mtl b");
}

static void test_skipped(void **state)
{
    (void)state;
    expect("g a b\ng\no thing\ns 1\ns off\nl 1 2 3\np 1\nvp 0.5\ncstype rat bspline\ndeg 3\ncurv 0 1 1 2\n"
           "parm u 0 1\nend\nshadow_obj x.obj\nmg 0\nlod 2\n" TRIANGLE "f 1 2 3\n",
           TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
    expect(TRIANGLE "foo 1 2\nV 1 2 3\nf 1 2 3\nfoo 3\nV\n",
           TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n"
                         "t.obj:4:1: warning: 'foo' is not known; it is skipped\n    foo 1 2\n    ^~~\n"
                         "t.obj:5:1: warning: 'V' is not known; it is skipped\n    V 1 2 3\n    ^\n");
}

// ---- messages -------------------------------------------------------------------------------

static void test_bad_numbers(void **state)
{
    (void)state;
    expect("v 1 x 3\n", "t.obj:1:5: error: 'x' is not a number\n    v 1 x 3\n        ^\n");
    expect("v 1 2 3\nv 1 2\n", "t.obj:2:6: error: v needs 3 numbers, here are 2\n    v 1 2\n         ^\n");
    expect("v", "t.obj:1:2: error: v needs 3 numbers, here are 0\n    v\n     ^\n");
    expect("vn 1 2 3 4\n",
           "t.obj:1:10: error: unexpected '4' after the 3 numbers of vn\n    vn 1 2 3 4\n             ^\n");
    expect("vt\n", "t.obj:1:3: error: vt needs 1 number, here are 0\n    vt\n      ^\n");
    expect("vn 1\n", "t.obj:1:5: error: vn needs 3 numbers, here is 1\n    vn 1\n        ^\n");
    expect("v 1.2.3 0 0\n", "t.obj:1:3: error: '1.2.3' is not a number\n    v 1.2.3 0 0\n      ^~~~~\n");
    expect("v 1e 0 0\n", "t.obj:1:3: error: '1e' is not a number\n    v 1e 0 0\n      ^~\n");
    expect("v - 0 0\n", "t.obj:1:3: error: '-' is not a number\n    v - 0 0\n      ^\n");
    expect("v 1-2 0 0\n", "t.obj:1:3: error: '1-2' is not a number\n    v 1-2 0 0\n      ^~~\n");
    expect("v 0x10 0 0\n", "t.obj:1:3: error: '0x10' is not a number\n    v 0x10 0 0\n      ^~~~\n");
    expect("v 1 2 3 4 5 6 7 8 9\n", "t.obj:1:19: error: unexpected '9' after the 8 numbers of v\n"
                                    "    v 1 2 3 4 5 6 7 8 9\n                      ^\n");
    expect("vn nan 0 0\nvt inf\nv 0 0 infinity\n",
           "t.obj:1:4: error: 'nan' is not a number\n    vn nan 0 0\n       ^~~\n"
           "t.obj:2:4: error: 'inf' is not a number\n    vt inf\n       ^~~\n"
           "t.obj:3:7: error: 'infinity' is not a number\n    v 0 0 infinity\n          ^~~~~~~~\n");
    expect("v 0 1e39 0\nv -1e999 0 0\n",
           "t.obj:1:5: error: 1e39 is above 3.40282e+38\n    v 0 1e39 0\n        ^~~~\n"
           "t.obj:2:3: error: -1e999 is above 3.40282e+38\n    v -1e999 0 0\n      ^~~~~~\n");
}

static void test_places(void **state)
{
    (void)state;
    // Characters, not bytes; a tab is one.
    expect("\xEF\xBB\xBFv 1 \xC3\xA9\xC3\xA9 y\n",
           "t.obj:1:5: error: '\xC3\xA9\xC3\xA9' is not a number\n    v 1 \xC3\xA9\xC3\xA9 y\n        ^~\n");
    expect("v 0 0 0\r\n\r\nv\t1 2 \\\r\n  x\r\n",
           "t.obj:4:3: error: 'x' is not a number\n      x\n      ^\n");
    expect("v 0 0 0\r\rv 1 2 x\rv 0 0 0\r", "t.obj:3:7: error: 'x' is not a number\n    v 1 2 x\n          ^\n");
    // In the order of the file, each its own line.
    expect("v a 0 0\nv 0 0 0\nv b 0 0\n", "t.obj:1:3: error: 'a' is not a number\n    v a 0 0\n      ^\n"
                                          "t.obj:3:3: error: 'b' is not a number\n    v b 0 0\n      ^\n");
}

static void test_bad_faces(void **state)
{
    (void)state;
    expect(TRIANGLE "f 1 2\n", "t.obj:4:6: error: a face needs 3 corners, here are 2\n    f 1 2\n         ^\n");
    expect(TRIANGLE "f 1\nf\n", "t.obj:4:4: error: a face needs 3 corners, here is 1\n    f 1\n       ^\n"
                                "t.obj:5:2: error: a face needs 3 corners, here are 0\n    f\n     ^\n");
    expect(TRIANGLE "f 1 2 4\n", "t.obj:4:7: error: there is no vertex 4: the file has 3 vertices\n"
                                 "    f 1 2 4\n          ^\n");
    expect(TRIANGLE "f 1 2 99999999999999999999999\n",
           "t.obj:4:7: error: there is no vertex 99999999999999999999999: the file has 3 vertices\n"
           "    f 1 2 99999999999999999999999\n          ^~~~~~~~~~~~~~~~~~~~~~~\n");
    expect(TRIANGLE "f 1 0 2\n", "t.obj:4:5: error: there is no vertex 0: indices begin at 1\n"
                                 "    f 1 0 2\n        ^\n");
    expect("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n",
           "t.obj:3:9: error: there is no vertex -3: up to here the file has 2 vertices\n"
           "    f -1 -2 -3\n            ^~\n");
    expect(TRIANGLE "vt 0 0\nf 1/1 2/2 3/1\n",
           "t.obj:5:9: error: there is no texture coordinate 2: the file has 1 of them\n"
           "    f 1/1 2/2 3/1\n            ^\n");
    expect(TRIANGLE "f 1//1 2//1 3//1\n", "t.obj:4:6: error: there is no normal 1: the file has 0 of them\n"
                                          "    f 1//1 2//1 3//1\n         ^\n");
    expect(TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//-2\n",
           "t.obj:5:16: error: there is no normal -2: up to here the file has 1 of them\n"
           "    f 1//1 2//1 3//-2\n                   ^~\n");
}

static void test_bad_corners(void **state)
{
    (void)state;
    static const char *const corners[] = { "1.5", "a", "/1", "1/2/3/", "1/2/3/4", "1/a", "1/-", "-", "1//x", "1-2", "1,2", "1\\" };
    for (size_t i = 0; i < sizeof corners / sizeof *corners; ++i) {
        char text[100], expected[300], tildes[20] = "~~~~~~~~~~~~~~~";
        tildes[strlen(corners[i]) - 1] = 0;
        snprintf(text, sizeof text, TRIANGLE "vt 0 0\nvt 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nf 1 %s 2 3\n",
                 corners[i]);
        snprintf(expected, sizeof expected,
                 "t.obj:9:5: error: '%s' is no corner of a face: 1, 1/2, 1//3 or 1/2/3\n"
                 "    f 1 %s 2 3\n        ^%s\n",
                 corners[i], corners[i], tildes);
        expect(text, expected);
    }
}

static void test_bytes(void **state)
{
    (void)state;
    expect_bytes("v 1 2\0 3\n", 9, "t.obj:1:5: error: '2' is not a number\n    v 1 2  3\n        ^~\n");
    expect_bytes("v 1 2 3\0", 8, "t.obj:1:7: error: '3' is not a number\n    v 1 2 3 \n          ^~\n");
    expect_bytes("v 1 2 3\n\0\n", 10,
                 "v 1 2 3\npart 0 -1\nt.obj:2:1: warning: '' is not known; it is skipped\n     \n    ^\n");
    // A number at the very end, of which nothing behind it is read.
    expect("v 1 2 12345678", "v 1 2 12345678\npart 0 -1\n");
    expect(TRIANGLE "f 1 2 -1", TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\npart 0 -1\n");
}

static void test_many_errors(void **state)
{
    (void)state;
    char text[2000] = "";
    for (int i = 0; i < 100; ++i)
        strcat(text, "v x y z\n");
    write_bytes("t.obj", text, strlen(text));
    Diagnostics *diagnostics = diagnostics_create();
    ObjFile obj;
    Error error;
    // A second file is refused, too, though nothing more is shown.
    for (int i = 0; i < 2; ++i) {
        const u32 before = diagnostics_error_count(diagnostics);
        assert_true(obj_read_in_pieces("t.obj", 64, diagnostics, &obj, &error));
        assert_true(diagnostics_error_count(diagnostics) > before);
        assert_null(obj.mesh.positions);
        obj_destroy(&obj);
    }
    assert_true(diagnostics_full(diagnostics));
    diagnostics_destroy(diagnostics);
    unlink("t.obj");
}

static void expect_failure(const char *path, ErrorCode code, const char *text)
{
    Diagnostics *diagnostics = diagnostics_create();
    ObjFile obj;
    Error error;
    assert_false(obj_read(path, diagnostics, &obj, &error));
    assert_int_equal(error.code, code);
    assert_string_equal(error.text, text);
    assert_null(obj.arena);
    assert_int_equal(diagnostics_error_count(diagnostics), 0);
    diagnostics_destroy(diagnostics);
}

static void test_failures(void **state)
{
    (void)state;
    expect_failure("missing.obj", ERROR_IO, strerror(ENOENT));
    expect_failure(".", ERROR_IO, strerror(EISDIR));
    assert_int_equal(mkfifo("pipe", 0600), 0);
    expect_failure("pipe", ERROR_IO, "not a regular file");
    unlink("pipe");
}

// ---- large files ----------------------------------------------------------------------------

static u64 next_random(u64 *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

// Every number is that of strtod.
static void test_numbers(void **state)
{
    (void)state;
    enum { COUNT = 30000 };
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_text(&text, &size);
    u64 random = 1;
    static f64 expected[COUNT];
    for (u32 i = 0; i < COUNT; ++i) {
        char number[80];
        const u32 form = i % 8;
        const u64 a = next_random(&random), b = next_random(&random), c = next_random(&random);
        const f64 value = (f64)a / (f64)(b + 1) * (c & 1 ? -1 : 1);
        const int digits = (int)(c / 2 % 20), exponent = (int)(c / 64 % 60) - 30;
        switch (form) {
        case 0: snprintf(number, sizeof number, "%.*f", digits, value); break;
        case 1: snprintf(number, sizeof number, "%.*e", digits, value); break;
        case 2: snprintf(number, sizeof number, "%.17g", value); break;
        case 3: snprintf(number, sizeof number, "%llu%llu.%llu", (unsigned long long)a, (unsigned long long)b % 10000, (unsigned long long)c); break;
        case 4: snprintf(number, sizeof number, ".%0*llu", digits + 1, (unsigned long long)a); break;
        case 5: snprintf(number, sizeof number, "%llue%d", (unsigned long long)a, exponent); break;
        case 6: snprintf(number, sizeof number, "-0.%llu%010lluE%d", (unsigned long long)b, (unsigned long long)a, exponent); break;
        default: snprintf(number, sizeof number, "%llu%09llu%09llu%09llu", 1 + (unsigned long long)a % 9, (unsigned long long)a % 1000000000, (unsigned long long)b % 1000000000, (unsigned long long)c % 1000000000); break;
        }
        expected[i] = strtod(number, NULL);
        if (fabs(expected[i]) > (f64)FLT_MAX) {
            strcpy(number, "0");
            expected[i] = 0;
        }
        fprintf(stream, i % 3 == 0 ? "v %s" : i % 3 == 1 ? " %s" : " %s\n", number);
    }
    fclose(stream);
    write_bytes("t.obj", text, size);
    free(text);
    Diagnostics *diagnostics = diagnostics_create();
    ObjFile obj;
    Error error;
    assert_true(obj_read_in_pieces("t.obj", 10000, diagnostics, &obj, &error));
    assert_int_equal(diagnostics_error_count(diagnostics), 0);
    assert_int_equal(obj.mesh.position_count, COUNT / 3);
    for (u32 i = 0; i < COUNT; ++i) {
        const Vec3 p = obj.mesh.positions[i / 3];
        const f64 got = i % 3 == 0 ? p.x : i % 3 == 1 ? p.y : p.z;
        if (memcmp(&got, &expected[i], sizeof got) != 0)
            fail_msg("number %u: %.17g, expected %.17g", i, got, expected[i]);
    }
    obj_destroy(&obj);
    diagnostics_destroy(diagnostics);
    unlink("t.obj");
}

// Values between two doubles, just beside them, and where a digit decides after many.
static void test_rounding(void **state)
{
    (void)state;
    static const char *const numbers[] = {
        "9007199254740993", "9007199254740993.0", "9007199254740993.00000000000000001", "0.1", "0.3",
        "1.00000000000000011102230246251565404236316680908203125", "2.2250738585072011e-308",
        "1.0000000000000002e-5", "123456789012345678e-27", "1844674407370955161.5", "18446744073709551615",
        "9999999999999999999e-27", "9999999999999999999e-28", "1e22", "1e23", "8.5e22", "4.9406564584124654e-324",
        "1e-400", "0e999999999999", "0.000000000000000000000000000000001", "72057594037927945",
        "7205759403792794.5", "3.4028234663852886e38", "0.00000000000000000000000000000000000001175494351"
    };
    for (size_t i = 0; i < sizeof numbers / sizeof *numbers; ++i) {
        char text[200], expected[200];
        const f64 value = strtod(numbers[i], NULL);
        snprintf(text, sizeof text, "v %s -%s 0\n", numbers[i], numbers[i]);
        snprintf(expected, sizeof expected, "v %.17g %.17g 0\npart 0 -1\n", value, -value);
        expect(text, expected);
    }
}

// A grid with materials, relative and absolute indices and all kinds of lines; the same for any number of
// threads and any division.
static void write_grid(u32 size)
{
    FILE *file = fopen("t.obj", "wb");
    assert_non_null(file);
    fputs("mtllib a.mtl\r\n", file);
    for (u32 y = 0; y < size; ++y) {
        for (u32 x = 0; x < size; ++x) {
            fprintf(file, "v %u %.3f %u%s", x, (f64)(x * y) / 7, y, x % 5 == 0 ? " # first\n" : "\n");
            fprintf(file, "vt %.6f %.6f\nvn %u 1 %u\n", (f64)x / size, (f64)y / size, x, y);
        }
        if (y == 0)
            continue;
        fprintf(file, "g row%u\nusemtl m%u\n", y, y % 3);
        for (u32 x = 0; x + 1 < size; ++x) {
            const u32 a = (y - 1) * size + x + 1, b = a + 1, c = a + size, d = c + 1;
            const int back = (int)((y + 1) * size) + 1; // from an index to a relative one
            if (x % 2 == 0)
                fprintf(file, "f %u/%u/%u %u/%u/%u %u/%u/%u %u/%u/%u\n", a, a, a, b, b, b, d, d, d, c, c, c);
            else
                fprintf(file, "f %d//%u %d//%d %u//%d \\\n %d//%u\n", (int)a - back, a, (int)b - back,
                        (int)b - back, d, (int)d - back, (int)c - back, c);
        }
    }
    fclose(file);
}

static void check_grid(const ObjFile *obj, u32 size)
{
    const Mesh *mesh = &obj->mesh;
    assert_int_equal(mesh->position_count, size * size);
    assert_int_equal(mesh->face_count, 2 * (size - 1) * (size - 1));
    assert_int_equal(obj->material_count, 3);
    assert_int_equal(mesh->part_count, size - 1);
    for (u32 i = 0; i < mesh->face_count; ++i) {
        const u32 quad = i / 2, x = quad % (size - 1), y = quad / (size - 1), a = y * size + x;
        const u32 expected[3] = { a, i % 2 == 0 ? a + 1 : a + size + 1, i % 2 == 0 ? a + size + 1 : a + size };
        assert_memory_equal(mesh->faces[i], expected, sizeof expected);
        assert_memory_equal(mesh->face_normals[i], expected, sizeof expected);
        if (x % 2 == 0)
            assert_memory_equal(mesh->face_uvs[i], expected, sizeof expected);
        else
            assert_int_equal(mesh->face_uvs[i][0], MESH_NO_INDEX);
    }
    for (u32 i = 0; i < mesh->part_count; ++i) {
        assert_int_equal(mesh->parts[i].first, 2 * i * (size - 1));
        char name[8];
        snprintf(name, sizeof name, "m%u", (i + 1) % 3);
        assert_string_equal(obj->material_names[mesh->parts[i].material], name);
    }
}

static void test_grid(void **state)
{
    (void)state;
    enum { SIZE = 150 };
    write_grid(SIZE);
    static const size_t pieces[] = { 1 << 30, 1, 100, 4093, 65536, 256 << 10 };
    char *first = NULL;
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; ++i) {
#ifdef _OPENMP
        omp_set_num_threads(1 + (int)i % 4);
#endif
        Diagnostics *diagnostics = diagnostics_create();
        ObjFile obj;
        Error error;
        assert_true(obj_read_in_pieces("t.obj", pieces[i], diagnostics, &obj, &error));
        assert_int_equal(diagnostics_error_count(diagnostics) + diagnostics_warning_count(diagnostics), 0);
        check_grid(&obj, SIZE);
        char *description = describe(&obj);
        if (first)
            assert_string_equal(description, first);
        else
            first = strdup(description);
        free(description);
        obj_destroy(&obj);
        diagnostics_destroy(diagnostics);
    }
    free(first);
    unlink("t.obj");
}

// A line longer than any window and any piece.
static void test_long_line(void **state)
{
    (void)state;
    enum { CORNERS = 50000 };
    FILE *file = fopen("t.obj", "wb");
    assert_non_null(file);
    fputs(TRIANGLE "f", file);
    for (u32 i = 0; i < CORNERS; ++i)
        fprintf(file, " %u", i % 3 + 1);
    fputs("\nf 3 2 1\n", file);
    fclose(file);
    static const size_t pieces[] = { 1, 1000, 1 << 20 };
    for (size_t i = 0; i < sizeof pieces / sizeof *pieces; ++i) {
        Diagnostics *diagnostics = diagnostics_create();
        ObjFile obj;
        Error error;
        assert_true(obj_read_in_pieces("t.obj", pieces[i], diagnostics, &obj, &error));
        assert_int_equal(obj.mesh.face_count, CORNERS - 1);
        for (u32 f = 0; f < CORNERS - 2; ++f) {
            const u32 expected[3] = { 0, (f + 1) % 3, (f + 2) % 3 };
            assert_memory_equal(obj.mesh.faces[f], expected, sizeof expected);
        }
        assert_int_equal(obj.mesh.faces[CORNERS - 2][0], 2);
        obj_destroy(&obj);
        diagnostics_destroy(diagnostics);
    }
    unlink("t.obj");
}

// Numbers have a point, wherever the program runs.
static void test_locale(void **state)
{
    (void)state;
    if (!setlocale(LC_ALL, "de_DE.UTF-8") && !setlocale(LC_ALL, "fr_FR.UTF-8"))
        skip(); // no such locale is installed
    expect("v 0.5 1.00000000000000011102230246251565404236316680908203126 1e-30\n",
           "v 0,5 1,0000000000000002 1,0000000000000001e-30\npart 0 -1\n");
    setlocale(LC_ALL, "C");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nothing),
        cmocka_unit_test(test_vertices),
        cmocka_unit_test(test_lines),
        cmocka_unit_test(test_faces),
        cmocka_unit_test(test_corners),
        cmocka_unit_test(test_relative),
        cmocka_unit_test(test_normals),
        cmocka_unit_test(test_materials),
        cmocka_unit_test(test_libraries),
        cmocka_unit_test(test_skipped),
        cmocka_unit_test(test_bad_numbers),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_bad_faces),
        cmocka_unit_test(test_bad_corners),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_many_errors),
        cmocka_unit_test(test_failures),
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_rounding),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_long_line),
        cmocka_unit_test(test_locale),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
