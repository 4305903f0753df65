#include "report.h"

#include <stdio.h>
#include <string.h>

void ulp_report_heading(const DeviceInfo *device)
{
    printf("%s, %s, driver %s\n\n", device->name, device->platform_name, device->driver);
    printf("%45s %40s\n", "every hit", "where an ulp of the inputs is at most 8 ulp of t");
    printf("%-14s %10s %10s %8s %9s %8s %8s %8s %8s %8s %9s %6s\n", "shape", "rays", "hits", "> 8 ulp",
           "max ulp", "hits", "p50 ulp", "p99", "p99.9", "max", "/ allowed", "wrong");
}

static f64 percent(u64 part, u64 whole)
{
    return whole ? 100 * (f64)part / (f64)whole : 0;
}

void ulp_report_row(const UlpResult *result)
{
    const Tally *t = &result->tally;
    const Spread *all = &t->all, *steady = &t->steady;
    printf("%-14s %10llu %10llu %7.3f%% %9.3g %7.3f%% %8.2f %8.2f %8.2f %8.2f %9.3f %6llu\n", result->name,
           (unsigned long long)t->rays, (unsigned long long)all->hits, percent(all->above_allowed, all->hits),
           all->max_ulps, percent(steady->hits, all->hits), spread_percentile(steady, 0.5),
           spread_percentile(steady, 0.99), spread_percentile(steady, 0.999), steady->max_ulps, t->max_over,
           (unsigned long long)t->wrong);
    fflush(stdout);
}

void ulp_report_histogram(const UlpResult *results, u32 count)
{
    enum { SHOWN = 8 }; // the last one takes the rest
    printf("\n%-14s", "% of hits");
    for (u32 k = 0; k < SHOWN - 1; k++)
        printf("  <= %-5g", tally_reported_ulps(k));
    printf("     more\n");
    for (u32 i = 0; i < count; i++) {
        const Tally *t = &results[i].tally;
        u64 rest = t->all.hits;
        printf("%-14s", results[i].name);
        for (u32 k = 0; k < SHOWN - 1; k++) {
            printf(" %9.4f", percent(t->reported[k], t->all.hits));
            rest -= t->reported[k];
        }
        printf(" %9.4f\n", percent(rest, t->all.hits));
    }
}

bool ulp_verdict(const UlpResult *results, u32 count, Error *error)
{
    char names[256] = "";
    for (u32 i = 0; i < count; i++) {
        const size_t used = strlen(names);
        if (results[i].tally.beyond > 0)
            snprintf(names + used, sizeof names - used, "%s%s", used ? ", " : "", results[i].name);
    }
    return !*names || error_set(error, ERROR_SELF_TEST, "beyond what is allowed: %s", names);
}
