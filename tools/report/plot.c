#include "plot.h"

#include <errno.h>
#include <string.h>

#include "child.h"
#include "doc.h"
#include "folder.h"

// Colours that people with any colour vision can tell apart (Okabe and Ito), dark enough for white.
static const char STYLE[] = "set encoding utf8\n"
                            "set linetype 1 lc rgb '#0072b2' lw 2 pt 7 ps 0.7\n"
                            "set linetype 2 lc rgb '#d55e00' lw 2 pt 5 ps 0.7\n"
                            "set linetype 3 lc rgb '#009e73' lw 2 pt 9 ps 0.9\n"
                            "set linetype 4 lc rgb '#cc79a7' lw 2 pt 13 ps 0.9\n"
                            "set linetype 5 lc rgb '#e69f00' lw 2 pt 11 ps 0.9\n"
                            "set linetype 6 lc rgb '#56b4e9' lw 2 pt 4 ps 0.9\n"
                            "set linetype 7 lc rgb '#7a6a00' lw 2 pt 6 ps 0.9\n"
                            "set linetype 8 lc rgb '#444444' lw 2 pt 8 ps 0.9\n"
                            "set linetype cycle 8\n"
                            "set border lc rgb '#444444' lw 1\n"
                            "set grid lc rgb '#dddddd' lw 1 lt 1\n"
                            "set tics nomirror\n"
                            "set key opaque\n";

static FILE *open_file(const Plot *plot, const char *suffix, Error *error)
{
    const char *path =
        text_format(plot->campaign->arena, "%s/plots/%s.%s", plot->campaign->out, plot->name, suffix);
    FILE *file = path ? fopen(path, "wb") : NULL;
    if (!path)
        error_set(error, ERROR_MEMORY, "no memory for a name");
    else if (!file)
        error_set(error, ERROR_IO, "%s: %s", path, strerror(errno));
    return file;
}

bool plot_open(Plot *plot, const Campaign *campaign, const char *name, u32 width, u32 height, Error *error)
{
    *plot = (Plot){.campaign = campaign, .name = name, .width = width, .height = height};
    plot->data = open_file(plot, "dat", error);
    plot->script = plot->data ? open_file(plot, "gp", error) : NULL;
    if (!plot->script) {
        if (plot->data)
            fclose(plot->data);
        return false;
    }
    fprintf(plot->script,
            "# gnuplot %s.gp draws %s.svg from %s.dat, all in one folder.\n"
            "set terminal svg size %u,%u font 'Helvetica,13' background rgb 'white' noenhanced\n"
            "set output '%s.svg'\n%sdata = '%s.dat'\n",
            name, name, name, width, height, name, STYLE, name);
    return true;
}

void plot_put_name(FILE *file, const char *name)
{
    fputc('"', file);
    for (; *name; name++)
        fputc(*name == '"' || (unsigned char)*name < ' ' ? '\'' : *name, file);
    fputc('"', file);
}

// False where a child cannot be run for another reason than that there is no such program.
static bool run_gnuplot(const Campaign *campaign, const char *const *argv, const char *folder, ChildEnd *end,
                        bool *there, Error *error)
{
    const char *talk = text_format(campaign->arena, "%s/gnuplot_talk", campaign->runner.folder);
    if (!talk)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    const Child child = {.argv = argv, .folder = folder, .talk_path = talk};
    *there = child_run(&child, end, error);
    return *there || error->code == ERROR_IO;
}

const char *plot_find_gnuplot(const Campaign *campaign, Error *error)
{
    const char *const argv[] = {"gnuplot", "-e", "print GPVAL_VERSION", NULL};
    ChildEnd end;
    bool there;
    if (!run_gnuplot(campaign, argv, NULL, &end, &there, error) || !there || end.status != 0)
        return NULL;
    return text_format(campaign->arena, "%s", end.talk); // print goes to standard error
}

bool plot_close(Plot *plot, json_t *plots, const char *scene, const char *kind, Error *error)
{
    const Campaign *campaign = plot->campaign;
    const bool whole = !ferror(plot->data) && !ferror(plot->script);
    if ((fclose(plot->data) != 0) + (fclose(plot->script) != 0) > 0 || !whole)
        return error_set(error, ERROR_IO, "%s: the plot's files cannot be written", plot->name);
    const char *folder = text_format(campaign->arena, "%s/plots", campaign->out);
    const char *script = text_format(campaign->arena, "%s.gp", plot->name);
    const char *file = text_format(campaign->arena, "plots/%s.svg", plot->name);
    if (!folder || !script || !file)
        return error_set(error, ERROR_MEMORY, "no memory for a name");
    const char *const argv[] = {"gnuplot", script, NULL};
    ChildEnd end = {.status = 0};
    bool there;
    if (!run_gnuplot(campaign, argv, folder, &end, &there, error))
        return false;
    if (there && end.status != 0)
        campaign_say(campaign, "gnuplot cannot draw %s: %s", plot->name, end.talk);
    json_array_append_new(plots, json_pack("{s:s, s:o, s:s, s:o}", "name", plot->name, "scene",
                                           doc_string(scene), "kind", kind, "file",
                                           doc_string(there && end.status == 0 ? file : NULL)));
    return true;
}
