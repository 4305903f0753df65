// Shapes, transforms, objects, instances.
#include <math.h>

#include "scene_parse_fixture.h"

static const Shape *only_shape(const Parsed *p)
{
    assert_int_equal(p->scene->shape_count, 1);
    return &p->scene->shapes[0];
}

static void test_sphere(void **state)
{
    (void)state;
    Parsed p = parse_good("\n  sphere { center 1 -2 3e0 radius .5 }");
    const Shape *s = only_shape(&p);
    assert_int_equal(s->kind, SHAPE_SPHERE);
    assert_int_equal(s->at.line, 2);
    assert_int_equal(s->at.column, 3);
    assert_int_equal(s->material, -1);
    assert_vec(s->as.sphere.center, 1, -2, 3);
    assert_true(s->as.sphere.radius == 0.5);
    assert_vec(s->transform.row[0], 1, 0, 0);
    assert_vec(s->transform.translation, 0, 0, 0);
    parsed_end(&p);
    expect_error("sphere { center 0 0 0 radius 0 }", "1:30: 'radius' must be above 0");
}

static void test_plane_and_disk(void **state)
{
    (void)state;
    Parsed p = parse_good("plane { point 1 2 3 normal 0 0 5 } disk { center 4 5 6 normal 1 0 0 radius 2 }");
    assert_vec(p.scene->shapes[0].as.plane.point, 1, 2, 3);
    assert_vec(p.scene->shapes[0].as.plane.normal, 0, 0, 5);
    assert_vec(p.scene->shapes[1].as.disk.center, 4, 5, 6);
    assert_vec(p.scene->shapes[1].as.disk.normal, 1, 0, 0);
    assert_true(p.scene->shapes[1].as.disk.radius == 2);
    parsed_end(&p);
    expect_error("plane { point 0 0 0 normal 0 -0 0 }", "1:28: 'normal' must not be zero");
    expect_error("disk { center 0 0 0 normal 1e-400 0 0 radius 1 }", "1:28: 'normal' must not be zero");
}

static void test_box(void **state)
{
    (void)state;
    Parsed p = parse_good("box { min -1 0 1 max 1 2 3 } box { center 1 2 3 size 2 4 6 }\n"
                          "box { size 1 center 0 0 0 }");
    assert_vec(p.scene->shapes[0].as.box.min, -1, 0, 1);
    assert_vec(p.scene->shapes[0].as.box.max, 1, 2, 3);
    assert_vec(p.scene->shapes[1].as.box.min, 0, 0, 0);
    assert_vec(p.scene->shapes[1].as.box.max, 2, 4, 6);
    assert_vec(p.scene->shapes[2].as.box.min, -0.5, -0.5, -0.5);
    assert_vec(p.scene->shapes[2].as.box.max, 0.5, 0.5, 0.5);
    parsed_end(&p);
    expect_error("box { center 0 0 0 size 1 0 1 }", "1:27: 'size' must be above 0");
    expect_error("box { center 0 0 0 size 1 1 }", "1:20: 'size' takes 1 or 3 numbers, found 2");
    expect_error("box { max 0 0 0 min 0 0 1 }", "1:17: 'min' must be below 'max' in x");
    expect_error("box { center 0 1e20 0 size 1 }", "1:23: 'size' is lost beside 'center' in y");
    expect_error("box { }", "1:1: box lacks 'min' and 'max', or 'center' and 'size'");
    expect_error("box { min 0 0 0 max 1 1 1 center 0 0 0 }", "1:27: 'max' and 'center' exclude each other");
    expect_error("box { min 0 0 0 mx 1 1 1 }", "1:17: unknown property 'mx' of box; did you mean 'max'?");
}

static void test_tetrahedron(void **state)
{
    (void)state;
    Parsed p = parse_good("tetrahedron { center 1 2 3 size 2 } "
                          "tetrahedron { vertices 0 0 0 1 0 0 0 1 0 0 0 1 }");
    const Vec3 *v = p.scene->shapes[0].as.tetrahedron.vertices;
    for (u32 i = 0; i < 4; ++i) {
        for (u32 j = 0; j < i; ++j)
            assert_near(vec_length(vec_sub(v[i], v[j])), 2, 1e-15);
    }
    const Vec3 sum = vec_add(vec_add(v[0], v[1]), vec_add(v[2], v[3]));
    assert_vec_near(sum, (Vec3){4, 8, 12}, 1e-14);
    assert_true(v[3].x == 1 && v[3].z == 3 && v[3].y > v[0].y); // the apex is up
    assert_true(v[0].x < v[1].x && v[2].z < v[0].z);
    assert_vec(p.scene->shapes[1].as.tetrahedron.vertices[1], 1, 0, 0);
    assert_vec(p.scene->shapes[1].as.tetrahedron.vertices[3], 0, 0, 1);
    parsed_end(&p);
    // Small or far, it has a volume; flat but for rounding, it has none.
    p = parse_good("tetrahedron { vertices 0 0 0 1e-9 0 0 0 1e-9 0 0 0 1e-9 }\n"
                   "tetrahedron { vertices 1000 0 0 1000.1 0 0 1000 0.1 0 1000 0 0.1 }");
    parsed_end(&p);
    expect_error("tetrahedron { vertices 0.1 0.1 0.1 0.2 0.2 0.3 0.3 0.3 0.7 0.4 0.4 0.15 }",
                 "1:15: the tetrahedron has no volume");
    expect_error("tetrahedron { size 1 }", "1:1: tetrahedron lacks 'vertices', or 'center' and 'size'");
}

static void test_triangle(void **state)
{
    (void)state;
    Parsed p = parse_good("triangle { vertices 0 0 0 1 0 0 0 1 0 }\n"
                          "triangle { vertices 0 0 0 1 0 0 0 1 0 normals 0 0 1 0 1 1 1 0 1\n"
                          "  uvs 0 0 1 0 0 1 }");
    const Shape *s = p.scene->shapes;
    assert_vec(s[0].as.triangle.vertices[2], 0, 1, 0);
    assert_false(s[0].as.triangle.has_normals);
    assert_false(s[0].as.triangle.has_uvs);
    assert_true(s[1].as.triangle.has_normals);
    assert_true(s[1].as.triangle.has_uvs);
    assert_vec(s[1].as.triangle.normals[2], 1, 0, 1);
    assert_true(s[1].as.triangle.uvs[1][0] == 1 && s[1].as.triangle.uvs[2][1] == 1);
    parsed_end(&p);
    p = parse_good("triangle { vertices 0 0 0 1 0 0 0.5 1e-7 0 }"); // thin is not without area
    parsed_end(&p);
    expect_error("triangle { vertices 0 0 0 0 0 0 1 0 0 }", "1:12: the triangle has no area");
    expect_error("triangle { vertices 0 0 0 1 0 0 }", "1:12: 'vertices' takes 9 numbers, found 6");
}

static void test_cylinder_cone_torus(void **state)
{
    (void)state;
    Parsed p = parse_good("cylinder { base 0 0 0 top 0 1 0 radius 2 }\n"
                          "cylinder { base 0 0 0 top 0 1 0 radius 2 caps off }\n"
                          "cone { base 0 0 0 top 0 1 0 radius 2 }\n"
                          "cone { base 0 0 0 top 0 1 0 radius 0 top_radius 3 caps off }\n"
                          "torus { center 1 2 3 axis 0 1 0 major 2 minor 2 }");
    const Shape *s = p.scene->shapes;
    assert_true(s[0].as.cylinder.caps && s[0].as.cylinder.radius == 2);
    assert_vec(s[0].as.cylinder.top, 0, 1, 0);
    assert_false(s[1].as.cylinder.caps);
    assert_true(s[2].as.cone.caps && s[2].as.cone.top_radius == 0 && s[2].as.cone.radius == 2);
    assert_true(!s[3].as.cone.caps && s[3].as.cone.top_radius == 3 && s[3].as.cone.radius == 0);
    assert_vec(s[4].as.torus.center, 1, 2, 3);
    assert_vec(s[4].as.torus.axis, 0, 1, 0);
    assert_true(s[4].as.torus.major == 2 && s[4].as.torus.minor == 2);
    parsed_end(&p);
    expect_error("cylinder { base 0 0 0 top 0 1 0 radius 0 }", "1:40: 'radius' must be above 0");
    expect_error("cone { base 0 0 0 top 0 0 0 radius 1 }", "1:19: 'base' and 'top' are the same point");
    expect_error("cone { base 0 0 0 top 0 1 0 top_radius 0 radius 0 }",
                 "1:42: 'radius' and 'top_radius' are both 0");
    expect_error("torus { center 0 0 0 axis 0 0 0 major 1 minor 0.1 }", "1:27: 'axis' must not be zero");
}

static void test_mesh(void **state)
{
    (void)state;
    Parsed p = parse_good("mesh { file \"a.obj\" } mesh { file \"/b.obj\" smooth on }\n"
                          "mesh { smooth off file \"c\" } mesh { file \"d\" terminator on }\n"
                          "mesh { file \"d\" terminator off }");
    assert_string_equal(p.scene->shapes[0].as.mesh.file, "a.obj");
    assert_string_equal(p.scene->shapes[1].as.mesh.file, "/b.obj");
    assert_int_equal(p.scene->shapes[0].as.mesh.smooth, -1);
    assert_int_equal(p.scene->shapes[1].as.mesh.smooth, 1);
    assert_int_equal(p.scene->shapes[2].as.mesh.smooth, 0);
    for (u32 i = 0; i < 5; i++)
        assert_true(p.scene->shapes[i].as.mesh.terminator == (i == 3));
    assert_int_equal(p.scene->shapes[2].as.mesh.file_at.line, 2);
    assert_int_equal(p.scene->shapes[2].as.mesh.file_at.column, 19);
    assert_null(p.scene->shapes[0].as.mesh.mesh); // files are not the parser's
    parsed_end(&p);
    expect_error("mesh { file \"a\" terminator yes }", "1:28: 'terminator' takes on or off, not 'yes'");
    expect_error("sphere { center 0 0 0 radius 1 terminator on }",
                 "1:32: unknown property 'terminator' of sphere");
    expect_error("mesh { file \"\" }", "1:13: the file name is empty");
}

// Where a transform written in a shape takes a point.
static Vec3 carried(const char *transforms, Vec3 point)
{
    char text[300];
    snprintf(text, sizeof text, "sphere { center 0 0 0 radius 1 %s }", transforms);
    Parsed p = parse_good(text);
    const Vec3 result = affine_point(only_shape(&p)->transform, point);
    parsed_end(&p);
    return result;
}

static void test_transforms(void **state)
{
    (void)state;
    const Vec3 p = {1, 2, 3};
    assert_vec(carried("translate 10 20 30", p), 11, 22, 33);
    assert_vec(carried("scale 2", p), 2, 4, 6);
    assert_vec(carried("scale 1 -2 3", p), 1, -4, 9);
    assert_vec(carried("rotate x 90", p), 1, -3, 2); // right-handed: y to z
    assert_vec(carried("rotate y 90", p), 3, 2, -1);
    assert_vec(carried("rotate z 90", p), -2, 1, 3);
    assert_vec(carried("rotate 0 0 7 -90", p), 2, -1, 3);
    assert_vec_near(carried("rotate 1 1 1 120", p), (Vec3){3, 1, 2}, 1e-15);
    assert_vec(carried("matrix 1 2 3 4 0 1 0 5 0 0 1 6", p), 18, 7, 9);
    // In the order written, first to last, however often.
    assert_vec(carried("translate 1 0 0 scale 2", p), 4, 4, 6);
    assert_vec(carried("scale 2 translate 1 0 0", p), 3, 4, 6);
    assert_vec(carried("translate 1 0 0 rotate z 90 translate 0 0 5 scale 10", p), -20, 20, 80);
    assert_vec_near(carried("rotate y 45 rotate y 45", p), (Vec3){3, 2, -1}, 1e-15);
}

static void test_singular_transforms(void **state)
{
    (void)state;
    Parsed p = parse_good("sphere { center 0 0 0 radius 1 matrix 1 0 0 0 0 1 0 0 0 0 1.1e-6 0 }\n"
                          "sphere { center 0 0 0 radius 1 scale 1 1 1e-9 scale 1e-30 }");
    parsed_end(&p);
    expect_error("sphere { center 0 0 0 radius 1 matrix 1 0 0 0 0 1 0 0 0 0 0.9e-6 0 }",
                 "1:32: the matrix is singular");
    expect_error("sphere { center 0 0 0 radius 1 matrix 0 0 0 0 0 0 0 0 0 0 0 0 }",
                 "1:32: the matrix is singular");
    // Regular in its elements, singular as a whole.
    expect_error("sphere { center 0 0 0 radius 1 matrix 1 2 3 0 4 5 6 0 7 8 9 0 }",
                 "1:32: the matrix is singular");
    expect_error("sphere { center 0 0 0 radius 1 scale 0 }", "1:38: 'scale' must be other than 0");
    expect_error("sphere { center 0 0 0 radius 1 scale 1e38 scale 1e38 scale 1e38 scale 1e38 }",
                 "1:1: the transforms of this sphere multiply out of range");
    expect_error("sphere { center 0 0 0 radius 1 scale 1e-38 scale 1e-38 scale 1e-38 scale 1e-38 }",
                 "1:1: the transforms of this sphere multiply out of range");
    expect_error("object o { } instance o { translate 1e38 0 0 scale 1e38 scale 1e38 scale 1e38 }",
                 "1:14: the transforms of this instance multiply out of range");
    p = parse_good("sphere { center 0 0 0 radius 1 scale 1e-38 scale 1e38 1e-38 1 }");
    parsed_end(&p);
}

static void test_objects(void **state)
{
    (void)state;
    Parsed p = parse_good("material m phong { }\n"
                          "object leaf { sphere { center 0 0 0 radius 1 material m } }\n"
                          "object tree { instance leaf { translate 1 0 0 } instance leaf { material m }\n"
                          "              box { center 0 0 0 size 1 } }\n"
                          "instance tree { scale 2 }\n"
                          "plane { point 0 0 0 normal 0 1 0 }\n"
                          "instance leaf { }");
    const Scene *s = p.scene;
    assert_int_equal(s->object_count, 2);
    assert_string_equal(s->objects[1].name, "tree");
    assert_int_equal(s->objects[0].placed, 0);
    assert_int_equal(s->objects[1].placed, 2);
    assert_int_equal(s->objects[1].group.count, 3);
    assert_int_equal(s->objects[1].group.items[0].kind, ITEM_INSTANCE);
    assert_int_equal(s->objects[1].group.items[2].kind, ITEM_SHAPE);
    assert_int_equal(s->instance_count, 4);
    assert_int_equal(s->instances[0].object, 0);
    assert_int_equal(s->instances[0].material, -1);
    assert_int_equal(s->instances[1].material, 1);
    assert_vec(s->instances[0].transform.translation, 1, 0, 0);
    assert_int_equal(s->world.count, 3); // in the order of the text
    assert_int_equal(s->world.items[0].kind, ITEM_INSTANCE);
    assert_int_equal(s->instances[s->world.items[0].index].object, 1);
    assert_int_equal(s->world.items[1].kind, ITEM_SHAPE);
    assert_int_equal(s->shapes[s->world.items[1].index].kind, SHAPE_PLANE);
    assert_int_equal(s->instances[s->world.items[2].index].object, 0);
    parsed_end(&p);
    expect_error("instance tree { }\nobject tree { }", "1:10: object 'tree' is not defined");
    expect_error("object a { }\nobject a { }", "2:8: object 'a' is defined already");
    expect_error("object a { object b { } }",
                 "1:12: 'object' cannot stand in an object; is a '}' missing before it?");
}

static void test_instance_limit(void **state)
{
    (void)state;
    // a0 is empty; a(i) places 2 (2^i - 1) instances; a23 and one of its own are 2^24 - 1.
    char text[4096];
    size_t length = (size_t)snprintf(text, sizeof text, "object a0 { }\n");
    for (u32 i = 1; i < 80; ++i)
        length += (size_t)snprintf(text + length, sizeof text - length,
                                   "object a%u { instance a%u{} instance a%u{} }\n", i, i - 1, i - 1);
    snprintf(text + length, sizeof text - length, "instance a23 { }\ninstance a0 { }\n");
    Parsed p = parse_good(text); // what is defined and not placed does not count
    parsed_end(&p);
    snprintf(text + length, sizeof text - length,
             "instance a23{}\ninstance a0{}\ninstance a0{}\ninstance a0{}");
    expect_error(text, "83:1: the scene places more than 16777216 instances here");
    snprintf(text + length, sizeof text - length, "instance a79 { }\n");
    expect_error(text, "81:1: the scene places more than 16777216 instances here");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sphere),          cmocka_unit_test(test_plane_and_disk),
        cmocka_unit_test(test_box),             cmocka_unit_test(test_tetrahedron),
        cmocka_unit_test(test_triangle),        cmocka_unit_test(test_cylinder_cone_torus),
        cmocka_unit_test(test_mesh),            cmocka_unit_test(test_transforms),
        cmocka_unit_test(test_singular_transforms), cmocka_unit_test(test_objects),
        cmocka_unit_test(test_instance_limit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
