// Bounds of scenes against closed forms.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "base/arena.h"
#include "budget/budget.h"
#include "scene/parse.h"

static ErrorBudget budget_clamped(const char *text, const BudgetPool *pool, f32 clamp)
{
    Arena *arena = arena_create();
    Diagnostics *diagnostics = diagnostics_create();
    Error error = {0};
    Scene *scene = scene_parse_text("scene", text, strlen(text), arena, diagnostics, &error);
    if (!scene || diagnostics_error_count(diagnostics)) {
        diagnostics_print(diagnostics, stdout);
        fail_msg("the scene of the test has errors");
    }
    Layout *layout = layout_create(scene, &error);
    assert_non_null(layout);
    const SceneBounds bounds = scene_bounds(scene, layout);
    const ErrorBudget budget = budget_make(scene, &bounds, pool, clamp, 8, NAN);
    layout_destroy(layout);
    diagnostics_destroy(diagnostics);
    arena_destroy(arena);
    return budget;
}

static ErrorBudget budget_of(const char *text)
{
    const BudgetPool pool = {.pixels = 1};
    return budget_clamped(text, &pool, 0);
}

static void is_about(f64 value, f64 expected)
{
    if (!(fabs(value - expected) <= 2e-5 * fabs(expected)))
        fail_msg("%.9g, not %.9g", value, expected);
}

#define DARK "background 0 ambient 0 "

// Two parallel mirrors that shine: the sum of k^i up to D, of (1 - k^(D + 1)) / (1 - k); what is missing is
// all of the bound.
static void parallel_mirrors(void **state)
{
    (void)state;
    for (u32 depth = 0; depth <= 64; depth += 8) {
        char text[512];
        snprintf(text, sizeof text,
                 DARK "render { max_depth %u min_weight 0 } material m phong { diffuse 0 reflect 0.9 emission 1 } "
                      "plane { point 0 1 0 normal 0 -1 0 material m } plane { point 0 -1 0 normal 0 1 0 material m }",
                 depth);
        const ErrorBudget budget = budget_of(text);
        is_about(budget.bounds.radiance[1], (1 - pow(0.9, depth + 1)) / 0.1);
        is_about(budget.bounds.depth, pow(0.9, depth + 1) / 0.1);
        assert_true(budget.bounds.min_weight == 0);
        is_about(budget.total, pow(0.9, depth + 1) / 0.1);
    }
}

// A ray of weight 0.9^7 = 0.478 is traced, the next, of 0.43, is not: no weight is below 0.45 up to depth 7.
static void cut_off(void **state)
{
    (void)state;
#define MIRROR(depth) \
    DARK "render { max_depth " depth " min_weight 0.45 } material m phong { diffuse 0 reflect 0.9 emission 1 } " \
         "sphere { center 0 0 -9 radius 1 material m }"
    assert_true(budget_of(MIRROR("7")).bounds.min_weight == 0);
    is_about(budget_of(MIRROR("8")).bounds.min_weight, 0.45 * (1 - pow(0.9, 8)) / 0.1);
    // A tree: each of the 2^2 ends may lack 0.01, and bring what one hit brings before it.
    is_about(budget_of(DARK "render { max_depth 2 min_weight 0.01 } material m phong { diffuse 0 reflect 0.2 "
                            "transmit 0.05 emission 1 } sphere { center 0 0 -9 radius 1 material m }")
                 .bounds.min_weight,
             4 * 0.01 * 1.25);
}

static void nothing_follows(void **state)
{
    (void)state;
    const ErrorBudget budget = budget_of(
        "background 0.25 ambient 0.5 light directional { direction 0 -1 0 intensity 2 } "
        "light point { position 0 9 0 intensity 3 attenuation 2 0 0 } "
        "material unused phong { reflect 1 emission 77 } "
        "material m phong { ambient 0.1 diffuse 0.6 specular 0.4 } sphere { center 0 0 -9 radius 1 material m }");
    assert_true(budget.bounds.depth == 0 && budget.bounds.min_weight == 0 && !budget.bounds.unbounded);
    is_about(budget.bounds.radiance[0], 0.05 + 1.0 * (2 + 1.5));
    assert_string_equal(budget.estimator, "pixel centres");
    assert_null(budget_assumption(&budget));
    assert_true(isnan(budget.sampling.rmse) && isnan(budget.arithmetic) && budget.total == 0);
    is_about(budget.quantisation, 0.5 / 255);
}

static void textures_and_channels(void **state)
{
    (void)state;
    const ErrorBudget budget = budget_of(
        DARK "light directional { direction 0 -1 0 intensity 1 2 0 } "
             "texture t checker { colors 0.1 0.2 0.3  0.4 0.1 0.9 } material m phong { diffuse t } "
             "plane { point 0 0 0 normal 0 1 0 material m }");
    is_about(budget.bounds.radiance[0], 0.4);
    is_about(budget.bounds.radiance[1], 0.4);
    assert_true(budget.bounds.radiance[2] == 0);
}

static void without_bound(void **state)
{
    (void)state;
    // Glass: the weights of what follows add up to 1, so depth has no bound; radiance has one.
    const ErrorBudget glass = budget_of(
        "background 1 material g phong { diffuse 0 transmit 1 reflect 1 fresnel on } "
        "sphere { center 0 0 -9 radius 1 material g }");
    assert_true(isinf(glass.bounds.depth) && isfinite(glass.bounds.radiance[0]) && isinf(glass.total));
    assert_true(isfinite(glass.bounds.min_weight) && glass.bounds.min_weight > 0);
    const ErrorBudget near = budget_of(
        "image { samples 4 } light point { position 0 0 0 attenuation 0 0 1 } torus { center 0 0 0 axis 0 1 0 "
        "major 2 minor 1 }");
    assert_non_null(near.bounds.unbounded);
    assert_string_equal(budget_assumption(&near), "normal");
    // Shadow rays grow brighter through it.
    const ErrorBudget bright = budget_of(
        "light directional { direction 0 -1 0 } material g phong { transmit 1.5 } "
        "sphere { center 0 0 -9 radius 1 material g }");
    assert_non_null(bright.bounds.unbounded);
}

// A limit of samples bounds what nothing else does, but for a filter that gives some of them negative weights.
static void limits_of_samples(void **state)
{
    (void)state;
    const BudgetPool pool = {.pixels = 1};
#define PANEL(image) \
    "image { " image " } light rectangle { corner 3 4 0 edge1 1 0 0 edge2 0 0 1 radiance 9 } " \
    "sphere { center 0 0 -4 radius 1 }"
    const ErrorBudget without = budget_of(PANEL("samples 4")), budget = budget_clamped(PANEL("samples 4"), &pool, 2);
    assert_non_null(without.bounds.unbounded);
    assert_null(budget.bounds.unbounded);
    assert_string_equal(budget_assumption(&budget), "bounded");
    for (int c = 0; c < 3; c++)
        assert_true(budget.bounds.radiance[c] == 2);
    const ErrorBudget lobes = budget_clamped(PANEL("samples 4 filter mitchell"), &pool, 2);
    assert_non_null(lobes.bounds.unbounded);
    assert_string_equal(budget_assumption(&lobes), "normal");
    assert_true(budget_clamped(PANEL("samples 1 filter mitchell"), &pool, 2).bounds.radiance[0] == 2);
    const ErrorBudget wide = budget_clamped("background 0.25 0.5 4", &pool, 2);
    is_about(wide.bounds.radiance[0], 0.25);
    is_about(wide.bounds.radiance[1], 0.5);
    assert_true(wide.bounds.radiance[2] == 2);
}

// Four pixels of 5 samples, 12 values with the mean 0.5. The samples of one lost 6, 3 and 1.5 in all.
static void what_a_limit_took(void **state)
{
    (void)state;
    const BudgetPool pool = {.pixels = 4, .radiance = 6, .clamped = 10.5, .clamped_squared = 36 + 9 + 2.25,
                             .clamped_samples = 3};
    const ErrorBudget budget = budget_clamped("image { samples 5 } background 4", &pool, 1);
    is_about(budget.clamp.removed, 10.5 / 60);
    is_about(budget.clamp.share, 0.175 / 0.675);
    is_about(budget.clamp.rmse, sqrt((1.2 * 1.2 + 0.6 * 0.6 + 0.3 * 0.3) / 12));
    assert_true(budget.clamp.limit == 1 && budget.clamp.clamped == 3 && budget.clamp.samples == 20);
    is_about(budget.total, budget.sampling.rmse + budget.clamp.rmse);
    char text[1024];
    budget_summary(&budget, text, sizeof text);
    assert_non_null(strstr(text, "; clamp 1: bias of the mean -0.175, rmse 0.397, 3 of 20 samples; "));
    const ErrorBudget without = budget_clamped("image { samples 5 } background 4", &pool, 0);
    assert_true(without.clamp.rmse == 0 && without.clamp.removed == 0);
    is_about(without.total, without.sampling.rmse);
    budget_summary(&without, text, sizeof text);
    assert_null(strstr(text, "clamp"));
}

#define PATHS(depth) "image { samples 4 } background 0 render { integrator path max_depth " depth " min_weight 0.5 } "
#define WALLS(material) \
    "material m " material " plane { point 0 1 0 normal 0 -1 0 material m } " \
    "plane { point 0 -1 0 normal 0 1 0 material m } "

static f64 depth_bound(const char *text)
{
    const ErrorBudget budget = budget_of(text);
    assert_true(budget.bounds.min_weight == 0); // whatever the scene says
    assert_string_equal(budget.bounds.unbounded, "paths of any weight");
    assert_true(isinf(budget.bounds.radiance[0]));
    return budget.bounds.depth;
}

// Two parallel walls: of rho^k, the light after k times, what comes after max_depth is missing. It is so much where all
// light stays between them, and no more anywhere.
static void paths_between_walls(void **state)
{
    (void)state;
    for (u32 depth = 0; depth <= 64; depth += 16) {
        char text[512];
        snprintf(text, sizeof text,
                 "render { integrator path max_depth %u } " WALLS("phong { diffuse 0.25 0.5 0.75 emission 2 }"), depth);
        is_about(depth_bound(text), 2 * pow(0.75, depth + 1) / 0.25);
    }
    // Mirrors, highlights and matte light are passed on together; a channel without light has none to pass on.
    is_about(depth_bound(PATHS("2") WALLS("phong { diffuse 0.25 reflect 0.125 specular 0.125 emission 0 3 0 }")),
             3 * pow(0.5, 3) / 0.5);
    is_about(depth_bound(PATHS("0") WALLS("phong { diffuse 0.25 reflect 0.125 transmit 0.5 fresnel on emission 1 }")),
             0.75 / 0.25);
    // blinn_phong with n = 8: 16 (8 + 1/16) / (10 * 12) of its weight.
    is_about(depth_bound(PATHS("0") WALLS("blinn_phong { diffuse 0 specular 0.5 shininess 8 emission 1 }")),
             0.5375 / (1 - 0.5375));
}

static void paths_of_lights(void **state)
{
    (void)state;
#define HALF WALLS("phong { diffuse 0.5 }")
    const char *panels = "light rectangle { corner 0 0 0 edge1 1 0 0 edge2 0 0 1 radiance 3 } "
                         "light sphere { center 5 0 0 radius 0.5 radiance 7 } ";
    char text[1024];
    snprintf(text, sizeof text, "%s%s", PATHS("1") HALF, panels);
    is_about(depth_bound(text), 7 * 0.25 / 0.5);
    // The sky is one more of what shines; what nothing hides adds up.
    snprintf(text, sizeof text, "background 8 render { integrator path max_depth 1 } %s%s", HALF, panels);
    is_about(depth_bound(text), 8 * 0.25 / 0.5);
    snprintf(text, sizeof text, "background 8 render { integrator path max_depth 1 shadows off } %s%s", HALF, panels);
    is_about(depth_bound(text), 18 * 0.25 / 0.5);
    // Lights without size make of the surface what they make of it where it faces them.
    is_about(depth_bound(PATHS("1") HALF "light directional { direction 0 -1 0 intensity 4 }"), 2 * 0.25 / 0.5);
    is_about(depth_bound(PATHS("1") WALLS("phong { diffuse 0.25 specular 0.25 shininess 6 }")
                             "light point { position 0 0 0 intensity 8 attenuation 2 0 0 }"),
             (0.25 + 0.25 * 4) * 4 * 0.25 / 0.5);
    is_about(depth_bound(PATHS("1") WALLS("blinn_phong { diffuse 0.25 specular 0.125 shininess 0 }")
                             "light directional { direction 0 -1 0 intensity 4 }"),
             (0.25 + 0.125) * 4 * 0.375 * 0.375 / 0.625);
}

static void paths_without_bound(void **state)
{
    (void)state;
#define LIT "light directional { direction 0 -1 0 } "
    assert_true(isinf(depth_bound(PATHS("9") LIT WALLS("phong { diffuse 0.5 specular 0.5 }"))));
    assert_true(isinf(depth_bound(PATHS("9") LIT WALLS("pbr { base_color 0.5 }"))));
    assert_true(isinf(depth_bound(PATHS("9") "light point { position 0 1 0 attenuation 0 0 1 } " HALF)));
    // Nothing that shines, nothing that passes on, nothing that is met: nothing is missing.
    assert_true(depth_bound(PATHS("0") WALLS("pbr { }")) == 0);
    assert_true(depth_bound(PATHS("0") LIT WALLS("phong { diffuse 0 emission 5 }")) == 0);
    assert_true(depth_bound(PATHS("0") LIT HALF "material unused pbr { emission 1 }") > 0);
    const ErrorBudget empty = budget_of("background 3 render { integrator path }");
    assert_true(empty.bounds.depth == 0 && !empty.bounds.unbounded);
    // The total is what is left: the samples' and the bound.
    const BudgetPool pool = {.pixels = 4, .radiance = 6};
    const ErrorBudget whole = budget_clamped(PATHS("1") LIT HALF, &pool, 0);
    is_about(whole.total, whole.sampling.rmse + 0.25);
    // Negative weights of a filter may add up to more than 1.
    const f64 lobes = depth_bound("image { samples 4 filter mitchell } background 0 render { integrator path "
                                  "max_depth 1 } " LIT HALF);
    assert_true(lobes > 0.25 * 1.01 && lobes < 0.25 * 2);
}

// A light that grows without limit is as bright as its nearest surface is near: 2, whatever the shape is.
static void nearest_surfaces(void **state)
{
    (void)state;
    const char *shapes[] = {
        "plane { point 0 -2 0 normal 0 1 0 }",
        "sphere { center 0 -5 0 radius 3 }",
        "sphere { center 0 1 0 radius 3 }",                       // from within
        "box { min -3 -2 -9 max 4 7 9 }",                         // from within
        "box { min -3 -9 -9 max 4 -2 9 }",
        "box { min -1 -1 -1 max 1 1 1 rotate z 45 translate 0 -3.414213562373095 0 }", // its edge
        "triangle { vertices -9 -2 -9  9 -2 -9  0 -2 9 }",
        "disk { center 0 -2 0 normal 0 1 0 radius 9 }",
        "torus { center 0 -3 0 axis 0 1 0 major 4 minor 1 }",     // its box
        "object o { sphere { center 0 0 0 radius 1 } box { min -1 -1 -1 max 1 1 1 } } "
        "instance o { translate 0 -3 0 }",
    };
    for (u32 i = 0; i < sizeof shapes / sizeof shapes[0]; i++) {
        char text[512];
        snprintf(text, sizeof text,
                 DARK "camera { position 1 2 3 look_at 0 0 -9 } light point { position 0 0 0 intensity 8 "
                      "attenuation 0 0 1 } material default phong { diffuse 0.5 } sphere { center 0 50 0 radius 1 } %s",
                 shapes[i]);
        const f64 radiance = budget_of(text).bounds.radiance[0];
        if (!(fabs(radiance - 1) < 1e-3 && radiance >= 1))
            fail_msg("%s: %.9g, not 1", shapes[i], radiance);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(parallel_mirrors), cmocka_unit_test(cut_off),
        cmocka_unit_test(nothing_follows),  cmocka_unit_test(textures_and_channels),
        cmocka_unit_test(without_bound),    cmocka_unit_test(nearest_surfaces),
        cmocka_unit_test(limits_of_samples), cmocka_unit_test(what_a_limit_took),
        cmocka_unit_test(paths_between_walls), cmocka_unit_test(paths_of_lights),
        cmocka_unit_test(paths_without_bound),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
