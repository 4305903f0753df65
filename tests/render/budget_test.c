// The stated error of samples holds: renders with a thousand seeds each of scenes whose pixels are known,
// some seen by one sample in a hundred. A statement at 95 % may fail in 67 of 1000, the 99 % quantile of the
// binomial.
#include <math.h>

#include "budget/budget.h"
#include "support.h"

enum { SEEDS = 1000, FAILURES_MAX = 67, SIDE_MAX = 4 };

static Device *device;

// A scene, and what its pixels are exactly.
typedef struct Known {
    const char *name;
    char *text;
    u32 side;  // pixels
    f64 truth[SIDE_MAX * SIDE_MAX]; // grey
} Known;

// How often each statement failed, and means of what was stated.
typedef struct Tally {
    u32 rmse, mean, largest;
    f64 error, bound; // root mean squares
} Tally;

static SceneBounds bounds_of(const char *text, Scene **scene, Arena *arena, Layout **layout)
{
    Diagnostics *diagnostics = diagnostics_create();
    Error error = {0};
    *scene = scene_parse_text("scene", text, strlen(text), arena, diagnostics, &error);
    if (!*scene || diagnostics_error_count(diagnostics)) {
        diagnostics_print(diagnostics, stdout);
        fail_msg("the scene of the test has errors: %s", error.text);
    }
    diagnostics_destroy(diagnostics);
    *layout = layout_create(*scene, &error);
    assert_non_null(*layout);
    return scene_bounds(*scene, *layout);
}

static ErrorBudget render_once(Render *render, u32 seed, const Known *known, const Scene *scene,
                               const SceneBounds *bounds, f32 *rgb)
{
    Error error = {0};
    BudgetPool pool = {0};
    const u32 side = known->side;
    u32 done = 0;
    if (!render_restart(render, seed, &error))
        fail_msg("%s", error.text);
    while (!render_finished(render)) {
        RenderRows rows;
        if (!render_step(render, &rows, &error))
            fail_msg("%s", error.text);
        for (u32 y = 0; y < rows.count; y++)
            budget_pool_add_row(&pool, rows.rgb + 3 * side * y, rows.m2 + side * y, side);
        if (rows.count)
            memcpy(rgb + 3 * side * done, rows.rgb, (size_t)rows.count * side * 3 * sizeof *rgb);
        done += rows.count;
    }
    assert_int_equal(done, side);
    return budget_make(scene, bounds, &pool, 0, 8, NAN);
}

static void judge(const Known *known, const ErrorBudget *budget, const f32 *rgb, Tally *tally)
{
    const u32 pixels = known->side * known->side;
    f64 squares = 0, largest = 0, mean = 0;
    for (u32 i = 0; i < pixels; i++) {
        mean += known->truth[i] / pixels;
        for (u32 c = 0; c < 3; c++) {
            const f64 off = fabs((f64)rgb[3 * i + c] - known->truth[i]);
            squares += off * off / (3 * pixels);
            largest = fmax(largest, off);
        }
    }
    const SamplingBudget *sampling = &budget->sampling;
    tally->rmse += sqrt(squares) > sampling->rmse;
    tally->largest += largest > sampling->largest;
    tally->mean += mean < sampling->mean_low || mean > sampling->mean_high;
    tally->error += squares / SEEDS;
    tally->bound += sampling->rmse * sampling->rmse / SEEDS;
}

static Tally tally_of(const Known *known, u32 samples, SamplingAssumption assumption)
{
    char *text = text_of("image { size %u %u samples %u } %s", known->side, known->side, samples, known->text);
    Arena *arena = arena_create();
    Scene *scene;
    Layout *layout;
    Error error = {0};
    const SceneBounds bounds = bounds_of(text, &scene, arena, &layout);
    const RenderJob job = {.layout = layout, .device = device, .width = known->side, .height = known->side};
    Render *render = render_create(&job, &error);
    if (!render)
        fail_msg("%s", error.text);
    Tally tally = {0};
    f32 rgb[3 * SIDE_MAX * SIDE_MAX];
    for (u32 seed = 0; seed < SEEDS; seed++) {
        const ErrorBudget budget = render_once(render, seed, known, scene, &bounds, rgb);
        assert_int_equal(budget.sampling.assumption, assumption);
        judge(known, &budget, rgb, &tally);
    }
    printf("%-20s %3u samples: covered rmse %4u, mean %4u, largest %4u of %d; rmse %.2e, stated %.2e\n",
           known->name, samples, SEEDS - tally.rmse, SEEDS - tally.mean, SEEDS - tally.largest, SEEDS,
           sqrt(tally.error), sqrt(tally.bound));
    render_destroy(render);
    layout_destroy(layout);
    arena_destroy(arena);
    free(text);
    return tally;
}

static void check(Known *known, SamplingAssumption assumption, bool must_hold)
{
    const u32 samples[] = {16, 64, 256};
    for (u32 i = 0; i < 3; i++) {
        const Tally tally = tally_of(known, samples[i], assumption);
        if (must_hold)
            assert_true(tally.rmse <= FAILURES_MAX && tally.mean <= FAILURES_MAX &&
                        tally.largest <= FAILURES_MAX);
    }
    free(known->text);
}

// A triangle and a disk out of sight, so that the scenes share a program.
#define UNSEEN "triangle { vertices 0 99 0  1 99 0  1 98 0 } disk { center 0 99 0 normal 0 0 1 radius 0.1 } "
#define SHINES "background 0 ambient 0 material m phong { diffuse 0 emission 1 } " UNSEEN

// A slanted half-plane through the middle of the only pixel: two triangles that share no edge with it.
static void half_covered(void **state)
{
    (void)state;
    Known known = {.name = "half a pixel", .side = 1, .truth = {0.5}};
    known.text = text_of("camera { position 0 0 1 look_at 0 0 0 orthographic 1 } " SHINES
                         "triangle { vertices -9 -3 0  9 3 0  9 -99 0 material m } "
                         "triangle { vertices -9 -3 0  9 -99 0  -9 -99 0 material m }");
    check(&known, SAMPLING_BOUNDED, true);
}

// A disk that one sample in a hundred sees, off the middle of the only pixel.
static void rarely_seen(void **state)
{
    (void)state;
    Known known = {.name = "1 % of a pixel", .side = 1, .truth = {0.01}};
    known.text = text_of("camera { position 0 0 1 look_at 0 0 0 orthographic 1 } " SHINES
                         "disk { center 0.113 -0.271 0 normal 0 0 1 radius %.17g material m }",
                         sqrt(0.01 / acos(-1)));
    check(&known, SAMPLING_BOUNDED, true);
}

// The same in each of 16 pixels, some empty, beside an edge that cuts a column at a third.
static void several_pixels(void **state)
{
    (void)state;
    Known known = {.name = "16 pixels", .side = 4};
    known.text = text_of("camera { position 0 0 1 look_at 0 0 0 orthographic 4 } " SHINES
                         "triangle { vertices -1.6666666666666667 -9 0  -1.6666666666666667 9 0  -99 0 0 material m } "
                         "triangle { vertices -1.6666666666666667 -9 0  -99 0 0  -99 -99 0 material m } "
                         "triangle { vertices -1.6666666666666667 9 0  -99 99 0  -99 0 0 material m } ");
    for (u32 y = 0; y < 4; y++) {
        known.truth[4 * y] = 1.0 / 3;
        known.truth[4 * y + 1] = known.truth[4 * y + 2] = 0.01;
        for (u32 x = 1; x < 3; x++)
            text_append(&known.text, "disk { center %.17g %.17g 0 normal 0 0 1 radius %.17g material m } ",
                        x - 1.5 + 0.1 * y, 1.5 - y + 0.07 * x, sqrt(0.01 / acos(-1)));
    }
    check(&known, SAMPLING_BOUNDED, true);
}

// Without a bound of radiance (a torus, out of sight, stands around the light) errors are taken for normal.
// Where many samples see what there is that holds; where one in a hundred does it cannot, and the figures
// tell by how much.
static void without_bound(void **state)
{
    (void)state;
    const char *lit = "camera { position 0 0 1 look_at 0 0 0 orthographic 1 } background 0 ambient 0 "
                      "light point { position 0 0 1000 intensity 1e6 attenuation 0 0 1 } "
                      "torus { center 0 0 1000 axis 0 0 1 major 0.2 minor 0.1 } "
                      "material m phong { diffuse 1 } " UNSEEN;
    Known half = {.name = "half, no bound", .side = 1, .truth = {0.5}};
    half.text = text_of("%striangle { vertices -9 -3 0  9 3 0  9 -99 0 material m } "
                        "triangle { vertices -9 -3 0  9 -99 0  -9 -99 0 material m }",
                        lit);
    check(&half, SAMPLING_NORMAL, true);
    Known rare = {.name = "1 %, no bound", .side = 1, .truth = {0.01}};
    rare.text = text_of("%sdisk { center 0.113 -0.271 0 normal 0 0 1 radius %.17g material m }", lit,
                        sqrt(0.01 / acos(-1)));
    check(&rare, SAMPLING_NORMAL, false);
}

// The spread of 1000 + and - 0.01, which a sum of squares in floats would lose: that of two values, of which the
// mean tells how often each was met.
static void spread_of_large_values(void **state)
{
    (void)state;
    const f64 low = (f64)999.99f, high = (f64)1000.01f;
    const u32 samples = 1024;
    char *text = text_of("image { size 1 1 samples %u } camera { position 0 0 1 look_at 0 0 0 orthographic 1 } "
                         "ambient 0 background 999.99 material m phong { diffuse 0 emission 1000.01 } "
                         "triangle { vertices -9 -3 0  9 3 0  9 -99 0 material m } "
                         "triangle { vertices -9 -3 0  9 -99 0  -9 -99 0 material m }", samples);
    Layout *layout = layout_of(text);
    Error error = {0};
    const RenderJob job = {.layout = layout, .device = device, .width = 1, .height = 1};
    Render *render = render_create(&job, &error);
    RenderRows rows = {0};
    while (render && rows.count == 0)
        assert_true(render_step(render, &rows, &error));
    assert_non_null(render);
    const f64 share = ((f64)rows.rgb[0] - low) / (high - low);
    const f64 expected = 3 * samples * share * (1 - share) * (high - low) * (high - low);
    printf("mean %.9g, variance %.6g of 1e-4\n", (f64)rows.rgb[0], (f64)rows.m2[0] / (3 * samples));
    assert_true(fabs(share - 0.5) < 0.05);
    // The mean is a float, and so are the differences from it: 2^-14 / 2 of 0.01.
    assert_true(fabs((f64)rows.m2[0] - expected) <= 0.005 * expected);
    render_destroy(render);
    layout_destroy(layout);
    free(text);
}

int main(void)
{
    device = test_device_open(0);
    if (!device)
        return TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(half_covered),
        cmocka_unit_test(rarely_seen),
        cmocka_unit_test(several_pixels),
        cmocka_unit_test(without_bound),
        cmocka_unit_test(spread_of_large_values),
    };
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    device_close(device);
    return failed;
}
