#include "plots.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "doc.h"
#include "folder.h"
#include "plot.h"
#include "plots_overall.h"

enum { POINTS_MAX = 1024 };

// ---- logarithmic axes ------------------------------------------------------------------------

typedef struct Range {
    f64 low, high; // low above high: of nothing
} Range;

static const Range NO_RANGE = {INFINITY, 0};

static void widen(Range *range, f64 value)
{
    if (!(value > 0) || isinf(value))
        return;
    range->low = fmin(range->low, value);
    range->high = fmax(range->high, value);
}

// An axis from below the lowest to above the highest value, with labels at 1, 2 and 5 of each power of ten,
// or at the powers alone where those are many.
static void put_axis(FILE *script, char axis, Range range, f64 margin)
{
    if (!(range.low <= range.high))
        return;
    const f64 low = range.low / margin, high = range.high * margin;
    const bool fine = high / low < 500;
    fprintf(script, "set %crange [%.6g:%.6g]\nset %ctics (", axis, low, high, axis);
    bool first = true;
    for (int power = (int)floor(log10(low)); power <= (int)ceil(log10(high)); power++)
        for (int i = 0; i < (fine ? 3 : 1); i++) {
            const f64 at = (i == 0 ? 1 : i == 1 ? 2 : 5) * pow(10, power);
            if (at < low || at > high)
                continue;
            fprintf(script, "%s\"%g\" %.6g", first ? "" : ", ", at, at);
            first = false;
        }
    fputs(")\n", script);
}

// ---- error against time ---------------------------------------------------------------------

typedef struct Point {
    f64 seconds, rmse;
} Point;

static bool is_of(const json_t *row, const char *scene)
{
    const char *name = doc_text(row, "run.scene");
    return name && strcmp(name, scene) == 0;
}

static bool has_error(const json_t *row)
{
    size_t i;
    json_t *point;
    json_array_foreach (json_object_get(row, "convergence"), i, point)
        if (doc_number(point, "rmse") > 0)
            return true;
    return false;
}

// A block of lines a mode: wall and kernel seconds, RMSE and its interval, samples.
static void put_convergence(FILE *data, const json_t *row)
{
    size_t i;
    json_t *point;
    json_array_foreach (json_object_get(row, "convergence"), i, point) {
        const f64 rmse = doc_number(point, "rmse");
        f64 low = doc_number(point, "rmse_low"), high = doc_number(point, "rmse_high");
        if (!(rmse > 0))
            continue;
        low = low > 0 ? low : rmse; // a logarithmic axis has no place for 0
        high = high > 0 ? high : rmse;
        fprintf(data, "%.9g %.9g %.9g %.9g %.9g %.0f\n", doc_number(point, "wall_s.median"),
                doc_number(point, "kernel_s.median"), rmse, low, high, doc_number(point, "spp"));
    }
    fputs("\n\n", data);
}

// A panel with all modes against the seconds of a column, and a line of slope -1/2 through the first point.
static void put_panel(FILE *script, const json_t *rows, const char *scene, int column, const char *what)
{
    size_t i, k;
    json_t *row, *point;
    Range seconds = NO_RANGE, errors = NO_RANGE;
    Point start = {0, 0};
    json_array_foreach (rows, i, row)
        json_array_foreach (json_object_get(row, "convergence"), k, point)
            if (is_of(row, scene) && doc_number(point, "rmse") > 0) {
                const f64 at = doc_number(point, column == 1 ? "wall_s.median" : "kernel_s.median");
                start = start.rmse > 0 ? start : (Point){at, doc_number(point, "rmse")};
                widen(&seconds, at);
                widen(&errors, doc_number(point, "rmse"));
                widen(&errors, doc_number(point, "rmse_low"));
                widen(&errors, doc_number(point, "rmse_high"));
            }
    put_axis(script, 'x', seconds, 1.4);
    put_axis(script, 'y', errors, 1.4);
    fprintf(script,
            "set title '%s'\nset xlabel 'seconds (median)'\nset ylabel 'RMSE of radiance'\n"
            "plot %.6g * (x / %.6g)**-0.5 lc rgb '#999999' lw 1.5 dt 2 title 'slope -1/2'",
            what, start.rmse, start.seconds);
    int index = 0;
    json_array_foreach (rows, i, row)
        if (is_of(row, scene) && has_error(row)) {
            fprintf(script, ", data index %d using %d:3:4:5 with yerrorlines lt %d title '%s'", index, column,
                    index + 1, doc_text(row, "run.mode"));
            index++;
        }
    fputs("\n", script);
}

static bool draw_convergence(const Campaign *campaign, json_t *report, const char *scene, Error *error)
{
    const json_t *rows = json_object_get(report, "rows");
    const char *name = text_format(campaign->arena, "%s_convergence", scene);
    Plot plot;
    if (!name)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!plot_open(&plot, campaign, name, 1040, 440, error))
        return false;
    fputs("# wall_s kernel_s rmse rmse_low rmse_high spp\n", plot.data);
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row)
        if (is_of(row, scene) && has_error(row))
            put_convergence(plot.data, row);
    fputs("set multiplot layout 1,2\nset logscale xy\nset key left bottom Left reverse\n", plot.script);
    put_panel(plot.script, rows, scene, 1, "whole run, from the start of the process to its end");
    put_panel(plot.script, rows, scene, 2, "kernels alone");
    fputs("unset multiplot\n", plot.script);
    return plot_close(&plot, json_object_get(report, "plots"), scene, "convergence", error);
}

// ---- Pareto ---------------------------------------------------------------------------------

static int compare_points(const void *a, const void *b)
{
    const Point *p = a, *q = b;
    return p->seconds != q->seconds ? (p->seconds > q->seconds) - (p->seconds < q->seconds)
                                    : (p->rmse > q->rmse) - (p->rmse < q->rmse);
}

// The points that no other one beats in both, as steps.
static void put_front(FILE *data, Point *points, size_t count)
{
    qsort(points, count, sizeof *points, compare_points);
    f64 best = INFINITY;
    for (size_t i = 0; i < count; i++) {
        if (points[i].rmse >= best)
            continue;
        best = points[i].rmse;
        fprintf(data, "%.9g %.9g\n", points[i].seconds, points[i].rmse);
    }
    fputs("\n\n", data);
}

// A block a mode, one of the peers if there are any, and at last the front; the number of blocks of modes.
static int put_pareto(Plot *plot, const json_t *report, const char *scene, bool peers)
{
    Point points[POINTS_MAX];
    size_t count = 0, i, k;
    int blocks = 0;
    FILE *data = plot->data;
    json_t *row, *point;
    json_array_foreach (json_object_get(report, "rows"), i, row) {
        if (!is_of(row, scene) || !has_error(row))
            continue;
        json_array_foreach (json_object_get(row, "convergence"), k, point) {
            const Point at = {doc_number(point, "wall_s.median"), doc_number(point, "rmse")};
            if (!(at.rmse > 0) || !(at.seconds > 0) || count == POINTS_MAX)
                continue;
            points[count++] = at;
            fprintf(data, "%.9g %.9g \"%.0f\"\n", at.seconds, at.rmse, doc_number(point, "spp"));
        }
        fputs("\n\n", data);
        blocks++;
    }
    json_array_foreach (json_object_get(report, "peers"), i, point) {
        const Point at = {doc_number(point, "seconds"), doc_number(point, "rmse")};
        fprintf(data, "%.9g %.9g ", at.seconds, at.rmse);
        plot_put_name(data, doc_text(point, "name"));
        fputc('\n', data);
        if (count < POINTS_MAX)
            points[count++] = at;
    }
    fputs(peers ? "\n\n" : "", data);
    Range seconds = NO_RANGE, errors = NO_RANGE;
    for (i = 0; i < count; i++) {
        widen(&seconds, points[i].seconds);
        widen(&errors, points[i].rmse);
    }
    put_axis(plot->script, 'x', seconds, 1.6);
    put_axis(plot->script, 'y', errors, 1.3);
    put_front(data, points, count);
    return blocks;
}

static bool draw_pareto(const Campaign *campaign, json_t *report, const char *scene, Error *error)
{
    const bool peers = json_array_size(json_object_get(report, "peers")) > 0;
    const char *name = text_format(campaign->arena, "%s_pareto", scene);
    Plot plot;
    if (!name)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!plot_open(&plot, campaign, name, 1040, 460, error))
        return false;
    fputs("# seconds rmse samples; the last block is the front\n", plot.data);
    const int blocks = put_pareto(&plot, report, scene, peers);
    fprintf(plot.script,
            "set logscale xy\nset key outside right top Left reverse\nset xlabel 'seconds of the whole run "
            "(median)'\nset ylabel 'RMSE of radiance'\n"
            "plot data index %d using 1:2 with steps lc rgb '#999999' lw 2 title 'front: nothing beats it "
            "in both'",
            blocks + peers);
    size_t i;
    int index = 0;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row)
        if (is_of(row, scene) && has_error(row)) {
            fprintf(plot.script,
                    ", data index %d using 1:2 with points lt %d ps 1.2 title '%s', data index %d using "
                    "1:2:3 with labels left offset 0.9,0.3 tc lt %d font ',10' notitle",
                    index, index + 1, doc_text(row, "run.mode"), index, index + 1);
            index++;
        }
    if (peers)
        fprintf(plot.script,
                ", data index %d using 1:2 with points lc rgb 'black' pt 2 ps 1.2 title 'other renderers', "
                "data index %d using 1:2:3 with labels left offset 0.9,0.3 font ',11' notitle",
                blocks, blocks);
    fputs("\n", plot.script);
    return plot_close(&plot, json_object_get(report, "plots"), scene, "pareto", error);
}

// ---- stages ---------------------------------------------------------------------------------

typedef struct Bar {
    const char *title;
    const char *keys[3]; // summed
} Bar;

static const Bar BARS[] = {
    {"start, file, end", {"other_s", "encode_s", NULL}},
    {"choose and open the device", {"device_s", NULL, NULL}},
    {"read scene and meshes", {"parse_s", "load_s", NULL}},
    {"layout, hierarchy", {"bvh_s", "layout_s", "upload_s"}},
    {"compile or load kernels", {"compile_s", NULL, NULL}},
    {"kernels", {"kernel_s", "download_s", NULL}},
};
enum { BAR_COUNT = sizeof BARS / sizeof BARS[0] };

static void put_stages(FILE *data, const json_t *row, const char *heat)
{
    plot_put_name(data, doc_text(row, "run.mode"));
    for (size_t b = 0; b < BAR_COUNT; b++) {
        f64 sum = 0;
        for (size_t k = 0; k < 3 && BARS[b].keys[k]; k++) {
            char path[64];
            snprintf(path, sizeof path, "time.%s.%s.median", heat, BARS[b].keys[k]);
            const f64 seconds = doc_number(row, path);
            sum += seconds > 0 ? seconds : 0;
        }
        fprintf(data, " %.6g", sum);
    }
    fputc('\n', data);
}

static bool draw_stages(const Campaign *campaign, json_t *report, const char *scene, Error *error)
{
    static const char *const HEATS[] = {"cold", "warm"};
    const char *name = text_format(campaign->arena, "%s_stages", scene);
    Plot plot;
    if (!name)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!plot_open(&plot, campaign, name, 1040, 400, error))
        return false;
    size_t i;
    json_t *row;
    for (size_t h = 0; h < 2; h++) {
        json_array_foreach (json_object_get(report, "rows"), i, row)
            if (is_of(row, scene) && json_is_null(doc_at(row, "run.unavailable")))
                put_stages(plot.data, row, HEATS[h]);
        fputs("\n\n", plot.data);
    }
    fputs("set style data histograms\nset style histogram rowstacked\nset style fill solid 1 border rgb "
          "'white'\n"
          "set boxwidth 0.6\nset ylabel 'seconds (median)'\nset yrange [0:*]\nset xtics rotate by -20\n"
          "set multiplot\nset key off\n",
          plot.script);
    for (int h = 0; h < 2; h++) {
        fprintf(plot.script, "set title '%s'\nset lmargin at screen %g\nset rmargin at screen %g\n%splot ",
                h ? "warm: kernels come from the cache" : "cold: kernel caches are empty", h ? 0.4 : 0.06,
                h ? 0.67 : 0.33,
                h ? "unset ylabel\nset key at screen 0.99, screen 0.85 vertical reverse Left invert\n" : "");
        for (size_t b = 0; b < BAR_COUNT; b++)
            fprintf(plot.script, "%sdata index %d using %zu:xtic(1) lt %zu title '%s'", b ? ", " : "", h,
                    b + 2, b == 0 ? 8 : b, BARS[b].title);
        fputs("\n", plot.script);
    }
    fputs("unset multiplot\n", plot.script);
    return plot_close(&plot, json_object_get(report, "plots"), scene, "stages", error);
}

static bool draw_scene(const Campaign *campaign, json_t *report, const char *scene, Error *error)
{
    bool available = false, errors = false;
    size_t i;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row) {
        if (!is_of(row, scene))
            continue;
        available = available || json_is_null(doc_at(row, "run.unavailable"));
        errors = errors || has_error(row);
    }
    return (!errors || (draw_convergence(campaign, report, scene, error) &&
                        draw_pareto(campaign, report, scene, error))) &&
           (!available || draw_stages(campaign, report, scene, error));
}

bool plots_make(const Campaign *campaign, json_t *report, Error *error)
{
    const char *folder = text_format(campaign->arena, "%s/plots", campaign->out);
    if (!folder)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!folder_make(folder, error))
        return false;
    doc_set(report, "settings.gnuplot", doc_string(plot_find_gnuplot(campaign, error)));
    const char *before = "";
    bool ok = true;
    size_t i;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row) {
        const char *scene = doc_text(row, "run.scene");
        if (ok && scene && strcmp(scene, before) != 0)
            ok = draw_scene(campaign, report, scene, error);
        before = scene ? scene : before;
    }
    return ok && plots_overall_features(campaign, report, error) && plots_overall_ulp(campaign, report, error);
}
