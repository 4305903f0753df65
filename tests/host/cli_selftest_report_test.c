// The table of the self-test and its JSON.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>
#include <jansson.h>

#include "cli/selftest_report.h"

static const DeviceInfo device = {.name = "Device", .platform_name = "Platform", .driver = "1.2"};

static SelfTestReport report_of_three(void)
{
    const Score right = {.answers = 7, .worst = 0.48}, leaks = {.answers = 100, .worst = 3};
    const Score miss = {.answers = 1, .nans = 1, .worst = INFINITY};
    const SelfTestCase cases[] = {
        case_judge("C1", "far spheres", "closed form", UNIT_ULP, 2, &right),
        case_judge("C13", "a mesh", "closed surface", UNIT_LEAKS, 0, &leaks),
        case_judge("C5", "the rim", "no hit", UNIT_ULP, 2, &miss),
    };
    SelfTestReport report = {.shape = {8, 32, 1}, .compile_seconds = 1.5, .run_seconds = 0.25};
    for (size_t i = 0; i < 3; i++)
        selftest_add(&report, &cases[i]);
    return report;
}

static char *printed(const SelfTestReport *report, bool failed_only)
{
    char *text = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);
    assert_non_null(stream);
    selftest_print(report, &device, failed_only, stream);
    fclose(stream);
    return text;
}

static void the_table_says_all(void **state)
{
    (void)state;
    const SelfTestReport report = report_of_three();
    char *text = printed(&report, false);
    static const char *const PARTS[] = {"Device", "Platform, driver 1.2", "8 lanes", "far spheres",
                                        "closed form", "0.48 ulp", "2 ulp", "pass", "3 leaks", "0 leaks",
                                        "FAIL", "inf ulp",
                                        "3 cases, 2 failed; compiled in 1.50 s, run in 0.25 s\n"};
    for (size_t i = 0; i < sizeof PARTS / sizeof PARTS[0]; i++)
        if (!strstr(text, PARTS[i]))
            fail_msg("no '%s' in:\n%s", PARTS[i], text);
    free(text);
}

static void failures_alone(void **state)
{
    (void)state;
    SelfTestReport report = report_of_three();
    char *text = printed(&report, true);
    assert_non_null(strstr(text, "C13"));
    assert_non_null(strstr(text, "C5"));
    assert_null(strstr(text, "far spheres"));
    assert_null(strstr(text, "Device"));
    free(text);
    report.count = 1;
    report.failed = 0;
    text = printed(&report, true);
    assert_string_equal(text, "");
    free(text);
}

static void the_json_says_all(void **state)
{
    (void)state;
    const SelfTestReport report = report_of_three();
    char path[] = "/tmp/clrt-report-XXXXXX";
    const int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    close(descriptor);
    Error error;
    assert_true(selftest_write_json(&report, &device, path, &error));
    json_error_t where;
    json_t *all = json_load_file(path, 0, &where);
    assert_non_null(all);
    assert_string_equal(json_string_value(json_object_get(all, "schema")), "clrt-self-test/1");
    assert_string_equal(json_string_value(json_object_get(all, "driver")), "1.2");
    assert_int_equal(json_integer_value(json_object_get(all, "failed")), 2);
    const json_t *cases = json_object_get(all, "cases");
    assert_int_equal(json_array_size(cases), 3);
    const json_t *first = json_array_get(cases, 0), *last = json_array_get(cases, 2);
    assert_string_equal(json_string_value(json_object_get(first, "case")), "C1");
    assert_true(fabs(json_real_value(json_object_get(first, "worst")) - 0.48) < 1e-9);
    assert_true(json_is_true(json_object_get(first, "passed")));
    assert_true(json_is_null(json_object_get(last, "worst"))); // no infinities in JSON
    assert_int_equal(json_integer_value(json_object_get(last, "nan")), 1);
    assert_true(json_is_false(json_object_get(last, "passed")));
    json_decref(all);
    unlink(path);
    assert_false(selftest_write_json(&report, &device, "/nowhere/at all", &error));
    assert_int_equal(error.code, ERROR_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_table_says_all),
        cmocka_unit_test(failures_alone),
        cmocka_unit_test(the_json_says_all),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
