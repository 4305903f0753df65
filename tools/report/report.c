#define _XOPEN_SOURCE 700

#include "report.h"

#include <ctype.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

#include "child.h"
#include "csv.h"
#include "doc.h"
#include "feature_costs.h"
#include "folder.h"
#include "html.h"
#include "measure.h"
#include "plots.h"
#include "reference.h"
#include "row.h"
#include "table.h"
#include "ulp.h"

static bool no_memory(Error *error)
{
    return error_set(error, ERROR_MEMORY, "no memory for the report");
}

// clrt beside this program, wherever that was found.
static const char *find_clrt(const char *program, Arena *arena)
{
    char own[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", own, sizeof own - 1);
    if (length > 0)
        own[length] = 0;
    else
        snprintf(own, sizeof own, "%s", program);
    const char *slash = strrchr(own, '/');
    return slash ? text_format(arena, "%.*s/clrt", (int)(slash - own), own) : "clrt";
}

// A folder that is no report is not ours to replace.
static bool check_out(const char *out, Arena *arena, Error *error)
{
    const char *inside = text_format(arena, "%s/report.json", out);
    if (!inside)
        return no_memory(error);
    if (!folder_exists(out) || folder_exists(inside) || folder_is_empty(out))
        return true;
    return error_set(error, ERROR_USAGE, "%s: is there and is no report; it stays as it is", out);
}

// The scene's file without folders and suffix, in letters, digits, - and _ alone; a number follows where a
// scene before has the same.
static const char *name_of(const Arguments *arguments, u32 index, Arena *arena)
{
    const char *path = arguments->scenes[index], *slash = strrchr(path, '/');
    const char *file = slash ? slash + 1 : path, *dot = strrchr(file, '.');
    const int length = dot && dot != file ? (int)(dot - file) : (int)strlen(file);
    u32 same = 0;
    for (u32 i = 0; i < index; i++) {
        const char *other = strrchr(arguments->scenes[i], '/');
        other = other ? other + 1 : arguments->scenes[i];
        same += strncmp(other, file, (size_t)length) == 0 && (other[length] == '.' || !other[length]);
    }
    char *name = same ? text_format(arena, "%.*s-%u", length, file, same + 1)
                      : text_format(arena, "%.*s", length, file);
    for (char *c = name; c && *c; c++)
        *c = isalnum((unsigned char)*c) || *c == '-' ? *c : '_';
    return name;
}

// ---- the document ---------------------------------------------------------------------------

static json_t *settings_of(const Arguments *arguments)
{
    char when[32] = "";
    const time_t now = time(NULL);
    struct tm parts;
    if (gmtime_r(&now, &parts))
        strftime(when, sizeof when, "%Y-%m-%dT%H:%M:%SZ", &parts);
    json_t *samples = json_array();
    for (u32 i = 0; i < arguments->sample_count; i++)
        json_array_append_new(samples, doc_whole(arguments->samples[i]));
    return json_pack("{s:s, s:s, s:b, s:i, s:i, s:o, s:i, s:f, s:f, s:i, s:n}", "made", when, "version",
                     CLRT_VERSION, "quick", arguments->quick, "runs", (int)arguments->runs, "cold_runs",
                     (int)arguments->cold_runs, "samples", samples, "reference_parts", REFERENCE_PARTS,
                     "reference_share", REFERENCE_SHARE, "confidence", STATISTICS_CONFIDENCE,
                     "pixels_per_degree_flip", 67, "gnuplot");
}

static bool measure_all(Campaign *campaign, json_t *report, Error *error)
{
    const Arguments *arguments = campaign->arguments;
    json_t *rows = json_object_get(report, "rows");
    for (u32 i = 0; i < arguments->scene_count; i++)
        if (!runner_check(&campaign->runner, arguments->scenes[i], error))
            return false;
    if (arguments->against && !runner_check(&campaign->runner, arguments->against, error))
        return false;
    if (arguments->self_test) {
        campaign_say(campaign, "self-test");
        json_t *self_test = runner_self_test(&campaign->runner, error);
        if (!self_test)
            return false;
        json_object_set_new(report, "self_test", self_test);
    }
    for (u32 i = 0; i < arguments->scene_count; i++) {
        const char *name = name_of(arguments, i, campaign->arena);
        if (!name)
            return no_memory(error);
        if (!measure_scene(campaign, arguments->scenes[i], name, rows, error))
            return false;
    }
    return !arguments->features || feature_costs_measure(campaign, json_object_get(report, "features"), error);
}

// The number of cases that failed, in every row's health.
static void spread_self_test(json_t *report)
{
    const f64 failed = doc_number(report, "self_test.failed");
    size_t i;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row)
        if (failed >= 0)
            doc_set(row, "health.self_test", json_string(failed > 0 ? "failed" : "passed"));
}

static bool write_all(const Campaign *campaign, json_t *report, Error *error)
{
    const char *out = campaign->out;
    Arena *arena = campaign->arena;
    const char *document = text_format(arena, "%s/report.json", out),
               *lines = text_format(arena, "%s/rows.jsonl", out);
    const char *csv = text_format(arena, "%s/report.csv", out);
    const char *convergence = text_format(arena, "%s/convergence.csv", out);
    if (!document || !lines || !csv || !convergence)
        return no_memory(error);
    const json_t *rows = json_object_get(report, "rows");
    return plots_make(campaign, report, error) && doc_write(report, false, document, error) &&
           doc_write(rows, true, lines, error) && csv_write_rows(rows, csv, error) &&
           csv_write_convergence(rows, convergence, error) && html_write(campaign, report, error);
}

static bool read_extras(const Arguments *arguments, json_t *report, Error *error)
{
    if (arguments->peers) {
        Peer peers[PEERS_MAX];
        size_t count;
        if (!csv_read_peers(arguments->peers, peers, &count, error))
            return false;
        for (size_t i = 0; i < count; i++)
            json_array_append_new(json_object_get(report, "peers"),
                                  json_pack("{s:o, s:f, s:f}", "name", doc_string(peers[i].name), "seconds",
                                            peers[i].seconds, "rmse", peers[i].rmse));
    }
    json_t *ulp = arguments->ulp ? ulp_read(arguments->ulp, error) : json_null();
    return ulp && json_object_set_new(report, "ulp", ulp) == 0;
}

static bool run(Campaign *campaign, Error *error)
{
    json_t *report =
        json_pack("{s:s, s:o, s:[], s:[], s:[], s:n, s:n, s:[]}", "schema", ROW_SCHEMA, "settings",
                  settings_of(campaign->arguments), "rows", "features", "peers", "ulp", "self_test", "plots");
    bool ok = report != NULL || no_memory(error);
    ok = ok && read_extras(campaign->arguments, report, error) && measure_all(campaign, report, error);
    if (ok)
        spread_self_test(report);
    ok = ok && write_all(campaign, report, error) &&
         folder_replace(campaign->out, campaign->arguments->out, campaign->arena, error);
    if (ok) {
        table_print(report, stdout);
        ok = fflush(stdout) == 0 || error_set(error, ERROR_IO, "the table cannot be written");
    }
    json_decref(report);
    return ok;
}

bool report_make(const Arguments *arguments, const char *program, Arena *arena, Error *error)
{
    Campaign campaign = {.arguments = arguments, .arena = arena};
    const char *folder = getenv("TMPDIR");
    char *work = text_format(arena, "%s/clrt-report-XXXXXX", folder && *folder ? folder : "/tmp");
    campaign.out = text_format(arena, "%s.new-%ld", arguments->out, (long)getpid());
    campaign.runner = (Runner){.clrt = arguments->clrt ? arguments->clrt : find_clrt(program, arena),
                              .device = arguments->device,
                              .folder = work,
                              .arena = arena};
    if (!work || !campaign.out || !campaign.runner.clrt)
        return no_memory(error);
    if (!check_out(arguments->out, arena, error))
        return false;
    child_hold_signals();
    if (!mkdtemp(work))
        return error_set(error, ERROR_IO, "%s: cannot be made", work);
    const bool ok = folder_make(campaign.out, error) && run(&campaign, error);
    folder_remove(campaign.out);
    folder_remove(work);
    return ok;
}
