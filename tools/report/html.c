#include "html.h"

#include <errno.h>
#include <math.h>
#include <string.h>

#include "doc.h"
#include "folder.h"
#include "html_page.h"
#include "html_scene.h"

static const json_t *find_row(const json_t *rows, const char *scene, const char *mode)
{
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row)
        if (strcmp(doc_text(row, "run.scene"), scene) == 0 && strcmp(doc_text(row, "run.mode"), mode) == 0)
            return json_is_null(doc_at(row, "run.unavailable")) ? row : NULL;
    return NULL;
}

// ---- what is on top -------------------------------------------------------------------------

static void put_finding(FILE *file, const json_t *rows, const char *scene)
{
    const json_t *exact = find_row(rows, scene, "exact"), *fast = find_row(rows, scene, "fast");
    if (!exact)
        return;
    fputs("<li><b>", file);
    page_text(file, scene);
    fputs("</b>: ", file);
    page_number(file, doc_number(exact, "time.warm.wall_s.median"));
    fputs(" s from the shell to the picture (", file);
    page_number(file, doc_number(exact, "time.cold.wall_s.median"));
    fputs(" s when nothing is compiled yet), ", file);
    page_number(file, doc_number(exact, "rays.mrays_per_s"));
    fputs(" million rays a second", file);
    if (fast) {
        fputs("; fast arithmetic takes ", file);
        page_number(file, doc_number(fast, "time.kernel_to_exact.median"));
        fputs(" &plusmn; ", file);
        page_number(file, doc_number(fast, "time.kernel_to_exact.mad"));
        fputs(" of the kernels' time of exact arithmetic", file);
    }
    if (isfinite(doc_number(exact, "error.r64.p99_abs"))) {
        fputs("; 99 of 100 values are within ", file);
        page_number(file, doc_number(exact, "error.r64.p99_abs"));
        fputs(" of double precision", file);
    }
    if (isfinite(doc_number(exact, "error.r64.other_object_pixels"))) {
        fputs(", ", file);
        page_number(file, doc_number(exact, "error.r64.other_object_pixels"));
        fputs(" pixels show another object", file);
    }
    if (isfinite(doc_number(exact, "error.rinf.rmse"))) {
        fputs("; sampling error ", file);
        page_number(file, doc_number(exact, "error.rinf.rmse"));
        fputs(" RMSE at ", file);
        page_number(file, doc_number(exact, "run.spp.mean"));
        fputs(doc_number(exact, "run.spp.mean") == 1 ? " sample" : " samples", file);
    }
    fputs(".</li>\n", file);
}

static void put_summary(FILE *file, const json_t *report)
{
    const json_t *rows = json_object_get(report, "rows");
    const char *before = "";
    size_t i;
    json_t *row;
    fputs("<ul>\n", file);
    json_array_foreach (rows, i, row) {
        const char *scene = doc_text(row, "run.scene");
        if (strcmp(scene, before) != 0)
            put_finding(file, rows, scene);
        before = scene;
    }
    fputs("</ul>\n", file);
}

static void put_top(FILE *file, const json_t *report)
{
    const json_t *first = doc_at(report, "rows.0");
    fputs("<h1>clrt: speed against error</h1>\n<p>", file);
    if (doc_text(first, "run.device")) {
        fputs("Measured on ", file);
        page_text(file, doc_text(first, "run.device"));
        fputs(", ", file);
    }
    page_text(file, doc_text(report, "settings.made"));
    fputs(". Each figure comes from runs of the program as a user starts it, ", file);
    page_number(file, doc_number(report, "settings.runs"));
    fputs(" warm and ", file);
    page_number(file, doc_number(report, "settings.cold_runs"));
    fputs(" cold of each kind, in turns.</p>\n", file);
    if (json_is_true(doc_at(report, "settings.quick")))
        fputs("<div class=\"note warn\"><p><b>A quick report</b>: small pictures and few runs. Start-up "
              "weighs more in it than in the pictures people render, and its medians are of few "
              "values.</p></div>\n",
              file);
    if (!doc_text(report, "settings.gnuplot"))
        fputs("<div class=\"note warn\"><p><b>No plots</b>: gnuplot was not found, or could not draw them. "
              "Their data and scripts are in the folder <code>plots</code>.</p></div>\n",
              file);
}

static void put_reading(FILE *file)
{
    fputs(
        "<div class=\"note\"><p><b>Two errors, never mixed.</b> <i>Arithmetic</i> error is what single "
        "precision does to the same samples, measured against double. <i>Sampling</i> error is what too few "
        "samples leave undecided, measured against a converged picture whose own uncertainty is "
        "known.</p><p><b>Modes.</b> <i>exact</i> is the default: the same bytes on every device. "
        "<i>fast</i> uses the device's native functions and contraction. <i>double</i> is the reference for "
        "arithmetic. Other names are variants by options of clrt.</p><p><b>Radiance</b> is linear light, 1 "
        "is white; all errors are of radiance, before tone mapping, FLIP excepted, which is of what a "
        "display shows at 67 pixels per degree, values above white cut off.</p></div>\n",
        file);
}

// ---- features -------------------------------------------------------------------------------

static void put_feature(FILE *file, const json_t *one)
{
    const json_t *unused = json_object_get(one, "unused");
    fputs("<tr>", file);
    page_cell_text(file, doc_text(one, "feature"));
    page_cell_text(file, doc_text(one, "what"));
    page_cell(file, doc_number(one, "used.ns_per_ray.median"));
    fputs("<td>", file);
    page_number(file, doc_number(one, "used.added_ns_per_ray.median"));
    fputs(" <small>&plusmn; ", file);
    page_number(file, doc_number(one, "used.added_ns_per_ray.mad"));
    fputs("</small></td><td>", file);
    if (json_is_object(unused)) {
        page_number(file, doc_number(unused, "added_ns_per_ray.median"));
        fputs(" <small>&plusmn; ", file);
        page_number(file, doc_number(unused, "added_ns_per_ray.mad"));
        fprintf(file, "</small></td><td>%s</td>",
                json_is_true(doc_at(unused, "within_noise")) ? "yes" : "<b>no</b>");
        const json_t *same = doc_at(unused, "same_kernels");
        const json_t *features = doc_at(unused, "same_features");
        fprintf(file, "<td>%s</td>",
                json_is_boolean(same)       ? json_is_true(same) ? "yes" : "<b>no</b>"
                : json_is_boolean(features) ? json_is_true(features) ? "same features" : "<b>no</b>"
                                            : "&ndash;");
    } else {
        fputs("&ndash;</td><td></td><td></td>", file);
    }
    fputs("</tr>\n", file);
}

static bool put_features(FILE *file, const Campaign *campaign, const json_t *report, Error *error)
{
    const json_t *features = json_object_get(report, "features");
    if (json_array_size(features) == 0)
        return true;
    fputs("<h2>What a feature costs</h2>\n<p>A small scene (a plane, three spheres, one light, no shadows) "
          "and, for each feature of the language, the same scene with that feature added alone; a shape "
          "stands in the place of one of the spheres. Nanoseconds of kernel time a ray, the difference to "
          "the plain scene just before: median and MAD. A ray is a ray of any kind, so that mirrored "
          "and shadow rays, which are cheaper than camera rays, can make the mean ray cheaper. <i>Declared "
          "but unused</i>: a torus in an object that is never placed, a material on nothing. That must be 0 "
          "within noise, and its program the same.</p>\n",
          file);
    if (!html_plot_write(file, campaign, report, "features", NULL,
                         "Cost of each feature added alone, and of its declaration without use.", error))
        return false;
    page_table(file, "feature|what is added|ns/ray|added ns/ray|unused:<br>added "
                     "ns/ray|within<br>noise|same<br>program");
    size_t i;
    json_t *one;
    json_array_foreach (features, i, one)
        put_feature(file, one);
    fputs("</table></div>\n", file);
    return true;
}

// ---- shapes, self-test ----------------------------------------------------------------------

static bool put_ulp(FILE *file, const Campaign *campaign, const json_t *report, Error *error)
{
    const json_t *shapes = doc_at(report, "ulp.shapes");
    if (json_array_size(shapes) == 0)
        return true;
    fputs("<h2>Arithmetic of the shapes</h2>\n<p>Distances along random rays as the device finds them, "
          "against a reference of higher precision, in units in the last place.</p>\n",
          file);
    if (!html_plot_write(
            file, campaign, report, "ulp", NULL,
            "Share of the hits (logarithmic) by their error: up to the number of ulp below each bar.", error))
        return false;
    page_table(file, "shape|rays|p99 ulp|max ulp");
    size_t i;
    json_t *shape;
    json_array_foreach (shapes, i, shape) {
        fputs("<tr>", file);
        page_cell_text(file, doc_text(shape, "name"));
        page_cell(file, doc_number(shape, "rays"));
        page_cell(file, doc_number(shape, "p99_ulp"));
        page_cell(file, doc_number(shape, "max_ulp"));
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
    return true;
}

static void put_self_test(FILE *file, const json_t *report)
{
    const json_t *cases = doc_at(report, "self_test.cases");
    if (json_array_size(cases) == 0)
        return;
    fputs("<h2>Self-test</h2>\n<p>Numerical hard cases on this device, ", file);
    page_number(file, doc_number(report, "self_test.failed"));
    fputs(" of them failed.</p>\n", file);
    page_table(file, "case|what|worst|bar|unit|passed");
    size_t i;
    json_t *one;
    json_array_foreach (cases, i, one) {
        fputs("<tr>", file);
        page_cell_text(file, doc_text(one, "case"));
        page_cell_text(file, doc_text(one, "what"));
        page_cell(file, doc_number(one, "worst"));
        page_cell(file, doc_number(one, "bar"));
        page_cell_text(file, doc_text(one, "unit"));
        page_cell_text(file, json_is_true(doc_at(one, "passed")) ? "yes" : "NO");
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
}

// ---- what to keep in mind -------------------------------------------------------------------

static void put_missing(FILE *file, const json_t *report)
{
    size_t i;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row) {
        const char *reason = doc_text(row, "run.unavailable");
        if (!reason)
            continue;
        fputs("<li>", file);
        page_text(file, doc_text(row, "run.scene"));
        fputs(", ", file);
        page_text(file, doc_text(row, "run.mode"));
        fputs(": not measured, clrt says <code>", file);
        page_text(file, reason);
        fputs("</code>.</li>\n", file);
    }
}

static void put_caveats(FILE *file, const json_t *report)
{
    fputs("<h2>What to keep in mind</h2>\n<ul>\n"
          "<li>Seconds are of one machine with whatever else ran on it. Modes took turns, so that a "
          "disturbance falls on all of them; MAD shows what is left of it.</li>\n"
          "<li>Double precision is the same program text. A mistake in a formula is in both and does not "
          "show here; closed forms and an independent renderer in the tests answer for that.</li>\n"
          "<li>The converged picture has an error of its own, stated above. It adds to the MSE of each "
          "candidate, at most a sixteenth of it.</li>\n"
          "<li>Kernel seconds are those that the host waits for launches, transfers of the picture "
          "included. Building the hierarchy is part of the layout, uploads of the scene part of opening the "
          "device and of the kernels: clrt does not tell them apart, and their columns are null.</li>\n"
          "<li>Sampling figures but RMSE, its interval, bias and times are of the first seed.</li>\n",
          file);
    put_missing(file, report);
    fputs("</ul>\n<p>All figures at full precision: <code>report.json</code> (schema "
          "<code>clrt-report/1</code>), <code>rows.jsonl</code>, <code>report.csv</code>, "
          "<code>convergence.csv</code>. Plots can be drawn again by <code>gnuplot</code> from the folder "
          "<code>plots</code>.</p>\n",
          file);
}

static bool put_scenes(FILE *file, const Campaign *campaign, const json_t *report, Error *error)
{
    const char *before = "";
    size_t i;
    json_t *row;
    json_array_foreach (json_object_get(report, "rows"), i, row) {
        const char *scene = doc_text(row, "run.scene");
        if (strcmp(scene, before) != 0 && !html_scene_write(file, campaign, report, scene, error))
            return false;
        before = scene;
    }
    return true;
}

bool html_write(const Campaign *campaign, const json_t *report, Error *error)
{
    const char *path = text_format(campaign->arena, "%s/report.html", campaign->out);
    FILE *file = path ? fopen(path, "wb") : NULL;
    if (!path)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    if (!file)
        return error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    page_begin(file, "clrt: speed against error");
    put_top(file, report);
    put_summary(file, report);
    put_reading(file);
    const bool ok = put_scenes(file, campaign, report, error) && put_features(file, campaign, report, error) &&
                    put_ulp(file, campaign, report, error);
    put_self_test(file, report);
    put_caveats(file, report);
    page_end(file);
    const bool whole = !ferror(file);
    if (fclose(file) != 0 || !whole)
        return ok && error_set(error, ERROR_IO, "%s: cannot be written", path);
    return ok;
}
