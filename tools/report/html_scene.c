#include "html_scene.h"

#include <math.h>
#include <string.h>

#include "doc.h"
#include "folder.h"
#include "html_page.h"
#include "html_tables.h"

bool html_plot_write(FILE *file, const Campaign *campaign, const json_t *report, const char *kind,
                     const char *scene, const char *caption, Error *error)
{
    size_t i;
    json_t *plot;
    json_array_foreach (json_object_get(report, "plots"), i, plot) {
        const char *of = doc_text(plot, "scene"), *name = doc_text(plot, "file");
        if (strcmp(doc_text(plot, "kind"), kind) != 0 || !name ||
            (of ? !scene || strcmp(of, scene) != 0 : !!scene))
            continue;
        const char *path = text_format(campaign->arena, "%s/%s", campaign->out, name);
        if (!path)
            return error_set(error, ERROR_MEMORY, "no memory for a name");
        fputs("<figure>", file);
        if (!page_image(file, path, "image/svg+xml", caption, error))
            return false;
        fprintf(file, "<figcaption>%s</figcaption></figure>\n", caption);
    }
    return true;
}

// ---- pictures -------------------------------------------------------------------------------

static bool put_picture(FILE *file, const Campaign *campaign, const json_t *row, const char *path,
                        const char *what, Error *error)
{
    const char *name = doc_text(row, path), *mode = doc_text(row, "run.mode");
    if (!name)
        return true;
    const char *place = text_format(campaign->arena, "%s/%s", campaign->out, name);
    const char *caption = text_format(campaign->arena, "%s: %s", mode, what);
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

static bool put_maps(FILE *file, const Campaign *campaign, const json_t *rows, const char *scene, Error *error)
{
    fputs("<h3>Where the errors are</h3><p>Each pixel's largest error of radiance over its three colours, "
          "all maps of all reports on one logarithmic scale from 10<sup>&minus;8</sup> to 1. Black: no "
          "difference at all.</p>\n",
          file);
    bool ok = true;
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row) {
        if (!html_row_is_of(row, scene) || !html_row_is_available(row))
            continue;
        fputs("<div class=\"row\">\n", file);
        ok = ok &&
             put_picture(file, campaign, row, "files.map_r64", "arithmetic error, against double", error) &&
             put_picture(file, campaign, row, "files.map_rinf",
                         "all of the error, against the converged picture", error);
        fputs("</div>\n", file);
    }
    return ok;
}

static void put_identity(FILE *file, const json_t *row)
{
    static const char *const KEYS[] = {"file",     "scene_hash", "kernel_hash",  "device",
                                       "platform", "driver",     "clrt_version", NULL};
    fputs("<p>", file);
    page_number(file, doc_number(row, "run.width"));
    fputs(" &times; ", file);
    page_number(file, doc_number(row, "run.height"));
    fputs(" pixels, ", file);
    page_number(file, doc_number(row, "run.spp.mean"));
    fprintf(file, " sample%s a pixel where nothing else is said.",
            doc_number(row, "run.spp.mean") == 1 ? "" : "s");
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
    json_array_foreach (doc_at(row, "run.features"), i, feature) {
        fputs(i ? ", " : "", file);
        page_text(file, json_string_value(feature));
    }
    fputs("</p>\n", file);
}

static const json_t *first_row(const json_t *rows, const char *scene)
{
    size_t i;
    json_t *row;
    json_array_foreach (rows, i, row)
        if (html_row_is_of(row, scene) && html_row_is_available(row))
            return row;
    return NULL;
}

bool html_scene_write(FILE *file, const Campaign *campaign, const json_t *report, const char *scene,
                      Error *error)
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
    if (!put_picture(file, campaign, first, "files.picture", "as a display shows it", error))
        return false;
    html_tables_times(file, rows, scene);
    html_tables_rays(file, rows, scene);
    if (!html_plot_write(file, campaign, report, "stages", scene,
                         "What the seconds of a run are spent on. The two panels have scales of their own.",
                         error))
        return false;
    html_tables_arithmetic(file, rows, scene);
    html_tables_sampling(file, rows, scene);
    html_tables_slopes(file, rows, scene);
    if (!html_plot_write(
            file, campaign, report, "convergence", scene,
            "Error against time, from few to many samples; bars are 95 % intervals, mostly smaller than the "
            "dots. The grey line falls as plain Monte Carlo does.",
            error) ||
        !html_plot_write(
            file, campaign, report, "pareto", scene,
            "All ways to render this scene: the number beside a dot is its samples a pixel. What lies above "
            "and to the right of the grey steps is beaten in both time and error.",
            error) ||
        !put_maps(file, campaign, rows, scene, error))
        return false;
    fputs("<h3>Error budget</h3><p>What clrt states of each picture, beside the largest arithmetic error "
          "measured above (<code>e_arith</code>). What is not listed, or has a dash, is not stated.</p>\n",
          file);
    html_tables_group(file, rows, scene, "budget");
    fputs("<h3>Health</h3>\n", file);
    html_tables_group(file, rows, scene, "health");
    return true;
}
