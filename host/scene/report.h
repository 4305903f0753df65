// Report: messages about places of a scene that is parsed, for whoever finds later what is wrong there.
#ifndef CLRT_SCENE_REPORT_H
#define CLRT_SCENE_REPORT_H

#include "scene/diagnostics.h"
#include "scene/scene.h"

// Adds a message at a place of the scene, with the line of its text; the word there is underlined.
void scene_report(const Scene *scene, Diagnostics *diagnostics, Severity severity, SourcePos at,
                  const char *format, ...) __attribute__((format(printf, 5, 6)));

#endif
