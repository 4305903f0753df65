#include "html_scene.h"

#include <math.h>
#include <string.h>

#include "doc.h"
#include "folder.h"
#include "html_page.h"

static const f64 MIB = 1024.0 * 1024.0;

bool html_plot_write(FILE *file, const Session *session, const json_t *report, const char *kind, const char *scene,
                     const char *caption, Error *error)
{
    size_t i;
    json_t *plot;
    json_array_foreach(json_object_get(report, "plots"), i, plot) {
        const char *of = doc_text(plot, "scene"), *name = doc_text(plot, "file");
        if (strcmp(doc_text(plot, "kind"), kind) != 0 || !name || (of ? !scene || strcmp(of, scene) != 0 : !!scene))
            continue;
        const char *path = text_format(session->arena, "%s/%s", session->out, name);
        if (!path)
            return error_set(error, ERROR_MEMORY, "no memory for a name");
        fputs("<figure>", file);
        if (!page_image(file, path, "image/svg+xml", caption, error))
            return false;
        fprintf(file, "<figcaption>%s</figcaption></figure>\n", caption);
    }
    return true;
}

static bool is_of(const json_t *row, const char *scene)
{
    const char *name = doc_text(row, "run.scene");
    return name && strcmp(name, scene) == 0;
}

static bool is_available(const json_t *row)
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

static void put_times(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<h3>Time, rays, memory</h3><p>Seconds from the start of the process to its end, and of two of its stages. "
          "Cold: the drivers' caches of compiled kernels are empty. Each figure is a median, below it the median "
          "distance from it (MAD). <i>Kernels, of exact</i>: kernel seconds over those of mode exact in the same round, at "
          "the most samples measured, where noise weighs least.</p>\n",
          file);
    page_table(file, "mode|warm run, s|cold run, s|compile<br>cold, s|compile<br>warm, s|kernels<br>warm, s|Mrays/s|"
                     "ns/ray|kernels, of<br>exact|device<br>peak, MiB|host<br>peak, MiB");
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene))
            continue;
        fputs("<tr>", file);
        page_cell_text(file, doc_text(row, "run.mode"));
        if (!is_available(row)) {
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

static void put_rays(FILE *file, const json_t *rows, const char *scene)
{
    page_table(file, "mode|camera rays|shadow rays|mirrored rays|transmitted rays|all rays");
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene) || !is_available(row))
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

static void put_arithmetic(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<h3>Arithmetic error</h3><p>The same kernels in double precision, at the same sample positions, are the "
          "right answer (R64), so that there is no noise in this: what is left is rounding, and the few samples for "
          "which rounding decides which object, which shadow or which square of a checker they see. Those make the "
          "largest differences; the 99th percentile tells of all others. Radiance 1 is white.</p>\n",
          file);
    page_table(file, "mode|samples|max ulp|max error|p99 error|RMSE|values that<br>differ, %|pixels with<br>another object|"
                     "of pixels");
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene) || !is_available(row))
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
    fputs(" independent renders with seeds that no candidate has. Their spread gives the reference's own standard "
          "error a value: ",
          file);
    page_number(file, doc_number(reference, "standard_error"));
    fputs(". Where that is more than a quarter of an error, the error is refused. In brackets of small print: 95 % "
          "intervals over the candidate's seeds. Bias is the mean of candidate minus reference over the whole "
          "picture; one sample a pixel is always the pixel's centre, so that its whole error is bias of a kind "
          "that no second seed shows. Efficiency is 1/(MSE&thinsp;&times;&thinsp;seconds): more is better.</p>\n",
          file);
}

static void put_sampling(FILE *file, const json_t *rows, const char *scene)
{
    size_t i, k;
    json_t *row, *point;
    bool begun = false;
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene) || !is_available(row))
            continue;
        if (!begun) {
            fputs("<h3>Sampling error and efficiency</h3>", file);
            put_reference(file, doc_at(row, "error.rinf.reference"));
            page_table(file, "mode|samples|run, s|kernels, s|RMSE|relMSE|PSNR, dB|FLIP|bias|efficiency,<br>run|"
                             "efficiency,<br>kernels");
            begun = true;
        }
        json_array_foreach(json_object_get(row, "convergence"), k, point)
            put_point(file, row, point, k == 0);
    }
    if (begun)
        fputs("</table></div>\n", file);
}

static void put_slopes(FILE *file, const json_t *rows, const char *scene)
{
    fputs("<p>Slope of log RMSE on log seconds, with its 95 % interval: &minus;&frac12; is plain Monte Carlo, steeper "
          "is what well-distributed samples gain, flatter is time that does not depend on the samples, or bias. "
          "Seconds to RMSE 0.01 are read from the fitted line of whole runs.</p>\n",
          file);
    page_table(file, "mode|slope, kernels|slope, run|seconds to<br>RMSE 0.01|");
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        const json_t *e = json_object_get(row, "efficiency");
        if (!is_of(row, scene) || !is_available(row))
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

// ---- pictures -------------------------------------------------------------------------------

static bool put_picture(FILE *file, const Session *session, const json_t *row, const char *path, const char *what,
                        Error *error)
{
    const char *name = doc_text(row, path), *mode = doc_text(row, "run.mode");
    if (!name)
        return true;
    const char *place = text_format(session->arena, "%s/%s", session->out, name);
    const char *caption = text_format(session->arena, "%s: %s", mode, what);
    if (!place || !caption)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    fprintf(file, "<figure%s>", doc_number(row, "run.width") < 480 ? " class=\"small\"" : "");
    if (!page_image(file, place, "image/png", caption, error))
        return false;
    fputs("<figcaption>", file);
    page_text(file, caption);
    fputs("</figcaption></figure>\n", file);
    return true;
}

static bool put_maps(FILE *file, const Session *session, const json_t *rows, const char *scene, Error *error)
{
    fputs("<h3>Where the errors are</h3><p>Each pixel's largest error of radiance over its three colours, all maps of "
          "all reports on one logarithmic scale from 10<sup>&minus;8</sup> to 1. Black: no difference at all.</p>\n"
          "<div class=\"row\">\n",
          file);
    bool ok = true;
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene) || !is_available(row))
            continue;
        ok = ok && put_picture(file, session, row, "files.map_r64", "arithmetic error, against double", error) &&
             put_picture(file, session, row, "files.map_rinf", "all of the error, against the converged picture", error);
    }
    fputs("</div>\n", file);
    return ok;
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
    json_array_foreach(rows, i, row) {
        const json_t *value = json_object_get(json_object_get(row, group), key);
        if (is_of(row, scene) && is_available(row) && value && !json_is_null(value))
            return true;
    }
    return false;
}

// A group of a row whose members are numbers and texts, as a table with a column a mode.
static void put_group(FILE *file, const json_t *rows, const char *scene, const char *group)
{
    const char *key;
    json_t *value, *row, *keys = json_object();
    size_t i;
    fputs("<div class=\"wide\"><table><tr><th></th>", file);
    json_array_foreach(rows, i, row) {
        if (!is_of(row, scene) || !is_available(row))
            continue;
        json_object_update(keys, json_object_get(row, group));
        fputs("<th>", file);
        page_text(file, doc_text(row, "run.mode"));
        fputs("</th>", file);
    }
    fputs("</tr>\n", file);
    json_object_foreach(keys, key, value) {
        if (json_is_object(value) || json_is_array(value) || !is_known(rows, scene, group, key))
            continue;
        fputs("<tr><td><code>", file);
        page_text(file, key);
        fputs("</code></td>", file);
        json_array_foreach(rows, i, row) {
            if (!is_of(row, scene) || !is_available(row))
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

static void put_identity(FILE *file, const json_t *row)
{
    static const char *const KEYS[] = {"file", "scene_hash", "kernel_hash", "device", "platform", "driver",
                                       "clrt_version", NULL};
    fputs("<p>", file);
    page_number(file, doc_number(row, "run.width"));
    fputs(" &times; ", file);
    page_number(file, doc_number(row, "run.height"));
    fputs(" pixels, ", file);
    page_number(file, doc_number(row, "run.spp.mean"));
    fprintf(file, " sample%s a pixel where nothing else is said.", doc_number(row, "run.spp.mean") == 1 ? "" : "s");
    for (const char *const *key = KEYS; *key; key++) {
        const char *text = json_string_value(json_object_get(json_object_get(row, "run"), *key));
        if (!text)
            continue;
        fprintf(file, " <small>%s</small> <code>", *key);
        page_text(file, text);
        fputs("</code>", file);
    }
    fputs("</p>\n<p><small>features</small> ", file);
    size_t i;
    json_t *feature;
    json_array_foreach(doc_at(row, "run.features"), i, feature) {
        fputs(i ? ", " : "", file);
        page_text(file, json_string_value(feature));
    }
    fputs("</p>\n", file);
}

static const json_t *first_row(const json_t *rows, const char *scene)
{
    size_t i;
    json_t *row;
    json_array_foreach(rows, i, row)
        if (is_of(row, scene) && is_available(row))
            return row;
    return NULL;
}

bool html_scene_write(FILE *file, const Session *session, const json_t *report, const char *scene, Error *error)
{
    const json_t *rows = json_object_get(report, "rows"), *first = first_row(rows, scene);
    fputs("<h2>Scene ", file);
    page_text(file, scene);
    fputs("</h2>\n", file);
    if (!first) {
        fputs("<p>None of the modes could render it.</p>\n", file);
        return true;
    }
    put_identity(file, first);
    if (!put_picture(file, session, first, "files.picture", "as a display shows it", error))
        return false;
    put_times(file, rows, scene);
    put_rays(file, rows, scene);
    if (!html_plot_write(file, session, report, "stages", scene,
                         "What the seconds of a run are spent on. The two panels have scales of their own.", error))
        return false;
    put_arithmetic(file, rows, scene);
    put_sampling(file, rows, scene);
    put_slopes(file, rows, scene);
    if (!html_plot_write(file, session, report, "convergence", scene,
                         "Error against time, from few to many samples; bars are 95 % intervals, mostly smaller "
                         "than the dots. The grey line falls as plain Monte Carlo does.",
                         error) ||
        !html_plot_write(file, session, report, "pareto", scene,
                         "All ways to render this scene: the number beside a dot is its samples a pixel. What lies "
                         "above and to the right of the grey steps is beaten in both time and error.",
                         error) ||
        !put_maps(file, session, rows, scene, error))
        return false;
    fputs("<h3>Error budget</h3><p>What clrt states of each picture, beside the largest arithmetic error measured "
          "above (<code>e_arith</code>). What is not listed, or has a dash, is not stated.</p>\n",
          file);
    put_group(file, rows, scene, "budget");
    fputs("<h3>Health</h3>\n", file);
    put_group(file, rows, scene, "health");
    return true;
}
