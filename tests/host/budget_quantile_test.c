// Quantiles against tables and closed forms.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "budget/quantile.h"

static void is_about(f64 value, f64 expected, f64 relative)
{
    if (!(fabs(value - expected) <= relative * fabs(expected)))
        fail_msg("%.15g, not %.15g", value, expected);
}

// Abramowitz and Stegun, Tables 26.9 and 26.10, and R's qf and qt.
static void known_values(void **state)
{
    (void)state;
    is_about(quantile_f(0.05, 1, 1), 161.4476387975881, 1e-8);
    is_about(quantile_f(0.05, 1, 15), 4.543077165, 1e-8);
    is_about(quantile_f(0.05, 10, 10), 2.978237016, 1e-8);
    is_about(quantile_f(0.01, 5, 20), 4.102684630, 1e-8);
    is_about(sqrt(quantile_f(0.05, 1, 9)), 2.262157163, 1e-8);
    is_about(sqrt(quantile_f(0.001, 1, 63)), 3.451768945, 1e-8); // the density summed up numerically
}

// With two degrees of freedom above, x = ((1 / upper)^(2 / n) - 1) n / 2 exactly.
static void closed_form(void **state)
{
    (void)state;
    const f64 uppers[] = {0.5, 0.05, 1e-3, 1e-9, 1e-15}, freedoms[] = {0.5, 1, 3, 63, 1e3, 1e6};
    for (u32 i = 0; i < 5; i++)
        for (u32 j = 0; j < 6; j++) {
            const f64 n = freedoms[j];
            is_about(quantile_f(uppers[i], 2, n), expm1(-log(uppers[i]) * 2 / n) * n / 2, 1e-6);
        }
}

// Towards the normal distribution, and monotone in everything.
static void limits(void **state)
{
    (void)state;
    is_about(sqrt(quantile_f(0.05, 1, 1e9)), 1.959963985, 1e-6);
    is_about(quantile_f(0.05, 1e7, 1e9), 1 + 1.644853627 * sqrt(2e-7), 1e-5);
    assert_true(quantile_f(0.01, 3, 7) > quantile_f(0.05, 3, 7));
    assert_true(quantile_f(0.05, 3, 7) > quantile_f(0.05, 3, 8));
    assert_true(quantile_f(0.05, 3, 7) > quantile_f(0.05, 6, 7));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(known_values),
        cmocka_unit_test(closed_form),
        cmocka_unit_test(limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
