#include "table.h"

#include <math.h>

#include "doc.h"

typedef struct Column {
    const char *head, *path, *format;
    int width;
} Column;

static const Column COLUMNS[] = {
    {"spp", "run.spp.mean", "%.0f", 5},
    {"wall s", "time.warm.wall_s.median", "%.3f", 8},
    {"+-", "time.warm.wall_s.mad", "%.3f", 6},
    {"cold s", "time.cold.wall_s.median", "%.2f", 7},
    {"kernel s", "time.warm.kernel_s.median", "%.3f", 9},
    {"Mrays/s", "rays.mrays_per_s", "%.1f", 8},
    {"ns/ray", "rays.ns_per_ray", "%.1f", 7},
    {"MiB", "memory.device_peak_bytes", "%.1f", 6},
    {"max ulp", "error.r64_one_sample.max_ulp", "%.0f", 9},
    {"p99 abs", "error.r64_one_sample.p99_abs", "%.1e", 8},
    {"other", "error.r64.other_object_pixels", "%.0f", 6},
    {"RMSE", "error.rinf.rmse", "%.5f", 8},
    {"relMSE", "error.rinf.relmse", "%.1e", 8},
    {"PSNR", "error.rinf.psnr_db", "%.1f", 6},
    {"FLIP", "error.rinf.flip_mean", "%.4f", 7},
    {"slope", "efficiency.slope_kernel", "%.2f", 6},
};
enum { COLUMN_COUNT = sizeof COLUMNS / sizeof COLUMNS[0], NAME_WIDTH = 14 };

static const f64 MIB = 1024.0 * 1024.0;

static void print_row(const json_t *row, FILE *stream)
{
    fprintf(stream, "%-*.*s %-*.*s", NAME_WIDTH, NAME_WIDTH, doc_text(row, "run.scene"), NAME_WIDTH,
            NAME_WIDTH, doc_text(row, "run.mode"));
    const char *unavailable = doc_text(row, "run.unavailable");
    if (unavailable) {
        fprintf(stream, " %.110s\n", unavailable);
        return;
    }
    for (size_t i = 0; i < COLUMN_COUNT; i++) {
        const Column *column = &COLUMNS[i];
        const f64 value = doc_number(row, column->path);
        char text[32] = "-";
        // The formats are those of the table above.
        if (isfinite(value))
            snprintf(text, sizeof text, column->format, column->path[0] == 'm' ? value / MIB : value);
        fprintf(stream, " %*s", column->width, text);
    }
    fputc('\n', stream);
}

// A number in a column, a dash where there is none.
static void print_number(f64 value, int width, FILE *stream)
{
    if (isfinite(value))
        fprintf(stream, " %*.2f", width, value);
    else
        fprintf(stream, " %*s", width, "-");
}

static void print_features(const json_t *features, FILE *stream)
{
    size_t i;
    json_t *one;
    fprintf(stream, "\n%-14s %8s %9s %7s   %20s %7s  %s\n", "feature", "ns/ray", "added ns", "+-",
            "unused: added ns", "+-", "same program");
    json_array_foreach (features, i, one) {
        const json_t *same = doc_at(one, "unused.same_kernels");
        fprintf(stream, "%-14s", doc_text(one, "feature"));
        print_number(doc_number(one, "used.ns_per_ray.median"), 8, stream);
        print_number(doc_number(one, "used.added_ns_per_ray.median"), 9, stream);
        print_number(doc_number(one, "used.added_ns_per_ray.mad"), 7, stream);
        fputs("  ", stream);
        print_number(doc_number(one, "unused.added_ns_per_ray.median"), 20, stream);
        print_number(doc_number(one, "unused.added_ns_per_ray.mad"), 7, stream);
        fprintf(stream, "  %s\n", !json_is_boolean(same) ? "-" : json_is_true(same) ? "yes" : "NO");
    }
}

void table_print(const json_t *report, FILE *stream)
{
    const json_t *rows = json_object_get(report, "rows"), *features = json_object_get(report, "features");
    size_t i;
    json_t *row;
    if (json_array_size(rows) > 0) {
        fprintf(stream, "%-*s %-*s", NAME_WIDTH, "scene", NAME_WIDTH, "mode");
        for (i = 0; i < COLUMN_COUNT; i++)
            fprintf(stream, " %*s", COLUMNS[i].width, COLUMNS[i].head);
        fputc('\n', stream);
    }
    json_array_foreach (rows, i, row)
        print_row(row, stream);
    if (json_array_size(features) > 0)
        print_features(features, stream);
}
