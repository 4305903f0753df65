/* Meshes: what is made of OBJ and MTL, and rays that meet it, against values found by hand. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "hit.h"
#include "oracle_test.h"

typedef struct Folder {
    char path[64];
    char *files[8];
    int count;
} Folder;

static int folder_open(void **state)
{
    Folder *folder = calloc(1, sizeof *folder);
    if (folder == NULL)
        return -1;
    strcpy(folder->path, "/tmp/oracle-mesh-XXXXXX");
    *state = folder;
    return mkdtemp(folder->path) == NULL ? -1 : 0;
}

static int folder_close(void **state)
{
    Folder *folder = *state;
    for (int i = 0; i < folder->count; i++) {
        unlink(folder->files[i]);
        free(folder->files[i]);
    }
    rmdir(folder->path);
    free(folder);
    return 0;
}

static void put(Folder *folder, const char *name, const char *text)
{
    const size_t size = strlen(folder->path) + strlen(name) + 2;
    char *path = malloc(size);
    assert_non_null(path);
    assert_in_range(folder->count, 0, 7);
    folder->files[folder->count++] = path;
    snprintf(path, size, "%s/%s", folder->path, name);
    FILE *file = fopen(path, "wb");
    assert_non_null(file);
    fputs(text, file);
    assert_int_equal(fclose(file), 0);
}

/* Reads a scene in which each @ stands for the folder's path; scene_free afterwards. */
static void read_scene(const Folder *folder, Scene *scene, const char *text)
{
    char full[2048];
    size_t length = 0;
    for (; *text != '\0'; text++) {
        char one[2] = {*text, '\0'};
        int added = snprintf(full + length, sizeof full - length, "%s", *text == '@' ? folder->path : one);
        length += (size_t)added;
        assert_in_range(length, 0, sizeof full - 1);
    }
    scene_init(scene);
    scene_read_text(scene, full);
}

static Hit hit_of(const Scene *scene, Vec o, Vec d)
{
    Ray ray = {o, normalized(d), NULL, 0};
    Hit hit;
    assert_true(hit_closest(scene, &ray, &hit));
    return hit;
}

static void misses(const Scene *scene, Vec o, Vec d)
{
    Ray ray = {o, normalized(d), NULL, 0};
    Hit hit;
    assert_false(hit_closest(scene, &ray, &hit));
}

/* Corners in the order x fastest, z slowest; every quad as seen from outside, against the clock. */
static const char CUBE[] = "v -1 -1 -1\nv 1 -1 -1\nv -1 1 -1\nv 1 1 -1\n"
                           "v -1 -1 1\nv 1 -1 1\nv -1 1 1\nv 1 1 1\n"
                           "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";

static void test_cube(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "cube.obj", CUBE);
    read_scene(folder, &scene, "mesh { file \"@/cube.obj\"  scale 2 1 0.5  translate 10 0 0 }");
    assert_int_equal(scene.primitive_count, 12);
    Hit hit = hit_of(&scene, vec(10.5L, 0.25L, 5), vec(0, 0, -1));
    assert_near(hit.t, 4.5L, 1e-17L);
    assert_vec_near(hit.normal, vec(0, 0, 1), 1e-18L);
    assert_vec_near(hit.local, vec(0.25L, 0.25L, 1), 1e-17L);
    /* From inside, where the normal still points outward. */
    hit = hit_of(&scene, vec(10, 0, 0), vec(1, 0.125L, 0));
    assert_near(hit.point.x, 12, 1e-17L);
    assert_vec_near(hit.normal, vec(1, 0, 0), 1e-18L);
    misses(&scene, vec(12.001L, 0, 5), vec(0, 0, -1));
    misses(&scene, vec(10, 1.001L, 5), vec(0, 0, -1));
    /* Through the middle of an edge, a corner, and the diagonal of a face. */
    assert_near(hit_of(&scene, vec(10, 0, 0), vec(0, 2, 1)).point.y, 1, 1e-17L);
    assert_near(hit_of(&scene, vec(10, 0, 0), vec(4, 2, 1)).point.x, 12, 1e-17L);
    assert_near(hit_of(&scene, vec(10.5L, 0.25L, 5), vec(0, 0, -1)).point.z, 0.5L, 1e-17L);
    scene_free(&scene);
}

static void test_fan(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "fan.obj", "v 0 0 0\nv 2 0 0\nv 3 1 0\nv 1 3 0\nv 0 2 0\nvt 0 0\nvt 1 1\n"
                           "f 1/1 2/2 3/1 4/2 5/1\nf 5 1 2 3\n");
    read_scene(folder, &scene, "mesh { file \"@/fan.obj\" }");
    static const int EXPECTED[5][3] = {{1, 2, 3}, {1, 3, 4}, {1, 4, 5}, {5, 1, 2}, {5, 2, 3}};
    static const int UVS[3][3] = {{0, 1, 0}, {0, 0, 1}, {0, 1, 0}};
    static const Vec POINTS[5] = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 3, 0}, {0, 2, 0}};
    assert_int_equal(scene.primitive_count, 5);
    for (int i = 0; i < 5; i++) {
        const Shape *face = scene.primitives[i].shape;
        assert_int_equal(face->has_uvs, i < 3);
        for (int k = 0; k < 3; k++) {
            assert_vec_near(face->vertices[k], POINTS[EXPECTED[i][k] - 1], 0);
            if (i < 3)
                assert_near(face->uvs[k][0], UVS[i][k], 0);
        }
    }
    /* Of faces in one place the first counts; this one has no coordinates of its own: b and c of 1 2 3. */
    Hit hit = hit_of(&scene, vec(2, 0.5L, 1), vec(0, 0, -1));
    assert_ptr_equal(hit.primitive, &scene.primitives[0]);
    assert_near(hit.surface.u, 0.25L, 1e-17L); /* (0, 1, 0) weighted by (1/4, 1/4, 1/2) */
    scene_free(&scene);
}

static void test_forms(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "forms.obj",
        "\r\n# v 9 9 9\r\nmtllib none.mtl\r\ng a b\r\nv 0 0 0 1\r\n\tv 1 0 0 1 0 0\r\nv 0 1 \\\r\n  0\r\n"
        "vn 0 0 2\r\nvt 0.5\r\nf -3//-1 -2//-1 -1//-1\r\nv 0 0 1\nf \\\n1/1 \\\n2/1 4/1 # 3\n"
        "f 1 2 2\nf 1 1 1\no end\ns 1\nf 4 3 1");
    read_scene(folder, &scene, "mesh { file \"@/forms.obj\" }");
    assert_int_equal(scene.primitive_count, 3);
    const Shape *face = scene.primitives[0].shape;
    assert_true(face->has_normals && !face->has_uvs);
    assert_vec_near(face->normals[1], vec(0, 0, 1), 0);
    assert_vec_near(face->vertices[2], vec(0, 1, 0), 0);
    face = scene.primitives[1].shape;
    assert_true(!face->has_normals && face->has_uvs);
    assert_near(face->uvs[2][0], 0.5L, 0);
    assert_near(face->uvs[2][1], 0, 0);
    assert_vec_near(face->vertices[2], vec(0, 0, 1), 0);
    face = scene.primitives[2].shape;
    assert_true(!face->has_normals && !face->has_uvs);
    assert_vec_near(face->vertices[0], vec(0, 0, 1), 0);
    scene_free(&scene);
}

static void test_smooth(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "cube.obj", CUBE);
    put(folder, "own.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 3 0 4\nf 1//1 2//1 3//1\n");
    read_scene(folder, &scene, "mesh { file \"@/cube.obj\"  smooth on }  mesh { file \"@/cube.obj\" }"
                               "mesh { file \"@/own.obj\"  smooth off }  mesh { file \"@/own.obj\" }"
                               "mesh { file \"@/own.obj\"  smooth on  scale 2 1 1 }");
    /* Both triangles of a quad count at its first and third corner, one at the others. Corner 1 is the first
     * of its three quads; corner 8 is third of +z, +y and +x; corner 2 is fourth of -z, second of -y, first
     * of +x; corner 4 third of -z, fourth of +y, second of +x. */
    static const struct {
        int face, corner;
        Vec normal;
    } CORNERS[] = {{0, 0, {-2, -2, -2}}, {2, 2, {2, 2, 2}}, {1, 2, {2, -1, -1}}, {0, 2, {1, 1, -2}}};
    for (size_t i = 0; i < CASES(CORNERS); i++) {
        const Shape *face = scene.primitives[CORNERS[i].face].shape;
        assert_true(face->has_normals);
        assert_vec_near(face->normals[CORNERS[i].corner], normalized(CORNERS[i].normal), 1e-18L);
    }
    assert_false(scene.primitives[12].shape->has_normals);
    assert_false(scene.primitives[24].shape->has_normals);
    assert_vec_near(scene.primitives[25].shape->normals[2], vec(0.6L, 0, 0.8L), 1e-18L);
    /* Carried by the inverse transpose: (0.3, 0, 0.8), at a point that only the scaled one covers. */
    Hit hit = hit_of(&scene, vec(1.25L, 0.125L, 3), vec(0, 0, -1));
    assert_vec_near(hit.shading, normalized(vec(0.3L, 0, 0.8L)), 1e-17L);
    assert_vec_near(hit.normal, vec(0, 0, 1), 1e-18L);
    scene_free(&scene);
}

static void test_materials(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "two.mtl", "newmtl a b\r\nKa 1 1 1\r\nKd 0.1 0.2 0.3\r\nKs 0.5\r\n"
                           "Ns 7\r\nNi 1.25\r\nKe 1 2 3\r\nd 0.75\r\n");
    put(folder, "bare.mtl", "# nothing but a name\nnewmtl bare\n");
    put(folder, "m.obj", "mtllib two.mtl bare.mtl\nmtllib missing.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                         "f 1 2 3\nusemtl a  b\nf 1 2 3\nusemtl bare\nf 1 2 3\nusemtl unheard\nf 1 2 3\n");
    read_scene(folder, &scene, "material own phong { }  material outer phong { }  object o {"
                               " mesh { file \"@/m.obj\" }  mesh { file \"@/m.obj\"  material own } }"
                               "object p { instance o { } }"
                               "instance p { }  instance p { material outer }"
                               "material default phong { diffuse 0.6 }");
    assert_int_equal(scene.primitive_count, 16);
    const Material *first = scene.primitives[0].material;
    assert_string_equal(first->name, "default");
    assert_near(first->diffuse.color.x, (real)0.6, 0);
    const Material *named = scene.primitives[1].material;
    assert_vec_near(named->diffuse.color, vec(0.1, 0.2, 0.3), 0);
    assert_vec_near(named->ambient.color, vec(0.1, 0.2, 0.3), 0);
    assert_vec_near(named->specular, grey(0.5), 0);
    assert_vec_near(named->emission.color, vec(1, 2, 3), 0);
    assert_vec_near(named->transmit, grey(0.25L), 0);
    assert_near(named->shininess, 7, 0);
    assert_near(named->ior, 1.25L, 0);
    assert_false(named->fresnel);
    const Material *bare = scene.primitives[2].material;
    assert_near(bare->diffuse.color.x, (real)0.8, 0);
    assert_near(bare->ambient.color.x, (real)0.8, 0);
    assert_near(bare->shininess, 32, 0);
    assert_ptr_equal(scene.primitives[3].material, first);
    for (int i = 0; i < 4; i++) {
        assert_string_equal(scene.primitives[4 + i].material->name, "own");
        assert_string_equal(scene.primitives[8 + i].material->name, "outer");
        assert_string_equal(scene.primitives[12 + i].material->name, "own");
    }
    scene_free(&scene);
}

static void test_crossings(void **state)
{
    Folder *folder = *state;
    Scene scene;
    put(folder, "cube.obj", CUBE);
    read_scene(folder, &scene, "material glass phong { transmit 0.5 }"
                               "mesh { file \"@/cube.obj\"  material glass }");
    /* In through a face, the diagonal of one, an edge, a corner; out likewise. */
    static const Vec ENDS[][2] = {{{0.3L, 0.2L, 5}, {0, 0, -1}}, {{0.5L, 0.5L, 5}, {0, 0, -1}},
                                  {{0, 3, 3}, {0, -1, -1}},      {{3, 3, 3}, {-1, -1, -1}},
                                  {{0, 0, 3}, {0.5L, 0.5L, -2}}, {{3, 3, 2.5L}, {-1, -1, -0.75L}}};
    for (size_t i = 0; i < CASES(ENDS); i++) {
        Ray ray = {ENDS[i][0], normalized(ENDS[i][1]), NULL, 0};
        assert_near(hit_transmittance(&scene, &ray, INFINITY, -1).x, 0.25L, 1e-18L);
        /* The way on from the first hit meets the other side alone, and nothing of the side that it is on. */
        Hit hit;
        assert_true(hit_closest(&scene, &ray, &hit));
        Ray inside = {hit.point, ray.d, hit.primitive, hit.patch};
        assert_near(hit_transmittance(&scene, &inside, INFINITY, -1).x, 0.5L, 1e-18L);
    }
    scene_free(&scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(test_cube, folder_open, folder_close),
        cmocka_unit_test_setup_teardown(test_fan, folder_open, folder_close),
        cmocka_unit_test_setup_teardown(test_forms, folder_open, folder_close),
        cmocka_unit_test_setup_teardown(test_smooth, folder_open, folder_close),
        cmocka_unit_test_setup_teardown(test_materials, folder_open, folder_close),
        cmocka_unit_test_setup_teardown(test_crossings, folder_open, folder_close),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
