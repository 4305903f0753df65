// Normals, texture coordinates and object spaces of meshes.
#include "layout_fixture.h"

#ifdef _OPENMP
#include <omp.h>
#endif

static const char checker[] = "texture t checker { scale 8 8 }\nmaterial m phong { diffuse t }\n";

// Vertex i of a sheet of n x n has the normal of its index; corners of faces name those of the next vertex.
static Vec3 normal_of(u32 i)
{
    return vec_normalize((Vec3){sin(i), cos(1.7 * i), 2});
}

static u32 corner_vertex(u32 n, u32 f, u32 k, u32 shift)
{
    const u32 y = f / (2 * n), x = f / 2 % n, a = y * (n + 1) + x;
    const u32 corners[2][3] = {{a, a + 1, a + n + 2}, {a, a + n + 2, a + n + 1}};
    return (corners[f % 2][k] + shift) % ((n + 1) * (n + 1));
}

// Normals are carried by the inverse transpose, all by one factor that makes the longest one 1.
static void check_normals(const Layout *l, const MeshRun *run, u32 n, Affine map)
{
    assert_true(run->flags & MESH_NORMALS);
    f64 longest = 0, factor = 0;
    for (u32 f = 0; f < 2 * n * n; f++) {
        for (u32 k = 0; k < 3; k++) {
            const u32 index = l->mesh_indices[run->corner_normals + 3 * f + k];
            if (f == 0) {
                assert_int_equal(index, NO_INDEX);
                continue;
            }
            assert_true(index < l->mesh_normal_count);
            const f32 *found = l->mesh_normals[index];
            const Vec3 carried = {(f64)found[0], (f64)found[1], (f64)found[2]};
            const Vec3 normal = normal_of(corner_vertex(n, f, k, 1));
            assert_vec_near(vec_normalize(carried), affine_normal(map, normal), 2e-7);
            // The inverse transpose, undone: the normal again, times the factor.
            const f64 here = vec_dot(carried, affine_direction(map, normal));
            if (factor == 0)
                factor = here;
            assert_near(here / factor, 1, 2e-6);
            longest = fmax(longest, vec_length(carried));
        }
    }
    assert_true(longest <= 1 + 1e-7);
    for (u32 i = 0; i < l->mesh_normal_count; i++) {
        const f32 *v = l->mesh_normals[i];
        longest = fmax(longest, vec_length((Vec3){(f64)v[0], (f64)v[1], (f64)v[2]}));
    }
    assert_near(longest, 1, 1e-6);
}

static void test_normals(void **state)
{
    (void)state;
    Layout *l =
        layout_good("mesh { file \"grid9 normals\" scale 1 3 -0.5 rotate 1 1 0 50 translate 3 2 1 }\n");
    const Affine map = affine_compose(affine_rotate((Vec3){1, 1, 0}, 50), affine_scale((Vec3){1, 3, -0.5}));
    assert_int_equal(l->mesh_normal_count, 100);
    assert_int_equal(l->mesh_index_count, 3 * 162);
    assert_int_equal(l->mesh_runs[0].flags, MESH_NORMALS | MESH_MIRRORED);
    check_normals(l, &l->mesh_runs[0], 9, map);
    layout_destroy(l);
    // Extremes: factors whose squares leave the range.
    l = layout_good("mesh { file \"grid9 normals\" scale 1e-36 }\n");
    check_normals(l, &l->mesh_runs[0], 9, affine_scale((Vec3){1e-36, 1e-36, 1e-36}));
    layout_destroy(l);
    // Shadow rays start above smooth faces only, and where there is light.
    l = layout_good("mesh { file \"grid9 normals\" terminator on }\nlight directional { direction 0 -1 0 }\n");
    assert_int_equal(l->mesh_runs[0].flags, MESH_NORMALS | MESH_TERMINATOR);
    assert_true(features_have(l->features, FEATURE_TERMINATOR));
    layout_destroy(l);
    l = layout_good("mesh { file \"grid9 normals\" terminator on }\n");
    assert_false(features_have(l->features, FEATURE_TERMINATOR));
    layout_destroy(l);
    l = layout_good("mesh { file \"grid9 normals\" terminator on smooth off }\n"
                    "light directional { direction 0 -1 0 }\n");
    assert_int_equal(l->mesh_runs[0].flags, 0);
    assert_false(features_have(l->features, FEATURE_TERMINATOR));
    layout_destroy(l);
    // Flat where it is asked for.
    l = layout_good("mesh { file \"grid9 normals\" smooth off }\n");
    assert_int_equal(l->mesh_runs[0].flags, 0);
    assert_int_equal(l->mesh_normal_count, 0);
    layout_destroy(l);
}

// Each placed mesh has normals of its own, each part the corners from its first face on.
static void test_normals_of_parts(void **state)
{
    (void)state;
    Layout *l = layout_good("material a phong { } material b phong { }\n"
                            "mesh { file \"grid4 normals parts\" rotate x 90 }\n"
                            "mesh { file \"grid4 normals parts\" rotate z 90 }\n");
    assert_int_equal(l->mesh_run_count, 6);
    assert_int_equal(l->mesh_normal_count, 50);
    static const u32 firsts[] = {0, 8, 16, 32, 40, 48};
    for (u32 i = 0; i < 6; i++) {
        const MeshRun *run = &l->mesh_runs[i];
        assert_int_equal(run->first, firsts[i]);
        assert_int_equal(run->order_low, firsts[i]);
        const u32 f = 3, index = l->mesh_indices[run->corner_normals + 3 * f + 1];
        const u32 vertex = corner_vertex(4, firsts[i] % 32 + f, 1, 1);
        assert_int_equal(index, vertex + (i < 3 ? 0 : 25));
        const Vec3 n = normal_of(vertex);
        const f32 *found = l->mesh_normals[index];
        const Vec3 turned = i < 3 ? (Vec3){n.x, -n.z, n.y} : (Vec3){-n.y, n.x, n.z};
        assert_vec_near((Vec3){(f64)found[0], (f64)found[1], (f64)found[2]}, turned, 2e-7);
    }
    layout_destroy(l);
}

// Texture coordinates are stored once a file, wherever it is placed, and only where they are wanted.
static void test_uvs(void **state)
{
    (void)state;
    char text[1000];
    snprintf(text, sizeof text, "%s%s", checker,
             "mesh { file \"grid4 uvs\" material m }\nmesh { file \"grid3 uvs normals\" }\n"
             "object o { mesh { file \"grid4 uvs\" material m } mesh { file \"grid2\" } }\n"
             "instance o { } instance o { }\n");
    Layout *l = layout_good(text);
    assert_true(features_have(l->features, FEATURE_MESH_UVS));
    assert_int_equal(l->mesh_run_count, 4);
    assert_int_equal(l->mesh_uv_count, 25 + 16);
    assert_int_equal(l->mesh_index_count, 3 * (32 + 18 + 18));
    assert_int_equal(l->mesh_runs[0].corner_uvs, l->mesh_runs[2].corner_uvs);
    assert_int_equal(l->mesh_runs[1].flags, MESH_UVS | MESH_NORMALS);
    assert_int_equal(l->mesh_runs[3].flags, 0);
    const u32 sides[] = {4, 3};
    for (u32 i = 0; i < 2; i++) {
        const u32 *corners = l->mesh_indices + l->mesh_runs[i].corner_uvs;
        for (u32 c = 0; c < 6 * sides[i] * sides[i]; c++) {
            const u32 vertex = corner_vertex(sides[i], c / 3, c % 3, 2);
            assert_true(c < 3 ? corners[c] == NO_INDEX
                              : l->mesh_uvs[corners[c]][0] == (f32)vertex &&
                                    l->mesh_uvs[corners[c]][1] == -(f32)vertex);
        }
    }
    layout_destroy(l);
    l = layout_good("mesh { file \"grid4 uvs\" }\n");
    assert_int_equal(l->mesh_runs[0].flags, 0);
    assert_int_equal(l->mesh_uv_count, 0);
    assert_int_equal(l->mesh_index_count, 0);
    layout_destroy(l);
}

// A mesh has one frame, behind those of the primitives.
static void test_frames(void **state)
{
    (void)state;
    Layout *l = layout_good("texture t checker3d { }\nmaterial m phong { diffuse t }\n"
                            "sphere { center 0 0 -4 radius 1 material m }\n"
                            "mesh { file \"grid3\" material m scale 2 translate 10 0 0 }\n"
                            "plane { point 0 0 0 normal 0 1 0 }\n"
                            "object o { mesh { file \"grid3 parts\" translate 0 7 0 } }\n"
                            "instance o { } instance o { translate 0 0 1 }\n"
                            "camera { position 1 0 0 look_at 0 0 0 }\n");
    assert_int_equal(l->primitive_count, 4);
    assert_int_equal(l->frame_count, 6);
    assert_int_equal(l->mesh_runs[0].frame, 4);
    assert_int_equal(l->mesh_runs[1].frame, 5);
    const ObjectFrame *top = &l->frames[4], *inner = &l->frames[5];
    assert_true(top->row0.x == 0.5f && top->row1.y == 0.5f);
    assert_true(top->row0.w + top->normal0.w == -4.5f); // (x + 1 - 10) / 2
    assert_true(inner->row1.y == 1 && inner->row1.w == -7 && inner->row0.w == 0);
    layout_destroy(l);
}

// Any number of threads makes the same bytes.
static void test_threads(void **state)
{
    (void)state;
#ifdef _OPENMP
    char text[1000];
    snprintf(text, sizeof text, "%s%s", checker,
             "mesh { file \"grid90 normals uvs\" material m rotate 1 1 1 20 }\n"
             "sphere { center 0 0 0 radius 1 }\n"
             "object o { mesh { file \"grid90 normals uvs\" } }\ninstance o { } instance o { }\n");
    const int threads = omp_get_max_threads();
    omp_set_num_threads(1);
    Layout *one = layout_good(text);
    omp_set_num_threads(5);
    Layout *more = layout_good(text);
    omp_set_num_threads(threads);
    LayoutArray a[LAYOUT_ARRAYS], b[LAYOUT_ARRAYS];
    layout_arrays(one, a);
    layout_arrays(more, b);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++) {
        assert_int_equal(a[i].bytes, b[i].bytes);
        if (a[i].bytes > 0)
            assert_memory_equal(a[i].data, b[i].data, a[i].bytes);
    }
    layout_destroy(one);
    layout_destroy(more);
#else
    skip();
#endif
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_normals), cmocka_unit_test(test_normals_of_parts),
        cmocka_unit_test(test_uvs),     cmocka_unit_test(test_frames),
        cmocka_unit_test(test_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
