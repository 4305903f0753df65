// The table by which paths draw lights: shares that are 1 together, aliases that give each light just its
// share, and the order of lights that the kernels count on.
#include "layout_fixture.h"

static char scene_text[65536];

// `points` point lights of brightness 1, 2, 3, ..., an area light before and one behind them, and a sky.
static Layout *layout_of_lights(u32 points, const char *settings, const char *more)
{
    size_t used = (size_t)snprintf(scene_text, sizeof scene_text,
                                   "render { integrator path %s }\nsphere { center 0 0 -5 radius 2 }\n%s"
                                   "light sphere { center 0 9 0 radius 1 radiance 3 }\n",
                                   settings, more);
    for (u32 i = 0; i < points; i++)
        used += (size_t)snprintf(scene_text + used, sizeof scene_text - used,
                                 "light point { position %u 4 0 intensity %u }\n", i, i + 1);
    snprintf(scene_text + used, sizeof scene_text - used,
             "light rectangle { corner 5 5 5 edge1 1 0 0 edge2 0 0 1 radiance 2 }\n");
    return layout_good(scene_text);
}

// What the table gives: the chance of each light where an entry is uniform, and a number below `keep` keeps
// it.
static void expect_shares(const Layout *layout)
{
    const u32 count = layout->light_count;
    f64 chances[4096] = {0}, sum = 0, worst = 0;
    assert_true(count <= 4096 && layout->light_table);
    for (u32 i = 0; i < count; i++) {
        const LightTableEntry *entry = &layout->light_table[i];
        assert_true(entry->keep >= 0 && entry->keep <= 1 && entry->alias < count && entry->share > 0);
        chances[i] += (f64)entry->keep / count;
        chances[entry->alias] += (1 - (f64)entry->keep) / count;
        sum += (f64)entry->share;
    }
    for (u32 i = 0; i < count; i++)
        worst = fmax(worst, fabs(chances[i] - (f64)layout->light_table[i].share) * count);
    assert_true(fabs(sum - 1) < 1e-6);
    if (!(worst <= 1e-6))
        fail_msg("of %u lights one is drawn %.3g / %u more or less often than its share", count, worst,
                 count);
}

static void test_few_lights(void **state)
{
    (void)state;
    for (u32 points = 0; points <= LIGHT_CHOICES; points++) {
        Layout *layout = layout_of_lights(points, "", "");
        const bool all = points + 2 <= LIGHT_CHOICES;
        assert_int_equal(layout->light_count, points + 2);
        assert_int_equal(layout->path.light_choices, all ? points + 2 : LIGHT_CHOICES);
        assert_true((layout->light_table == NULL) == all);
        assert_true(features_have(layout->features, FEATURE_MANY_LIGHTS) == !all);
        layout_destroy(layout);
    }
}

static void test_shares(void **state)
{
    (void)state;
    static const u32 counts[] = {7, 8, 15, 64, 500, 1000};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        Layout *layout = layout_of_lights(counts[i], "", i % 2 ? "background 2\n" : "");
        expect_shares(layout);
        // Point lights at one distance of the scene: their shares rise with their brightness.
        for (u32 k = 3; k < 2 + counts[i]; k++)
            assert_true(layout->light_table[k].share > layout->light_table[k - 1].share);
        layout_destroy(layout);
    }
}

// Lights that are all black, or one that outshines all others beyond the range of float.
static void test_extremes(void **state)
{
    (void)state;
    Layout *layout = layout_of_lights(20, "", "light directional { direction 0 -1 0 intensity 3e38 }\n");
    expect_shares(layout);
    f64 least = 1, most = 0;
    for (u32 i = 0; i < layout->light_count; i++) {
        least = fmin(least, (f64)layout->light_table[i].share);
        most = fmax(most, (f64)layout->light_table[i].share);
    }
    assert_true(most > 0.9 &&
                least >= 0.09 / layout->light_count); // a weak light near to something is found there
    layout_destroy(layout);
    char text[2048] = "render { integrator path }\nsphere { center 0 0 -5 radius 2 }\n";
    for (u32 i = 0; i < 12; i++)
        strcat(text, "light sphere { center 0 9 0 radius 1 radiance 0 }\n");
    layout = layout_good(text);
    assert_int_equal(layout->light_count, 12); // they are surfaces, which are found by their number
    expect_shares(layout);
    for (u32 i = 0; i < 12; i++)
        assert_true(fabs((f64)layout->light_table[i].share - 1.0 / 12) < 1e-7);
    layout_destroy(layout);
}

// Area lights first, in their order, which is that of their materials; the sky last.
static void test_order(void **state)
{
    (void)state;
    Layout *layout = layout_of_lights(12, "shadows off", "light spot { position 0 3 0 look_at 0 0 0 }\nbackground 1\n");
    assert_int_equal(layout->light_count, 1 + 1 + 12 + 1 + 1);
    assert_int_equal(layout->lights[0].kind, LIGHT_KIND_SPHERE);
    assert_int_equal(layout->lights[1].kind, LIGHT_KIND_RECTANGLE);
    assert_int_equal(layout->lights[2].kind, LIGHT_KIND_SPOT);
    for (u32 i = 3; i < 15; i++)
        assert_int_equal(layout->lights[i].kind, LIGHT_KIND_POINT);
    assert_int_equal(layout->lights[15].kind, LIGHT_KIND_ENVIRONMENT);
    assert_int_equal(layout->material_count, layout->path.area_materials + 2);
    for (u32 i = 0; i < 2; i++) {
        const LightRecord *light = &layout->lights[i];
        const MaterialRecord *material = &layout->materials[layout->path.area_materials + i];
        assert_true(light->surface >= 0 &&
                    layout->infos[light->surface].material == layout->path.area_materials + i);
        assert_true((material->flags & MATERIAL_ONE_SIDED) != 0);
        assert_true(material->emission[0] == light->intensity.x);
    }
    layout_destroy(layout);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_few_lights),
        cmocka_unit_test(test_shares),
        cmocka_unit_test(test_extremes),
        cmocka_unit_test(test_order),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
