#include "report.h"

#include <jansson.h>

#include "cli/json_file.h"

static json_t *histogram(const Tally *tally)
{
    json_t *bins = json_array();
    for (u32 i = 0; bins && i < TALLY_REPORTED; i++) {
        // The last bin has no upper end.
        json_t *end = i < TALLY_REPORTED - 1 ? json_real(tally_reported_ulps(i)) : json_null();
        json_t *bin = json_pack("{s:o, s:I}", "ulp", end, "count", (json_int_t)tally->reported[i]);
        if (json_array_append_new(bins, bin) != 0) {
            json_decref(bins);
            return NULL;
        }
    }
    return bins;
}

static json_t *steady(const Spread *spread)
{
    return json_pack("{s:I, s:f, s:f, s:f, s:f}", "hits", (json_int_t)spread->hits, "p50_ulp",
                     spread_percentile(spread, 0.5), "p99_ulp", spread_percentile(spread, 0.99), "p999_ulp",
                     spread_percentile(spread, 0.999), "max_ulp", spread->max_ulps);
}

static json_t *shape(const UlpResult *result)
{
    const Tally *t = &result->tally;
    const Spread *all = &t->all;
    return json_pack("{s:s, s:I, s:I, s:f, s:f, s:f, s:f, s:f, s:f, s:I, s:I, s:I, s:I, s:o, s:o}", "name",
                     result->name, "rays", (json_int_t)t->rays, "hits", (json_int_t)all->hits, "max_ulp",
                     all->max_ulps, "p50_ulp", spread_percentile(all, 0.5), "p99_ulp",
                     spread_percentile(all, 0.99), "p999_ulp", spread_percentile(all, 0.999), "max_relative",
                     t->max_relative, "max_over_allowed", t->max_over, "above_1_ulp",
                     (json_int_t)all->above_one, "above_8_ulp", (json_int_t)all->above_allowed,
                     "beyond_allowed", (json_int_t)t->beyond, "wrong_verdicts", (json_int_t)t->wrong, "steady",
                     steady(&t->steady), "histogram", histogram(t));
}

// Names of drivers need not be UTF-8.
static json_t *text_of(const char *text)
{
    json_t *string = json_string(text);
    return string ? string : json_string("?");
}

bool ulp_report_json(const UlpResult *results, u32 count, const DeviceInfo *device, const char *path,
                     Error *error)
{
    json_t *shapes = json_array();
    bool whole = shapes != NULL;
    for (u32 i = 0; whole && i < count; i++)
        whole = json_array_append_new(shapes, shape(&results[i])) == 0;
    json_t *document = NULL;
    if (whole)
        document = json_pack("{s:s, s:s, s:o, s:o, s:o, s:s, s:o}", "schema", "clrt-ulp/1", "version",
                             CLRT_VERSION, "device", text_of(device->name), "platform",
                             text_of(device->platform_name), "driver", text_of(device->driver), "math",
                             "exact", "shapes", shapes);
    else
        json_decref(shapes);
    return json_file_write(document, path, "the report", error);
}
