// After an error: what is still found, and what must not be said; texts that are hardly any.
#include <locale.h>
#include <time.h>

#include "scene_parse_fixture.h"

#define COUNT(array) (sizeof(array) / sizeof *(array))

static void test_each_mistake_once(void **state)
{
    (void)state;
    static const char *const all[] = {
        "1:14: 'fov' must be above 0 and below 180",
        "1:16: unknown property 'positon' of camera; did you mean 'position'?",
        "2:1: unknown statement 'sphre'; did you mean 'sphere'?",
        "3:7: unknown kind of light 'spt'; did you mean 'spot'?",
        "4:1: torus lacks 'axis', 'minor'",
        "5:18: '0.5x' is not a number",
        "6:43: material 'm' is not defined",
    };
    expect_errors("camera { fov 0 positon 1 2 3 look_at 1 1 1 }\n"
                  "sphre { center 0 0 0 radus 1 { } }\n"
                  "light spt { position 0 1 0 inner 4 }\n"
                  "torus { center 0 0 0 major 1 }\n"
                  "box { center 0 0 0.5x size 1 }\n"
                  "sphere { center 0 0 0 radius 1   material m }\n"
                  "sphere { center 0 0 0 radius 1 }\n",
                  all, COUNT(all));
}

static void test_no_cascades(void **state)
{
    (void)state;
    // A definition that is wrong still defines; what may be misspelt is not missed.
    expect_error("material m phong { diffus 1 }\nsphere { center 0 0 0 radius 1 material m }",
                 "1:20: unknown property 'diffus' of phong material; did you mean 'diffuse'?");
    expect_error("material m phnog { diffuse 1 }\nsphere { center 0 0 0 radius 1 material m }",
                 "1:12: unknown kind of material 'phnog'; did you mean 'phong'?");
    expect_error("texture t image { fil \"a\" }\nmaterial m phong { diffuse t }",
                 "1:19: unknown property 'fil' of image texture; did you mean 'file'?");
    expect_error("object o { sphere { } }\ninstance o { }", "1:12: sphere lacks 'center', 'radius'");
    // The word behind an unknown property is its value.
    expect_error("image { filtr gaussian samples 2 }",
                 "1:9: unknown property 'filtr' of image; did you mean 'filter'?");
    expect_error("sphere { center 0,0,0 radius 1 }", "1:17: '0,0,0' is not a number");
    expect_error("sphere { center: 0 0 0 radius 1 }",
                 "1:10: 'center:' is not a name; names have letters, digits and '_'");
    expect_errors("sphere { center (0 0 0) radius 1 }",
                  (const char *const[]){"1:17: unexpected '(0'", "1:22: '0)' is not a number"}, 2);
}

static void test_missing_braces(void **state)
{
    (void)state;
    expect_error("object o {\n sphere { center 0 0 0 radius 1\n sphere { center 0 0 0 radius 1 }\n}\n"
                 "instance o { }",
                 "3:2: 'sphere' is not a property of sphere; is a '}' missing before it?");
    expect_error("object o {\n sphere { center 0 0 0 radius 1 }\nlight point { position 0 0 0 }\n"
                 "sphere { center 0 0 0 radius 1 }\ninstance o { }",
                 "3:1: 'light' cannot stand in an object; is a '}' missing before it?");
    expect_error("camera { fov 50\nbackground 0.5\nsphere { center 0 0 0 radius 1 }",
                 "2:1: 'background' is not a property of camera; is a '}' missing before it?");
    expect_error("camera { sphere { center 0 0 0 radius 1 } }\nambient 1",
                 "1:10: 'sphere' is not a property of camera; is a '}' missing before it?");
    expect_error("sphere }\nambient 1", "1:8: expected '{', found '}'");
    expect_error("sphere\nbox { center 0 0 0 size 1 }", "2:1: expected '{', found 'box'");
    expect_error("sphere", "1:7: expected '{', found the end of the file");
    expect_error("object o sphere { center 0 0 0 radius 1 } }", "1:10: expected '{', found 'sphere'");
    expect_error("sphere {", "1:8: this '{' is never closed");
    expect_error("} sphere { center 0 0 0 radius 1 }", "1:1: unexpected '}'");
    expect_error("{ sphere { center 0 0 0 radius 1 } }", "1:1: expected a statement, found '{'");
}

static void test_suggests_what_is_legal(void **state)
{
    (void)state;
    expect_error("sphere { center 0 0 0 radius 1 radus 2 }", "1:32: unknown property 'radus' of sphere");
    expect_error("object o { lihgt point { } }", "1:12: unknown statement 'lihgt'");
    expect_error("lihgt point { }", "1:1: unknown statement 'lihgt'; did you mean 'light'?");
    expect_error("sphere { center 0 0 0 radius 1 rotat x 3 rotate x 3 }",
                 "1:32: unknown property 'rotat' of sphere; did you mean 'rotate'?");
    expect_error("material mm phong { } texture mn checker { } material a phong { diffuse mm }",
                 "1:73: texture 'mm' is not defined; did you mean 'mn'?");
}

static void test_values_in_the_wrong_place(void **state)
{
    (void)state;
    expect_error("sphere { 1 center 0 0 0 radius 1 }", "1:10: expected a property of sphere, found '1'");
    expect_error("sphere { center radius 1 }", "1:10: 'center' takes 3 numbers");
    expect_error("sphere { center 0 0 0 radius 1 material }",
                 "1:32: 'material' takes the name of a material");
    expect_error("sphere { center 0 0 0 material radius 1 }",
                 "1:23: 'material' takes the name of a material");
    expect_error("sphere { center 0 0 0 radius 1 material 5 }",
                 "1:41: 'material' takes the name of a material, not '5'");
    expect_error("material \"m\" phong { }", "1:10: expected the name of the material, found \"m\"");
    expect_error("mesh { file bunny }", "1:13: 'file' takes a file name in quotes, not 'bunny'");
    expect_error("render { shadows 1 }", "1:18: 'shadows' takes on or off, not '1'");
}

static void test_hardly_any_text(void **state)
{
    (void)state;
    static const char *const texts[] = {"", "\n", "   ", "# only a comment", "#", "\r\n\r\n", "\xEF\xBB\xBF",
                                        "\xEF\xBB\xBF# x\n", "# a\n# b", "\t\v\f"};
    for (u32 i = 0; i < COUNT(texts); ++i) {
        Parsed p = parse_good(texts[i]);
        assert_int_equal(p.scene->world.count, 0);
        parsed_end(&p);
    }
    Parsed p = parse_good("sphere{center 0 0 0 radius 1}"); // no line end, no spaces
    assert_int_equal(p.scene->world.count, 1);
    parsed_end(&p);
    p = parse_good("\xEF\xBB\xBFsphere\r\n{\r\n center 0#a\r\n0 0 radius 1#b\r\n}#c");
    assert_int_equal(p.scene->shapes[0].at.column, 1);
    parsed_end(&p);
}

static void test_no_text_at_all(void **state)
{
    (void)state;
    Parsed p = parse_bytes("ambient 1\n\0ambient 1", 20);
    assert_string_equal(p.messages, "t:2:1: error: the file is not text: a byte is 0\n    \n    ^\n");
    parsed_end(&p);
    // UTF-16 has zeros; one message is enough.
    p = parse_bytes("\xFF\xFE" "a\0m\0", 6);
    assert_int_equal(diagnostics_error_count(p.diagnostics), 1);
    parsed_end(&p);
    // Not UTF-8 in a comment is an error, but the rest is read.
    expect_errors("# \xE9\nsphere { }\n", (const char *const[]){"1:3: the file is not UTF-8 from here",
                                                               "2:1: sphere lacks 'center', 'radius'"}, 2);
}

static void test_twenty_are_shown(void **state)
{
    (void)state;
    char text[3000] = "";
    for (u32 i = 0; i < 100; ++i)
        strcat(text, "sphere { radius 1 }\n");
    Parsed p = parse_bytes(text, strlen(text));
    assert_int_equal(diagnostics_error_count(p.diagnostics), 100);
    assert_non_null(strstr(p.messages, "t:20:1: error: "));
    assert_null(strstr(p.messages, "t:21:1: error: "));
    assert_non_null(strstr(p.messages, "\n80 more not shown\n"));
    parsed_end(&p);
}

// Files of meshes are read later, so that their errors do not hide those of the text.
static void test_meshes_come_last(void **state)
{
    (void)state;
    expect_error("mesh { file \"a.obj\" }\nsphere { radius 1 }", "2:1: sphere lacks 'center'");
}

static void test_locale(void **state)
{
    (void)state;
    // Where the machine has a locale with a decimal comma, it changes nothing.
    static const char *const locales[] = {"de_DE.UTF-8", "fr_FR.UTF-8", "de_DE.utf8"};
    const char *text = "ambient 0.12345678901234567890123";
    for (u32 i = 0; i < COUNT(locales); ++i)
        setlocale(LC_ALL, locales[i]);
    Parsed p = parse_good(text);
    setlocale(LC_ALL, "C");
    assert_true(p.scene->ambient.x == 0.12345678901234567890123);
    parsed_end(&p);
}

static void test_speed(void **state)
{
    (void)state;
    // Quadratic in the number of shapes, in the length of the line or in that of the array would be
    // minutes; the bound is for sanitizers on a busy machine.
    enum { SHAPES = 66430, BYTES = 64 };
    char *text = malloc(SHAPES * BYTES + 1);
    size_t length = 0;
    for (u32 i = 0; i < SHAPES; ++i)
        length += (size_t)snprintf(text + length, BYTES, "sphere { center %u.5 -0.125 3e-2 radius 1 } ", i);
    struct timespec begin, end;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &begin);
    Parsed p = parse_good(text);
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &end);
    assert_int_equal(p.scene->shape_count, SHAPES);
    assert_true(p.scene->shapes[SHAPES - 1].as.sphere.center.x == SHAPES - 0.5);
    assert_true(p.scene->shapes[1].at.column == strlen("sphere { center 0.5 -0.125 3e-2 radius 1 } ") + 1);
    const f64 seconds = (f64)(end.tv_sec - begin.tv_sec) + 1e-9 * (f64)(end.tv_nsec - begin.tv_nsec);
    if (seconds > 3)
        fail_msg("%u spheres took %.2f s", SHAPES, seconds);
    parsed_end(&p);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_mistake_once),         cmocka_unit_test(test_no_cascades),
        cmocka_unit_test(test_missing_braces),            cmocka_unit_test(test_suggests_what_is_legal),
        cmocka_unit_test(test_values_in_the_wrong_place), cmocka_unit_test(test_hardly_any_text),
        cmocka_unit_test(test_no_text_at_all),            cmocka_unit_test(test_twenty_are_shown),
        cmocka_unit_test(test_meshes_come_last),          cmocka_unit_test(test_locale),
        cmocka_unit_test(test_speed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
