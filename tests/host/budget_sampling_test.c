// Pooled sums, and what is said of the error of samples: exact cases, limits, and the coverage of random
// ones.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "budget/sampling.h"

static const f64 GREY[3] = {1, 1, 1};
static const f64 NO_BOUND[3] = {1, INFINITY, 1};

static f64 random_unit(u64 *state)
{
    *state = *state * 6364136223846793005u + 1442695040888963407u;
    return (f64)(*state >> 11) * 0x1p-53;
}

static void is_about(f64 value, f64 expected, f64 tolerance)
{
    if (!(fabs(value - expected) <= tolerance))
        fail_msg("%.15g, not %.15g", value, expected);
}

static void pool_counts(void **state)
{
    (void)state;
    const f32 rgb[12] = {1, 2, 3, NAN, 0.5f, -1, INFINITY, -INFINITY, 0, -0.0f, 4, 0};
    const f32 m2[4] = {1, 2, 3, 0.5f};
    BudgetPool pool = {0};
    budget_pool_add_row(&pool, rgb, m2, 4);
    assert_int_equal(pool.pixels, 4);
    assert_int_equal(pool.nan, 1);
    assert_int_equal(pool.infinite, 2);
    assert_int_equal(pool.negative, 2); // -1 and -INFINITY; not -0
    assert_true(pool.radiance == 9.5 && pool.m2 == 6.5 && pool.m2_squared == 14.25 && pool.m2_max == 3);
    assert_int_equal(sampling_budget(&pool, 4, GREY, 0.95).assumption, SAMPLING_NONE);
}

static void pool_counts_what_is_clamped(void **state)
{
    (void)state;
    const f32 rows[2][8] = {{1, 2, 3, 5, 0, 0, 0, 0}, {-0.5f, 0, 0.25f, 1, 1, 1, 1, 1048576}};
    BudgetPool pool = {0};
    budget_pool_add_clamped(&pool, NULL, 2);
    assert_true(pool.clamped == 0 && pool.clamped_squared == 0 && pool.clamped_samples == 0);
    for (int i = 0; i < 2; i++)
        budget_pool_add_clamped(&pool, rows[i], 2);
    assert_true(pool.clamped == 8.75 && pool.clamped_squared == 17.3125);
    assert_int_equal(pool.clamped_samples, 1048582);
}

static void nothing_is_said(void **state)
{
    (void)state;
    const BudgetPool empty = {0}, plain = {.pixels = 4, .radiance = 1};
    BudgetPool overflow = {.pixels = 4, .radiance = 1, .m2 = INFINITY, .m2_squared = INFINITY};
    assert_int_equal(sampling_budget(&empty, 4, GREY, 0.95).assumption, SAMPLING_NONE);
    assert_int_equal(sampling_budget(&plain, 1, GREY, 0.95).assumption, SAMPLING_NONE);
    assert_int_equal(sampling_budget(&overflow, 9, GREY, 0.95).assumption, SAMPLING_NONE);
    assert_true(isnan(sampling_budget(&plain, 1, GREY, 0.95).rmse));
}

// One pixel of n samples of which `lit` are white: everything by hand.
static void by_hand(void **state)
{
    (void)state;
    const f64 n = 64, lit = 16, m2 = 3 * lit * (n - lit) / n;
    const BudgetPool pool = {.pixels = 1, .radiance = 3 * lit / n, .m2 = m2, .m2_squared = m2 * m2, .m2_max = m2};
    const SamplingBudget none = sampling_budget(&pool, 64, NO_BOUND, 0.95);
    const f64 error = sqrt(lit / n * (1 - lit / n) / (n - 1)), t = 1.998340543;
    assert_int_equal(none.assumption, SAMPLING_NORMAL);
    is_about(none.standard_error, error, 1e-12);
    is_about(none.mean, lit / n, 1e-12);
    is_about(none.mean_high - none.mean, t * error, 1e-8);
    is_about(none.rmse, t * error, 1e-8);
    assert_true(none.largest > none.rmse);
    const SamplingBudget some = sampling_budget(&pool, 64, GREY, 0.95);
    // Hoeffding's bound, the smaller one here.
    assert_int_equal(some.assumption, SAMPLING_BOUNDED);
    is_about(some.mean_high - some.mean, sqrt(log(80) / 128), 1e-9);
    is_about(some.largest, sqrt(log(240) / 128), 1e-9);
}

// Black but bounded: what was not seen may still be there, less and less.
static void black_is_not_trusted(void **state)
{
    (void)state;
    f64 before = 1;
    for (u32 samples = 4; samples <= 1 << 20; samples *= 4) {
        const BudgetPool pool = {.pixels = 10};
        const SamplingBudget budget = sampling_budget(&pool, samples, GREY, 0.95);
        assert_true(budget.rmse > 0 && budget.largest > 0 && budget.mean_high > 0 && budget.mean_low == 0);
        assert_true(budget.largest <= before);
        before = budget.largest;
    }
    assert_true(before < 2e-3);
}

// More pixels and samples of the same kind say more; more confidence says less; a scale scales.
static void monotone(void **state)
{
    (void)state;
    const f64 twice[3] = {2, 2, 2};
    for (u64 pixels = 1; pixels <= 1000000; pixels *= 10) {
        const f64 count = (f64)pixels, m2 = 3 * 0.01 * 0.99 * 256;
        const BudgetPool pool = {.pixels = pixels, .radiance = 0.03 * count, .m2 = m2 * count,
                                 .m2_squared = m2 * m2 * count, .m2_max = m2};
        const BudgetPool scaled = {.pixels = pixels, .radiance = 0.06 * count, .m2 = 4 * m2 * count,
                                   .m2_squared = 16 * m2 * m2 * count, .m2_max = 4 * m2};
        const SamplingBudget a = sampling_budget(&pool, 256, GREY, 0.95);
        const SamplingBudget sure = sampling_budget(&pool, 256, GREY, 0.999);
        const SamplingBudget large = sampling_budget(&scaled, 256, twice, 0.95);
        assert_true(sure.rmse >= a.rmse && sure.largest >= a.largest && sure.mean_high >= a.mean_high);
        is_about(large.rmse, 2 * a.rmse, 1e-12);
        is_about(large.largest, 2 * a.largest, 1e-12);
        is_about(large.mean_high, 2 * a.mean_high, 1e-12);
        assert_true(a.rmse <= a.largest && a.standard_error <= a.rmse);
        if (pixels == 1000000) // many pixels: hardly more than the estimate
            assert_true(a.rmse < 1.25 * a.standard_error);
    }
}

// Independent samples, white with probability p: each statement fails in at most 5 % of the cases; 67 of 1000
// is the 99 % quantile of the binomial.
static void coverage(void **state)
{
    (void)state;
    const f64 probabilities[] = {0.5, 0.1, 0.01, 0.001};
    u64 random = 1;
    for (u32 i = 0; i < 16; i++) {
        const f64 p = probabilities[i % 4];
        const u32 samples = i < 8 ? 16 : 128, pixels = i / 4 % 2 ? 16 : 1;
        u32 rmse_failed = 0, mean_failed = 0, largest_failed = 0;
        for (u32 image = 0; image < 1000; image++) {
            BudgetPool pool = {0};
            f64 squares = 0, largest = 0;
            for (u32 pixel = 0; pixel < pixels; pixel++) {
                u32 lit = 0;
                for (u32 k = 0; k < samples; k++)
                    lit += random_unit(&random) < p;
                const f64 share = (f64)lit / samples;
                const f32 rgb[3] = {(f32)share, (f32)share, (f32)share};
                const f32 m2 = (f32)(3 * samples * share * (1 - share));
                budget_pool_add_row(&pool, rgb, &m2, 1);
                squares += (share - p) * (share - p) / pixels;
                largest = fmax(largest, fabs(share - p));
            }
            const SamplingBudget budget = sampling_budget(&pool, samples, GREY, 0.95);
            rmse_failed += sqrt(squares) > budget.rmse;
            largest_failed += largest > budget.largest;
            mean_failed += p < budget.mean_low || p > budget.mean_high;
        }
        printf("p %-5g %3u samples %2u pixels: covered rmse %u, largest %u, mean %u of 1000\n", p, samples, pixels,
               1000 - rmse_failed, 1000 - largest_failed, 1000 - mean_failed);
        assert_true(rmse_failed <= 67 && mean_failed <= 67 && largest_failed <= 67);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(pool_counts),     cmocka_unit_test(pool_counts_what_is_clamped),
        cmocka_unit_test(nothing_is_said), cmocka_unit_test(by_hand),
        cmocka_unit_test(monotone),        cmocka_unit_test(black_is_not_trusted),
        cmocka_unit_test(coverage),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
