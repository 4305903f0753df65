// The set of features: what a scene makes use of, and nothing that it only mentions.
#include "layout_fixture.h"

#include "layout_feature_scenes.h"

static char *names_of(FeatureSet set, char *text, size_t size)
{
    text[0] = 0;
    for (Feature f = 0; f < FEATURE_COUNT; f++)
        if (features_have(set, f))
            snprintf(text + strlen(text), size - strlen(text), " %s", feature_name(f));
    return text;
}

static void test_with_and_without(void **state)
{
    (void)state;
    FeatureSet shown = 0;
    for (u32 i = 0; i < FEATURE_SCENE_COUNT; i++) {
        const FeatureScenes *scenes = &feature_scenes[i];
        const FeatureSet with = features_of(scenes->with) | feature_scenes_asked(scenes);
        const FeatureSet without = features_of(scenes->without);
        char text[1000];
        if (!features_have(with, scenes->feature))
            fail_msg("the scene with %s has only%s", feature_name(scenes->feature),
                     names_of(with, text, sizeof text));
        if (features_have(without, scenes->feature))
            fail_msg("the scene without %s has%s", feature_name(scenes->feature),
                     names_of(without, text, sizeof text));
        shown |= feature_bit(scenes->feature);
    }
    assert_true(shown == feature_bit(FEATURE_COUNT) - 1); // no feature is left out
}

static void expect_features(const char *text, FeatureSet expected)
{
    const FeatureSet found = features_of(text);
    char a[1000], b[1000];
    if (found != expected)
        fail_msg("expected%s but found%s in\n%s", names_of(expected, a, sizeof a),
                 names_of(found, b, sizeof b), text);
}

// The whole sets of small scenes.
static void test_exact_sets(void **state)
{
    (void)state;
    const FeatureSet ball =
        feature_bit(FEATURE_SURFACES) | feature_bit(FEATURE_BVH) | feature_bit(FEATURE_SPHERE);
    const FeatureSet ambient = feature_bit(FEATURE_AMBIENT), lamp = feature_bit(FEATURE_LIGHTS) |
                                                                    feature_bit(FEATURE_POINT) |
                                                                    feature_bit(FEATURE_SHADOWS);
    expect_features("", 0);
    expect_features("mesh { file \"grid2\" }\n",
                    (ball & ~feature_bit(FEATURE_SPHERE)) | feature_bit(FEATURE_MESH) | ambient);
    expect_features("background 1", feature_bit(FEATURE_BACKGROUND));
    expect_features(SHAPE_BALL, ball | ambient);
    expect_features(SHAPE_BALL LIGHT_LAMP, ball | ambient | lamp);
    expect_features("plane { point 0 -1 0 normal 0 1 0 } ambient 0",
                    feature_bit(FEATURE_SURFACES) | feature_bit(FEATURE_PLANE));
    expect_features(MATERIAL_M("transmit 1 ambient 0") SHAPE_BALL_OF("m"),
                    ball | feature_bit(FEATURE_REFLECT) | feature_bit(FEATURE_TRANSMIT));
}

// Paths: no ambient light, nothing parked, no light through surfaces but by rays; a background is an environment.
static void test_paths(void **state)
{
    (void)state;
    const FeatureSet ball = feature_bit(FEATURE_SURFACES) | feature_bit(FEATURE_BVH) | feature_bit(FEATURE_SPHERE) |
                            feature_bit(FEATURE_PATH) | feature_bit(FEATURE_HIT_RANDOM);
    const FeatureSet lit = ball | feature_bit(FEATURE_LIGHTS) | feature_bit(FEATURE_SHADOWS);
    const FeatureSet sky = feature_bit(FEATURE_ENVIRONMENT) | feature_bit(FEATURE_ENVIRONMENT_LIGHT);
    const FeatureSet clear = feature_bit(FEATURE_REFLECT) | feature_bit(FEATURE_TRANSMIT);
    expect_features(RENDER_PATHS, 0);
    expect_features("background 1 " RENDER_PATHS, feature_bit(FEATURE_BACKGROUND));
    expect_features(SHAPE_BALL RENDER_PATHS, ball);
    expect_features("render { integrator path ambient_occlusion 4 1 } " SHAPE_BALL, ball);
    expect_features(SHAPE_BALL LIGHT_LAMP RENDER_PATHS, lit | feature_bit(FEATURE_POINT));
    // An even sky is found by rays that surfaces draw; where nothing casts shadows it is a light.
    expect_features("background 1 " SHAPE_BALL RENDER_PATHS, ball | feature_bit(FEATURE_ENVIRONMENT));
    expect_features("background 1 render { integrator path shadows off } " SHAPE_BALL,
                    (lit | sky) & ~feature_bit(FEATURE_SHADOWS));
    // The map of these tests is an even one.
    expect_features("render { integrator path environment_lighting prefiltered } " SHAPE_BALL ENVIRONMENT_SKY(""),
                    ball | feature_bit(FEATURE_ENVIRONMENT));
    expect_features(MATERIAL_M("transmit 0.5 reflect 0.5") SHAPE_BALL_OF("m") LIGHT_LAMP RENDER_PATHS,
                    lit | feature_bit(FEATURE_POINT) | clear);
    // An area light has one record, whatever its samples are, and a black one too: it stands in the way.
    expect_features(SHAPE_BALL LIGHT_LAMPS LIGHT_LAMP LIGHT_LAMP LIGHT_LAMP
                    "light sphere { center 3 4 0 radius 1 radiance 1 samples 64 }\n" RENDER_PATHS,
                    lit | feature_bit(FEATURE_POINT) | feature_bit(FEATURE_SPHERE_LIGHT) |
                        feature_bit(FEATURE_EMISSION));
}

// What is defined but never seen is not there.
static void test_unused(void **state)
{
    (void)state;
    const FeatureSet plain = features_of(SHAPE_BALL), lit = features_of(SHAPE_BALL LIGHT_LAMP);
    static const char *const idle[] = {
        "material m phong { specular 1 reflect 1 transmit 1 fresnel on emission 1 }\n",
        "texture t checker { }\ntexture s checker3d { }\nmaterial m phong { diffuse t ambient s }\n",
        "object o { box { min 0 0 0 max 1 1 1 } torus { center 0 0 0 axis 0 1 0 major 2 minor 1 } }\n",
        "object o { plane { point 0 0 0 normal 0 1 0 } }\nobject p { instance o { } }\n",
        "light spot { position 0 4 0 look_at 0 0 -4 intensity 0 }\n",
        "light directional { direction 0 -1 0 intensity 0 0 0 }\n",
        "camera { fov 20 } image { size 10 10 seed 5 } output { tone_map aces exposure 2 }\n",
    };
    for (size_t i = 0; i < sizeof idle / sizeof *idle; i++) {
        char text[1000];
        snprintf(text, sizeof text, "%s%s", idle[i], SHAPE_BALL);
        expect_features(text, plain);
        snprintf(text, sizeof text, "%s%s%s", idle[i], SHAPE_BALL, LIGHT_LAMP);
        expect_features(text, lit);
    }
    // Texture coordinates of a mesh in a scene whose textures need none, or are not seen.
    const FeatureSet sheet = features_of("mesh { file \"grid2\" }\n");
    expect_features("mesh { file \"grid2 uvs\" }\n", sheet);
    expect_features("texture t checker { }\n" MATERIAL_M("diffuse t") "mesh { file \"grid2 uvs\" }\n", sheet);
    expect_features("object o { mesh { file \"grid2\" } }\n" SHAPE_BALL, plain);
    // Lights without anything to shine on; rays that no depth is left for; highlights without lights.
    expect_features(LIGHT_LAMP, 0);
    expect_features("render { max_depth 0 }\n"
                    MATERIAL_M("reflect 1 transmit 1 fresnel on") SHAPE_BALL_OF("m"), plain);
    expect_features(MATERIAL_M("specular 1") SHAPE_BALL_OF("m"), plain);
    // Without ambient light, a texture of the ambient colour; without lights, one of the diffuse colour.
    expect_features("ambient 0\ntexture t checker { }\n" MATERIAL_M("ambient t") SHAPE_BALL_OF("m"),
                    plain & ~feature_bit(FEATURE_AMBIENT));
    expect_features("texture t checker3d { }\n"
                    MATERIAL_M("diffuse t ambient 0.5") SHAPE_BALL_OF("m"), plain);
    // Depth 0 still lets light through glass.
    assert_true(features_have(features_of("render { max_depth 0 }\n" MATERIAL_M("transmit 1")
                                              SHAPE_BALL_OF("m") LIGHT_LAMP),
                              FEATURE_TRANSMITTANCE));
}

// A material that an instance gives to shapes without one counts as used, and its textures and rays with it.
static void test_inherited(void **state)
{
    (void)state;
    const char *object = MATERIAL_M("reflect 0.5 emission 1")
        "object o { sphere { center 0 0 0 radius 1 } sphere { center 1 0 0 radius 1 } }\n";
    char text[1000];
    snprintf(text, sizeof text, "%s%s", object, "instance o { }\n");
    assert_false(features_have(features_of(text), FEATURE_REFLECT));
    snprintf(text, sizeof text, "%s%s", object, "instance o { material m }\n");
    assert_true(features_have(features_of(text), FEATURE_REFLECT));
    snprintf(text, sizeof text, "%s%s", object, "object p { instance o { } }\ninstance p { material m }\n");
    assert_true(features_have(features_of(text), FEATURE_REFLECT));
    assert_true(features_have(features_of(text), FEATURE_EMISSION));
    // The shapes have materials of their own: that of the instance is not used.
    expect_features(MATERIAL_M("reflect 0.5") "material n phong { }\n"
                    "object o { sphere { center 0 0 0 radius 1 material n }\n"
                    "box { min 0 0 0 max 1 1 1 material n } }\n"
                    "instance o { material m }\n",
                    features_of("object o { sphere { center 0 0 0 radius 1 } box { min 0 0 0 max 1 1 1 } }\n"
                                "instance o { }\n"));
}

static void test_options(void **state)
{
    (void)state;
    char text[4096], exact[4096];
    const size_t length = features_options(feature_bit(FEATURE_TORUS), text, sizeof text);
    assert_int_equal(length, strlen(text));
    assert_non_null(strstr(text, " -DHAS_TORUS=1"));
    assert_non_null(strstr(text, " -DHAS_SPHERE=0"));
    u32 count = 0;
    for (const char *at = text; (at = strstr(at, " -DHAS_")); at++)
        count++;
    assert_int_equal(count, FEATURE_COUNT);
    assert_int_equal(features_options(feature_bit(FEATURE_TORUS), NULL, 0), length);
    memset(exact, 'x', sizeof exact);
    assert_int_equal(features_options(feature_bit(FEATURE_TORUS), exact, 20), length);
    assert_true(exact[19] == 0 && exact[20] == 'x');
    for (Feature f = 0; f < FEATURE_COUNT; f++)
        assert_true(strlen(feature_name(f)) > 0 && strlen(feature_meaning(f)) > 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_with_and_without), cmocka_unit_test(test_exact_sets),
        cmocka_unit_test(test_unused),           cmocka_unit_test(test_inherited),
        cmocka_unit_test(test_options),          cmocka_unit_test(test_paths),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
