// Same scene, same bytes on every device that is here: pictures of the scenes that have every feature,
// and the functions of kernels/base over a million inputs. Needs two devices.
#include "scenes.h"
#include "support.h"

#include <math.h>

#include "device/list.h"
#include "selftest/agreed.h"
#include "selftest/probe.h"

enum { SCENES = 4, DEVICES_MAX = 8 };

typedef struct Fixture {
    u32 count; // devices that can be used, the first of which is what the others are held to
    Device *devices[DEVICES_MAX];
} Fixture;

static const char *name_of(const Fixture *f, u32 d)
{
    return device_info(f->devices[d])->name;
}

static void test_pictures(void **state)
{
    const Fixture *f = *state;
    const char *const marked[SCENES] = {scene_glass, scene_toys, scene_studio, scene_hall};
    for (int k = 0; k < SCENES; k++) {
        char *text = scene_under(marked[k], NULL);
        Layout *layout = layout_of(text);
        Picture first = render_layout(f->devices[0], layout, NULL);
        for (u32 d = 1; d < f->count; d++) {
            Picture other = render_layout(f->devices[d], layout, NULL);
            assert_same_picture(&first, &other, name_of(f, d));
            picture_destroy(&other);
        }
        picture_destroy(&first);
        layout_destroy(layout);
        free(text);
    }
}

typedef struct Tested {
    u32 function; // FUNCTION_X
    const char *name;
    bool moderate; // takes numbers whose products are floats
} Tested;

static const Tested FUNCTIONS[] = {
    {FUNCTION_SIN, "sin", false},           {FUNCTION_COS, "cos", false},
    {FUNCTION_ACOS, "acos", false},         {FUNCTION_ATAN2, "atan2", false},
    {FUNCTION_EXP, "exp", false},           {FUNCTION_EXP2, "exp2", false},
    {FUNCTION_LOG, "log", false},           {FUNCTION_LOG2, "log2", false},
    {FUNCTION_POW, "pow", false},           {FUNCTION_DIVIDE, "divide", true},
    {FUNCTION_SQRT, "square root", true},   {FUNCTION_EXPRESSION, "a b - c d", true},
    {FUNCTION_PRODUCTS, "difference of products", true},
    {FUNCTION_NORMALIZE, "normalize", true}, {FUNCTION_UNIT, "random number", false},
    {FUNCTION_LEAVE, "origin of a ray", true},
};

// From 2^-20 to 2^20, either sign.
static f32 moderate(u64 *random)
{
    const f64 size = exp2(random_in(random, -20, 20));
    return (f32)(random_unit(random) < 0.5 ? -size : size);
}

static void fill(NumberTable *table, const Tested *tested)
{
    u64 random = 3;
    if (!tested->moderate) {
        agreed_fill(table->in, table->in + table->stride);
        return;
    }
    for (u32 i = 0; i < table->count; i++)
        for (u32 k = 0; k < table->columns; k++)
            number_set(table, i, k, moderate(&random));
}

static u32 bits_of(f32 x)
{
    u32 bits;
    memcpy(&bits, &x, sizeof bits);
    return isnan(x) ? 0x7fc00000u : bits;
}

// The results of every function on a device; the caller's to free.
static f32 *results_of(Device *device, NumberTable *table)
{
    const size_t functions = sizeof FUNCTIONS / sizeof *FUNCTIONS;
    const size_t numbers = (size_t)NUMBERS_OUT * table->stride;
    Error error = {0};
    Probe *probe = probe_create(device, PROBE_NUMBERS, &error);
    f32 *results = calloc(functions * numbers, sizeof *results);
    if (!probe || !results)
        fail_msg("%s", error.text);
    for (size_t i = 0; i < functions; i++) {
        fill(table, &FUNCTIONS[i]);
        if (!probe_numbers(probe, FUNCTIONS[i].function, table, &error))
            fail_msg("%s", error.text);
        memcpy(results + i * numbers, table->out, numbers * sizeof *results);
    }
    probe_destroy(probe);
    return results;
}

static void test_functions(void **state)
{
    const Fixture *f = *state;
    const size_t functions = sizeof FUNCTIONS / sizeof *FUNCTIONS;
    Arena *arena = arena_create();
    NumberTable *table = arena ? number_table_create(arena, AGREED_INPUTS, NUMBERS_IN) : NULL;
    assert_non_null(table);
    const size_t numbers = (size_t)NUMBERS_OUT * table->stride;
    f32 *first = results_of(f->devices[0], table);
    for (u32 d = 1; d < f->count; d++) {
        f32 *other = results_of(f->devices[d], table);
        for (size_t i = 0; i < functions; i++) {
            u32 different = 0;
            for (u32 column = 0; column < NUMBERS_OUT; column++)
                for (u32 k = 0; k < table->count; k++) {
                    const size_t at = i * numbers + (size_t)column * table->stride + k;
                    different += bits_of(first[at]) != bits_of(other[at]);
                }
            if (different)
                fail_msg("%s: %u of %u results of %s differ from those of %s", name_of(f, d), different,
                         table->count, FUNCTIONS[i].name, name_of(f, 0));
        }
        free(other);
    }
    free(first);
    arena_destroy(arena);
}

// Opens every device that can be used.
static void open_all(Fixture *f)
{
    Error error = {0};
    DeviceList *list = device_list_create(&error);
    for (u32 i = 0; list && i < list->count && f->count < DEVICES_MAX; i++) {
        const DeviceOptions all = {0};
        if (list->devices[i].unusable[0])
            continue;
        f->devices[f->count] = device_open(&list->devices[i], &all, &error);
        if (!f->devices[f->count]) {
            printf("%s: %s\n", list->devices[i].name, error.text);
            continue;
        }
        printf("%s, %s\n", list->devices[i].platform_name, list->devices[i].name);
        f->count++;
    }
    device_list_destroy(list);
}

int main(void)
{
    Fixture f = {0};
    open_all(&f);
    int failed = TEST_SKIP;
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_functions, &f),
        cmocka_unit_test_prestate(test_pictures, &f),
    };
    if (f.count > 1)
        failed = cmocka_run_group_tests(tests, NULL, NULL);
    else
        printf("skipped: there is %s to compare\n", f.count ? "only one device" : "no device");
    for (u32 d = 0; d < f.count; d++)
        device_close(f.devices[d]);
    return failed;
}
