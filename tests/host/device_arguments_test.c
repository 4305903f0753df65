// Names of kernel arguments from source text, as used where a driver does not tell them.
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

#include "device/conditions.h"
#include "device/internal.h"

enum { NAMES = 8, SIZE = 16 };

static void finds_with(const char *options, const char *source, const char *kernel, i32 count,
                       const char *joined)
{
    char names[NAMES][SIZE] = {{0}};
    char all[NAMES * SIZE] = "";
    assert_int_equal(
        source_argument_names(source, strlen(source), options, kernel, names[0], SIZE, NAMES), count);
    for (i32 i = 0; i < count && i < NAMES; i++) {
        strcat(all, names[i]);
        strcat(all, " ");
    }
    assert_string_equal(all, joined);
}

static void finds(const char *source, const char *kernel, i32 count, const char *joined)
{
    finds_with("", source, kernel, count, joined);
}

static void reads_plain_kernels(void **state)
{
    (void)state;
    const char *source = "kernel void a(global float *x, const uint count) { x[0] = count; }\n"
                         "__kernel void b(__global const float4 *restrict rays,local int*scratch , float t)\n"
                         "{}\n"
                         "kernel void none(void) {}\nkernel void empty() {}\n";
    finds(source, "a", 2, "x count ");
    finds(source, "b", 3, "rays scratch t ");
    finds(source, "none", 0, "");
    finds(source, "empty", 0, "");
    finds(source, "x", -1, "");
}

static void passes_over_what_is_no_argument(void **state)
{
    (void)state;
    const char *source = "/* kernel void f(int wrong) */ // kernel void f(int wrong)\n"
                         "#define MANY kernel void f(int \\\n wrong)\n"
                         "void f_helper(int f); void f(int wrong);\n"
                         "kernel __attribute__((reqd_work_group_size(1, 1, 1))) void\n"
                         "f(global float *rays, // the rays, in order\n"
                         "  /* (a, b) */ constant Camera *camera,\n"
                         "#line 7 \"kernels/a, b.cl\"\n"
                         "  float4 weights)\n{ f_helper(1); }\n";
    finds(source, "f", 3, "rays camera weights ");
    finds(source, "f_helper", -1, "");
}

static void passes_over_what_stands_in_brackets(void **state)
{
    (void)state;
    const char *source = "kernel void f(local float sums[2 * (3, 4)], const uint n,\n"
                         "              float4 m __attribute__((aligned(16)))) {}\n";
    finds(source, "f", 3, "sums n m ");
}

static void prefers_the_whole_name(void **state)
{
    (void)state;
    const char *source = "kernel void shade_hits(int a) {} kernel void shade(int b) {} void kernel2(int c);";
    finds(source, "shade", 1, "b ");
    finds(source, "shade_hits", 1, "a ");
}

static void counts_beyond_the_room(void **state)
{
    (void)state;
    finds("kernel void f(int a, int b, int c, int d, int e, int f, int g, int h, int i, int j) {}", "f", 10,
          "a b c d e f g h ");
    finds("kernel void f(int a_name_longer_than_the_room_there_is) {}", "f", 1, "a_name_longer_t ");
}

static void passes_over_what_conditions_leave_out(void **state)
{
    (void)state;
    const char *source = "#if HAS_A\nvoid f(int wrong);\n#endif\n"
                         "kernel void f(global int *first,\n"
                         "#if HAS_A // the array, (or both\n"
                         "  global int *a, // (\n"
                         "#if HAS_B\n  global int *ab,\n#else\n  global int *a_only,\n#endif\n"
                         "#elif HAS_B || \\\n HAS_C\n  global int *b_or_c,\n"
                         "#endif\n"
                         "#line 3 \"a.cl\"\n"
                         "#if !HAS_A\n  /* #endif */ int not_a\n#else\n  int last\n#endif\n)\n"
                         "#if HAS_A\n{ }\n#endif\n";
    finds_with("-w -DHAS_A=0 -DHAS_B=0", source, "f", 2, "first not_a ");
    finds_with("-DHAS_A=1 -DHAS_B=0", source, "f", 4, "first a a_only last ");
    finds_with("-DHAS_A=1 -DHAS_B=1", source, "f", 4, "first a ab last ");
    finds_with("-DHAS_A=0 -DHAS_B=1", source, "f", 3, "first b_or_c not_a ");
    finds_with("-DHAS_C", source, "f", 3, "first b_or_c not_a ");
    const char *all = "kernel void g(\n#if HAS_A\nint a\n#endif\n) {}";
    finds_with("-DHAS_A=1", all, "g", 1, "a ");
    finds_with("-DHAS_A=0", all, "g", 0, "");
}

static void refuses_what_it_does_not_understand(void **state)
{
    (void)state;
    finds_with("", "kernel void f(\n#if A > 1\nint a,\n#endif\nint b) {}", "f", -1, "");
    finds_with("-DA=float", "kernel void f(\n#if A\nint a,\n#endif\nint b) {}", "f", -1, "");
    finds_with("", "kernel void f(\n#endif\nint b) {}", "f", -1, "");
    finds_with("", "kernel void f(\n#else\nint b) {}", "f", -1, "");
    finds_with("", "kernel void f(\n#if 0\nint b) {}", "f", -1, "");
    // Nor need it where that stands in a part that is left out.
    finds_with("", "kernel void f(\n#if 0\n#if A > 1\n#elif A > 2\n#endif\n#endif\nint b) {}", "f", 1, "b ");
    char deep[1024] = "kernel void f(\n";
    for (u32 i = 0; i < CONDITIONS_MAX + 1; i++)
        strcat(deep, "#if 1\n");
    strcat(deep, "int a) {}\n");
    finds_with("", deep, "f", -1, "");
    memcpy(deep + 15, "      ", 6); // one less
    finds_with("", deep, "f", 1, "a ");
}

static void survives_broken_text(void **state)
{
    (void)state;
    finds("", "f", -1, "");
    finds("kernel void f(", "f", -1, "");
    finds("kernel void f(int a", "f", -1, "");
    finds("kernel void f /*", "f", -1, "");
    finds("#define f \\", "f", -1, "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reads_plain_kernels),
        cmocka_unit_test(passes_over_what_is_no_argument),
        cmocka_unit_test(passes_over_what_stands_in_brackets),
        cmocka_unit_test(prefers_the_whole_name),
        cmocka_unit_test(counts_beyond_the_room),
        cmocka_unit_test(passes_over_what_conditions_leave_out),
        cmocka_unit_test(refuses_what_it_does_not_understand),
        cmocka_unit_test(survives_broken_text),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
