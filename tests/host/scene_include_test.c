// include, and files as such: where they are looked for, what may not be, how they are named.
#include <stdio.h>
#include <sys/stat.h>
#include <unistd.h>

#include "scene_parse_fixture.h"

static char folder[64];

static const char *path_of(const char *name)
{
    static char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return path;
}

static void write_file(const char *name, const char *text)
{
    FILE *file = fopen(path_of(name), "wb");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static int begin(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/clrt-include-XXXXXX");
    if (!mkdtemp(folder) || mkdir(path_of("sub"), 0700) != 0)
        return 1;
    return mkdir(path_of("sub/deep"), 0700);
}

static int end(void **state)
{
    (void)state;
    static const char *const names[] = {"a.txt", "b.txt", "link.txt", "pipe", "sub/c.txt", "sub/d.txt",
                                        "sub/deep/e.txt", "sub/deep", "sub", "."};
    for (u32 i = 0; i < sizeof names / sizeof *names; ++i)
        remove(path_of(names[i]));
    return 0;
}

// Parses a.txt and asserts what is printed; %s in expected stands for the folder.
static void expect_printed(const char *expected)
{
    char text[1000];
    snprintf(text, sizeof text, expected, folder, folder, folder);
    Parsed p = parse_file(path_of("a.txt"));
    assert_non_null(p.scene);
    assert_string_equal(p.messages, text);
    parsed_end(&p);
}

static void test_nested(void **state)
{
    (void)state;
    write_file("a.txt", "sphere { center 1 0 0 radius 1 }\n"
                        "include \"sub/c.txt\" sphere { center 5 0 0 radius 1 }\n"
                        "include \"b.txt\" # x");
    write_file("b.txt", "sphere { center 6 0 0 radius 1 material m }");
    write_file("sub/c.txt", "sphere { center 2 0 0 radius 1 }\ninclude \"deep/e.txt\"\n"
                            "texture t image { file \"t.png\" }\nmaterial m phong { }");
    write_file("sub/deep/e.txt", "\xEF\xBB\xBFsphere { center 3 0 0 radius 1 } include \"../d.txt\"");
    write_file("sub/d.txt", "sphere { center 4 0 0 radius 1 }");
    Parsed p = parse_file(path_of("a.txt"));
    const Scene *s = p.scene;
    assert_non_null(s);
    assert_int_equal(diagnostics_error_count(p.diagnostics), 0);
    assert_int_equal(s->shape_count, 6);
    for (u32 i = 0; i < 6; ++i)
        assert_true(s->shapes[i].as.sphere.center.x == i + 1);
    assert_int_equal(s->file_count, 5);
    assert_string_equal(s->files[0], path_of("a.txt"));
    assert_string_equal(s->files[1], path_of("sub/c.txt"));
    assert_string_equal(s->files[2], path_of("sub/deep/e.txt"));
    assert_string_equal(s->files[3], path_of("sub/deep/../d.txt"));
    assert_string_equal(s->textures[0].file, path_of("sub/t.png")); // beside the file that names it
    assert_int_equal(s->shapes[4].at.file, 0);
    assert_int_equal(s->shapes[4].at.line, 2);
    assert_int_equal(s->shapes[4].at.column, 21);
    assert_int_equal(s->shapes[2].at.file, 2);
    assert_int_equal(s->shapes[5].material, 1);
    parsed_end(&p);
}

static void test_errors_name_the_file(void **state)
{
    (void)state;
    write_file("a.txt", "include \"sub/c.txt\"\nbox { }\n");
    write_file("sub/c.txt", "\nsphere { radius 1 }\n");
    expect_printed("%s/sub/c.txt:2:1: error: sphere lacks 'center'\n    sphere { radius 1 }\n    ^~~~~~\n"
                   "%s/a.txt:2:1: error: box lacks 'min' and 'max', or 'center' and 'size'\n    box { }\n"
                   "    ^~~\n");
    // An open brace does not reach beyond its file.
    write_file("a.txt", "include \"sub/c.txt\"\nambient 1");
    write_file("sub/c.txt", "object o {");
    expect_printed("%s/sub/c.txt:1:10: error: this '{' is never closed\n    object o {\n             ^\n");
}

static void test_twice_and_cycles(void **state)
{
    (void)state;
    write_file("a.txt", "include \"b.txt\"\ninclude \"./sub/../b.txt\"\n");
    write_file("b.txt", "");
    expect_printed("%s/a.txt:2:9: error: the file is included already, at line 1\n"
                   "    include \"./sub/../b.txt\"\n            ^~~~~~~~~~~~~~~~\n");
    assert_int_equal(symlink("b.txt", path_of("link.txt")), 0);
    write_file("a.txt", "include \"b.txt\"\ninclude \"link.txt\"\n");
    expect_printed("%s/a.txt:2:9: error: the file is included already, at line 1\n"
                   "    include \"link.txt\"\n            ^~~~~~~~~~\n");
    write_file("a.txt", "include \"b.txt\"");
    write_file("b.txt", "ambient 1\ninclude \"a.txt\" background 1");
    expect_printed("%s/b.txt:2:9: error: the file includes itself, directly or through others\n"
                   "    include \"a.txt\" background 1\n            ^~~~~~~\n");
    write_file("a.txt", "camera { fov 50 }\ninclude \"b.txt\"");
    write_file("b.txt", "camera { fov 40 }");
    expect_printed("%s/b.txt:1:1: error: 'camera' stands once in a scene; the first is at %s/a.txt:1\n"
                   "    camera { fov 40 }\n    ^~~~~~\n");
    write_file("b.txt", "include \"b.txt\"");
    expect_printed("%s/b.txt:1:9: error: the file includes itself, directly or through others\n"
                   "    include \"b.txt\"\n            ^~~~~~~\n");
}

static void test_unreadable(void **state)
{
    (void)state;
    write_file("a.txt", "include \"none.txt\"\nsphere { }");
    expect_printed("%s/a.txt:1:9: error: cannot read \"none.txt\": No such file or directory\n"
                   "    include \"none.txt\"\n            ^~~~~~~~~~\n"
                   "%s/a.txt:2:1: error: sphere lacks 'center', 'radius'\n    sphere { }\n    ^~~~~~\n");
    write_file("a.txt", "include \"sub\"");
    expect_printed("%s/a.txt:1:9: error: cannot read \"sub\": Is a directory\n"
                   "    include \"sub\"\n            ^~~~~\n");
    write_file("a.txt", "include \"\"");
    expect_printed("%s/a.txt:1:9: error: the file name is empty\n    include \"\"\n            ^~\n");
}

static void test_pipe_is_not_waited_for(void **state)
{
    (void)state;
    assert_int_equal(mkfifo(path_of("pipe"), 0600), 0);
    write_file("a.txt", "include \"pipe\"");
    expect_printed("%s/a.txt:1:9: error: cannot read \"pipe\": not a regular file\n"
                   "    include \"pipe\"\n            ^~~~~~\n");
}

static void test_scene_file_itself(void **state)
{
    (void)state;
    Parsed p = parse_file(path_of("none.txt"));
    assert_null(p.scene);
    assert_int_equal(p.error.code, ERROR_IO);
    assert_non_null(strstr(p.error.text, "/none.txt: No such file or directory"));
    assert_string_equal(p.messages, "");
    parsed_end(&p);
    p = parse_file(folder);
    assert_null(p.scene);
    assert_int_equal(p.error.code, ERROR_IO);
    parsed_end(&p);
}

static void test_stdin(void **state)
{
    (void)state;
    // As a pipe, of which the size is not known beforehand.
    int ends[2];
    assert_int_equal(pipe(ends), 0);
    const char *text = "ambient 0.5\nsphere { center 0 0 0 radius 1 }\nfog";
    assert_int_equal(write(ends[1], text, strlen(text)), strlen(text));
    close(ends[1]);
    const int saved = dup(STDIN_FILENO);
    dup2(ends[0], STDIN_FILENO);
    Parsed p = parse_file("-");
    dup2(saved, STDIN_FILENO);
    close(saved);
    close(ends[0]);
    assert_string_equal(p.messages, "<stdin>:3:1: error: unknown statement 'fog'\n    fog\n    ^~~\n");
    assert_int_equal(p.scene->shape_count, 1);
    parsed_end(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_nested),           cmocka_unit_test(test_errors_name_the_file),
        cmocka_unit_test(test_twice_and_cycles), cmocka_unit_test(test_unreadable),
        cmocka_unit_test(test_pipe_is_not_waited_for), cmocka_unit_test(test_scene_file_itself),
        cmocka_unit_test(test_stdin),
    };
    return cmocka_run_group_tests(tests, begin, end);
}
