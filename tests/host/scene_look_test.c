// Lights, textures, materials.
#include "scene_parse_fixture.h"

static void test_lights(void **state)
{
    (void)state;
    Parsed p = parse_good("light point { position 1 2 3 }\n"
                          "light point { position 1 2 3 intensity 4 5 6 attenuation 0 0.5 1 }\n"
                          "light directional { direction 0 -2 0 intensity \"#ffffff\" }\n"
                          "light spot { position 0 5 0 look_at 0 0 0 }\n"
                          "light spot { position 0 5 0 look_at 0 0 0 inner 0 outer 360 attenuation 0 0 1 }");
    const Light *l = p.scene->lights;
    assert_int_equal(p.scene->light_count, 5);
    assert_int_equal(l[0].kind, LIGHT_POINT);
    assert_vec(l[0].position, 1, 2, 3);
    assert_vec(l[0].intensity, 1, 1, 1);
    assert_true(l[0].attenuation[0] == 1 && l[0].attenuation[1] == 0 && l[0].attenuation[2] == 0);
    assert_vec(l[1].intensity, 4, 5, 6);
    assert_true(l[1].attenuation[0] == 0 && l[1].attenuation[1] == 0.5 && l[1].attenuation[2] == 1);
    assert_int_equal(l[2].kind, LIGHT_DIRECTIONAL);
    assert_vec(l[2].direction, 0, -2, 0);
    assert_int_equal(l[3].kind, LIGHT_SPOT);
    assert_true(l[3].inner == 45 && l[3].outer == 45);
    assert_true(l[4].inner == 0 && l[4].outer == 360);
    assert_int_equal(l[4].at.line, 5);
    assert_int_equal(p.scene->world.count, 0); // nothing of them can be hit
    parsed_end(&p);
    expect_error("light point { }", "1:1: point light lacks 'position'");
    expect_error("light spot { position 0 0 0 look_at 0 1 0 outer 361 }",
                 "1:49: 'outer' must be above 0 and at most 360");
    expect_error("light spot { position 0 0 0 look_at 0 1 0 outer 0 }",
                 "1:49: 'outer' must be above 0 and at most 360");
    expect_error("light directional { direction 1 0 0 attenuation 1 0 0 }",
                 "1:37: unknown property 'attenuation' of directional light");
}

static void test_area_lights(void **state)
{
    (void)state;
    const char *text = "light sphere { center 1 2 3 radius 4 radiance 5 samples 6 }\n"
                       "sphere { center 0 0 0 radius 1 }\n"
                       "light rectangle { corner 1 2 3 edge1 1 0 0 edge2 0 1 0 radiance 7 8 9 }";
    Parsed p = parse_good(text);
    const Scene *s = p.scene;
    assert_int_equal(s->lights[0].kind, LIGHT_SPHERE);
    assert_vec(s->lights[0].position, 1, 2, 3);
    assert_true(s->lights[0].radius == 4);
    assert_vec(s->lights[0].intensity, 5, 5, 5);
    assert_int_equal(s->lights[0].samples, 6);
    assert_vec(s->lights[1].edge2, 0, 1, 0);
    assert_int_equal(s->lights[1].samples, 1);
    assert_int_equal(s->world.count, 3); // they take part in the order of what is hit
    assert_int_equal(s->world.items[0].kind, ITEM_LIGHT);
    assert_int_equal(s->world.items[1].kind, ITEM_SHAPE);
    assert_int_equal(s->world.items[2].kind, ITEM_LIGHT);
    assert_int_equal(s->world.items[2].index, 1);
    parsed_end(&p);
    expect_error("light rectangle { corner 0 0 0 edge1 1 0 0 edge2 -3 0 0 radiance 1 }",
                 "1:44: the rectangle has no area");
    expect_error("light sphere { center 0 0 0 radius 1 }", "1:1: sphere light lacks 'radiance'");
}

static void test_checker_colors(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        Vec3 a, b;
    } cases[] = {
        {"", {1, 1, 1}, {0, 0, 0}},
        {"colors 0.2 0.4", {0.2, 0.2, 0.2}, {0.4, 0.4, 0.4}},
        {"colors 1 2 3 4 5 6", {1, 2, 3}, {4, 5, 6}},
        {"colors \"#ffffff\" \"#ff0000\"", {1, 1, 1}, {1, 0, 0}},
        {"colors \"#ff0000\" 0.5", {1, 0, 0}, {0.5, 0.5, 0.5}},
        {"colors 0.5 \"#ff0000\"", {0.5, 0.5, 0.5}, {1, 0, 0}},
        {"colors \"#ff0000\" 1 2 3", {1, 0, 0}, {1, 2, 3}},
        {"colors 1 2 3 \"#ff0000\"", {1, 2, 3}, {1, 0, 0}},
    };
    for (u32 i = 0; i < sizeof cases / sizeof *cases; ++i) {
        char text[120];
        snprintf(text, sizeof text, "texture t checker { %s scale 2 -3 }", cases[i].text);
        Parsed p = parse_good(text);
        const Texture *t = &p.scene->textures[0];
        assert_vec(t->colors[0], cases[i].a.x, cases[i].a.y, cases[i].a.z);
        assert_vec(t->colors[1], cases[i].b.x, cases[i].b.y, cases[i].b.z);
        assert_true(t->scale[0] == 2 && t->scale[1] == -3);
        parsed_end(&p);
    }
    static const char *const wrong[] = {"1", "1 2 3", "1 2 3 4", "1 2 3 4 5", "\"#ffffff\" 1 2",
                                        "1 2 \"#ffffff\"", "1 2 3 \"#ffffff\" 4"};
    for (u32 i = 0; i < sizeof wrong / sizeof *wrong; ++i) {
        char text[120];
        snprintf(text, sizeof text, "texture t checker { colors %s }", wrong[i]);
        Parsed p = parse_bytes(text, strlen(text));
        assert_int_equal(diagnostics_error_count(p.diagnostics), 1);
        assert_non_null(strstr(p.messages, "t:1:21: error: 'colors' takes 2 colors"));
        parsed_end(&p);
    }
    expect_error("texture t checker { colors 1 2 3 4 5 6 7 }",
                 "1:40: unexpected '7'; 'colors' takes 2 colors: 2 or 6 numbers, or \"#rrggbb\" for one or "
                 "both");
    expect_error("texture t checker { colors 1 -1 }", "1:30: 'colors' must be 0 or more");
}

static void test_textures(void **state)
{
    (void)state;
    Parsed p = parse_good("texture a checker { } texture b checker3d { scale 0.25 }");
    assert_int_equal(p.scene->texture_count, 2);
    assert_string_equal(p.scene->textures[1].name, "b");
    assert_int_equal(p.scene->textures[1].kind, TEXTURE_CHECKER3D);
    assert_true(p.scene->textures[1].scale[0] == 0.25);
    assert_true(p.scene->textures[0].scale[0] == 1 && p.scene->textures[0].scale[1] == 1);
    parsed_end(&p);
    const char *text = "texture i image { file \"a.png\" scale 2 3 filter nearest color linear }\n"
                       "texture j image { file \"b \\\"c\\\\.png\" }";
    p = parse_bytes(text, strlen(text));
    assert_int_equal(diagnostics_error_count(p.diagnostics), 0);
    const Texture *t = p.scene->textures;
    assert_string_equal(t[0].file, "a.png");
    assert_int_equal(t[0].filter, TEXTURE_NEAREST);
    assert_int_equal(t[0].encoding, ENCODING_LINEAR);
    assert_string_equal(t[1].file, "b \"c\\.png");
    assert_int_equal(t[1].filter, TEXTURE_BILINEAR);
    assert_int_equal(t[1].encoding, ENCODING_SRGB);
    parsed_end(&p);
    expect_error("texture i image { }", "1:1: image texture lacks 'file'");
    expect_error("texture i checkr { }", "1:11: unknown kind of texture 'checkr'; did you mean 'checker'?");
}

static void test_phong(void **state)
{
    (void)state;
    Parsed p = parse_good("texture t checker { }\n"
                          "material a phong { }\n"
                          "material b blinn_phong { diffuse t specular 0.5 shininess 0 reflect 1 2 3\n"
                          "  transmit 0.25 ior 1.3 fresnel on emission 4 }\n"
                          "material c phong { diffuse 0.5 ambient t }\n"
                          "sphere { center 0 0 0 radius 1 material b }");
    const Material *m = p.scene->materials;
    assert_int_equal(p.scene->material_count, 4);
    assert_int_equal(m[1].kind, MATERIAL_PHONG);
    assert_vec(m[1].diffuse.color, 0.8, 0.8, 0.8);
    assert_vec(m[1].ambient.color, 0.8, 0.8, 0.8);
    assert_vec(m[1].specular, 0, 0, 0);
    assert_true(m[1].shininess == 32 && m[1].ior == 1.5 && !m[1].fresnel);
    assert_vec(m[1].reflect, 0, 0, 0);
    assert_vec(m[1].transmit, 0, 0, 0);
    assert_vec(m[1].emission.color, 0, 0, 0);
    assert_int_equal(m[1].emission.texture, -1);
    assert_int_equal(m[1].normal_map, -1);
    assert_int_equal(m[2].kind, MATERIAL_BLINN_PHONG);
    assert_int_equal(m[2].diffuse.texture, 0);
    assert_int_equal(m[2].ambient.texture, 0); // as diffuse
    assert_vec(m[2].specular, 0.5, 0.5, 0.5);
    assert_vec(m[2].reflect, 1, 2, 3);
    assert_true(m[2].shininess == 0 && m[2].ior == 1.3 && m[2].fresnel);
    assert_int_equal(m[3].ambient.texture, 0);
    assert_int_equal(m[3].diffuse.texture, -1);
    assert_vec(m[3].diffuse.color, 0.5, 0.5, 0.5);
    assert_int_equal(p.scene->shapes[0].material, 2);
    parsed_end(&p);
    expect_error("material a phong { ior 0 }", "1:24: 'ior' must be above 0");
    expect_error("material a phong { metallic 1 }", "1:20: unknown property 'metallic' of phong material");
}

static void test_pbr(void **state)
{
    (void)state;
    const char *text = "texture t checker { }\nmaterial a pbr { }\n"
                       "material b pbr { base_color 1 0 0 metallic t roughness 0 emission t occlusion 0.5\n"
                       "transmit 1 ior 2 normal_map t }";
    Parsed p = parse_bytes(text, strlen(text));
    assert_int_equal(diagnostics_error_count(p.diagnostics), 0);
    const Material *m = p.scene->materials;
    assert_int_equal(m[1].kind, MATERIAL_PBR);
    assert_vec(m[1].base_color.color, 0.8, 0.8, 0.8);
    assert_true(m[1].metallic.value == 0 && m[1].metallic.texture == -1);
    assert_true(m[1].roughness.value == 0.5 && m[1].occlusion.value == 1);
    assert_true(m[1].pbr_transmit == 0 && m[1].ior == 1.5);
    assert_vec(m[2].base_color.color, 1, 0, 0);
    assert_int_equal(m[2].metallic.texture, 0);
    assert_true(m[2].metallic.value == 1); // as the texture says
    assert_true(m[2].roughness.value == 0 && m[2].roughness.texture == -1);
    assert_int_equal(m[2].emission.texture, 0);
    assert_true(m[2].pbr_transmit == 1 && m[2].ior == 2);
    assert_int_equal(m[2].normal_map, 0);
    parsed_end(&p);
    expect_error("material a pbr { metallic 1 1 }",
                 "1:29: unexpected '1'; 'metallic' takes a number or a texture");
}

static void test_default_material(void **state)
{
    (void)state;
    Parsed p = parse_good("sphere { center 0 0 0 radius 1 material default }\n"
                          "material default blinn_phong { diffuse 0.1 }");
    assert_int_equal(p.scene->material_count, 1);
    assert_int_equal(p.scene->shapes[0].material, 0);
    assert_int_equal(p.scene->materials[0].kind, MATERIAL_BLINN_PHONG);
    assert_vec(p.scene->materials[0].diffuse.color, 0.1, 0.1, 0.1);
    assert_int_equal(p.scene->materials[0].at.line, 2);
    parsed_end(&p);
}

static void test_namespaces(void **state)
{
    (void)state;
    // A namespace each, and words of the language are names like others.
    Parsed p = parse_good("texture phong checker { } material phong phong { diffuse phong }\n"
                          "object phong { sphere { center 0 0 0 radius 1 material phong } }\n"
                          "texture specular checker { } material material phong "
                          "{ diffuse specular specular 1 }\n"
                          "instance phong { material material }");
    assert_int_equal(p.scene->materials[1].diffuse.texture, 0);
    assert_int_equal(p.scene->materials[2].diffuse.texture, 1);
    assert_vec(p.scene->materials[2].specular, 1, 1, 1);
    assert_int_equal(p.scene->instances[0].material, 2);
    parsed_end(&p);
}

static void test_many_names(void **state)
{
    (void)state;
    enum { COUNT = 3000 };
    char *text = malloc(COUNT * 90);
    size_t length = 0;
    for (u32 i = 0; i < COUNT; ++i)
        length += (size_t)snprintf(text + length, 90, "material m%u phong { diffuse %u }\n", i, i);
    for (u32 i = 0; i < COUNT; ++i)
        length += (size_t)snprintf(text + length, 90, "sphere { center 0 0 0 radius 1 material m%u }\n",
                                   COUNT - 1 - i);
    Parsed p = parse_good(text);
    assert_int_equal(p.scene->material_count, COUNT + 1);
    assert_int_equal(p.scene->world.count, COUNT);
    for (u32 i = 0; i < COUNT; ++i) {
        const i32 material = p.scene->shapes[i].material;
        assert_true(p.scene->materials[material].diffuse.color.x == COUNT - 1 - i);
        assert_int_equal(p.scene->world.items[i].index, i);
    }
    parsed_end(&p);
    free(text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_lights),           cmocka_unit_test(test_area_lights),
        cmocka_unit_test(test_checker_colors),   cmocka_unit_test(test_textures),
        cmocka_unit_test(test_phong),            cmocka_unit_test(test_pbr),
        cmocka_unit_test(test_default_material), cmocka_unit_test(test_namespaces),
        cmocka_unit_test(test_many_names),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
