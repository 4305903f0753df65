// Statistics of clrt-report against values worked by hand and tables of Student's distribution.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "statistics.h"

static void expect_near(f64 value, f64 right, f64 relative)
{
    if (!(fabs(value - right) <= relative * fabs(right) + 1e-300))
        fail_msg("%.17g is not %.17g", value, right);
}

static void test_median_and_mad(void **state)
{
    (void)state;
    const f64 odd[] = {9, 1, 5}, even[] = {4, 1, 3, 100}, one[] = {7};
    expect_near(statistics_median(odd, 3), 5, 0);
    expect_near(statistics_median(even, 4), 3.5, 0);
    expect_near(statistics_median(one, 1), 7, 0);
    assert_true(isnan(statistics_median(one, 0)));
    expect_near(odd[0], 9, 0);                    // stays as it was
    expect_near(statistics_mad(odd, 3), 4, 0);    // 4, 4, 0
    expect_near(statistics_mad(even, 4), 1.5, 0); // 0.5, 2.5, 0.5, 96.5
    assert_int_equal(statistics_mad(one, 1) == 0, 1);
    assert_true(isnan(statistics_mad(one, 0)));
}

static void test_mean(void **state)
{
    (void)state;
    const f64 values[] = {1, 2, 3, 4};
    const Mean mean = statistics_mean(values, 4), single = statistics_mean(values, 1);
    expect_near(mean.value, 2.5, 0);
    expect_near(mean.standard_error, sqrt(5.0 / 3 / 4), 1e-15);
    expect_near(single.value, 1, 0);
    assert_true(isnan(single.standard_error));
    assert_true(isnan(statistics_mean(values, 0).value));
}

static void test_student(void **state)
{
    (void)state;
    expect_near(statistics_student(0.95, 1), 12.706204736432095, 1e-10);
    expect_near(statistics_student(0.95, 2), 4.302652729911275, 1e-10);
    expect_near(statistics_student(0.95, 4), 2.7764451051977987, 1e-10);
    expect_near(statistics_student(0.95, 7), 2.364624251592785, 1e-10);
    expect_near(statistics_student(0.99, 10), 3.169272672616872, 1e-10);
    expect_near(statistics_student(0.95, 29), 2.045229642132703, 1e-10);
    expect_near(statistics_student(0.95, 1e7), 1.959963984540054, 1e-6); // the normal distribution's
}

static void test_batches(void **state)
{
    (void)state;
    const f64 values[] = {1, 2, 3, 4}, same[] = {3, 3, 3};
    const Estimate mean = statistics_batches(values, 4), exact = statistics_batches(same, 3);
    const f64 half = 3.182446305284263 * sqrt(5.0 / 12);
    expect_near(mean.low, 2.5 - half, 1e-10);
    expect_near(mean.high, 2.5 + half, 1e-10);
    assert_true(exact.low == 3 && exact.value == 3 && exact.high == 3);
    const Estimate one = statistics_batches(values, 1);
    assert_true(one.value == 1 && isnan(one.low) && isnan(one.high));
}

static void test_difference(void **state)
{
    (void)state;
    const Mean a = {10, 1, 5}, b = {8, 0.5, 10}, exact = {8, 0, 3};
    const Estimate both = statistics_difference(a, b);
    expect_near(both.value, 2, 0);
    expect_near(both.high - both.value, 2.726912920959699, 1e-7);
    expect_near(both.value - both.low, 2.726912920959699, 1e-7);
    // What has no spread adds none, and no freedom either.
    const Estimate one = statistics_difference(a, exact);
    expect_near(one.high - one.value, 2.7764451051977987, 1e-10);
    const Estimate none = statistics_difference(exact, exact);
    assert_true(none.low == 0 && none.high == 0);
}

static void test_log_line(void **state)
{
    (void)state;
    const f64 x[] = {1, 10, 100, 1000}, half[] = {2, 2 / sqrt(10), 0.2, 0.2 / sqrt(10)};
    Line line;
    assert_true(statistics_log_line(x, half, 4, &line));
    expect_near(line.slope.value, -0.5, 1e-12);
    expect_near(line.intercept, log(2), 1e-12);
    assert_true(fabs(line.slope.high - line.slope.low) < 1e-12);

    const f64 y[] = {1, 1.1 / sqrt(10), 0.1 / 1.1, 0.1 / sqrt(10)};
    assert_true(statistics_log_line(x, y, 4, &line));
    expect_near(line.slope.value, -0.5082785370316449, 1e-10);
    expect_near(line.slope.low, -0.5838392675462951, 1e-10);
    expect_near(line.slope.high, -0.4327178065169947, 1e-10);
    expect_near(line.intercept, 0.02859305394129722, 1e-9);

    assert_true(statistics_log_line(x, half, 2, &line));
    expect_near(line.slope.value, -0.5, 1e-12);
    assert_true(isnan(line.slope.low));
    const f64 still[] = {3, 3, 3};
    assert_false(statistics_log_line(still, y, 3, &line));
    assert_false(statistics_log_line(x, y, 1, &line));
    assert_false(statistics_log_line(x, y, 0, &line));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_median_and_mad), cmocka_unit_test(test_mean),
        cmocka_unit_test(test_student),        cmocka_unit_test(test_batches),
        cmocka_unit_test(test_difference),     cmocka_unit_test(test_log_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
