// The OBJ reader: messages with their place, files that cannot be read, and bytes that upset it.
#include "assets_obj_expect.h"

#include <errno.h>
#include <sys/stat.h>

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
    expect("v 0 0 0\r\rv 1 2 x\rv 0 0 0\r",
           "t.obj:3:7: error: 'x' is not a number\n    v 1 2 x\n          ^\n");
    // In the order of the file, each its own line.
    expect("v a 0 0\nv 0 0 0\nv b 0 0\n", "t.obj:1:3: error: 'a' is not a number\n    v a 0 0\n      ^\n"
                                          "t.obj:3:3: error: 'b' is not a number\n    v b 0 0\n      ^\n");
}

static void test_bad_faces(void **state)
{
    (void)state;
    expect(TRIANGLE "f 1 2\n",
           "t.obj:4:6: error: a face needs 3 corners, here are 2\n    f 1 2\n         ^\n");
    expect(TRIANGLE "f 1\nf\n", "t.obj:4:4: error: a face needs 3 corners, here is 1\n    f 1\n       ^\n"
                                "t.obj:5:2: error: a face needs 3 corners, here are 0\n    f\n     ^\n");
    expect(TRIANGLE "f 1 2 4\n", "t.obj:4:7: error: there is no vertex 4: the file has 3\n"
                                 "    f 1 2 4\n          ^\n");
    expect(TRIANGLE "f 1 2 99999999999999999999999\n",
           "t.obj:4:7: error: there is no vertex 99999999999999999999999: the file has 3\n"
           "    f 1 2 99999999999999999999999\n          ^~~~~~~~~~~~~~~~~~~~~~~\n");
    expect(TRIANGLE "f 1 0 2\n", "t.obj:4:5: error: there is no vertex 0: indices begin at 1\n"
                                 "    f 1 0 2\n        ^\n");
    expect("v 0 0 0\nv 1 0 0\nf -1 -2 -3\nv 0 1 0\n",
           "t.obj:3:9: error: there is no vertex -3: up to here the file has 2\n"
           "    f -1 -2 -3\n            ^~\n");
    expect(TRIANGLE "vt 0 0\nf 1/1 2/2 3/1\n",
           "t.obj:5:9: error: there is no texture coordinate 2: the file has 1\n"
           "    f 1/1 2/2 3/1\n            ^\n");
    expect(TRIANGLE "f 1//1 2//1 3//1\n", "t.obj:4:6: error: there is no normal 1: the file has 0\n"
                                          "    f 1//1 2//1 3//1\n         ^\n");
    expect(TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//-2\n",
           "t.obj:5:16: error: there is no normal -2: up to here the file has 1\n"
           "    f 1//1 2//1 3//-2\n                   ^~\n");
}

static void test_bad_corners(void **state)
{
    (void)state;
    static const char *const corners[] = {
        "1.5", "a", "/1", "1/2/3/", "1/2/3/4", "1/a", "1/-", "-", "1//x", "1-2", "1,2", "1\\"
    };
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

static void check_crasher(const char *path)
{
    char *whole = read_file(path, 1 << 20), *divided = read_file(path, 7);
    assert_true(whole[0] != 0);
    // How many are not shown depends on where the reader gives up.
    if (!strstr(whole, "more not shown"))
        assert_string_equal(whole, divided);
    free(whole);
    free(divided);
}

static void test_crashers(void **state)
{
    (void)state;
    assert_true(for_each_crasher(".obj", check_crasher) >= 10);
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_bad_numbers),
        cmocka_unit_test(test_places),
        cmocka_unit_test(test_bad_faces),
        cmocka_unit_test(test_bad_corners),
        cmocka_unit_test(test_bytes),
        cmocka_unit_test(test_many_errors),
        cmocka_unit_test(test_crashers),
        cmocka_unit_test(test_failures),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
