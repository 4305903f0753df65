#include "cli/selftest_report.h"

#include <jansson.h>
#include <math.h>
#include <string.h>

#include "cli/json_file.h"

// "0.37 ulp"; as many digits as say something.
static void format_amount(char *text, size_t size, f64 amount, Unit unit)
{
    const bool count = unit == UNIT_LEAKS || unit == UNIT_WRONG;
    snprintf(text, size, count ? "%.0f %s" : "%.3g %s", count ? floor(amount) : amount, unit_name(unit));
}

static void print_case(const SelfTestCase *one, FILE *stream)
{
    char worst[32], bar[32];
    format_amount(worst, sizeof worst, one->worst, one->unit);
    format_amount(bar, sizeof bar, one->bar, one->unit);
    fprintf(stream, "%-4s %-60s %-18s %8u %17s %17s %4u  %s\n", one->id, one->what, one->against,
            one->answers, worst, bar, one->nans, one->passed ? "pass" : "FAIL");
}

void selftest_print(const SelfTestReport *report, const DeviceInfo *device, bool failed_only, FILE *stream)
{
    if (!failed_only) {
        fprintf(stream, "clrt %s self-test on %s\n", CLRT_VERSION, device->name);
        fprintf(stream, "%s, driver %s; kernels with %u lanes, %u rays a batch, %u work-items a group\n\n",
                device->platform_name, device->driver, report->shape.lanes, report->shape.batch,
                report->shape.group);
        fprintf(stream, "%-4s %-60s %-18s %8s %17s %17s %4s\n", "case", "what", "against", "answers", "worst",
                "bar", "NaN");
    }
    for (u32 i = 0; i < report->count; i++)
        if (!failed_only || !report->cases[i].passed)
            print_case(&report->cases[i], stream);
    if (!failed_only)
        fprintf(stream, "\n%u cases, %u failed; compiled in %.2f s, run in %.2f s\n", report->count,
                report->failed, report->compile_seconds, report->run_seconds);
}

// JSON has no infinities.
static json_t *number(f64 value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *case_to_json(const SelfTestCase *one)
{
    return json_pack("{s:s, s:s, s:s, s:i, s:s, s:o, s:o, s:i, s:b}", "case", one->id, "what", one->what,
                     "against", one->against, "answers", (int)one->answers, "unit", unit_name(one->unit),
                     "worst", number(one->worst), "bar", number(one->bar), "nan", (int)one->nans, "passed",
                     (int)one->passed);
}

// Names of drivers need not be UTF-8.
static json_t *text_of(const char *text)
{
    json_t *string = json_string(text);
    return string ? string : json_string("?");
}

static json_t *to_json(const SelfTestReport *report, const DeviceInfo *device)
{
    json_t *cases = json_array();
    for (u32 i = 0; cases && i < report->count; i++)
        if (json_array_append_new(cases, case_to_json(&report->cases[i])) != 0) {
            json_decref(cases);
            return NULL;
        }
    return json_pack("{s:s, s:s, s:o, s:o, s:o, s:i, s:i, s:i, s:f, s:f, s:i, s:o}", "schema",
                     "clrt-self-test/1", "version", CLRT_VERSION, "device", text_of(device->name), "platform",
                     text_of(device->platform_name), "driver", text_of(device->driver), "lanes",
                     (int)report->shape.lanes, "batch", (int)report->shape.batch, "group",
                     (int)report->shape.group, "compile_seconds", report->compile_seconds, "run_seconds",
                     report->run_seconds, "failed", (int)report->failed, "cases", cases);
}

bool selftest_write_json(const SelfTestReport *report, const DeviceInfo *device, const char *path,
                         Error *error)
{
    return json_file_write(to_json(report, device), path, "the report of the self-test", error);
}
