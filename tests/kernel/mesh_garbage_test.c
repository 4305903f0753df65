// Equal triangles, triangles that are none and rays that are none.
#include "mesh_support.h"

#include <math.h>
#include <string.h>

// Of triangles in one place the first of the file is hit, in every variant; the others follow at the same t.
static void the_first_of_equals_is_hit(void **state)
{
    enum { COPIES = 12, TRIANGLES = 100 };
    u64 random = 9;
    TriangleList soup = triangles_soup(TRIANGLES, false, &random);
    for (u32 i = TRIANGLES; i < COPIES * TRIANGLES; i++) {
        // Each time in another order.
        const Vec3 *v = soup.vertices + 3 * ((i * 37 + i / TRIANGLES) % TRIANGLES);
        const Vec3 a = v[0], b = v[1], c = v[2];
        triangles_add(&soup, a, b, c);
    }
    const Affine identity = affine_identity();
    Layout *layout = mesh_layout(&soup, &identity, false);
    FaceTable faces = face_table_create(layout);
    Rays rays = rays_create(2048);
    rays_aim_at_soup(&rays, &faces, 1, (Vec3){0, 0, 0}, &random);
    for (int k = 0; k < VARIANTS; k++) {
        KernelProgram *program = walk_program(*state, mesh_variants[k], false);
        walk(program, mesh_variants[k], layout, COPIES, &rays);
        u32 hits = 0;
        for (u32 i = 0; i < rays.count; i++) {
            hits += rays.crossings[i] > 0;
            assert_true(rays.crossings[i] == 0 || rays.face[i] < TRIANGLES);
            assert_true(rays.crossings[i] == 0 || rays.crossings[i] == COPIES);
        }
        assert_true(hits > rays.count / 4);
        kernel_program_destroy(program);
    }
    rays_destroy(&rays);
    face_table_destroy(&faces);
    layout_destroy(layout);
    triangles_destroy(&soup);
}

// Makes faces that are no triangles of those whose number is not a multiple of 5: two equal vertices, three,
// or numbers that are none.
static void spoil(Layout *layout)
{
    for (u32 i = 0; i < layout->block_count * BLOCK_WIDTH; i++) {
        TriangleBlock *block = &layout->blocks[i / BLOCK_WIDTH];
        const u32 lane = i % BLOCK_WIDTH, kind = block->face[lane] % 5;
        if (block->face[lane] == NO_INDEX)
            continue;
        for (int axis = 0; axis < 3; axis++) {
            f32 *a = &block->vertex[0][axis][lane], *b = &block->vertex[1][axis][lane];
            f32 *c = &block->vertex[2][axis][lane];
            if (kind == 1)
                *b = *a;
            else if (kind == 2)
                *c = *a;
            else if (kind == 3)
                *b = *c = *a;
            else if (kind == 4 && axis == (int)(lane % 3))
                *b = lane % 2 ? NAN : INFINITY;
        }
    }
}

static void spoilt_faces_are_never_hit(void **state)
{
    u64 random = 13;
    TriangleList soup = triangles_soup(1500, false, &random);
    const Affine identity = affine_identity();
    Layout *layout = mesh_layout(&soup, &identity, false);
    FaceTable faces = face_table_create(layout);
    Rays rays = rays_create(4096);
    rays_aim_at_soup(&rays, &faces, 1, (Vec3){0, 0, 0}, &random);
    spoil(layout);
    for (int k = 0; k < VARIANTS; k++) {
        KernelProgram *program = walk_program(*state, mesh_variants[k], false);
        walk(program, mesh_variants[k], layout, 64, &rays);
        u32 hits = 0;
        for (u32 i = 0; i < rays.count; i++) {
            assert_true(isfinite(rays.t[i]) && rays.crossings[i] < 64);
            assert_true(rays.crossings[i] == 0 || rays.face[i] % 5 == 0);
            hits += rays.crossings[i] > 0;
        }
        assert_true(hits > 100);
        kernel_program_destroy(program);
    }
    rays_destroy(&rays);
    face_table_destroy(&faces);
    layout_destroy(layout);
    triangles_destroy(&soup);
}

// pbrt-v4, src/pbrt/shapes_test.cpp, Triangle.BadCases: corners on a line.
static void a_line_is_not_hit(void **state)
{
    TriangleList list = {.vertices = NULL};
    triangles_add(&list, (Vec3){-1113.45459, -79.049614, -56.2431908},
                  (Vec3){-1113.45459, -87.0922699, -56.2431908},
                  (Vec3){-1113.45459, -79.2090149, -56.2431908});
    const Affine identity = affine_identity();
    Layout *layout = mesh_layout(&list, &identity, false);
    Rays rays = rays_create(32);
    for (u32 i = 0; i < rays.count; i++) {
        rays_set(&rays, i, (f32[3]){-1081.47925F, 99.9999542F, 87.7701111F},
                 (f32[3]){-32.1072998F, -183.355865F, -144.607635F});
        rays.numbers[COLUMN_END * rays.count + i] = 0.9999F;
    }
    for (int k = 0; k < VARIANTS; k++) {
        KernelProgram *program = walk_program(*state, mesh_variants[k], false);
        walk(program, mesh_variants[k], layout, 1, &rays);
        for (u32 i = 0; i < rays.count; i++)
            assert_int_equal(rays.crossings[i], 0);
        kernel_program_destroy(program);
    }
    rays_destroy(&rays);
    layout_destroy(layout);
    triangles_destroy(&list);
}

// Half of the rays get numbers that are none, or no direction: these meet nothing and take no time, and the
// others, which share batches with them, go on as before.
static void garbage_meets_nothing(void **state)
{
    static const f32 bad[] = {NAN, INFINITY, -INFINITY};
    u64 random = 17;
    TriangleList sphere = triangles_icosphere(4);
    const Affine identity = affine_identity();
    Layout *layout = mesh_layout(&sphere, &identity, false);
    FaceTable faces = face_table_create(layout);
    Rays clean = rays_create(8192), dirty = rays_create(8192);
    rays_aim_at_soup(&clean, &faces, 0.3, (Vec3){0, 0, 0}, &random);
    memcpy(dirty.numbers, clean.numbers, RAY_COLUMNS * clean.count * sizeof(f32));
    for (u32 i = 0; i < dirty.count; i += 2) {
        const u32 what = (u32)(random_unit(&random) * 7);
        for (u32 k = 0; k < 3 && what == 6; k++)
            dirty.numbers[(COLUMN_DIR + k) * dirty.count + i] = 0;
        if (what < 6)
            dirty.numbers[what * dirty.count + i] = bad[i / 2 % 3];
    }
    for (int k = 0; k < VARIANTS; k++) {
        KernelProgram *program = walk_program(*state, mesh_variants[k], false);
        walk(program, mesh_variants[k], layout, 1, &clean);
        const double normal = walk(program, mesh_variants[k], layout, 1, &clean);
        const double slow = walk(program, mesh_variants[k], layout, 1, &dirty);
        for (u32 i = 0; i < dirty.count; i++) {
            assert_int_equal(dirty.crossings[i], i % 2 ? clean.crossings[i] : 0);
            assert_true(i % 2 == 0 || memcmp(&dirty.t[i], &clean.t[i], sizeof(f32)) == 0);
        }
        // Ten times the normal, and what a busy machine may add.
        assert_true(slow < 10 * normal + 1);
        kernel_program_destroy(program);
    }
    rays_destroy(&clean);
    rays_destroy(&dirty);
    face_table_destroy(&faces);
    layout_destroy(layout);
    triangles_destroy(&sphere);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_first_of_equals_is_hit),
        cmocka_unit_test(spoilt_faces_are_never_hit),
        cmocka_unit_test(a_line_is_not_hit),
        cmocka_unit_test(garbage_meets_nothing),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
