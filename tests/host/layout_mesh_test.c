// Meshes: what becomes of their triangles in the leaves, against the map in double, and what is told of their
// faces: order, materials, whether light may pass.
#include "layout_fixture.h"

#include <float.h>
#include <time.h>

// A scene and its layout side by side.
typedef struct Both {
    Parsed parsed;
    Scene *scene;
    Layout *layout;
} Both;

static Both both_good(const char *text)
{
    Both both = {.parsed = parse_good(text)};
    Error error = {0};
    both.scene = both.parsed.scene;
    meshes_attach(both.scene);
    both.layout = layout_create(both.scene, &error);
    if (!both.layout)
        fail_msg("%s\n%s", error.text, text);
    return both;
}

static void both_end(Both *both)
{
    layout_destroy(both->layout);
    meshes_detach(both->scene);
    parsed_end(&both->parsed);
}

// The triangle of a face, and the blocks' word for it.
typedef struct Found {
    f32 vertex[3][3];
    u32 word;
    u32 times;
} Found;

static void note_block(const TriangleBlock *block, Found *found, u32 face_count, const f32 low[3],
                       const f32 high[3])
{
    bool ended = false;
    for (u32 lane = 0; lane < BLOCK_WIDTH; lane++) {
        ended = ended || block->face[lane] == NO_INDEX;
        if (ended) { // unused lanes come last
            assert_int_equal(block->face[lane], NO_INDEX);
            for (int i = 0; i < 9; i++)
                assert_true(isnan(block->vertex[i / 3][i % 3][lane]));
            continue;
        }
        const u32 face = block->face[lane] & ~FACE_TRANSMITS;
        assert_true(face < face_count);
        found[face].word = block->face[lane];
        found[face].times++;
        f32 largest = 0;
        for (int i = 0; i < 9; i++) {
            found[face].vertex[i / 3][i % 3] = block->vertex[i / 3][i % 3][lane];
            largest = fmaxf(largest, fabsf(found[face].vertex[i / 3][i % 3]));
        }
        const f64 pad = 8 * ldexp(1, -24) * (f64)largest;
        for (int i = 0; i < 9; i++) {
            const f64 v = (f64)found[face].vertex[i / 3][i % 3];
            assert_true((f64)low[i % 3] <= fmax(v - pad, (f64)-FLT_MAX));
            assert_true((f64)high[i % 3] >= fmin(v + pad, (f64)FLT_MAX));
        }
    }
    assert_true(block->face[0] != NO_INDEX);
}

// Walks a hierarchy, each node, block and primitive once; boxes hold what is below them.
static void walk(const Layout *l, u32 at, const f32 low[3], const f32 high[3], Found *found, u32 faces,
                 u32 *primitives)
{
    assert_true(at < l->node_count);
    const BvhNode *node = &l->nodes[at];
    for (u32 k = 0; k < BVH_WIDTH && node->lower_x[k] <= node->upper_x[k]; k++) {
        const f32 inner_low[3] = {node->lower_x[k], node->lower_y[k], node->lower_z[k]};
        const f32 inner_high[3] = {node->upper_x[k], node->upper_y[k], node->upper_z[k]};
        for (int axis = 0; axis < 3; axis++)
            assert_true(low[axis] <= inner_low[axis] && inner_high[axis] <= high[axis]);
        if (node->child[k] >= 0) {
            walk(l, (u32)node->child[k], inner_low, inner_high, found, faces, primitives);
        } else if (~(u32)node->child[k] & 1) {
            const u32 block = ~(u32)node->child[k] >> 1;
            assert_true(block < l->block_count);
            note_block(&l->blocks[block], found, faces, inner_low, inner_high);
        } else {
            assert_true(~(u32)node->child[k] >> 1 < l->primitive_count);
            (*primitives)++;
        }
    }
}

// All faces of the hierarchy of a root; *primitives: how many leaves of one. found is the caller's to free.
static Found *faces_below(const Layout *l, u32 root, u32 face_count, u32 *primitives)
{
    const f32 low[3] = {-INFINITY, -INFINITY, -INFINITY}, high[3] = {INFINITY, INFINITY, INFINITY};
    Found *found = calloc(face_count + (size_t)1, sizeof *found);
    *primitives = 0;
    walk(l, root, low, high, found, face_count, primitives);
    return found;
}

// The `count` faces from number `first` on are those of the mesh under the map, to the bit.
static void check_faces(const Found *found, u32 first, const Mesh *mesh, Affine map)
{
    for (u32 f = 0; f < mesh->face_count; f++) {
        assert_int_equal(found[first + f].times, 1);
        for (int corner = 0; corner < 3; corner++) {
            const Vec3 p = affine_point(map, mesh->positions[mesh->faces[f][corner]]);
            const f32 *v = found[first + f].vertex[corner];
            assert_true(v[0] == (f32)p.x && v[1] == (f32)p.y && v[2] == (f32)p.z);
        }
    }
}

static void test_alone(void **state)
{
    (void)state;
    Both b = both_good("camera { position 1000000.125 2 3 look_at 1000000 2 0 }\n"
                       "mesh { file \"grid20\" rotate 1 2 3 35 scale 1 2 1 translate 1000000 0 -4 }\n");
    const Layout *l = b.layout;
    const Shape *shape = &b.scene->shapes[0];
    u32 primitives;
    Found *found = faces_below(l, l->root, 800, &primitives);
    assert_int_equal(primitives, 0);
    assert_int_equal(l->primitive_count, 0);
    check_faces(found, 0, shape->as.mesh.mesh,
                affine_compose(affine_translate(vec_scale(b.scene->camera.position, -1)), shape->transform));
    free(found);
    assert_int_equal(l->mesh_run_count, 1);
    assert_int_equal(l->params.mesh_run_count, 1);
    const MeshRun *run = l->mesh_runs;
    assert_true(run->first == 0 && run->material == 0 && run->order_low == 0 && run->order_high == 0);
    assert_true(run->flags == 0 && run->corner_normals == NO_INDEX && run->corner_uvs == NO_INDEX);
    assert_null(l->mesh_indices);
    assert_null(l->frames);
    assert_int_equal((uintptr_t)l->blocks % 4096, 0);
    both_end(&b);
}

// Primitives and meshes in one hierarchy; a mesh takes as many places in the order as it has faces.
static void test_beside_shapes(void **state)
{
    (void)state;
    Both b = both_good("plane { point 0 -1 0 normal 0 1 0 }\nsphere { center 0 0 -4 radius 1 }\n"
                       "mesh { file \"grid4\" }\nbox { min 0 0 0 max 1 1 1 }\n"
                       "mesh { file \"grid5\" scale -1 1 1 }\nmesh { file \"grid4\" translate 0 0 1 }\n"
                       "cone { base 0 0 0 top 0 1 0 radius 1 }\n");
    const Layout *l = b.layout;
    u32 primitives;
    Found *found = faces_below(l, l->root, 32 + 50 + 32, &primitives);
    assert_int_equal(primitives, 3);
    assert_int_equal(l->primitive_count, 4);
    static const u32 shapes[] = {2, 4, 5}, firsts[] = {0, 32, 82}, orders[] = {2, 35, 85};
    const Affine to_camera = affine_translate(vec_scale(b.scene->camera.position, -1));
    assert_int_equal(l->mesh_run_count, 3);
    for (int i = 0; i < 3; i++) {
        const Shape *shape = &b.scene->shapes[shapes[i]];
        check_faces(found, firsts[i], shape->as.mesh.mesh, affine_compose(to_camera, shape->transform));
        assert_int_equal(l->mesh_runs[i].first, firsts[i]);
        assert_int_equal(l->mesh_runs[i].order_low, orders[i]);
        assert_int_equal(l->mesh_runs[i].flags, i == 1 ? MESH_MIRRORED : 0);
    }
    for (u32 i = 0; i < l->primitive_count; i++) {
        const u32 kind = kind_of(&l->primitives[i]);
        assert_int_equal(order_of(l, i), kind == PRIMITIVE_PLANE    ? 0
                                         : kind == PRIMITIVE_SPHERE ? 1
                                         : kind == PRIMITIVE_BOX    ? 34
                                                                    : 117);
    }
    free(found);
    both_end(&b);
}

static u32 instance_root(const Layout *l, u32 i)
{
    u32 root;
    memcpy(&root, &l->primitives[i].p0, sizeof root);
    return root;
}

// Placed more than once, a mesh is stored once, in the space of its object; placed once, at the top.
static void test_instances(void **state)
{
    (void)state;
    const char *objects = "object one { mesh { file \"grid6\" translate 1 0 0 } }\n"
                          "object pair { instance one { } instance one { translate 0 1 0 } }\n"
                          "object more { sphere { center 0 0 0 radius 1 } instance one { } }\n";
    char text[1000];
    snprintf(text, sizeof text, "%s%s", objects, "box { min 0 0 0 max 1 1 1 }\ninstance pair { }\n"
                                                 "instance more { scale 2 }\n");
    Both b = both_good(text);
    const Layout *l = b.layout;
    assert_int_equal(count_kind(l, PRIMITIVE_INSTANCE), 3);
    assert_int_equal(count_kind(l, PRIMITIVE_SPHERE), 1);
    assert_int_equal(l->mesh_run_count, 1);
    u32 primitives, root = NO_INDEX, places = 0;
    for (u32 i = 0; i < l->primitive_count; i++) {
        if (kind_of(&l->primitives[i]) != PRIMITIVE_INSTANCE)
            continue;
        assert_true(root == NO_INDEX || root == instance_root(l, i));
        root = instance_root(l, i);
        assert_int_equal(l->infos[i].material, NO_INDEX);
        places += (u32)order_of(l, i);
    }
    assert_int_equal(places, 1 + 73 + 146); // behind the box, the faces, and more faces and a sphere
    Found *found = faces_below(l, root, 72, &primitives);
    assert_int_equal(primitives, 0);
    check_faces(found, 0, b.scene->meshes, affine_translate((Vec3){1, 0, 0}));
    free(found);
    free(faces_below(l, l->root, 0, &primitives));
    assert_int_equal(primitives, 5);
    both_end(&b);
    snprintf(text, sizeof text, "%s%s", objects, "camera { position 0 0 0 look_at 0 0 -1 }\n"
                                                 "instance more { scale 2 }\n");
    b = both_good(text);
    assert_int_equal(count_kind(b.layout, PRIMITIVE_INSTANCE), 0);
    found = faces_below(b.layout, b.layout->root, 72, &primitives);
    assert_int_equal(primitives, 1);
    check_faces(found, 0, b.scene->meshes,
                affine_compose(affine_scale((Vec3){2, 2, 2}), affine_translate((Vec3){1, 0, 0})));
    assert_int_equal(b.layout->mesh_runs[0].order_low, 1);
    free(found);
    both_end(&b);
}

#define MATERIALS "material a phong { }\nmaterial b phong { }\nmaterial c phong { transmit 0.5 }\n"

typedef struct ExpectedRun {
    u32 first, material;
    bool transmits;
} ExpectedRun;

static void expect_runs(const char *text, const ExpectedRun *expected, u32 count)
{
    Layout *l = layout_good(text);
    assert_int_equal(l->mesh_run_count, count);
    for (u32 i = 0; i < count; i++) {
        assert_int_equal(l->mesh_runs[i].first, expected[i].first);
        assert_int_equal(l->mesh_runs[i].material, expected[i].material);
    }
    for (u32 i = 0; i < l->block_count * BLOCK_WIDTH; i++) {
        const u32 word = l->blocks[i / BLOCK_WIDTH].face[i % BLOCK_WIDTH];
        u32 run = count - 1;
        if (word == NO_INDEX)
            continue;
        while ((word & ~FACE_TRANSMITS) < expected[run].first)
            run--;
        assert_int_equal((word & FACE_TRANSMITS) != 0, expected[run].transmits);
    }
    layout_destroy(l);
}

// Own material, else the nearest instance's, else the file's, else the default; parts of one material are one
// run. The parts of the sheet begin at a quarter and a half and are of materials a, none, b.
static void test_materials(void **state)
{
    (void)state;
    const u32 inherited = MATERIAL_INHERITED;
    expect_runs(MATERIALS "mesh { file \"grid2 parts\" }",
                (ExpectedRun[]){{0, 1, false}, {2, 0, false}, {4, 2, false}}, 3);
    expect_runs(MATERIALS "mesh { file \"grid2 parts\" material c }", (ExpectedRun[]){{0, 3, true}}, 1);
    // Baked where it is placed once.
    expect_runs(MATERIALS "object o { mesh { file \"grid2 parts\" } }\ninstance o { material c }",
                (ExpectedRun[]){{0, 3, true}}, 1);
    expect_runs(MATERIALS "object o { mesh { file \"grid2 parts\" material b } }\ninstance o { material c }",
                (ExpectedRun[]){{0, 2, false}}, 1);
    // Left to the instances, and as transparent as the most transparent of them.
    const u32 a = 1 | inherited, none = inherited, b = 2 | inherited;
    const ExpectedRun opaque[] = {{0, a, false}, {2, none, false}, {4, b, false}};
    const ExpectedRun clear[] = {{0, a, true}, {2, none, true}, {4, b, true}};
    const ExpectedRun first_clear[] = {{0, a, true}, {2, none, false}, {4, b, false}};
    const char *object = MATERIALS "object o { mesh { file \"grid2 parts\" } }\n";
    char text[1000];
    snprintf(text, sizeof text, "%sinstance o { } instance o { material a }\n", object);
    expect_runs(text, opaque, 3);
    snprintf(text, sizeof text, "%s%s", object,
             "object p { instance o { } } instance o { } instance p { material c }\n");
    expect_runs(text, clear, 3);
    snprintf(text, sizeof text, "%sinstance o { material c } instance o { material a }\n", object);
    expect_runs(text, clear, 3);
    // The file's own count where an instance names none.
    const char *glass = "material a phong { transmit 1 } material b phong { }\n"
                        "object o { mesh { file \"grid2 parts\" } }\n";
    snprintf(text, sizeof text, "%sinstance o { } instance o { }\n", glass);
    expect_runs(text, first_clear, 3);
    snprintf(text, sizeof text, "%sinstance o { material b } instance o { material b }\n", glass);
    expect_runs(text, opaque, 3);
}

// The features of a file's materials count where they can be seen.
static void test_materials_used(void **state)
{
    (void)state;
    const char *object = "material a phong { reflect 1 }\nmaterial b phong { emission 1 }\n"
                         "object o { mesh { file \"grid2 parts\" } }\n";
    static const struct {
        const char *placed;
        bool reflects, glows;
    } cases[] = {{"instance o { }", true, true},
                 {"instance o { material b }", false, true},
                 {"instance o { } instance o { }", true, true},
                 {"instance o { material a } instance o { material a }", true, false},
                 {"instance o { material b } instance o { }", true, true},
                 {"mesh { file \"grid2 parts\" material default }", false, false}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s\n", object, cases[i].placed);
        const FeatureSet set = features_of(text);
        assert_int_equal(features_have(set, FEATURE_REFLECT), cases[i].reflects);
        assert_int_equal(features_have(set, FEATURE_EMISSION), cases[i].glows);
    }
}

static void test_out_of_range(void **state)
{
    (void)state;
    const Error error = layout_error("\n mesh { file \"grid3\" scale 1e30 scale 1e30 }\n");
    assert_int_equal(error.code, ERROR_SCENE);
    assert_non_null(strstr(error.text, "t:2:2: error: "));
    const Error inner = layout_error("object o { mesh { file \"grid3\" translate 3e38 0 0 scale 9 } }\n"
                                     "instance o { } instance o { }\n");
    assert_int_equal(inner.code, ERROR_SCENE);
    assert_non_null(strstr(inner.text, "t:1:12: error: "));
    // Vertices of no face do not matter.
    Layout *l = layout_good("mesh { file \"grid3 far\" }\n");
    assert_true(l->nodes[l->root].upper_x[0] < 2);
    layout_destroy(l);
    // Near the end of the range the boxes stay finite.
    l = layout_good("mesh { file \"grid3\" scale 3.4028234e38 }\n");
    u32 primitives;
    assert_true(l->nodes[l->root].upper_x[0] <= FLT_MAX);
    free(faces_below(l, l->root, 18, &primitives));
    layout_destroy(l);
}

static f64 bytes_of(const Layout *l)
{
    LayoutArray arrays[LAYOUT_ARRAYS];
    f64 bytes = 0;
    layout_arrays(l, arrays);
    for (u32 i = 0; i < LAYOUT_ARRAYS; i++)
        bytes += (f64)arrays[i].bytes;
    return bytes;
}

// A hundred thousand placements of a mesh take their own time and a few hundred bytes each, not the mesh's.
static void test_many_instances(void **state)
{
    (void)state;
    char text[4000] = "object ten0 { mesh { file \"grid100 normals\" } }\n";
    for (int k = 1; k <= 5; k++) {
        snprintf(text + strlen(text), sizeof text - strlen(text), "object ten%d {\n", k);
        for (int i = 0; i < 10; i++)
            snprintf(text + strlen(text), sizeof text - strlen(text),
                     "instance ten%d { translate %d %d 0 }\n", k - 1, i * k, k);
        strcat(text, "}\n");
    }
    strcat(text, "instance ten5 { }\n");
    const clock_t start = clock();
    Layout *l = layout_good(text);
    const f64 seconds = (f64)(clock() - start) / CLOCKS_PER_SEC;
    Layout *single = layout_good("mesh { file \"grid100 normals\" }\n");
    assert_int_equal(count_kind(l, PRIMITIVE_INSTANCE), 100000);
    assert_true(bytes_of(l) - bytes_of(single) < 300.0 * 100000);
    layout_destroy(single);
    layout_destroy(l);
    if (seconds > 5)
        fail_msg("%.2f s for 100 000 placements of a mesh", seconds);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_alone),        cmocka_unit_test(test_beside_shapes),
        cmocka_unit_test(test_instances),    cmocka_unit_test(test_materials),
        cmocka_unit_test(test_materials_used), cmocka_unit_test(test_out_of_range),
        cmocka_unit_test(test_many_instances),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
