// Pixel filters: values, quantiles and ratios against closed forms.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "layout/filter.h"

static const f64 PI = 3.14159265358979323846;

static void gives_values_of_the_language(void **state)
{
    (void)state;
    assert_true(filter_value(FILTER_BOX, 0.49) == 1 && filter_value(FILTER_BOX, 0.51) == 0);
    assert_true(filter_value(FILTER_TENT, -0.25) == 0.75 && filter_value(FILTER_TENT, 1.5) == 0);
    assert_true(fabs(filter_value(FILTER_GAUSSIAN, 1) - (exp(-2) - exp(-4.5))) < 1e-15);
    assert_true(filter_value(FILTER_GAUSSIAN, 1.5) == 0);
    // (1 - B/3) at 0, B/6 at 1, with both pieces the same there
    assert_true(fabs(filter_value(FILTER_MITCHELL, 0) - 8.0 / 9) < 1e-15);
    assert_true(fabs(filter_value(FILTER_MITCHELL, 1) - 1.0 / 18) < 1e-15);
    assert_true(fabs(filter_value(FILTER_MITCHELL, 1 - 1e-9) - 1.0 / 18) < 1e-8);
    assert_true(filter_value(FILTER_MITCHELL, 1.5) < 0 && filter_value(FILTER_MITCHELL, 2) == 0);
}

// The integral of |f| from 0 to x.
static f64 below(Filter filter, f64 x)
{
    if (filter == FILTER_GAUSSIAN)
        return sqrt(PI / 2) / 2 * erf(sqrt(2) * x) - exp(-4.5) * x;
    const f64 zero = 8.0 / 7, d = x < 1 ? x : 1;
    f64 sum = 7.0 / 24 * pow(d, 4) - 2.0 / 3 * pow(d, 3) + 8.0 / 9 * d;
    if (x > 1) { // with y = 2 - x the outer piece is 7/18 (y^3 - 6/7 y^2)
        const f64 end = x < zero ? x : zero, a = 1, b = 2 - end;
        sum += 7.0 / 18 * ((pow(a, 4) - pow(b, 4)) / 4 - 2.0 / 7 * (pow(a, 3) - pow(b, 3)));
    }
    if (x > zero) {
        const f64 a = 2 - zero, b = 2 - x;
        sum -= 7.0 / 18 * ((pow(a, 4) - pow(b, 4)) / 4 - 2.0 / 7 * (pow(a, 3) - pow(b, 3)));
    }
    return sum;
}

static void inverts_the_integral(void **state)
{
    (void)state;
    const Filter filters[2] = {FILTER_GAUSSIAN, FILTER_MITCHELL};
    const f64 radii[2] = {1.5, 2};
    for (int f = 0; f < 2; f++) {
        f32 quantiles[FILTER_STEPS + 1];
        filter_quantiles(filters[f], quantiles);
        const f64 total = below(filters[f], radii[f]);
        assert_true(quantiles[0] == 0 && (f64)quantiles[FILTER_STEPS] == radii[f]);
        for (u32 k = 0; k <= FILTER_STEPS; k++)
            assert_true(fabs(below(filters[f], quantiles[k]) / total - (f64)k / FILTER_STEPS) < 2e-7);
    }
}

static void knows_the_ratio_of_the_integrals(void **state)
{
    (void)state;
    const f64 lobe = 7.0 / 18 * pow(6.0 / 7, 4) / 12; // of one side; the filter itself has the integral 1
    assert_true(fabs(filter_ratio(FILTER_MITCHELL) - pow(1 + 4 * lobe, 2)) < 1e-9);
    assert_true(filter_ratio(FILTER_BOX) == 1 && filter_ratio(FILTER_GAUSSIAN) == 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(gives_values_of_the_language),
        cmocka_unit_test(inverts_the_integral),
        cmocka_unit_test(knows_the_ratio_of_the_integrals),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
