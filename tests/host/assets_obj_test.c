// The OBJ reader: every form of every statement.
#include "assets_obj_expect.h"

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
    expect("usemtl never\n" TRIANGLE
           "usemtl red one \nf 1 2 3\nf 1 2 3\nusemtl b#2\nusemtl red one\nf 1 2 3\n"
           "usemtl b#2\nf 1 2 3\nusemtl\nf 1 2 3\nusemtl red one\nf 1 2 3\nusemtl last\n",
           TRIANGLE_READ "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\n"
                         "f 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\nf 0/-/- 1/-/- 2/-/-\n"
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
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
