// The elementary functions of kernels/base: special values, and the same bits for every number of lanes and
// on every device.
#include "base_support.h"

#include "selftest/agreed.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

typedef struct {
    Function function;
    float x, y, expected; // equal in all bits; any NaN for NaN
} Special;

// Two of the angles are the lower of the two floats around pi/4, which is not the nearer one.
static const Special specials[] = {
    { SIN, 0.0f, 0, 0.0f }, { SIN, -0.0f, 0, 0.0f }, { COS, 0.0f, 0, 1.0f },
    { SIN, 1e30f, 0, 0.0f }, { COS, -1e30f, 0, 1.0f },
    { SIN, INFINITY, 0, NAN }, { COS, -INFINITY, 0, NAN }, { SIN, NAN, 0, NAN },
    { ACOS, 1.0f, 0, 0.0f }, { ACOS, 0x1.000002p+0f, 0, 0.0f }, { ACOS, INFINITY, 0, 0.0f },
    { ACOS, -1.0f, 0, 0x1.921fb6p+1f }, { ACOS, -0x1.000002p+0f, 0, 0x1.921fb6p+1f },
    { ACOS, 0.0f, 0, 0x1.921fb6p+0f }, { ACOS, -0.0f, 0, 0x1.921fb6p+0f }, { ACOS, NAN, 0, NAN },
    { ATAN2, 0.0f, 0.0f, 0.0f }, { ATAN2, 0.0f, -0.0f, -0.0f },
    { ATAN2, -0.0f, 0.0f, 0x1.921fb6p+1f }, { ATAN2, -0.0f, -0.0f, -0x1.921fb6p+1f },
    { ATAN2, 1.0f, 0.0f, 0.0f }, { ATAN2, 1.0f, -0.0f, -0.0f },
    { ATAN2, -1.0f, 0.0f, 0x1.921fb6p+1f }, { ATAN2, -1.0f, -0.0f, -0x1.921fb6p+1f },
    { ATAN2, 0.0f, 1.0f, 0x1.921fb6p+0f }, { ATAN2, -0.0f, -1.0f, -0x1.921fb6p+0f },
    { ATAN2, 1e-40f, 1e-40f, 0.0f }, { ATAN2, 1e-40f, 1.0f, 0x1.921fb6p+0f },
    { ATAN2, 3e38f, 1e-38f, 0.0f }, { ATAN2, 1.0f, 1.0f, 0x1.921fb4p-1f },
    { ATAN2, INFINITY, INFINITY, 0x1.921fb4p-1f }, { ATAN2, -INFINITY, INFINITY, 0x1.2d97c8p+1f },
    { ATAN2, INFINITY, 1.0f, 0.0f }, { ATAN2, -INFINITY, -1.0f, -0x1.921fb6p+1f },
    { ATAN2, 1.0f, -INFINITY, -0x1.921fb6p+0f }, { ATAN2, NAN, 1.0f, NAN }, { ATAN2, 1.0f, NAN, NAN },
    { EXP, 0.0f, 0, 1.0f }, { EXP, -0.0f, 0, 1.0f }, { EXP, 1e-40f, 0, 1.0f }, { EXP, 88.75f, 0, INFINITY },
    { EXP, -87.5f, 0, 0.0f }, { EXP, INFINITY, 0, INFINITY }, { EXP, -INFINITY, 0, 0.0f },
    { EXP, NAN, 0, NAN },
    { EXP2, 0.0f, 0, 1.0f }, { EXP2, 127.0f, 0, 0x1p+127f }, { EXP2, 128.0f, 0, INFINITY },
    { EXP2, -126.0f, 0, 0x1p-126f }, { EXP2, -126.5f, 0, 0.0f }, { EXP2, INFINITY, 0, INFINITY },
    { EXP2, -INFINITY, 0, 0.0f }, { EXP2, NAN, 0, NAN },
    { LOG, 1.0f, 0, 0.0f }, { LOG, 0.0f, 0, -INFINITY }, { LOG, -0.0f, 0, -INFINITY },
    { LOG, 1e-40f, 0, -INFINITY }, { LOG, -1.0f, 0, NAN }, { LOG, INFINITY, 0, INFINITY },
    { LOG, -INFINITY, 0, NAN }, { LOG, NAN, 0, NAN },
    { LOG2, 1.0f, 0, 0.0f }, { LOG2, 0x1p-126f, 0, -126.0f }, { LOG2, 0x1p+100f, 0, 100.0f },
    { LOG2, 0.0f, 0, -INFINITY }, { LOG2, -1.0f, 0, NAN }, { LOG2, INFINITY, 0, INFINITY },
    { POW, 0.0f, 0.0f, 1.0f }, { POW, -0.1f, 0.0f, 1.0f }, { POW, INFINITY, 0.0f, 1.0f },
    { POW, 0.0f, 5.0f, 0.0f }, { POW, -0.1f, 5.0f, 0.0f }, { POW, -0.0f, 5.0f, 0.0f },
    { POW, 1.0f, 1e6f, 1.0f }, { POW, 1.0f, FLT_MAX, 1.0f }, { POW, 0.5f, 1e6f, 0.0f },
    { POW, 0.5f, 126.0f, 0.0f }, { POW, 0.5f, 125.0f, 0x1p-125f }, { POW, 2.0f, 127.0f, 0x1p+127f },
    { POW, 2.0f, 128.0f, INFINITY }, { POW, 2.0f, FLT_MAX, INFINITY }, { POW, 0.5f, FLT_MAX, 0.0f },
    { POW, 1e-40f, 1.0f, 0.0f }, { POW, INFINITY, 0.5f, INFINITY }, { POW, NAN, 2.0f, NAN },
    { POW, 0x1.41fe38p+0f, 0x1.82d72cp+8f, INFINITY }, // 2^127.999997
    { POW, 3.0f, 1.0f, 3.0f }, { POW, 9.0f, 0.5f, 3.0f }, { POW, 0.75f, 2.0f, 0.5625f },
};
enum { SPECIALS = sizeof specials / sizeof *specials };

static void special_values_are_exact(void **state)
{
    Batch *batch = batch_create();
    for (size_t i = 0; i < SPECIALS; i++) {
        batch->x[i] = specials[i].x;
        batch->y[i] = specials[i].y;
    }
    for (size_t w = 0; w < WIDTHS; w++) {
        KernelProgram *program = functions_create(*state, widths[w], NULL);
        for (Function function = 0; function < FUNCTIONS; function++) {
            functions_apply(program, function, widths[w], batch);
            for (size_t i = 0; i < SPECIALS; i++) {
                const float expected = specials[i].expected, result = batch->result[i];
                if (specials[i].function != function)
                    continue;
                if (isnan(expected) ? !isnan(result) : bits_of(result) != bits_of(expected))
                    fail_msg("%s(%a, %a) = %a, not %a", function_names[function], (double)batch->x[i],
                             (double)batch->y[i], (double)result, (double)expected);
            }
        }
        kernel_program_destroy(program);
    }
    free(batch);
}

// A mirror highlight is never brighter than its light: a cosine of at most 1, however near, gives at most 1.
static void power_of_a_cosine_is_at_most_one(void **state)
{
    KernelProgram *program = functions_create(*state, 8, NULL);
    Batch *batch = batch_create();
    static const float exponents[] = { 1e-3f, 1.0f, 50.0f, 1e3f, 1e6f };
    for (uint32_t i = 0; i < BATCH; i++) {
        batch->x[i] = from_bits(bits_of(1.0f) - (i < BATCH / 2 ? i : mix(i) % bits_of(1.0f)));
        batch->y[i] = exponents[i % 5];
    }
    functions_apply(program, POW, 8, batch);
    for (size_t i = 0; i < BATCH; i++)
        assert_true(batch->result[i] >= 0.0f && batch->result[i] <= 1.0f);
    free(batch);
    kernel_program_destroy(program);
}

_Static_assert((int)BATCH == (int)AGREED_INPUTS && (int)FUNCTIONS == (int)AGREED_FUNCTIONS, "the same tables");

static int differences_from_agreed(KernelDevice *device, int lanes, const char *options, Batch *batch)
{
    int differences = 0;
    KernelProgram *program = functions_create(device, lanes, options);
    for (Function function = 0; function < FUNCTIONS; function++) {
        functions_apply(program, function, lanes, batch);
        const u64 hash = agreed_hash(batch->result);
        if (hash == AGREED_HASHES[function])
            continue;
        printf("%s with %d lanes %s: 0x%016llx\n", function_names[function], lanes, options ? options : "",
               (unsigned long long)hash);
        differences++;
    }
    kernel_program_destroy(program);
    return differences;
}

static void bits_agree_for_all_lanes_and_devices(void **state)
{
    Batch *batch = batch_create();
    agreed_fill(batch->x, batch->y);
    int differences = differences_from_agreed(*state, 8, "-cl-denorms-are-zero", batch);
    for (size_t w = 0; w < WIDTHS; w++)
        differences += differences_from_agreed(*state, widths[w], NULL, batch);
    free(batch);
    assert_int_equal(differences, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(special_values_are_exact),
        cmocka_unit_test(power_of_a_cosine_is_at_most_one),
        cmocka_unit_test(bits_agree_for_all_lanes_and_devices),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
