// What a scene does not use costs nothing. The program of a small scene with each feature, and of one without
// it, is preprocessed as a device's compiler would do it. In the functions that the kernel can reach there is
// no word of a feature that the scene lacks, and the kernel has just the arguments that its features need. No
// device takes part.
#include "support.h"

#include <ctype.h>

#include "../host/layout_feature_scenes.h"
#include "bundle/bundle.h"
#include "render/plan.h"

enum { FUNCTIONS_MAX = 600, PROGRAMS = 4 * FEATURE_SCENE_COUNT };

// Texts that only the code of a feature has. Those that begin and end as names do are looked for as whole
// names.
static const struct {
    Feature feature;
    const char *words[3];
} feature_words[] = {
    {FEATURE_SURFACES, {"intersect_closest", "hit_make", NULL}},
    {FEATURE_BVH, {"push_children", "traverse_scene", "prepare_slabs"}},
    {FEATURE_INSTANCES, {"enter_instance", "SELF_INSTANCE", "surface_place"}},
    {FEATURE_SPHERE, {"intersect_sphere", "surface_sphere", NULL}},
    {FEATURE_GIANT_SPHERE, {"intersect_giant_sphere", "surface_giant_sphere", NULL}},
    {FEATURE_ELLIPSOID, {"intersect_ellipsoid", "surface_ellipsoid", NULL}},
    {FEATURE_PLANE, {"intersect_plane", "surface_plane", NULL}},
    {FEATURE_BOX, {"intersect_box", "surface_box", NULL}},
    {FEATURE_TETRAHEDRON, {"intersect_tetrahedron", "surface_tetrahedron", NULL}},
    {FEATURE_DISK, {"intersect_disk", "surface_disk", NULL}},
    {FEATURE_CYLINDER, {"intersect_cylinder", "surface_cylinder", NULL}},
    {FEATURE_CONE, {"intersect_cone", "surface_cone", NULL}},
    {FEATURE_TORUS, {"intersect_torus", "surface_torus", "torus_value"}},
    {FEATURE_RECTANGLE, {"intersect_rectangle", "surface_rectangle", NULL}},
    {FEATURE_TRIANGLE, {"intersect_triangle", "surface_triangle", NULL}},
    {FEATURE_TRIANGLE_EXTRA, {"hit_interpolate", NULL, NULL}},
    {FEATURE_MESH, {"test_block", "mesh_hit_make", "mesh_runs"}},
    {FEATURE_MESH_NORMALS, {"mesh_normal", "mesh_normals", NULL}},
    {FEATURE_TERMINATOR, {"mesh_raise", "raise_way", "horizon"}},
    {FEATURE_MESH_UVS, {"mesh_uv", "mesh_uvs", NULL}},
    {FEATURE_UV, {"surface_uv", "hit.at.u", NULL}},
    {FEATURE_CHECKER, {"cell_parity(at->u_whole", NULL, NULL}},
    {FEATURE_CHECKER3D, {"object_point", "inset", NULL}},
    {FEATURE_IMAGE, {"image_color", "tile_place", "texels"}},
    {FEATURE_NORMAL_MAP, {"mapped_normal", "surface_tangents", "tangent_u"}},
    {FEATURE_LIGHTS, {"shade_lights", "light_ray", NULL}},
    {FEATURE_POINT, {NULL, NULL, NULL}}, // shares all with spots: asked of scenes without either, below
    {FEATURE_DIRECTIONAL, {"travel", NULL, NULL}},
    {FEATURE_SPOT, {"versine_outer", "soft", NULL}},
    {FEATURE_SPHERE_LIGHT, {"sphere_light_sample", "half_chord", NULL}},
    {FEATURE_RECTANGLE_LIGHT, {"rectangle_light_sample", "to_corner", NULL}},
    {FEATURE_OCCLUSION, {"occlusion_ray", NULL, NULL}},
    {FEATURE_ENVIRONMENT, {"environment_radiance", "environment_texels", NULL}},
    {FEATURE_ENVIRONMENT_LIGHT, {"environment_ray", "environment_sample", "draw_index"}},
    {FEATURE_PREFILTERED, {"hit_prefiltered", "prefiltered_map", NULL}},
    {FEATURE_HIT_RANDOM, {"hit_random", "path_begin", "PATH"}},
    {FEATURE_PATH, {"path_trace", "path_shade", "path_scattering"}},
    {FEATURE_MANY_LIGHTS, {"light_table", "path->light_count", NULL}},
    {FEATURE_SHADOWS, {"intersect_shadow", "shadow_batch", "SHADOW_ORG"}},
    {FEATURE_TRANSMITTANCE, {"transmit_shadows", "last_primitive", "follows_last"}},
    {FEATURE_TRANSMIT_TEXTURE, {"textured_transmit", NULL, NULL}},
    {FEATURE_SPECULAR, {"MATERIAL_SHININESS", "MATERIAL_SPECULAR", NULL}},
    {FEATURE_PHONG, {"lobe_phong", NULL, NULL}},
    {FEATURE_BLINN, {"lobe_blinn", NULL, NULL}},
    {FEATURE_EMISSION, {"MATERIAL_EMISSION", NULL, NULL}},
    {FEATURE_AMBIENT, {"MATERIAL_AMBIENT", NULL, NULL}},
    {FEATURE_BACKGROUND, {"params->background", NULL, NULL}},
    {FEATURE_REFLECT, {"spawn_rays", "scatter_make", "next_ray"}},
    {FEATURE_TRANSMIT, {"scatter.transmit_dir", NULL, NULL}},
    {FEATURE_FRESNEL, {"fresnel_dielectric", NULL, NULL}},
    {FEATURE_BRANCHING, {"park_ray", "unpark_ray", "PENDING_COUNT"}},
    {FEATURE_ORTHOGRAPHIC, {"v3_scale(up, view_y)", NULL, NULL}},
    {FEATURE_PBR, {"hit_pbr", NULL, NULL}},
    {FEATURE_SAMPLES, {"sample_offset", "sum_add", NULL}},
    {FEATURE_APERTURE, {"disk_point", NULL, NULL}},
    {FEATURE_FILTER_TENT, {"left ? u", NULL, NULL}},
    {FEATURE_FILTER_TABLE, {"centered", NULL, NULL}},
    {FEATURE_FILTER_LOBES, {"weigh_samples", "filter_sign", NULL}},
    {FEATURE_CLAMP, {"clamp_samples", "film_add_clamped", "clamp_limit"}},
};

// The same in programs of the path integrator, of features whose words there are others.
static const struct {
    Feature feature;
    const char *words[3];
} path_words[] = {
    {FEATURE_LIGHTS, {"path_lights", "path_light_ray", NULL}},
    {FEATURE_ENVIRONMENT, {"path_sky", "environment_texels", NULL}},
    {FEATURE_ENVIRONMENT_LIGHT, {"environment_look", "environment_sample", "draw_index"}},
    {FEATURE_SHADOWS, {"intersect_shadow", "SHADOW_ORG", NULL}},
    {FEATURE_REFLECT, {"scatter_make", NULL, NULL}},
    {FEATURE_TRANSMIT, {NULL, NULL, NULL}}, // shares all with mirrored rays
};

#define BIT(name) ((FeatureSet)1 << FEATURE_##name)

static const FeatureSet shapes = BIT(SPHERE) | BIT(GIANT_SPHERE) | BIT(ELLIPSOID) | BIT(PLANE) | BIT(BOX) |
                                 BIT(TETRAHEDRON) | BIT(DISK) | BIT(CYLINDER) | BIT(CONE) | BIT(TORUS) |
                                 BIT(TRIANGLE) | BIT(RECTANGLE);

// Arrays among the arguments of the kernel, and features any of which asks for them.
static const struct {
    const char *name;
    FeatureSet features;
} arguments[] = {
    {"primitives", BIT(SURFACES)}, {"infos", BIT(SURFACES)},  {"materials", BIT(SURFACES)},
    {"nodes", BIT(BVH)},           {"lights", BIT(LIGHTS)},   {"textures", BIT(CHECKER) | BIT(CHECKER3D) | BIT(IMAGE)},
    {"texels", BIT(IMAGE)},
    {"frames", BIT(CHECKER3D)},    {"film_low", BIT(SAMPLES)}, {"extras", BIT(TRIANGLE_EXTRA)},
    {"film_m2", BIT(SAMPLES)}, {"film_clamped", BIT(CLAMP)}, {"clamp_limit", BIT(CLAMP)},
    {"environment", BIT(ENVIRONMENT)}, {"environment_texels", BIT(ENVIRONMENT)},
    {"environment_cdf", BIT(ENVIRONMENT_LIGHT)}, {"environment_edges", BIT(ENVIRONMENT_LIGHT)},
    {"environment_levels", BIT(PREFILTERED)},
    {"blocks", BIT(MESH)},         {"mesh_runs", BIT(MESH)},  {"mesh_normals", BIT(MESH_NORMALS)},
    {"light_table", BIT(MANY_LIGHTS)}, {"path_techniques", BIT(PATH)}, {"path_light_choices", BIT(PATH)},
    {"path_area_materials", BIT(PATH)},
    {"quantiles", BIT(FILTER_TABLE)}, {"mesh_uvs", BIT(MESH_UVS)},   {"mesh_indices", BIT(MESH_NORMALS) | BIT(MESH_UVS)},
};

typedef struct Function {
    const char *begin, *end; // of its text, from its return type on
    const char *name;
    size_t name_length;
    bool reached, followed;
} Function;

typedef struct ProgramText {
    FeatureSet features;
    char *text; // preprocessed
    size_t size;
    Function *functions;
    u32 count;
    size_t reached_bytes; // of functions that the kernel can reach
    size_t idle_bytes;    // of others
    char *reached;        // the text of the former
} ProgramText;

static bool name_character(char c)
{
    return isalnum((unsigned char)c) || c == '_';
}

// The first place of a word in text; as a whole name where it begins and ends like one.
static const char *find_word(const char *text, const char *word)
{
    const size_t length = strlen(word);
    for (const char *at = text; (at = strstr(at, word)); at++) {
        const bool before = at > text && name_character(at[-1]) && name_character(word[0]);
        const bool behind = name_character(at[length]) && name_character(word[length - 1]);
        if (!before && !behind)
            return at;
    }
    return NULL;
}

static char *preprocess(FeatureSet features)
{
    const DeviceInfo cpu = {.type = DEVICE_CPU, .float_width = 8};
    char options[4096], line[4096];
    assert_true(render_program_options(features, &cpu, MATH_EXACT, options, sizeof options) < sizeof options);
    char *command = text_of("\"%s\" -E -P -undef -x c -D__OPENCL_C_VERSION__=120 %s \"%s\"", CLRT_CC, options,
                            "features_test.cl");
    FILE *pipe = popen(command, "r");
    free(command);
    assert_non_null(pipe);
    char *text = NULL;
    size_t size = 0, read;
    FILE *out = open_memstream(&text, &size);
    assert_non_null(out);
    while ((read = fread(line, 1, sizeof line, pipe)) > 0)
        fwrite(line, 1, read, out);
    fclose(out);
    assert_int_equal(pclose(pipe), 0);
    return text;
}

// The function whose body opens at `brace`; its text began at `begin`. False where it is something else.
static bool function_at(const char *begin, const char *brace, Function *function)
{
    const char *at = brace;
    while (at > begin && isspace((unsigned char)at[-1]))
        at--;
    if (at == begin || at[-1] != ')')
        return false;
    int depth = 0;
    do {
        at--;
        depth += (*at == ')') - (*at == '(');
    } while (depth > 0 && at > begin);
    const char *end = at;
    while (at > begin && name_character(at[-1]))
        at--;
    *function = (Function){.begin = begin, .name = at, .name_length = (size_t)(end - at)};
    return end > at;
}

static void split_functions(ProgramText *program)
{
    const char *begin = program->text;
    int depth = 0;
    bool open = false;
    for (const char *at = program->text; *at; at++) {
        if (*at == '{' && depth++ == 0) {
            assert_true(program->count < FUNCTIONS_MAX);
            open = function_at(begin, at, &program->functions[program->count]);
        } else if (*at == '}' && --depth == 0) {
            if (open) {
                program->functions[program->count++].end = at + 1;
                begin = at + 1;
            }
            open = false;
        } else if (*at == ';' && depth == 0) {
            begin = at + 1;
        }
    }
    assert_int_equal(depth, 0);
}

// Marks what is named within the function.
static void follow(ProgramText *program, Function *function)
{
    function->followed = true;
    for (const char *at = function->begin; at < function->end;) {
        if (!name_character(*at)) {
            at++;
            continue;
        }
        const char *end = at;
        while (name_character(*end))
            end++;
        for (u32 i = 0; i < program->count; i++)
            if (program->functions[i].name_length == (size_t)(end - at) &&
                memcmp(program->functions[i].name, at, (size_t)(end - at)) == 0)
                program->functions[i].reached = true;
        at = end;
    }
}

static void find_reached(ProgramText *program)
{
    bool more = true;
    u32 kernels = 0;
    for (u32 i = 0; i < program->count; i++) {
        program->functions[i].reached = strncmp(program->functions[i].name, "render_tiles", 12) == 0;
        kernels += program->functions[i].reached;
    }
    assert_int_equal(kernels, 1);
    while (more) {
        more = false;
        for (u32 i = 0; i < program->count; i++) {
            if (program->functions[i].reached && !program->functions[i].followed) {
                follow(program, &program->functions[i]);
                more = true;
            }
        }
    }
    text_append(&program->reached, "%s", "");
    for (u32 i = 0; i < program->count; i++) {
        const Function *f = &program->functions[i];
        const size_t bytes = (size_t)(f->end - f->begin);
        *(f->reached ? &program->reached_bytes : &program->idle_bytes) += bytes;
        if (f->reached)
            text_append(&program->reached, "%.*s\n", (int)bytes, f->begin);
    }
}

// asked: features of renders.
static ProgramText program_make(const char *scene, FeatureSet asked)
{
    Layout *layout = layout_of(scene);
    ProgramText program = {.features = layout->features | asked};
    program.functions = calloc(FUNCTIONS_MAX, sizeof *program.functions);
    layout_destroy(layout);
    assert_non_null(program.functions);
    program.text = preprocess(program.features);
    program.size = strlen(program.text);
    split_functions(&program);
    find_reached(&program);
    return program;
}

static void program_free(ProgramText *program)
{
    free(program->text);
    free(program->functions);
    free(program->reached);
}

// The scene under the path integrator; NULL where it says itself how it is rendered.
static char *scene_of_paths(const char *scene)
{
    return strstr(scene, "render {") ? NULL : text_of("%s" RENDER_PATHS, scene);
}

// Programs 2 i and 2 i + 1: with and without the feature of row i; behind all of them the same scenes with paths.
static int make_programs(void **state)
{
    FILE *file = fopen("features_test.cl", "w");
    assert_non_null(file);
    assert_int_equal(fwrite(clrt_kernel_source, 1, clrt_kernel_source_size, file), clrt_kernel_source_size);
    assert_int_equal(fclose(file), 0);
    ProgramText *programs = calloc(PROGRAMS, sizeof *programs);
    assert_non_null(programs);
    for (u32 i = 0; i < PROGRAMS; i++) {
        const FeatureScenes *row = &feature_scenes[i / 2 % FEATURE_SCENE_COUNT];
        const char *scene = i % 2 ? row->without : row->with;
        char *paths = i < PROGRAMS / 2 ? NULL : scene_of_paths(scene);
        if (i < PROGRAMS / 2 || paths)
            programs[i] = program_make(paths ? paths : scene, i % 2 ? 0 : feature_scenes_asked(row));
        free(paths);
    }
    *state = programs;
    return 0;
}

static int free_programs(void **state)
{
    ProgramText *programs = *state;
    for (u32 i = 0; i < PROGRAMS; i++)
        program_free(&programs[i]);
    free(programs);
    remove("features_test.cl");
    return 0;
}

// Texts of the feature in the program.
static const char *const *words_of(const ProgramText *program, size_t row)
{
    const bool paths = features_have(program->features, FEATURE_PATH);
    for (size_t i = 0; paths && i < sizeof path_words / sizeof *path_words; i++)
        if (path_words[i].feature == feature_words[row].feature)
            return path_words[i].words;
    return feature_words[row].words;
}

static Feature shown_by(u32 i)
{
    return feature_scenes[i / 2 % FEATURE_SCENE_COUNT].feature;
}

static void expect_words(const ProgramText *program, size_t row, u32 i)
{
    const Feature feature = feature_words[row].feature;
    const char *const *words = words_of(program, row);
    const bool has = features_have(program->features, feature);
    for (int k = 0; k < 3 && words[k]; k++)
        if ((find_word(program->reached, words[k]) != NULL) != has)
            fail_msg("'%s' of %s is %s the program of the scene %s %s%s", words[k], feature_name(feature),
                     has ? "missing in" : "in", i % 2 ? "without" : "with", feature_name(shown_by(i)),
                     i < PROGRAMS / 2 ? "" : ", with paths");
}

// Every program has the words of its features and no word of another one.
static void test_words(void **state)
{
    const ProgramText *programs = *state;
    FeatureSet listed = 0;
    for (size_t w = 0; w < sizeof feature_words / sizeof *feature_words; w++) {
        const Feature feature = feature_words[w].feature;
        listed |= feature_bit(feature);
        for (u32 i = 0; i < PROGRAMS; i++)
            if (programs[i].text)
                expect_words(&programs[i], w, i);
    }
    assert_true(listed == feature_bit(FEATURE_COUNT) - 1); // a new feature needs its words here
    for (u32 i = 0; i < PROGRAMS; i++) {
        if (!programs[i].text)
            continue;
        // Lights that shine from somewhere; shapes that are not meshes.
        assert_true((find_word(programs[i].reached, "attenuation") != NULL) ==
                    ((programs[i].features & (BIT(POINT) | BIT(SPOT))) != 0));
        assert_true((find_word(programs[i].reached, "test_primitive") != NULL) ==
                    ((programs[i].features & shapes) != 0));
        assert_true((find_word(programs[i].reached, "surface_primitive") != NULL) ==
                    ((programs[i].features & shapes) != 0));
    }
}

static void test_arguments(void **state)
{
    const ProgramText *programs = *state;
    for (u32 i = 0; i < PROGRAMS; i++) {
        if (!programs[i].text)
            continue;
        const char *begin = strstr(programs[i].text, "render_tiles(");
        assert_non_null(begin);
        char *list = text_of("%.*s", (int)strcspn(begin, "{"), begin);
        for (size_t a = 0; a < sizeof arguments / sizeof *arguments; a++)
            if ((find_word(list, arguments[a].name) != NULL) !=
                ((programs[i].features & arguments[a].features) != 0))
                fail_msg("argument %s, scene %s %s%s: %s", arguments[a].name, i % 2 ? "without" : "with",
                         feature_name(shown_by(i)), i < PROGRAMS / 2 ? "" : ", with paths", list);
        free(list);
    }
}

// What a feature adds is what the program grows by; where the scene without it has features of its own
// instead (another camera, another texture), the two sizes stand beside each other.
static void test_sizes(void **state)
{
    const ProgramText *programs = *state;
    print_message("%-16s %9s %9s   bytes of functions that the kernel reaches (and others)\n", "", "without",
                  "with");
    for (u32 i = 0; i < PROGRAMS; i += 2) {
        if (!programs[i].text || !programs[i + 1].text)
            continue;
        const ProgramText *with = &programs[i], *without = &programs[i + 1];
        if (with->features == without->features) { // paths make nothing of it
            assert_string_equal(with->text, without->text);
            continue;
        }
        const bool grows = (with->features & without->features) == without->features &&
                           shown_by(i) != FEATURE_ORTHOGRAPHIC; // the other camera goes
        print_message("%-16s %9zu %9zu   (%zu, %zu)%s%s\n", feature_name(shown_by(i)), without->reached_bytes,
                      with->reached_bytes, without->idle_bytes, with->idle_bytes, i < PROGRAMS / 2 ? "" : "  paths",
                      grows ? "" : "  instead of others");
        if (grows)
            assert_true(without->reached_bytes < with->reached_bytes);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_words),
        cmocka_unit_test(test_arguments),
        cmocka_unit_test(test_sizes),
    };
    return cmocka_run_group_tests(tests, make_programs, free_programs);
}
