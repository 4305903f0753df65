// The judging of the self-test: right answers pass, wrong ones fail, what fails is an error with status 5.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "selftest/selftest.h"

static void ulps_are_those_of_the_right_number(void **state)
{
    (void)state;
    assert_true(ulp_of(1) == 0x1p-23 && ulp_of(-1.5) == 0x1p-23 && ulp_of(1e7) == 1);
    Score score = {0};
    score_ulps(&score, 1, 1);
    assert_true(score.answers == 1 && score.worst == 0);
    score_ulps(&score, 1, 1 + 3 * 0x1p-23);
    assert_true(score.worst == 3);
    score_ulps(&score, 1, 1 - 0x1p-24);
    assert_true(score.answers == 3 && score.worst == 3); // the worst counts, not the last
    score_ulps(&score, -0x1p-13, -0x1p-13 - 5 * 0x1p-36);
    assert_true(score.worst == 5);
}

static void hits_and_misses_are_no_numbers(void **state)
{
    (void)state;
    Score miss = {0};
    score_ulps(&miss, INFINITY, INFINITY);
    assert_true(miss.worst == 0);
    score_ulps(&miss, INFINITY, 1e30);
    assert_true(isinf(miss.worst));
    Score hit = {0}, other = {0}, third = {0};
    score_ulps(&hit, 5, INFINITY);
    score_relative(&other, 5, INFINITY);
    score_absolute(&third, INFINITY, -INFINITY);
    assert_true(isinf(hit.worst) && isinf(other.worst) && isinf(third.worst));
}

static void nan_is_never_right(void **state)
{
    (void)state;
    Score score = {0};
    score_ulps(&score, INFINITY, NAN);
    score_relative(&score, 1, NAN);
    score_absolute(&score, 0, NAN);
    score_value(&score, NAN);
    assert_true(score.answers == 4 && score.nans == 4 && score.worst == 0);
    assert_false(case_judge("C0", "", "", UNIT_ULP, INFINITY, &score).passed);
}

static void differences_and_counts(void **state)
{
    (void)state;
    Score relative = {0}, absolute = {0}, wrong = {0};
    score_relative(&relative, -4, -3);
    assert_true(relative.worst == 0.25);
    score_absolute(&absolute, -4, -3);
    assert_true(absolute.worst == 1);
    for (int i = 0; i < 10; i++)
        score_wrong(&wrong, i % 5 == 0);
    assert_true(wrong.answers == 10 && wrong.worst == 2);
}

static void bars_are_kept(void **state)
{
    (void)state;
    const Score score = {.answers = 7, .worst = 2}, none = {.answers = 0};
    const SelfTestCase one = case_judge("C1", "what", "against", UNIT_ULP, 2, &score);
    assert_true(one.passed && one.answers == 7 && one.worst == 2 && one.bar == 2 && one.unit == UNIT_ULP);
    assert_string_equal(one.id, "C1");
    assert_false(case_judge("C1", "", "", UNIT_ULP, 1.999, &score).passed);
    assert_false(case_judge("C1", "", "", UNIT_ULP, 2, &none).passed); // nothing was judged
    const Score nan = {.answers = 7, .nans = 1};
    assert_false(case_judge("C1", "", "", UNIT_ULP, 2, &nan).passed);
    for (Unit unit = 0; unit < UNIT_COUNT; unit++)
        assert_non_null(unit_name(unit));
}

static void what_fails_is_an_error(void **state)
{
    (void)state;
    static SelfTestReport report;
    Error error = {.code = ERROR_NONE};
    assert_false(selftest_verdict(&report, &error)); // no cases at all
    assert_int_equal(error.code, ERROR_SELF_TEST);
    const Score right = {.answers = 1}, wrong = {.answers = 1, .worst = 9};
    const SelfTestCase good = case_judge("C1", "", "", UNIT_ULP, 2, &right);
    const SelfTestCase bad = case_judge("C2", "", "", UNIT_ULP, 2, &wrong);
    const SelfTestCase other = case_judge("C20", "", "", UNIT_WRONG, 0, &wrong);
    selftest_add(&report, &good);
    assert_true(selftest_verdict(&report, &error));
    selftest_add(&report, &bad);
    selftest_add(&report, &bad);
    selftest_add(&report, &other);
    assert_int_equal(report.count, 4);
    assert_int_equal(report.failed, 3);
    error = (Error){.code = ERROR_NONE};
    assert_false(selftest_verdict(&report, &error));
    assert_int_equal(error.code, 5); // the exit status
    assert_string_equal(error.text, "the self-test failed in 3 of 4 cases: C2, C20");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ulps_are_those_of_the_right_number),
        cmocka_unit_test(hits_and_misses_are_no_numbers),
        cmocka_unit_test(nan_is_never_right),
        cmocka_unit_test(differences_and_counts),
        cmocka_unit_test(bars_are_kept),
        cmocka_unit_test(what_fails_is_an_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
