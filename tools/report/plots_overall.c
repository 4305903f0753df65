#include "plots_overall.h"

#include <math.h>

#include "doc.h"
#include "plot.h"

static void put_feature(FILE *data, const json_t *one)
{
    static const char *const PATHS[] = {"used.added_ns_per_ray.median", "used.added_ns_per_ray.mad",
                                        "unused.added_ns_per_ray.median", "unused.added_ns_per_ray.mad"};
    plot_put_name(data, doc_text(one, "feature"));
    for (size_t i = 0; i < 4; i++) {
        const f64 value = doc_number(one, PATHS[i]);
        if (isfinite(value))
            fprintf(data, " %.6g", value);
        else
            fputs(" NaN", data);
    }
    fputc('\n', data);
}

bool plots_overall_features(const Campaign *campaign, json_t *report, Error *error)
{
    const json_t *features = json_object_get(report, "features");
    Plot plot;
    const u32 count = (u32)json_array_size(features);
    if (count == 0)
        return true;
    if (!plot_open(&plot, campaign, "features", 860, 120 + 24 * count, error))
        return false;
    fputs("# feature added_ns mad unused_added_ns mad\n", plot.data);
    size_t i;
    json_t *one;
    json_array_foreach (features, i, one)
        put_feature(plot.data, one);
    fprintf(
        plot.script,
        "set yrange [%u.5:-0.7]\nset xlabel 'ns a ray more than the scene without it (median and MAD)'\n"
        "set style fill solid 0.8 noborder\nset key bottom right\n"
        "set arrow from 0, graph 0 to 0, graph 1 nohead lc rgb '#444444' lw 1\n"
        "plot data using 2:0:(0):2:($0-0.32):($0+0.32):ytic(1) with boxxyerror lc rgb '#0072b2' title "
        "'used', data using 2:0:3 with xerrorbars lc rgb '#003a5c' lw 1.5 pt 0 notitle, data using 4:0:5 "
        "with xerrorbars lc rgb '#d55e00' lw 1.5 pt 7 ps 0.6 title 'declared but unused'\n",
        count - 1);
    return plot_close(&plot, json_object_get(report, "plots"), NULL, "features", error);
}

// The share of a shape's answers in each bin; a block a shape.
static void put_shape(FILE *data, const json_t *shape)
{
    const json_t *bins = json_object_get(shape, "histogram");
    f64 sum = 0;
    size_t i;
    json_t *bin;
    json_array_foreach (bins, i, bin)
        sum += doc_number(bin, "count");
    json_array_foreach (bins, i, bin) {
        const f64 count = doc_number(bin, "count"), end = doc_number(bin, "ulp");
        char label[32] = "more";
        if (isfinite(end))
            snprintf(label, sizeof label, "%g", end);
        fprintf(data, "%zu %.9g \"%s\"\n", i, sum > 0 && count > 0 ? count / sum : 0.0, label);
    }
    fputs("\n\n", data);
}

bool plots_overall_ulp(const Campaign *campaign, json_t *report, Error *error)
{
    enum { COLUMNS = 3, PANEL_WIDTH = 340, PANEL_HEIGHT = 190 };
    const json_t *shapes = doc_at(report, "ulp.shapes");
    const u32 count = (u32)json_array_size(shapes), lines = (count + COLUMNS - 1) / COLUMNS;
    Plot plot;
    if (count == 0)
        return true;
    if (!plot_open(&plot, campaign, "ulp", COLUMNS * PANEL_WIDTH, lines * PANEL_HEIGHT, error))
        return false;
    fprintf(
        plot.script,
        "set multiplot layout %u,%d\nset logscale y\nset yrange [1e-8:2]\nset format y '%%.0e'\nset key off\n"
        "set style fill solid 0.8 noborder\nset boxwidth 0.8\nset xtics rotate by -60 font ',9'\n"
        "set ytics font ',9' 100\n",
        lines, COLUMNS);
    size_t i;
    json_t *shape;
    json_array_foreach (shapes, i, shape) {
        put_shape(plot.data, shape);
        fputs("set title ", plot.script);
        plot_put_name(plot.script, doc_text(shape, "name"));
        fprintf(plot.script, "\nplot data index %zu using 1:2:xtic(3) with boxes lt 1\n", i);
    }
    fputs("unset multiplot\n", plot.script);
    return plot_close(&plot, json_object_get(report, "plots"), NULL, "ulp", error);
}
