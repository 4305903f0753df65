#include "selftest/selftest.h"

#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "selftest/run.h"

void selftest_add(SelfTestReport *report, const SelfTestCase *one)
{
    report->failed += one->passed ? 0 : 1;
    report->cases[report->count++] = *one;
}

bool selftest_verdict(const SelfTestReport *report, Error *error)
{
    char names[512] = "";
    for (u32 i = 0; i < report->count; i++) {
        const size_t used = strlen(names);
        if (!report->cases[i].passed)
            snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", report->cases[i].id);
    }
    if (report->count == 0)
        return error_set(error, ERROR_SELF_TEST, "the self-test has no cases");
    if (report->failed > 0)
        return error_set(error, ERROR_SELF_TEST, "the self-test failed in %u of %u cases: %s", report->failed,
                         report->count, names);
    return true;
}

// In the order of the table.
static bool (*const GROUPS[])(Run *run) = {
    arithmetic_cases, function_cases, sphere_cases,   flat_cases,    round_cases,
    origin_cases,     rim_cases,      transform_cases, mesh_cases,   triangle_cases,
    garbage_cases,    shading_cases,  texture_cases,  color_cases,
};

static bool run_groups(Run *run)
{
    for (size_t i = 0; i < sizeof GROUPS / sizeof GROUPS[0]; i++) {
        run->arena = arena_create();
        const bool ok = run->arena ? GROUPS[i](run)
                                   : error_set(run->error, ERROR_MEMORY, "no memory for the self-test");
        arena_destroy(run->arena);
        if (!ok)
            return false;
    }
    return true;
}

bool selftest_run(Device *device, SelfTestReport *report, Error *error)
{
    memset(report, 0, sizeof *report);
    const f64 start = clock_seconds();
    Probe *probe = probe_create(device, error);
    if (!probe)
        return false;
    const f64 compiled = clock_seconds();
    Run run = {.probe = probe, .report = report, .error = error};
    const bool ok = run_groups(&run);
    report->shape = probe_shape(probe);
    report->compile_seconds = compiled - start;
    report->run_seconds = clock_seconds() - compiled;
    probe_destroy(probe);
    return ok;
}
