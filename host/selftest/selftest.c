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

// Appends the name unless it is the last one there.
static void append_name(char *names, size_t size, const char *name)
{
    const char *comma = strrchr(names, ' ');
    const size_t used = strlen(names);
    if (strcmp(comma ? comma + 1 : names, name) != 0)
        snprintf(names + used, size - used, "%s%s", used ? ", " : "", name);
}

bool selftest_verdict(const SelfTestReport *report, Error *error)
{
    char names[512] = "";
    for (u32 i = 0; i < report->count; i++)
        if (!report->cases[i].passed)
            append_name(names, sizeof names, report->cases[i].id);
    if (report->count == 0)
        return error_set(error, ERROR_SELF_TEST, "the self-test has no cases");
    if (report->failed > 0)
        return error_set(error, ERROR_SELF_TEST, "the self-test failed in %u of %u cases: %s", report->failed,
                         report->count, names);
    return true;
}

typedef bool CaseGroup(Run *run);

// In the order of the table.
static CaseGroup *const ALL[] = {
    arithmetic_cases, division_cases, function_cases,  agreed_cases, film_cases,
    sphere_cases,     flat_cases,     round_cases,     origin_cases, rim_cases,
    transform_cases,  mesh_cases,     triangle_cases,  garbage_cases, shading_cases,
    texture_cases,    color_cases,
};
static CaseGroup *const SHORT[] = {arithmetic_cases, division_cases, function_cases};
enum { ALL_COUNT = sizeof ALL / sizeof ALL[0], SHORT_COUNT = sizeof SHORT / sizeof SHORT[0] };

static bool run_groups(Run *run, CaseGroup *const *groups, u32 count)
{
    for (u32 i = 0; i < count; i++) {
        run->arena = arena_create();
        const bool ok = run->arena ? groups[i](run)
                                   : error_set(run->error, ERROR_MEMORY, "no memory for the self-test");
        arena_destroy(run->arena);
        if (!ok)
            return false;
    }
    return true;
}

static bool run_program(Device *device, ProbeProgram program, u32 inputs, CaseGroup *const *groups, u32 count,
                        SelfTestReport *report, Error *error)
{
    memset(report, 0, sizeof *report);
    const f64 start = clock_seconds();
    Probe *probe = probe_create(device, program, error);
    if (!probe)
        return false;
    const f64 compiled = clock_seconds();
    Run run = {.probe = probe, .inputs = inputs, .report = report, .error = error};
    const bool ok = run_groups(&run, groups, count);
    report->shape = probe_shape(probe);
    report->compile_seconds = compiled - start;
    report->run_seconds = clock_seconds() - compiled;
    probe_destroy(probe);
    return ok;
}

bool selftest_run(Device *device, SelfTestReport *report, Error *error)
{
    return run_program(device, PROBE_ALL, 1 << 15, ALL, ALL_COUNT, report, error);
}

bool selftest_run_short(Device *device, SelfTestReport *report, Error *error)
{
    const u32 groups = device_info(device)->exact_divide ? SHORT_COUNT : 1;
    return run_program(device, PROBE_NUMBERS, 1 << 10, SHORT, groups, report, error);
}
