// The MTL reader: every statement that it reads, those that it skips, and messages with their place.
#include "assets_obj_fixture.h"

#include <errno.h>

#include "assets/mtl.h"

static void print_color(FILE *stream, const char *name, const f64 color[3])
{
    fprintf(stream, " %s %g %g %g", name, color[0], color[1], color[2]);
}

// A line a material: NAME LINE and what it gives.
static char *describe(const MtlFile *mtl)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_text(&text, &size);
    for (u32 i = 0; i < mtl->count; ++i) {
        const MtlMaterial *m = &mtl->materials[i];
        fprintf(stream, "%s %u", m->name, m->line);
        if (m->given & MTL_KD)
            print_color(stream, "Kd", m->kd);
        if (m->given & MTL_KS)
            print_color(stream, "Ks", m->ks);
        if (m->given & MTL_KE)
            print_color(stream, "Ke", m->ke);
        if (m->given & MTL_NS)
            fprintf(stream, " Ns %g", m->ns);
        if (m->given & MTL_NI)
            fprintf(stream, " Ni %g", m->ni);
        if (m->given & MTL_D)
            fprintf(stream, " d %g", m->d);
        if (m->map_kd)
            fprintf(stream, " map_Kd [%s] %u", m->map_kd, m->map_kd_line);
        if (m->map_bump)
            fprintf(stream, " bump [%s] %u", m->map_bump, m->map_bump_line);
        fputs("\n", stream);
    }
    fclose(stream);
    return text;
}

static void expect_bytes(const char *bytes, size_t length, const char *expected)
{
    write_bytes("t.mtl", bytes, length);
    Diagnostics *diagnostics = diagnostics_create();
    assert_non_null(diagnostics);
    MtlFile mtl;
    Error error;
    if (!mtl_read("t.mtl", diagnostics, &mtl, &error))
        fail_msg("%s", error.text);
    char *description = describe(&mtl), *messages = printed(diagnostics);
    char got[4000];
    snprintf(got, sizeof got, "%s%s", description, messages);
    if (strcmp(got, expected) != 0)
        fail_msg("%s\ngives\n%s\nexpected\n%s", bytes, got, expected);
    free(description);
    free(messages);
    mtl_destroy(&mtl);
    diagnostics_destroy(diagnostics);
    unlink("t.mtl");
}

static void expect(const char *text, const char *expected)
{
    expect_bytes(text, strlen(text), expected);
}

static void test_materials(void **state)
{
    (void)state;
    expect("", "");
    expect("# nothing\n\n", "");
    expect("newmtl a", "a 1\n");
    expect("newmtl red\nKa 1 1 1\nKd 0.8 0.1 0\nKs .5 .5 .5\nKe 0 0 2\nNs 96.5\nNi 1.45\nd 0.25\nillum 2\n",
           "red 1 Kd 0.8 0.1 0 Ks 0.5 0.5 0.5 Ke 0 0 2 Ns 96.5 Ni 1.45 d 0.25\n");
    expect("\xEF\xBB\xBF# made by hand\r\n\r\nnewmtl a b \r\n\tKd 1 1 1 # white\r\n"
           "  newmtl\tc#1\r\n\tNs 5\r\n",
           "a b 3 Kd 1 1 1\nc#1 5 Ns 5\n");
    expect("newmtl a\rKd 1 \\\r 0 0\rnewmtl b\rd 1", "a 1 Kd 1 0 0\nb 4 d 1\n");
    // A grey; the last of several; colours above 1.
    expect("newmtl a\nKd 0.5\nKs 1 2 3\nKs 4 5 6\n", "a 1 Kd 0.5 0.5 0.5 Ks 4 5 6\n");
    // The same name twice: both are listed.
    expect("newmtl a\nd 1\nnewmtl a\nd 0\n", "a 1 d 1\na 3 d 0\n");
}

static void test_opacity(void **state)
{
    (void)state;
    expect("newmtl a\nTr 0.25\n", "a 1 d 0.75\n");
    expect("newmtl a\nTr 0.25\nd 0.5\n", "a 1 d 0.5\n");
    expect("newmtl a\nd 0.5\nTr 0.25\nnewmtl b\nTr 1\n", "a 1 d 0.5\nb 4 d 0\n");
    expect("newmtl a\nd -halo 0.5\n",
           "a 1 d 0.5\nt.mtl:2:3: warning: -halo is not supported; it is left out\n"
           "    d -halo 0.5\n      ^~~~~\n");
}

static void test_maps(void **state)
{
    (void)state;
    expect("newmtl a\nmap_Kd wood.png\nmap_Bump bumps.png\n", "a 1 map_Kd [wood.png] 2 bump [bumps.png] 3\n");
    expect("newmtl a\nmap_kd my wood #1.png \nbump b.png\n",
           "a 1 map_Kd [my wood #1.png] 2 bump [b.png] 3\n");
    // norm goes first, wherever it stands.
    expect("newmtl a\nnorm n.png\nmap_bump b.png\nnewmtl b\nbump b.png\nnorm n.png\n",
           "a 1 bump [n.png] 2\nb 4 bump [n.png] 6\n");
    expect("newmtl a\nmap_Kd -clamp on -blendu off -imfchan r -texres 512 -o 0 0 -s 1 1 1 x y.png\n"
           "map_Bump -bm 1.000000 n.png\n",
           "a 1 map_Kd [x y.png] 2 bump [n.png] 3\n");
    expect("newmtl a\nmap_Kd -s 2 2 2 -mm 0 1 x.png\nmap_Bump -bm 0.5 n.png\n",
           "a 1 map_Kd [x.png] 2 bump [n.png] 3\n"
           "t.mtl:2:8: warning: option -s is not supported; it is left out\n"
           "    map_Kd -s 2 2 2 -mm 0 1 x.png\n           ^~\n"
           "t.mtl:3:10: warning: option -bm is not supported; it is left out\n"
           "    map_Bump -bm 0.5 n.png\n             ^~~\n");
    expect("newmtl a\nmap_Kd -odd.png\nmap_Bump \\\n n.png\n", "a 1 map_Kd [-odd.png] 2 bump [n.png] 4\n");
    expect("newmtl a\nmap_Kd\nnorm -s 1\n",
           "a 1\nt.mtl:2:7: warning: map_Kd names no file\n    map_Kd\n          ^\n"
           "t.mtl:3:10: warning: norm names no file\n    norm -s 1\n             ^\n");
}

static void test_skipped(void **state)
{
    (void)state;
    expect("newmtl a\nKa 1 1 1\nTf 1 1 1\nillum 4\nsharpness 60\nmap_Ka a.png\nmap_Ks b.png\nmap_Ns c.png\n"
           "map_d d.png\ndisp e.png\ndecal f.png\nrefl -type sphere g.png\nPr 0.5\nPm 0\naniso 0\n"
           "map_Pr h.png\n",
           "a 1\n");
    expect("Kd 1 1 1\nNs 5\nnewmtl a\nfoo 1\nfoo 2\nkd 1 1 1\n",
           "a 3\nt.mtl:1:1: warning: 'Kd' before the first newmtl; it is left out\n    Kd 1 1 1\n    ^~\n"
           "t.mtl:4:1: warning: 'foo' is not known; it is skipped\n    foo 1\n    ^~~\n"
           "t.mtl:6:1: warning: 'kd' is not known; it is skipped\n    kd 1 1 1\n    ^~\n");
    expect("newmtl a\nKd spectral x.rfl\nKs xyz 1 1 1\n",
           "a 1\nt.mtl:2:4: warning: Kd spectral is not supported; it is left out\n"
           "    Kd spectral x.rfl\n       ^~~~~~~~\n"
           "t.mtl:3:4: warning: Ks xyz is not supported; it is left out\n    Ks xyz 1 1 1\n       ^~~\n");
}

static void test_ranges(void **state)
{
    (void)state;
    expect("newmtl a\nKd -1 0.5 0\nNs 2e6\nNs -3\nd 1.5\nNi 0\n",
           "a 1 Kd 0 0.5 0 Ns 0 d 1\n"
           "t.mtl:2:4: warning: Kd -1 is taken as 0\n    Kd -1 0.5 0\n       ^~\n"
           "t.mtl:3:4: warning: Ns 2e+06 is taken as 1e+06\n    Ns 2e6\n       ^~~\n"
           "t.mtl:4:4: warning: Ns -3 is taken as 0\n    Ns -3\n       ^~\n"
           "t.mtl:5:3: warning: d 1.5 is taken as 1\n    d 1.5\n      ^~~\n"
           "t.mtl:6:4: warning: Ni 0 is not above 0; it is left out\n    Ni 0\n       ^\n");
}

static void test_errors(void **state)
{
    (void)state;
    expect("newmtl a\nKd x 1 1\nKs 1 1\nNs\nd 1 1\nNi nan\nTr 1e39\nKe 1 1 1 1\n",
           "a 1\n"
           "t.mtl:2:4: error: 'x' is not a number\n    Kd x 1 1\n       ^\n"
           "t.mtl:3:6: error: Ks needs 1 or 3 numbers, here are 2\n    Ks 1 1\n         ^\n"
           "t.mtl:4:3: error: Ns needs a number\n    Ns\n      ^\n"
           "t.mtl:5:5: error: unexpected '1' after d\n    d 1 1\n        ^\n"
           "t.mtl:6:4: error: 'nan' is not a number\n    Ni nan\n       ^~~\n"
           "t.mtl:7:4: error: 1e39 is above 3.40282e+38\n    Tr 1e39\n       ^~~~\n"
           "t.mtl:8:10: error: unexpected '1' after Ke\n    Ke 1 1 1 1\n             ^\n");
    expect("newmtl  \n", " 1\nt.mtl:1:9: error: newmtl needs a name\n    newmtl  \n            ^\n");
    expect_bytes("newmtl a\nd 1\0 \n", 14,
                 "a 1\nt.mtl:2:3: error: '1' is not a number\n    d 1  \n      ^~\n");
}

static void check_crasher(const char *path)
{
    Diagnostics *diagnostics = diagnostics_create();
    assert_non_null(diagnostics);
    MtlFile mtl;
    Error error;
    if (!mtl_read(path, diagnostics, &mtl, &error))
        fail_msg("%s: %s", path, error.text);
    for (u32 i = 0; i < mtl.count; ++i)
        assert_non_null(mtl.materials[i].name);
    mtl_destroy(&mtl);
    diagnostics_destroy(diagnostics);
}

static void test_crashers(void **state)
{
    (void)state;
    assert_true(for_each_crasher(".mtl", check_crasher) >= 5);
}

static void test_failures(void **state)
{
    (void)state;
    Diagnostics *diagnostics = diagnostics_create();
    MtlFile mtl;
    Error error;
    assert_false(mtl_read("missing.mtl", diagnostics, &mtl, &error));
    assert_int_equal(error.code, ERROR_IO);
    assert_string_equal(error.text, strerror(ENOENT));
    assert_null(mtl.arena);
    assert_int_equal(diagnostics_error_count(diagnostics), 0);
    diagnostics_destroy(diagnostics);
}

// More materials than an array begins with.
static void test_many(void **state)
{
    (void)state;
    FILE *file = fopen("t.mtl", "wb");
    assert_non_null(file);
    enum { COUNT = 3000 };
    for (u32 i = 0; i < COUNT; ++i)
        fprintf(file, "newmtl material%u\nKd 0.%u 0 0\nmap_Kd image%u.png\n", i, i, i);
    fclose(file);
    Diagnostics *diagnostics = diagnostics_create();
    MtlFile mtl;
    Error error;
    assert_true(mtl_read("t.mtl", diagnostics, &mtl, &error));
    assert_int_equal(mtl.count, COUNT);
    for (u32 i = 0; i < COUNT; ++i) {
        const MtlMaterial *m = &mtl.materials[i];
        char name[32], image[32], red[32];
        snprintf(name, sizeof name, "material%u", i);
        snprintf(image, sizeof image, "image%u.png", i);
        snprintf(red, sizeof red, "0.%u", i);
        assert_string_equal(m->name, name);
        assert_string_equal(m->map_kd, image);
        assert_int_equal(m->given, MTL_KD);
        assert_true(m->kd[0] == strtod(red, NULL));
        assert_int_equal(m->line, 3 * i + 1);
    }
    mtl_destroy(&mtl);
    diagnostics_destroy(diagnostics);
    unlink("t.mtl");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_materials), cmocka_unit_test(test_opacity), cmocka_unit_test(test_maps),
        cmocka_unit_test(test_skipped),   cmocka_unit_test(test_ranges),  cmocka_unit_test(test_errors),
        cmocka_unit_test(test_crashers),  cmocka_unit_test(test_failures), cmocka_unit_test(test_many),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
