// The OBJ reader: all kinds of numbers, and files of many pieces; the same whatever the number of threads,
// the division, and the locale.
#include "assets_obj_expect.h"

#include <float.h>
#include <locale.h>
#include <math.h>

#ifdef _OPENMP
#include <omp.h>
#endif

static u64 next_random(u64 *state)
{
    *state = *state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return *state >> 33;
}

// Writes a number of one of eight forms, from 0 on.
static void random_number(u32 form, u64 *random, char *number, size_t size)
{
    const unsigned long long a = next_random(random), b = next_random(random), c = next_random(random);
    const f64 value = (f64)a / (f64)(b + 1) * (c & 1 ? -1 : 1);
    const int digits = (int)(c / 2 % 20), exponent = (int)(c / 64 % 60) - 30;
    const unsigned long long nine = 1000000000;
    switch (form) {
    case 0: snprintf(number, size, "%.*f", digits, value); break;
    case 1: snprintf(number, size, "%.*e", digits, value); break;
    case 2: snprintf(number, size, "%.17g", value); break;
    case 3: snprintf(number, size, "%llu%llu.%llu", a, b % 10000, c); break;
    case 4: snprintf(number, size, ".%0*llu", digits + 1, a); break;
    case 5: snprintf(number, size, "%llue%d", a, exponent); break;
    case 6: snprintf(number, size, "-0.%llu%010lluE%d", b, a, exponent); break;
    default: snprintf(number, size, "%llu%09llu%09llu%09llu", 1 + a % 9, a % nine, b % nine, c % nine);
    }
}

// Every number is that of strtod.
static void test_numbers(void **state)
{
    (void)state;
    enum { COUNT = 30000 };
    static f64 expected[COUNT];
    u64 random = 1;
    FILE *file = fopen("t.obj", "wb");
    assert_non_null(file);
    for (u32 i = 0; i < COUNT; ++i) {
        char number[80];
        random_number(i % 8, &random, number, sizeof number);
        expected[i] = strtod(number, NULL);
        if (fabs(expected[i]) > (f64)FLT_MAX) {
            strcpy(number, "0");
            expected[i] = 0;
        }
        fprintf(file, "%s %s%s", i % 3 == 0 ? "v" : "", number, i % 3 == 2 ? "\n" : "");
    }
    fclose(file);
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
        "9999999999999999999e-27", "9999999999999999999e-28", "1e22", "1e23", "8.5e22",
        "4.9406564584124654e-324", "1e-400", "0e999999999999", "0.000000000000000000000000000000001",
        "72057594037927945",
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
        const u32 opposite = a + size + 1;
        const u32 expected[3] = { a, i % 2 == 0 ? a + 1 : opposite, i % 2 == 0 ? opposite : a + size };
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
        cmocka_unit_test(test_numbers),
        cmocka_unit_test(test_rounding),
        cmocka_unit_test(test_grid),
        cmocka_unit_test(test_long_line),
        cmocka_unit_test(test_locale),
    };
    return cmocka_run_group_tests(tests, enter_folder, leave_folder);
}
