// What a glTF says of its maps beside their files: coordinates, strength, names, and what is left out.
#include "assets_fixture.h"
#include "scene_parse_fixture.h"

#include <math.h>
#include <png.h>

#include "assets/assets.h"
#include "assets/gltf_json.h"
#include "assets/import.h"

// Of three vertices, as in test.bin: positions, two sets of uvs (v downwards), colors.
static const f32 buffer[] = {0,     0,    0,     1,    0,    0, 0,    1,    0,   // positions
                             0.25f, 0.5f, 0.75f, 0,    0.5f, 1,                  // uvs
                             0,     0,    1,     0.5f, 0,    2,                  // other uvs
                             1,     1,    1,     1,    0.5f, 1, 1,    1,    1};  // colors

#define TRANSFORM \
    "\"extensions\":{\"KHR_texture_transform\":{\"offset\":[0.1,-0.2],\"rotation\":0.5,\"scale\":[2,-3]}}"

// A triangle with that material, as the text of a .gltf; false where it does not fit.
static bool gltf_text(char *text, size_t size, const char *material, bool colored)
{
    const int length = snprintf(
        text, size,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"mesh\":0}],"
        "\"extensionsUsed\":[\"KHR_texture_transform\",\"KHR_materials_clearcoat\",\"KHR_materials_unlit\"],"
        "\"materials\":[{\"name\":\"m\",%s}],"
        "\"textures\":[{\"source\":0},{\"source\":1,\"sampler\":0},{\"source\":2}],"
        "\"samplers\":[{\"wrapT\":33071}],"
        "\"images\":[{\"uri\":\"a%%20%%62.png\"},{\"uri\":\"a b.png\"},{\"uri\":\"away%%2.png\"}],"
        "\"meshes\":[{\"primitives\":[{\"attributes\":{\"POSITION\":0,\"TEXCOORD_0\":1,\"TEXCOORD_1\":2%s},"
        "\"material\":0}]}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\",\"min\":[0,0,0],"
        "\"max\":[1,1,0]},"
        "{\"bufferView\":0,\"byteOffset\":36,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":60,\"componentType\":5126,\"count\":3,\"type\":\"VEC2\"},"
        "{\"bufferView\":0,\"byteOffset\":84,\"componentType\":5126,\"count\":3,\"type\":\"VEC3\"}],"
        "\"bufferViews\":[{\"buffer\":0,\"byteOffset\":0,\"byteLength\":120}],"
        "\"buffers\":[{\"byteLength\":120,\"uri\":\"test.bin\"}]}",
        material, colored ? ",\"COLOR_0\":3" : "");
    return length > 0 && (size_t)length < size;
}

static void write_gltf(const char *name, const char *material, bool colored)
{
    char text[4096];
    assert_true(gltf_text(text, sizeof text, material, colored));
    write_text(name, text);
}

static Parsed load(const char *material, bool colored)
{
    write_gltf("test.gltf", material, colored);
    Parsed parsed = parse_bytes("mesh { file \"test.gltf\" }", 25);
    assert_non_null(parsed.scene);
    if (!assets_load(parsed.scene, parsed.arena, parsed.diagnostics, &parsed.error))
        fail_msg("%s", parsed.error.text);
    free(parsed.messages);
    parsed.messages = printed(parsed.diagnostics);
    assert_int_equal(diagnostics_error_count(parsed.diagnostics), 0);
    return parsed;
}

static void release(Parsed *parsed)
{
    assets_release(parsed->scene);
    parsed_end(parsed);
}

// The uvs of the triangle, v upwards.
static void expect_uvs(const char *material, f64 expected[3][2])
{
    Parsed p = load(material, false);
    assert_string_equal(p.messages, "");
    const Mesh *mesh = p.scene->shapes[0].as.mesh.mesh;
    for (u32 i = 0; i < 3; ++i)
        for (u32 k = 0; k < 2; ++k) {
            const f64 found = (f64)mesh->uvs[mesh->face_uvs[0][i]][k];
            if (fabs(found - expected[i][k]) > 1e-6)
                fail_msg("%s: uv %u, %u is %g, not %g", material, i, k, found, expected[i][k]);
        }
    release(&p);
}

#define BASE "\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":0"

static void test_uvs(void **state)
{
    (void)state;
    f64 plain[3][2] = {{0.25, 0.5}, {0.75, 1}, {0.5, 0}}, other[3][2] = {{0, 1}, {1, 0.5}, {0, -1}};
    expect_uvs("\"doubleSided\":true", plain);
    expect_uvs(BASE "}}", plain);
    expect_uvs(BASE ",\"texCoord\":1}}", other);
    // By the extension's words: scaled, turned counter-clockwise as seen with v downwards, moved.
    f64 turned[3][2];
    for (u32 i = 0; i < 3; ++i) {
        const f64 u = 2 * (f64)buffer[9 + 2 * i], v = -3 * (f64)buffer[10 + 2 * i];
        turned[i][0] = cos(0.5) * u + sin(0.5) * v + 0.1;
        turned[i][1] = 1 - (cos(0.5) * v - sin(0.5) * u - 0.2);
    }
    expect_uvs(BASE "," TRANSFORM "}},\"normalTexture\":{\"index\":0," TRANSFORM "}", turned);
}

static void expect_warning(const char *material, bool colored, const char *warning)
{
    char expected[512];
    snprintf(expected, sizeof expected,
             "t:1:8: warning: material 'm' of 'test.gltf': %s\n"
             "    mesh { file \"test.gltf\" }\n           ^~~~\n",
             warning);
    Parsed p = load(material, colored);
    assert_string_equal(p.messages, expected);
    release(&p);
}

static void test_left_out(void **state)
{
    (void)state;
    static const char uvs[] = "all maps are looked up by the coordinates of the first";
    static const char layers[] =
        "clear coat, sheen, specular and glossiness, unlit and maps of transmission are left out";
    expect_warning(BASE "}},\"normalTexture\":{\"index\":0," TRANSFORM "}", false, uvs);
    expect_warning(BASE "}},\"occlusionTexture\":{\"index\":0,\"texCoord\":1}", false, uvs);
    expect_warning("\"emissiveTexture\":{\"index\":1}", false,
                   "textures that are clamped or mirrored repeat");
    expect_warning("\"alphaMode\":\"MASK\"", false, "alpha is ignored");
    expect_warning("\"alphaMode\":\"OPAQUE\"", true, "colors of vertices are ignored");
    expect_warning("\"extensions\":{\"KHR_materials_clearcoat\":{\"clearcoatFactor\":0.5}}", false, layers);
    expect_warning("\"extensions\":{\"KHR_materials_unlit\":{}}", false, layers);
}

// a b.png is 2 x 1: 51 102 204, then white.
static void expect_texel(const Bitmap *bitmap, f64 r, f64 g, f64 b)
{
    assert_non_null(bitmap);
    const f64 expected[] = {r, g, b};
    for (u32 c = 0; c < 3; ++c)
        assert_true(fabs(bitmap_value(bitmap, 0, 0, c) - expected[c]) < 1e-6);
}

static void test_strengths(void **state)
{
    (void)state;
    // Two files' names for one; the maps of normals and occlusion are each made anew, the other map is not.
    Parsed p = load(BASE "}},\"normalTexture\":{\"index\":0,\"scale\":2},"
                    "\"occlusionTexture\":{\"index\":0,\"strength\":0.25}", false);
    assert_string_equal(p.messages, "");
    const Material *m = &p.scene->materials[1];
    const Texture *t = p.scene->textures;
    assert_int_equal(p.scene->bitmap_count, 3);
    assert_string_equal(t[m->base_color.texture].file, "a b.png");
    assert_int_equal(t[m->base_color.texture].bitmap->type, BITMAP_U8);
    expect_texel(t[m->base_color.texture].bitmap, 0.2, 0.4, 0.8);
    expect_texel(t[m->normal_map].bitmap, 0.5 + 2 * (0.2 - 0.5), 0.5 + 2 * (0.4 - 0.5), 0.8);
    expect_texel(t[m->occlusion.texture].bitmap, 1 + 0.25 * (0.2 - 1), 1 + 0.25 * (0.4 - 1), 0.8);
    release(&p);
}

static void test_missing(void **state)
{
    (void)state;
    Parsed p = load("\"pbrMetallicRoughness\":{\"baseColorTexture\":{\"index\":2},"
                    "\"metallicRoughnessTexture\":{\"index\":2}},"
                    "\"normalTexture\":{\"index\":2,\"scale\":0.5},\"emissiveTexture\":{\"index\":0}",
                    false);
    // What is no code stays as it is.
    assert_string_equal(p.messages,
                        "t:1:8: warning: cannot read 'away%2.png', which 'test.gltf' names: No such file or "
                        "directory; it is left out\n"
                        "    mesh { file \"test.gltf\" }\n           ^~~~\n");
    const Material *m = &p.scene->materials[1];
    assert_int_equal(m->base_color.texture, -1);
    assert_int_equal(m->metallic.texture, -1);
    assert_int_equal(m->roughness.texture, -1);
    assert_int_equal(m->normal_map, -1);
    assert_non_null(p.scene->textures[m->emission.texture].bitmap);
    release(&p);
}

// ---- emissive strength ----------------------------------------------------------------------

#define STRENGTH(s) "\"extensions\":{\"KHR_materials_emissive_strength\":{\"emissiveStrength\":" s "}}"

static void test_emission(void **state)
{
    (void)state;
    Parsed p = load("\"emissiveFactor\":[1,0.5,0]," STRENGTH("2.5"), false);
    assert_string_equal(p.messages, "");
    const Vec3 emission = p.scene->materials[1].emission.color;
    assert_true(emission.x == 2.5 && emission.y == 1.25 && emission.z == 0);
    release(&p);
}

static void expect_strengths(const char *name, f64 first, f64 second)
{
    Error error = {0};
    f64 strengths[2] = {-1, -1};
    assert_true(gltf_emissive_strengths(name, strengths, 2, &error));
    if (strengths[0] != first || strengths[1] != second)
        fail_msg("%s: %g and %g, not %g and %g", name, strengths[0], strengths[1], first, second);
}

static void test_json(void **state)
{
    (void)state;
    expect_strengths("away.gltf", 1, 1);
    write_text("json", "");
    expect_strengths("json", 1, 1);
    write_text("json", "{\"materials\":[{" STRENGTH("3") "},{}]}");
    expect_strengths("json", 3, 1);
    write_text("json", "{\"materials\":[{" STRENGTH("\"3\"") "},{" STRENGTH("-1") "},{" STRENGTH("4") "}]}");
    expect_strengths("json", 1, 0);
    write_text("json", "{\"materials\":{\"emissiveStrength\":2}}");
    expect_strengths("json", 1, 1);
    write_text("json", "{\"materials\":[{" STRENGTH("3") "},{}");
    expect_strengths("json", 1, 1);
    static const char glb[] = "glTF\2\0\0\0\0\0\0\0\xff\xff\0\0JSON"
                              "{\"materials\":[{},{" STRENGTH("0.5") "}]}";
    for (size_t length = 0; length < sizeof glb - 1; ++length) {
        write_bytes("json", glb, length);
        expect_strengths("json", 1, 1);
    }
    write_bytes("json", glb, sizeof glb - 1);
    expect_strengths("json", 1, 0.5);
}

int main(void)
{
    char folder[FIXTURE_PATH_MAX];
    enter_folder(folder);
    static const u8 levels[] = {51, 102, 204, 255, 255, 255};
    png_image image = {.version = PNG_IMAGE_VERSION, .width = 2, .height = 1, .format = PNG_FORMAT_RGB};
    bool ready = png_image_write_to_file(&image, "a b.png", 0, levels, 0, NULL) != 0;
    FILE *file = fopen("test.bin", "wb");
    ready = file && fwrite(buffer, sizeof buffer, 1, file) == 1 && ready;
    ready = file && fclose(file) == 0 && ready;
    const struct CMUnitTest tests[] = {cmocka_unit_test(test_json),      cmocka_unit_test(test_uvs),
                                       cmocka_unit_test(test_left_out),  cmocka_unit_test(test_strengths),
                                       cmocka_unit_test(test_missing),   cmocka_unit_test(test_emission)};
    const struct CMUnitTest without[] = {cmocka_unit_test(test_json)};
    const int failed = import_available() ? cmocka_run_group_tests(tests, NULL, NULL)
                                          : cmocka_run_group_tests(without, NULL, NULL);
    leave_folder(folder);
    return ready ? failed : 1;
}
