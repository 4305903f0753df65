// Plot: a data file and a script for gnuplot, and the picture that gnuplot makes of them where it is
// installed. It knows nothing of what is drawn.
#ifndef CLRT_REPORT_PLOT_H
#define CLRT_REPORT_PLOT_H

#include <jansson.h>
#include <stdio.h>

#include "measure.h"

typedef struct Plot {
    const Campaign *campaign;
    const char *name; // of its files, without suffix
    u32 width, height;
    FILE *data, *script;
} Plot;

// Opens NAME.dat and NAME.gp in the folder `plots` of the report, which is there. The script sets the
// terminal and the style so far; it draws from NAME.dat beside it. False with ERROR_IO.
bool plot_open(Plot *plot, const Campaign *campaign, const char *name, u32 width, u32 height, Error *error);

// A name in a data file: quoted, as one column.
void plot_put_name(FILE *file, const char *name);

// Closes the files and draws NAME.svg. Appends {"name", "scene", "kind", "file"} to `plots`, with a file
// null where gnuplot could not draw. scene NULL: of no scene. False with ERROR_IO, ERROR_INTERRUPTED,
// ERROR_MEMORY.
bool plot_close(Plot *plot, json_t *plots, const char *scene, const char *kind, Error *error);

// Whether there is a gnuplot; its version in the arena, or NULL.
const char *plot_find_gnuplot(const Campaign *campaign, Error *error);

#endif
