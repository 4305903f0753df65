// Scenes with meshes: what is shared, what materials come of, what is said of bad files and where.
#include "assets_fixture.h"
#include "scene_parse_fixture.h"

#include <sys/stat.h>

#include "assets/assets.h"
#include "assets/import.h"

#define SQUARE_VERTICES "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
#define SQUARE SQUARE_VERTICES "f 1 2 3 4\n"

// Parses a text without errors and loads what it names; messages are those of both.
static Parsed load_text(const char *text)
{
    Parsed parsed = parse_good(text);
    if (!assets_load(parsed.scene, parsed.arena, parsed.diagnostics, &parsed.error))
        fail_msg("%s", parsed.error.text);
    free(parsed.messages);
    parsed.messages = printed(parsed.diagnostics);
    return parsed;
}

static void release(Parsed *parsed)
{
    assets_release(parsed->scene);
    assert_int_equal(parsed->scene->mesh_count, 0);
    for (u32 i = 0; i < parsed->scene->shape_count; ++i) {
        if (parsed->scene->shapes[i].kind == SHAPE_MESH)
            assert_null(parsed->scene->shapes[i].as.mesh.mesh);
    }
    assets_release(parsed->scene);
    parsed_end(parsed);
}

static void expect_messages(const char *text, const char *expected)
{
    Parsed parsed = load_text(text);
    assert_string_equal(parsed.messages, expected);
    release(&parsed);
}

static const Mesh *mesh_of(const Parsed *parsed, u32 shape)
{
    assert_true(shape < parsed->scene->shape_count);
    const Mesh *mesh = parsed->scene->shapes[shape].as.mesh.mesh;
    assert_non_null(mesh);
    assert_true(mesh >= parsed->scene->meshes && mesh < parsed->scene->meshes + parsed->scene->mesh_count);
    assert_sound(mesh);
    return mesh;
}

// ---- meshes ---------------------------------------------------------------------------------

static void test_sharing(void **state)
{
    (void)state;
    write_text("flat.obj", SQUARE);
    write_text("round.obj", SQUARE_VERTICES "vn 0 0 2\nf 1//1 2//1 3//1 4//1\n");
    assert_int_equal(symlink("flat.obj", "link.obj"), 0);
    Parsed p = load_text("mesh { file \"flat.obj\" } mesh { file \"flat.obj\" smooth off }\n"
                         "mesh { file \"flat.obj\" smooth on } mesh { file \"./link.obj\" smooth on }\n"
                         "object o { mesh { file \"link.obj\" } sphere { center 0 0 0 radius 1 } }\n"
                         "mesh { file \"round.obj\" smooth on } mesh { file \"round.obj\" }\n");
    assert_string_equal(p.messages, "");
    assert_int_equal(p.scene->mesh_count, 3);
    const Mesh *flat = mesh_of(&p, 0), *smooth = mesh_of(&p, 2), *round = mesh_of(&p, 6);
    assert_true(flat == mesh_of(&p, 1) && flat == mesh_of(&p, 4));
    assert_true(smooth == mesh_of(&p, 3) && smooth != flat);
    assert_true(round == mesh_of(&p, 7) && round != flat && round != smooth);
    assert_int_equal(flat->face_count, 2);
    assert_null(flat->normals);
    assert_face(smooth->faces, 1, 0, 2, 3);
    for (u32 k = 0; k < 3; ++k)
        assert_normal(smooth, smooth->face_normals[1][k], 0, 0, 1);
    assert_int_equal(round->normal_count, 1);
    assert_normal(round, 0, 0, 0, 1);
    assert_int_equal(flat->parts[0].material, -1);
    release(&p);
}

static void test_smooth_alone(void **state)
{
    (void)state;
    write_text("flat.obj", SQUARE);
    Parsed p = load_text("mesh { file \"flat.obj\" smooth on }");
    assert_int_equal(p.scene->mesh_count, 1);
    assert_non_null(mesh_of(&p, 0)->face_normals);
    release(&p);
}

static void test_no_meshes(void **state)
{
    (void)state;
    Parsed p = load_text("sphere { center 0 0 0 radius 1 }");
    assert_int_equal(p.scene->mesh_count, 0);
    assert_int_equal(p.scene->material_count, 1);
    release(&p);
    assets_release(NULL);
}

// Many shapes of few files.
static void test_many(void **state)
{
    (void)state;
    write_text("flat.obj", SQUARE);
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    for (u32 i = 0; i < 5000; ++i)
        fprintf(stream, "mesh { file \"%sflat.obj\" translate %u 0 0 }\n", i % 3 ? "./" : "", i);
    fclose(stream);
    Parsed p = load_text(text);
    free(text);
    assert_int_equal(p.scene->mesh_count, 1);
    assert_true(mesh_of(&p, 4999) == mesh_of(&p, 0));
    release(&p);
}

// ---- materials ------------------------------------------------------------------------------

static void test_materials(void **state)
{
    (void)state;
    assert_int_equal(mkdir("sub", 0700), 0);
    write_text("sub/a.mtl", "newmtl red\nKa 1 1 1\nKd 1 0.5 0.25\nKs 0.1 0.2 0.3\nNs 90\nNi 1.25\n"
                            "Ke 0 2 0\nd 0.75\nnewmtl unused\nnewmtl bare\n");
    write_text("sub/b.mtl", "newmtl red\nKd 0 0 0\nnewmtl other\nKd 0 0 1\n");
    write_text("sub/m.obj", "mtllib a.mtl b.mtl\n" SQUARE_VERTICES
                            "f 1 2 3\nusemtl red\nf 1 2 3\nusemtl other\nf 2 3 4\nusemtl bare\nf 1 2 4\n");
    Parsed p = load_text("material red phong { diffuse 0.5 }\nmesh { file \"sub/m.obj\" material red }");
    assert_string_equal(p.messages, "");
    const Scene *scene = p.scene;
    assert_int_equal(scene->material_count, 5);
    assert_int_equal(scene->shapes[0].material, 1);
    const Mesh *mesh = mesh_of(&p, 0);
    assert_int_equal(mesh->part_count, 4);
    assert_int_equal(mesh->parts[0].material, -1);
    for (u32 i = 1; i < 4; ++i)
        assert_int_equal(mesh->parts[i].first, i);
    const Material *red = &scene->materials[mesh->parts[1].material];
    assert_string_equal(red->name, "red");
    assert_int_equal(red->kind, MATERIAL_PHONG);
    assert_vec(red->diffuse.color, 1, 0.5, 0.25);
    assert_vec(red->ambient.color, 1, 0.5, 0.25);
    assert_vec(red->specular, 0.1, 0.2, 0.3);
    assert_vec(red->emission.color, 0, 2, 0);
    assert_vec(red->transmit, 0.25, 0.25, 0.25);
    assert_vec(red->reflect, 0, 0, 0);
    assert_true(red->shininess == 90 && red->ior == 1.25 && !red->fresnel);
    assert_true(red->diffuse.texture == -1 && red->ambient.texture == -1 && red->normal_map == -1);
    const Material *other = &scene->materials[mesh->parts[2].material];
    assert_string_equal(other->name, "other");
    assert_vec(other->diffuse.color, 0, 0, 1);
    const Material *bare = &scene->materials[mesh->parts[3].material];
    assert_vec(bare->diffuse.color, 0.8, 0.8, 0.8);
    assert_vec(bare->specular, 0, 0, 0);
    assert_vec(bare->transmit, 0, 0, 0);
    assert_true(bare->shininess == 32 && bare->ior == 1.5);
    release(&p);
    unlink("sub/a.mtl");
    unlink("sub/b.mtl");
    unlink("sub/m.obj");
    rmdir("sub");
}

static void test_missing_materials(void **state)
{
    (void)state;
    write_text("here.mtl", "newmtl a\n");
    write_text("name.obj", SQUARE_VERTICES "mtllib here.mtl\nusemtl a\nf 1 2 3\nusemtl b\nf 1 3 4\n");
    Parsed p = load_text("mesh { file \"name.obj\" }");
    assert_string_equal(p.messages, "name.obj:8:1: warning: no mtllib of the file has a material 'b'\n");
    const Mesh *mesh = mesh_of(&p, 0);
    assert_int_equal(mesh->parts[0].material, 1);
    assert_int_equal(mesh->parts[1].material, -1);
    release(&p);

    write_text("lib.obj", SQUARE_VERTICES "mtllib away.mtl\nusemtl a\nf 1 2 3\n");
    p = load_text("mesh { file \"lib.obj\" }");
    assert_string_equal(p.messages,
                        "lib.obj:5:1: warning: cannot read 'away.mtl': No such file or directory\n");
    assert_int_equal(mesh_of(&p, 0)->parts[0].material, -1);
    release(&p);
}

// One texel of grey 51, 8 bits.
static const u8 grey_png[] = {
    0x89, 'P', 'N', 'G', 0x0d, 0x0a, 0x1a, 0x0a, 0, 0, 0, 13, 'I', 'H', 'D', 'R', 0, 0, 0, 1, 0, 0, 0, 1, 8, 0, 0, 0, 0,
    0x3a, 0x7e, 0x9b, 0x55, 0x00, 0x00, 0x00, 0x0a, 0x49, 0x44, 0x41, 0x54, 0x78, 0x9c, 0x63, 0x30,
    0x06, 0x00, 0x00, 0x35, 0x00, 0x34, 0xca, 0xb4, 0x99, 0xed, 0x00, 0x00, 0x00, 0x00, 0x49, 0x45,
    0x4e, 0x44, 0xae, 0x42, 0x60, 0x82,
};

static void write_grey(const char *name)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(grey_png, 1, sizeof grey_png, file), sizeof grey_png);
    assert_int_equal(fclose(file), 0);
}

static void test_textures(void **state)
{
    (void)state;
    write_text("t.mtl", "newmtl plain\nnewmtl wood\nKd 1 0.5 0.25\nmap_Kd wood.png\nnewmtl brick\nmap_Kd wood.png\n"
                        "norm bumps.png\nnewmtl unused\nmap_Kd away.png\n");
    write_text("t.obj", SQUARE_VERTICES
               "mtllib t.mtl\nusemtl plain\nf 1 2 3\nusemtl wood\nf 1 3 4\nusemtl brick\nf 1 2 4\n");
    write_grey("wood.png");
    write_grey("bumps.png");
    Parsed p = load_text("mesh { file \"t.obj\" }");
    assert_string_equal(p.messages, "");
    const Scene *s = p.scene;
    assert_int_equal(s->texture_count, 3);
    assert_int_equal(s->bitmap_count, 2);
    const Material *wood = &s->materials[2], *brick = &s->materials[3];
    assert_int_equal(s->materials[1].diffuse.texture, -1);
    assert_int_equal(wood->diffuse.texture, 0);
    assert_int_equal(wood->ambient.texture, 0);
    assert_vec(wood->diffuse.color, 1, 0.5, 0.25);
    assert_vec(wood->ambient.color, 1, 0.5, 0.25);
    assert_int_equal(wood->normal_map, -1);
    assert_vec(brick->diffuse.color, 0.8, 0.8, 0.8); // what is missing has the defaults
    assert_int_equal(brick->normal_map, 2);
    assert_ptr_equal(s->textures[0].bitmap, s->textures[1].bitmap);
    assert_ptr_not_equal(s->textures[0].bitmap, s->textures[2].bitmap);
    assert_int_equal(s->textures[0].encoding, ENCODING_SRGB);
    assert_true(s->textures[0].scale[0] == 1 && s->textures[0].scale[1] == 1);
    release(&p);
}

// The material goes without it; an image that the scene names itself is an error.
static void test_missing_textures(void **state)
{
    (void)state;
    write_grey("wood.png");
    write_text("u.mtl", "newmtl wood\nKd 0.5 0.25 0\nmap_Kd away.png\nnorm .\\wood.png\n"
                        "newmtl brick\nmap_Kd away.png\nnorm u.mtl\n");
    write_text("u.obj", SQUARE_VERTICES "mtllib u.mtl\nusemtl wood\nf 1 2 3\nusemtl brick\nf 1 3 4\n");
    Parsed p = load_text("mesh { file \"u.obj\" }");
    assert_string_equal(p.messages, "t:1:8: warning: cannot read 'away.png', which 'u.mtl' names: No such file or "
                                    "directory; it is left out\n"
                                    "    mesh { file \"u.obj\" }\n           ^~~~\n"
                                    "t:1:8: warning: cannot read 'u.mtl', which 'u.mtl' names: not a PNG, JPEG, "
                                    "Radiance HDR or OpenEXR file; it is left out\n"
                                    "    mesh { file \"u.obj\" }\n           ^~~~\n");
    const Material *wood = &p.scene->materials[1], *brick = &p.scene->materials[2];
    assert_int_equal(wood->diffuse.texture, -1);
    assert_int_equal(wood->ambient.texture, -1);
    assert_vec(wood->diffuse.color, 0.5, 0.25, 0);
    assert_non_null(p.scene->textures[wood->normal_map].bitmap); // from where a backslash parts folders
    assert_int_equal(brick->diffuse.texture, -1);
    assert_int_equal(brick->normal_map, -1);
    release(&p);
    expect_messages("mesh { file \"u.obj\" }\nenvironment { file \"away.png\" }",
                    "t:1:8: warning: cannot read 'u.mtl', which 'u.mtl' names: not a PNG, JPEG, Radiance HDR or "
                    "OpenEXR file; it is left out\n"
                    "    mesh { file \"u.obj\" }\n           ^~~~\n"
                    "t:2:15: error: cannot read 'away.png': No such file or directory\n"
                    "    environment { file \"away.png\" }\n                  ^~~~\n");
}

#define GREY_URI \
    "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGMwBgAANQA0" \
    "yrSZ7QAAAABJRU5ErkJggg=="

static void test_gltf_materials(void **state)
{
    (void)state;
    if (!import_available())
        skip();
    write_text("m.gltf",
               "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
               "\"nodes\":[{\"mesh\":0}],\"materials\":[{\"name\":\"blue\","
               "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0.5,1,1],\"metallicFactor\":0.25,"
               "\"roughnessFactor\":0.75,\"baseColorTexture\":{\"index\":0},"
               "\"metallicRoughnessTexture\":{\"index\":1}},\"emissiveFactor\":[1,0.5,0],"
               "\"emissiveTexture\":{\"index\":0},\"normalTexture\":{\"index\":2},\"occlusionTexture\":{\"index\":1},"
               "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":0.5}}}],"
               "\"extensionsUsed\":[\"KHR_materials_transmission\"],"
               "\"samplers\":[{\"magFilter\":9728}],"
               "\"textures\":[{\"source\":0},{\"source\":1},{\"source\":2,\"sampler\":0}],"
               "\"images\":[{\"uri\":\"wood.png\"},{\"uri\":\"" GREY_URI "\"},{\"uri\":\"bumps.png\"}],"
               "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0},\"material\":0}]}],"
               "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\","
               "\"min\":[0,0,0],\"max\":[1,1,0]}],"
               "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":36}],"
               "\"buffers\":[{\"byteLength\":36,\"uri\":\"data:application/octet-stream;base64,"
               "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA\"}]}");
    write_grey("wood.png");
    write_grey("bumps.png");
    Parsed p = load_text("mesh { file \"m.gltf\" }");
    assert_string_equal(p.messages, "");
    const Mesh *mesh = mesh_of(&p, 0);
    assert_int_equal(mesh->parts[0].material, 1);
    const Material *m = &p.scene->materials[1];
    const Texture *t = p.scene->textures;
    assert_int_equal(m->kind, MATERIAL_PBR);
    assert_vec(m->base_color.color, 0, 0.5, 1);
    assert_vec(m->emission.color, 1, 0.5, 0);
    assert_true(m->metallic.value == 0.25 && m->roughness.value == 0.75 && m->occlusion.value == 1);
    assert_true(m->pbr_transmit == 0.5 && m->ior == 1.5);
    assert_string_equal(t[m->base_color.texture].file, "wood.png");
    assert_string_equal(t[m->emission.texture].file, "wood.png");
    assert_string_equal(t[m->normal_map].file, "bumps.png");
    assert_int_equal(t[m->normal_map].filter, TEXTURE_NEAREST);
    assert_int_equal(t[m->base_color.texture].filter, TEXTURE_BILINEAR);
    // The picture within the file, read once for three numbers.
    assert_int_equal(t[m->roughness.texture].channel, 1);
    assert_int_equal(t[m->metallic.texture].channel, 2);
    assert_int_equal(t[m->occlusion.texture].channel, 0);
    assert_string_equal(t[m->metallic.texture].file, "m.gltf");
    assert_int_equal(p.scene->bitmap_count, 3);
    const Bitmap *within = t[m->metallic.texture].bitmap;
    assert_ptr_equal(within, t[m->roughness.texture].bitmap);
    assert_ptr_equal(within, t[m->occlusion.texture].bitmap);
    assert_int_equal(within->width, 1);
    assert_int_equal(within->height, 1);
    assert_true(bitmap_value(within, 0, 0, 0) == 51.0 / 255);
    release(&p);
}

// ---- what is wrong --------------------------------------------------------------------------

// The first line of the messages about a scene with a bad mesh in its second line.
static void expect_bad(const char *name, const char *expected)
{
    char text[300];
    snprintf(text, sizeof text, "# bad\n  mesh { smooth on file \"%s\" }\nmesh { file \"%s\" }", name, name);
    Parsed p = load_text(text);
    assert_int_equal(diagnostics_error_count(p.diagnostics), 1);
    p.messages[strcspn(p.messages, "\n")] = 0;
    assert_string_equal(p.messages, expected);
    release(&p);
}

static void test_bad_files(void **state)
{
    (void)state;
    expect_bad("away.obj", "t:2:20: error: cannot read 'away.obj': No such file or directory");
    expect_bad(".", "t:2:20: error: cannot read '.': Is a directory");
    expect_bad("/dev/null", "t:2:20: error: cannot read '/dev/null': not a regular file");
    write_text("empty.obj", "");
    expect_bad("empty.obj", "t:2:20: error: cannot use 'empty.obj': it has no faces");
    write_text("points.obj", SQUARE_VERTICES);
    expect_bad("points.obj", "t:2:20: error: cannot use 'points.obj': it has no faces");
    write_text("line.obj", "v 0 0 0\nv 1 1 1\nv 2 2 2\nf 1 2 3\nf 1 1 2\n");
    expect_bad("line.obj", "t:2:20: error: cannot use 'line.obj': none of its faces has an area");
    write_text("junk.ply", "junk");
    Parsed p = load_text("mesh { file \"junk.ply\" }");
    assert_int_equal(diagnostics_error_count(p.diagnostics), 1);
    assert_memory_equal(p.messages, "t:1:8: error: cannot read 'junk.ply': ", 37);
    release(&p);
}

// Errors inside an OBJ are told where they are; other files are read all the same.
static void test_errors_inside(void **state)
{
    (void)state;
    write_text("good.obj", SQUARE);
    write_text("index.obj", SQUARE_VERTICES "f 1 2 9\n");
    Parsed p = load_text("mesh { file \"index.obj\" } mesh { file \"good.obj\" } mesh { file \"away.obj\" }");
    assert_int_equal(diagnostics_error_count(p.diagnostics), 2);
    assert_non_null(strstr(p.messages, "index.obj:5:"));
    assert_non_null(strstr(p.messages, "t:1:59: error: cannot read 'away.obj'"));
    assert_null(p.scene->shapes[0].as.mesh.mesh);
    assert_null(p.scene->shapes[2].as.mesh.mesh);
    release(&p);
}

int main(void)
{
    char folder[FIXTURE_PATH_MAX];
    enter_folder(folder);
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_sharing),       cmocka_unit_test(test_smooth_alone),
        cmocka_unit_test(test_no_meshes),     cmocka_unit_test(test_many),
        cmocka_unit_test(test_materials),     cmocka_unit_test(test_missing_materials),
        cmocka_unit_test(test_textures),
        cmocka_unit_test(test_missing_textures),      cmocka_unit_test(test_gltf_materials),
        cmocka_unit_test(test_bad_files),     cmocka_unit_test(test_errors_inside),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    leave_folder(folder);
    return failed;
}
