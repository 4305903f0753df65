#include "html_tables.h"

#include <math.h>
#include <string.h>

#include "doc.h"
#include "html_page.h"

static const f64 MIB = 1024.0 * 1024.0;

bool html_row_is_of(const json_t *row, const char *scene)
{
    const char *name = doc_text(row, "run.scene");
    return name && strcmp(name, scene) == 0;
}

bool html_row_is_available(const json_t *row)
{
    return json_is_null(doc_at(row, "run.unavailable"));
}

// A cell of the median, its MAD below it.
static void put_spread(FILE *file, const json_t *row, const char *path)
{
    const json_t *spread = doc_at(row, path);
    fputs("<td>", file);
    page_number(file, doc_number(spread, "median"));
    if (isfinite(doc_number(spread, "mad"))) {
        fputs("<br><small>&plusmn; ", file);
        page_number(file, doc_number(spread, "mad"));
        fputs("</small>", file);
    }
    fputs("</td>", file);
}

void html_tables_times(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<h3>Time, rays, memory</h3><p>Seconds from the start of the process to its end, and of two of its "
          "stages. Cold: the drivers' caches of compiled kernels are empty. Each figure is a median, below "
          "it the median distance from it (MAD). <i>Kernels, of exact</i>: kernel seconds over those of "
          "mode exact in the same round, at the most samples measured, where noise weighs least.</p>\n",
          file);
    page_table(
        file, "mode|warm run, s|cold run, s|compile<br>cold, s|compile<br>warm, s|kernels<br>warm, s|Mrays/s|"
              "ns/ray|kernels, of<br>exact|device<br>peak, MiB|host<br>peak, MiB");
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene))
            continue;
        fputs("<tr>", file);
        page_cell_text(file, doc_text(row, "run.mode"));
        if (!html_row_is_available(row)) {
            fputs("<td class=\"text\" colspan=\"10\">not available: ", file);
            page_text(file, doc_text(row, "run.unavailable"));
            fputs("</td></tr>\n", file);
            continue;
        }
        put_spread(file, row, "time.warm.wall_s");
        put_spread(file, row, "time.cold.wall_s");
        put_spread(file, row, "time.cold.compile_s");
        put_spread(file, row, "time.warm.compile_s");
        put_spread(file, row, "time.warm.kernel_s");
        page_cell(file, doc_number(row, "rays.mrays_per_s"));
        page_cell(file, doc_number(row, "rays.ns_per_ray"));
        put_spread(file, row, "time.kernel_to_exact");
        page_cell(file, doc_number(row, "memory.device_peak_bytes") / MIB);
        page_cell(file, doc_number(row, "memory.host_peak_bytes") / MIB);
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
}

void html_tables_rays(FILE *file, const json_t *rows, const char *scene)
{
    page_table(file, "mode|camera rays|shadow rays|mirrored or scattered rays|transmitted rays|all rays");
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        fputs("<tr>", file);
        page_cell_text(file, doc_text(row, "run.mode"));
        page_cell(file, doc_number(row, "rays.camera"));
        page_cell(file, doc_number(row, "rays.shadow"));
        page_cell(file, doc_number(row, "rays.reflect"));
        page_cell(file, doc_number(row, "rays.refract"));
        page_cell(file, doc_number(row, "rays.total"));
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
}

// ---- arithmetic -----------------------------------------------------------------------------

static void put_distance(FILE *file, const json_t *row, const char *group)
{
    const json_t *d = doc_at(row, group);
    fprintf(file, "<tr%s>", strcmp(group, "error.r64") == 0 ? " class=\"first\"" : "");
    page_cell_text(file, doc_text(row, "run.mode"));
    if (doc_text(d, "reason")) {
        fputs("<td class=\"text\" colspan=\"8\">not measured: ", file);
        page_text(file, doc_text(d, "reason"));
        fputs("</td></tr>\n", file);
        return;
    }
    page_cell(file, doc_number(d, "spp"));
    page_cell(file, doc_number(d, "max_ulp"));
    page_cell(file, doc_number(d, "max_abs"));
    page_cell(file, doc_number(d, "p99_abs"));
    page_cell(file, doc_number(d, "rmse"));
    page_cell(file, 100 * doc_number(d, "different_values") / doc_number(d, "values"));
    page_cell(file, doc_number(d, "other_object_pixels"));
    page_cell(file, doc_number(row, "run.width") * doc_number(row, "run.height"));
    fputs("</tr>\n", file);
}

void html_tables_arithmetic(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<h3>Arithmetic error</h3><p>The same kernels in double precision, at the same sample positions, "
          "are the right answer (R64), so that there is no noise in this: what is left is rounding, and the "
          "few samples for which rounding decides which object, which shadow or which square of a checker "
          "they see. Those make the largest differences; the 99th percentile tells of all others. Radiance "
          "1 is white.</p>\n",
          file);
    page_table(
        file, "mode|samples|max ulp|max error|p99 error|RMSE|values that<br>differ, %|pixels with<br>another "
              "object|of pixels");
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        put_distance(file, row, "error.r64");
        if (doc_number(row, "error.r64.spp") != 1 && !doc_text(row, "error.r64_one_sample.reason"))
            put_distance(file, row, "error.r64_one_sample");
    }
    fputs("</table></div>\n", file);
}

// ---- sampling -------------------------------------------------------------------------------

static void put_point(FILE *file, const json_t *row, const json_t *point, bool first)
{
    fprintf(file, "<tr%s>", first ? " class=\"first\"" : "");
    page_cell_text(file, first ? doc_text(row, "run.mode") : "");
    page_cell(file, doc_number(point, "spp"));
    put_spread(file, point, "wall_s");
    put_spread(file, point, "kernel_s");
    if (doc_text(point, "reason")) {
        fputs("<td class=\"text\" colspan=\"7\">refused: ", file);
        page_text(file, doc_text(point, "reason"));
        fputs("</td></tr>\n", file);
        return;
    }
    fputs("<td>", file);
    page_number(file, doc_number(point, "rmse"));
    page_interval(file, doc_number(point, "rmse_low"), doc_number(point, "rmse_high"));
    fputs("</td>", file);
    page_cell(file, doc_number(point, "relmse"));
    page_cell(file, doc_number(point, "psnr_db"));
    page_cell(file, doc_number(point, "flip_mean"));
    fputs("<td>", file);
    page_number(file, doc_number(point, "bias"));
    page_interval(file, doc_number(point, "bias_low"), doc_number(point, "bias_high"));
    fputs("</td>", file);
    page_cell(file, doc_number(point, "per_mse_wall"));
    page_cell(file, doc_number(point, "per_mse_kernel"));
    fputs("</tr>\n", file);
}

static void put_reference(FILE *file, const json_t *reference)
{
    fputs("<p>Held against a converged picture (R&infin;): ", file);
    page_number(file, doc_number(reference, "spp"));
    fputs(" samples a pixel in ", file);
    page_text(file, doc_text(reference, "math"));
    fputs(" arithmetic, of <code>", file);
    page_text(file, doc_text(reference, "scene"));
    fputs("</code>, the mean of ", file);
    page_number(file, doc_number(reference, "parts"));
    fputs(" independent renders with seeds that no candidate has. Their spread gives the reference's own "
          "standard error a value: ",
          file);
    page_number(file, doc_number(reference, "standard_error"));
    fputs(
        ". Where that is more than a quarter of an error, the error is refused. In brackets of small print: "
        "95 % intervals over the candidate's seeds. Bias is the mean of candidate minus reference over the "
        "whole picture; one sample a pixel is always the pixel's centre, so that its whole error is bias of "
        "a kind that no second seed shows. Efficiency is 1/(MSE&thinsp;&times;&thinsp;seconds): more is "
        "better.</p>\n",
        file);
}

void html_tables_sampling(FILE *file, const json_t *rows, const char *scene)
{
    size_t i, k;
    json_t *row, *point;
    bool begun = false;
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        if (!begun) {
            fputs("<h3>Sampling error and efficiency</h3>", file);
            put_reference(file, doc_at(row, "error.rinf.reference"));
            page_table(file,
                       "mode|samples|run, s|kernels, s|RMSE|relMSE|PSNR, "
                       "dB|FLIP|bias|efficiency,<br>run|efficiency,<br>kernels");
            begun = true;
        }
        json_array_foreach (json_object_get(row, "convergence"), k, point)
            put_point(file, row, point, k == 0);
    }
    if (begun)
        fputs("</table></div>\n", file);
}

void html_tables_slopes(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<p>Slope of log RMSE on log seconds, with its 95 % interval: &minus;&frac12; is plain Monte "
          "Carlo, steeper is what well-distributed samples gain, flatter is time that does not depend on "
          "the samples, or bias. Seconds to RMSE 0.01 are read from the fitted line of whole runs.</p>\n",
          file);
    page_table(file, "mode|slope, kernels|slope, run|seconds to<br>RMSE 0.01|");
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        const json_t *e = json_object_get(row, "efficiency");
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        fputs("<tr>", file);
        page_cell_text(file, doc_text(row, "run.mode"));
        fputs("<td>", file);
        page_number(file, doc_number(e, "slope_kernel"));
        page_interval(file, doc_number(e, "slope_kernel_low"), doc_number(e, "slope_kernel_high"));
        fputs("</td><td>", file);
        page_number(file, doc_number(e, "slope_wall"));
        page_interval(file, doc_number(e, "slope_wall_low"), doc_number(e, "slope_wall_high"));
        fputs("</td>", file);
        page_cell(file, doc_number(e, "seconds_to_rmse_0_01"));
        page_cell_text(file, json_is_true(doc_at(e, "seconds_extrapolated")) ? "extrapolated" : "");
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
}

// ---- what else is known ---------------------------------------------------------------------

static void put_value(FILE *file, const json_t *value)
{
    if (json_is_number(value))
        page_number(file, json_number_value(value));
    else if (json_is_string(value))
        page_text(file, json_string_value(value));
    else if (json_is_boolean(value))
        fputs(json_is_true(value) ? "yes" : "no", file);
    else
        fputs("&ndash;", file);
}

// Whether any mode says something of it.
static bool is_known(const json_t *rows, const char *scene, const char *group, const char *key)
{
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        const json_t *value = json_object_get(json_object_get(row, group), key);
        if (html_row_is_of(row, scene) && html_row_is_available(row) && value && !json_is_null(value))
            return true;
    }
    return false;
}

// A group of a row whose members are numbers and texts, as a table with a column a mode.
void html_tables_group(FILE *file, const json_t *rows, const char *scene, const char *group)
{
    const char *key;
    json_t *value, *row, *keys = json_object();
    size_t i;
    fputs("<div class=\"wide\"><table class=\"left\"><tr><th></th>", file);
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        json_object_update(keys, json_object_get(row, group));
        fputs("<th>", file);
        page_text(file, doc_text(row, "run.mode"));
        fputs("</th>", file);
    }
    fputs("</tr>\n", file);
    json_object_foreach (keys, key, value) {
        if (json_is_object(value) || json_is_array(value) || !is_known(rows, scene, group, key))
            continue;
        fputs("<tr><td><code>", file);
        page_text(file, key);
        fputs("</code></td>", file);
        json_array_foreach (rows, i, row) {
            if (!html_row_is_of(row, scene) || !html_row_is_available(row))
                continue;
            fputs("<td class=\"text\">", file);
            put_value(file, json_object_get(json_object_get(row, group), key));
            fputs("</td>", file);
        }
        fputs("</tr>\n", file);
    }
    fputs("</table></div>\n", file);
    json_decref(keys);
}
