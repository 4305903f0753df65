// Objects and instances: what becomes of them, in which order, with which material, and where.
#include "layout_fixture.h"

#include <time.h>

// The only primitive of a kind.
static u32 find_kind(const Layout *layout, u32 kind)
{
    assert_int_equal(count_kind(layout, kind), 1);
    for (u32 i = 0; i < layout->primitive_count; i++)
        if (kind_of(&layout->primitives[i]) == kind)
            return i;
    return NO_INDEX;
}

static void test_empty(void **state)
{
    (void)state;
    Layout *layout = layout_good("");
    assert_int_equal(layout->primitive_count, 0);
    assert_int_equal(layout->node_count, 0);
    assert_int_equal(layout->root, NO_INDEX);
    assert_int_equal(layout->params.root, NO_INDEX);
    layout_destroy(layout);
    layout_destroy(NULL);
    layout = layout_good("object o { }\nobject p { instance o { } }\ninstance p { }\ninstance o { }\n");
    assert_int_equal(layout->primitive_count, 0);
    layout_destroy(layout);
}

// Planes come first and lie in no hierarchy.
static void test_planes(void **state)
{
    (void)state;
    Layout *layout = layout_good("sphere { center 0 0 -4 radius 1 }\nplane { point 0 0 0 normal 0 1 0 }\n"
                                 "object o { plane { point 0 1 0 normal 0 1 0 } box { min 0 0 0 max 1 1 1 }\n"
                                 "cone { base 0 0 0 top 0 1 0 radius 1 } }\n"
                                 "instance o { translate 0 5 0 }\ninstance o { rotate x 90 }\n");
    assert_int_equal(layout->plane_count, 3);
    assert_int_equal(layout->params.plane_count, 3);
    for (u32 i = 0; i < layout->primitive_count; i++)
        assert_true((kind_of(&layout->primitives[i]) == PRIMITIVE_PLANE) == (i < 3));
    // The object's plane is placed with each instance, in its place in the order.
    const f32x4 n = layout->primitives[1].row2;
    assert_true(n.x == 0 && n.y == 1 && n.z == 0 && layout->primitives[1].p0 == 6);
    assert_int_equal(order_of(layout, 0), 1);
    assert_int_equal(order_of(layout, 1), 2);
    assert_int_equal(order_of(layout, 2), 5);
    // Sphere and two instances at the top, then the two shapes once.
    assert_int_equal(layout->primitive_count, 3 + 3 + 2);
    layout_destroy(layout);
    layout = layout_good("plane { point 0 0 0 normal 0 1 0 }\n");
    assert_int_equal(layout->node_count, 0);
    assert_int_equal(layout->params.root, NO_INDEX);
    layout_destroy(layout);
}

// The place of a shape in the order of definition is that of its instance plus its own in the object.
static void test_order(void **state)
{
    (void)state;
    Layout *layout = layout_good("object inner { sphere { center 0 0 0 radius 1 }\n"
                                 "box { min 0 0 0 max 1 1 1 } }\n"
                                 "object outer { cone { base 0 0 0 top 0 1 0 radius 1 }\n"
                                 "instance inner { }\ndisk { center 0 0 0 normal 0 1 0 radius 1 }\n"
                                 "instance inner { translate 1 0 0 } }\n"
                                 "torus { center 0 0 0 axis 0 1 0 major 1 minor 0.2 }\n"
                                 "instance outer { }\n"
                                 "cylinder { base 0 0 0 top 0 1 0 radius 1 }\n");
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_TORUS)), 0);
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_CYLINDER)), 7);
    // In the space of their objects.
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_CONE)), 0);
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_DISK)), 3);
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_SPHERE)), 0);
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_BOX)), 1);
    // The placed objects, all of them at the top: outer from 1, the inner ones from 2 and from 5.
    u64 places = 0;
    for (u32 i = 0; i < layout->primitive_count; i++)
        if (kind_of(&layout->primitives[i]) == PRIMITIVE_INSTANCE)
            places |= (u64)1 << order_of(layout, i);
    assert_int_equal(places, 1u << 1 | 1u << 2 | 1u << 5);
    layout_destroy(layout);
}

// Twenty objects, each around the one before.
static void test_order_of_nested(void **state)
{
    (void)state;
    char text[8000] = "object o0 { sphere { center 0 0 -4 radius 1 } sphere { center 0 1 -4 radius 1 } }\n";
    for (int i = 1; i <= 20; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "object o%d { instance o%d { } plane { point 0 0 0 normal 0 1 0 } }\n", i, i - 1);
    snprintf(text + strlen(text), sizeof text - strlen(text), "instance o20 { }\n"
             "box { min 0 0 0 max 1 1 1 }\n");
    Layout *layout = layout_good(text);
    assert_int_equal(order_of(layout, find_kind(layout, PRIMITIVE_BOX)), 22);
    assert_int_equal(layout->plane_count, 20);
    for (u32 i = 0; i < 20; i++) // innermost first
        assert_int_equal(order_of(layout, i), 2 + i);
    layout_destroy(layout);
}

static u32 material_of(const Layout *layout, u32 kind)
{
    return layout->infos[find_kind(layout, kind)].material;
}

// Own material, else that of the nearest enclosing instance that names one, else the default.
static void test_materials(void **state)
{
    (void)state;
    // Materials: 0 is the default, then a, b, c. An object of one shape is baked with what it inherits.
    Layout *layout = layout_good(
        "material a phong { }\nmaterial b phong { }\nmaterial c phong { }\n"
        "object one { sphere { center 0 0 0 radius 1 } }\n"
        "object own { cone { base 0 0 0 top 0 1 0 radius 1 material c } }\n"
        "object deep { instance one { } instance own { } }\n"
        "object named { instance deep { material b } }\n"
        "instance named { material a }\n"
        "object ring { torus { center 0 0 0 axis 0 1 0 major 1 minor 0.2 } }\n"
        "instance ring { }\n"
        "object flat { plane { point 0 0 0 normal 0 1 0 } }\n"
        "instance flat { material a }\n"
        "cylinder { base 0 0 0 top 0 1 0 radius 1 material b }\n");
    assert_int_equal(material_of(layout, PRIMITIVE_SPHERE), 2);
    assert_int_equal(material_of(layout, PRIMITIVE_CONE), 3);
    assert_int_equal(material_of(layout, PRIMITIVE_TORUS), 0);
    assert_int_equal(material_of(layout, PRIMITIVE_PLANE), 1);
    assert_int_equal(material_of(layout, PRIMITIVE_CYLINDER), 2);
    layout_destroy(layout);
    // In a stored object the shape keeps its own and leaves the rest to each instance.
    layout = layout_good("material a phong { }\nmaterial b phong { }\n"
                         "object o { sphere { center 0 0 0 radius 1 }\n"
                         "box { min 0 0 0 max 1 1 1 material b } }\n"
                         "instance o { material a }\n");
    assert_int_equal(material_of(layout, PRIMITIVE_SPHERE), MATERIAL_INHERITED);
    assert_int_equal(material_of(layout, PRIMITIVE_BOX), 2);
    assert_int_equal(material_of(layout, PRIMITIVE_INSTANCE), 1);
    layout_destroy(layout);
    layout = layout_good("object o { sphere { center 0 0 0 radius 1 } box { min 0 0 0 max 1 1 1 } }\n"
                         "instance o { }\n");
    assert_int_equal(material_of(layout, PRIMITIVE_INSTANCE), NO_INDEX);
    layout_destroy(layout);
}

// Only what surely stops light is marked: not what transmits, and not what may inherit anything.
static void test_opaque(void **state)
{
    (void)state;
    Layout *layout = layout_good("material g phong { transmit 0 0 0.5 }\n"
                                 "sphere { center 0 0 0 radius 1 material g }\n"
                                 "torus { center 0 0 0 axis 0 1 0 major 1 minor 0.2 }\n"
                                 "material opaque phong { reflect 1 }\n"
                                 "object o { box { min 0 0 0 max 1 1 1 }\n"
                                 "cone { base 0 0 0 top 0 1 0 radius 1 material opaque }\n"
                                 "disk { center 0 0 0 normal 0 1 0 radius 1 material g } }\n"
                                 "instance o { }\n");
    static const struct {
        u32 kind;
        bool opaque;
    } expected[] = {{PRIMITIVE_SPHERE, false}, {PRIMITIVE_TORUS, true}, {PRIMITIVE_BOX, false},
                    {PRIMITIVE_CONE, true},    {PRIMITIVE_DISK, false}, {PRIMITIVE_INSTANCE, false}};
    for (size_t i = 0; i < sizeof expected / sizeof *expected; i++) {
        const u32 at = find_kind(layout, expected[i].kind);
        assert_int_equal((layout->primitives[at].kind & PRIMITIVE_OPAQUE) != 0, expected[i].opaque);
    }
    layout_destroy(layout);
}

// An object of a single bounded shape is no second level: it is baked wherever it is placed.
static void test_single_shape_baked(void **state)
{
    (void)state;
    Layout *layout = layout_good("object o { sphere { center 1 0 0 radius 1 }\n"
                                 "plane { point 0 0 0 normal 0 1 0 } }\n"
                                 "object p { instance o { scale 2 } }\n"
                                 "instance p { translate 0 0 -8 }\ninstance o { translate 0 3 0 }\n");
    assert_int_equal(count_kind(layout, PRIMITIVE_INSTANCE), 0);
    assert_int_equal(count_kind(layout, PRIMITIVE_SPHERE), 2);
    for (u32 i = layout->plane_count; i < layout->primitive_count; i++) {
        const Primitive *p = &layout->primitives[i];
        const bool first = order_of(layout, i) == 0;
        assert_true(p->p0 == (first ? 2.0f : 1.0f));
        assert_true(p->row0.w == (first ? 2.0f : 1.0f) && p->row1.w == (first ? 0.0f : 3.0f) &&
                    p->row2.w == (first ? -8.0f : 0.0f));
    }
    layout_destroy(layout);
}

static f32 instance_number(const Primitive *p, int row, int column)
{
    const f32x4 r = row == 0 ? p->row0 : row == 1 ? p->row1 : p->row2;
    return column == 0 ? r.x : column == 1 ? r.y : column == 2 ? r.z : r.w;
}

// q = A (p - c) leads to the object's space, whatever the chain of transforms.
static void test_instance_maps(void **state)
{
    (void)state;
    Layout *layout = layout_good("camera { position 1 2 3 look_at 1 2 0 }\n"
                                 "object o { box { min 0 0 0 max 1 1 1 } box { min 2 0 0 max 3 1 1 } }\n"
                                 "object p { instance o { scale 2 1 1 translate 0 1 0 } }\n"
                                 "instance p { rotate z 90 translate 5 0 0 }\n");
    const Primitive *p = &layout->primitives[find_kind(layout, PRIMITIVE_INSTANCE)];
    // x, y, z -> 2x, y + 1, z -> -(y + 1) + 5, 2x, z, seen from (1, 2, 3).
    const f32 expected[3][4] = {{0, 0.5f, 0, 3}, {-1, 0, 0, -2}, {0, 0, 1, -3}};
    for (int row = 0; row < 3; row++)
        for (int column = 0; column < 4; column++)
            assert_near((f64)instance_number(p, row, column), (f64)expected[row][column], 1e-6);
    u32 root;
    memcpy(&root, &p->p0, sizeof root);
    assert_true(root < layout->node_count && root != layout->root);
    // The box in the top-level hierarchy holds the placed object, x in 2..3, y in -2..4 from the camera,
    // closely.
    const BvhNode *node = &layout->nodes[layout->root];
    assert_true(node->lower_x[0] <= 2 && node->lower_x[0] > 1.99f);
    assert_true(node->upper_x[0] >= 3 && node->upper_x[0] < 3.01f);
    assert_true(node->lower_y[0] <= -2 && node->lower_y[0] > -2.01f);
    assert_true(node->upper_y[0] >= 4 && node->upper_y[0] < 4.01f);
    layout_destroy(layout);
}

static u64 layout_bytes(const Layout *l)
{
    return l->primitive_count * (u64)sizeof *l->primitives + l->node_count * (u64)sizeof *l->nodes +
           l->extra_count * (u64)sizeof *l->extras;
}

// The shapes of an object are stored once: a placement costs one primitive and its share of a node.
static void test_geometry_once(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    u64 bytes[2];
    const u32 placements[2] = {1, 64};
    for (int k = 0; k < 2; k++) {
        FILE *stream = open_memstream(&text, &size);
        fprintf(stream, "object o {\n");
        for (int i = 0; i < 500; i++)
            fprintf(stream, "triangle { vertices %d 0 0  %d 1 0  %d 0 1 normals 1 0 0 1 0 0 1 0 0 }\n", i, i,
                    i);
        fprintf(stream, "}\nobject p { instance o { } }\n");
        for (u32 i = 0; i < placements[k]; i++)
            fprintf(stream, "instance p { translate 0 %u 0 }\n", i);
        fclose(stream);
        Layout *layout = layout_good(text);
        assert_int_equal(count_kind(layout, PRIMITIVE_TRIANGLE), 500);
        assert_int_equal(count_kind(layout, PRIMITIVE_INSTANCE), placements[k]);
        assert_int_equal(layout->extra_count, 500);
        bytes[k] = layout_bytes(layout);
        layout_destroy(layout);
        free(text);
    }
    assert_true(bytes[1] - bytes[0] <= 63 * (sizeof(Primitive) + sizeof(BvhNode) / 2));
}

// Far deeper than a stack of calls would allow.
static void test_deep_nesting(void **state)
{
    (void)state;
    enum { DEEP = 20000 };
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    fprintf(stream, "object o0 { sphere { center 0 0 0 radius 1 } box { min 0 0 0 max 1 1 1 } }\n");
    for (int i = 1; i <= DEEP; i++)
        fprintf(stream, "object o%d { instance o%d { translate 1 0 0 } }\n", i, i - 1);
    fprintf(stream, "instance o%d { }\n", DEEP);
    fclose(stream);
    Layout *layout = layout_good(text);
    free(text);
    const Primitive *p = &layout->primitives[find_kind(layout, PRIMITIVE_INSTANCE)];
    assert_true(p->row0.w == (f32)DEEP && p->row0.x == 1);
    layout_destroy(layout);
}

// Many placements of an object of many shapes take time for the placements, not for their product.
static void test_placement_time(void **state)
{
    (void)state;
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    fprintf(stream, "object o {\n");
    for (int i = 0; i < 4000; i++)
        fprintf(stream, "sphere { center %d 0 0 radius 1 }\n", i);
    fprintf(stream, "}\nobject ten0 { instance o { } }\n");
    for (int k = 1; k <= 5; k++) {
        fprintf(stream, "object ten%d {\n", k);
        for (int i = 0; i < 10; i++)
            fprintf(stream, "instance ten%d { translate 0 %d %d }\n", k - 1, k, i);
        fprintf(stream, "}\n");
    }
    fprintf(stream, "instance ten5 { }\n");
    fclose(stream);
    Parsed parsed = parse_good(text);
    free(text);
    Error error = {0};
    const clock_t start = clock();
    Layout *layout = layout_create(parsed.scene, &error);
    const f64 seconds = (f64)(clock() - start) / CLOCKS_PER_SEC; // of work, whoever else keeps the machine busy
    assert_non_null(layout);
    assert_int_equal(count_kind(layout, PRIMITIVE_INSTANCE), 100000);
    layout_destroy(layout);
    parsed_end(&parsed);
    if (seconds > 5)
        fail_msg("%.2f s for 100 000 placements of 4000 shapes", seconds);
}

// Render space begins at the camera, in double: nothing is lost a million units away.
static void test_camera_relative(void **state)
{
    (void)state;
    Layout *layout = layout_good("camera { position 1000000.125 0 1000000 look_at 1000000.125 0 0 }\n"
                                 "sphere { center 1000000.5 0.25 999995.1 radius 0.1 }\n"
                                 "plane { point 1000000 -1 1000000 normal 1 0 0 }\n"
                                 "triangle { vertices 1000000.25 0 999999 1000000.5 0 999999\n"
                                 "1000000.25 1 999999 }\n"
                                 "light point { position 1000001.1 2 1000003 }\n"
                                 "light spot { position 1000000 0 1000000 look_at 1000000 0 999999.9 }\n");
    const Primitive *sphere = &layout->primitives[find_kind(layout, PRIMITIVE_SPHERE)];
    assert_true(sphere->row0.w == 0.375f && sphere->row1.w == 0.25f);
    assert_near((f64)sphere->row2.w, -4.9, 3e-7);
    assert_true(layout->primitives[0].p0 == -0.125f);
    const Primitive *triangle = &layout->primitives[find_kind(layout, PRIMITIVE_TRIANGLE)];
    assert_true(triangle->row0.x == 0.125f && triangle->row1.x == 0.375f && triangle->row2.z == -1);
    assert_near((f64)layout->lights[0].position.x, 0.975, 1e-7);
    assert_true(layout->lights[0].position.y == 2 && layout->lights[0].position.z == 3);
    assert_near((f64)layout->lights[1].direction.z, -1, 1e-7);
    layout_destroy(layout);
}

// A light knows the planes that it lies on, wherever those are, and no others.
static void test_planes_of_lights(void **state)
{
    (void)state;
    Layout *layout = layout_good("camera { position 1e5 3 -7 look_at 0 0 0 }\n"
                                 "plane { point 0 2.7 0 normal 0 -1 0 }\nplane { point 1 0 1 normal 1 2 3 }\n"
                                 "light point { position 100 2.7 -3 }\n"
                                 "light point { position 100 2.70001 -3 }\n"
                                 "light spot { position 4 2.7 -1.8 look_at 0 0 0 }\n"
                                 "light directional { direction 0 -1 0 }\nlight point { position 4 0 0 }\n");
    static const u32 expected[] = {1, 0, 1 | 2, 0, 2};
    // The second plane: x + 2 y + 3 z = 4; the spot: 4 + 5.4 - 5.4.
    for (u32 i = 0; i < 5; i++)
        assert_int_equal(layout->lights[i].planes, expected[i]);
    layout_destroy(layout);
    char text[4000] = "light point { position 0 0 0 }\n"; // more planes than there are bits
    for (int i = 0; i < 40; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text), "plane { point 0 %d 0 normal 0 1 0 }\n",
                 i % 8);
    layout = layout_good(text);
    assert_int_equal(layout->lights[0].planes, 0x01010101);
    layout_destroy(layout);
}

static void test_out_of_range(void **state)
{
    (void)state;
    const Error error = layout_error("\nsphere { center 0 0 0 radius 1e30 scale 1e30 }\n");
    assert_int_equal(error.code, ERROR_SCENE);
    assert_non_null(strstr(error.text, "t:2:1: error: ")); // where the shape stands
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_empty),         cmocka_unit_test(test_planes),
        cmocka_unit_test(test_order),         cmocka_unit_test(test_order_of_nested),
        cmocka_unit_test(test_materials),     cmocka_unit_test(test_opaque),
        cmocka_unit_test(test_single_shape_baked), cmocka_unit_test(test_instance_maps),
        cmocka_unit_test(test_geometry_once), cmocka_unit_test(test_deep_nesting),
        cmocka_unit_test(test_placement_time), cmocka_unit_test(test_camera_relative),
        cmocka_unit_test(test_out_of_range),  cmocka_unit_test(test_planes_of_lights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
