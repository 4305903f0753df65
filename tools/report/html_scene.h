// Html scene: what the page says of one scene.
#ifndef CLRT_REPORT_HTML_SCENE_H
#define CLRT_REPORT_HTML_SCENE_H

#include <stdio.h>

#include "measure.h"

// All rows of the scene. False with ERROR_IO or ERROR_MEMORY.
bool html_scene_write(FILE *file, const Campaign *campaign, const json_t *report, const char *scene,
                      Error *error);

// The plot of a kind and scene (NULL: of the report), if there is one, with its caption. False with ERROR_IO
// or ERROR_MEMORY.
bool html_plot_write(FILE *file, const Campaign *campaign, const json_t *report, const char *kind,
                     const char *scene, const char *caption, Error *error);

#endif
