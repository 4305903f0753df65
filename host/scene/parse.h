// scene_parse: text to Scene. All errors of the text are collected with their places.
// A byte 0 is an error that ends its file; bytes that are not UTF-8, in comments too, are an error once a
// file, and the rest is read.
#ifndef CLRT_SCENE_PARSE_H
#define CLRT_SCENE_PARSE_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

// Reads the scene file at path ("-" is stdin, whose includes are relative to the working folder).
// The scene and its texts live in arena. Returns NULL and sets *error with ERROR_IO where the file
// itself cannot be read or ERROR_MEMORY; otherwise the scene, of which nothing may be used when
// diagnostics_error_count(diagnostics) > 0.
Scene *scene_parse_file(const char *path, Arena *arena, Diagnostics *diagnostics, Error *error);

// The same for length bytes of text in memory, called `name` in diagnostics. Text need not end in 0.
Scene *scene_parse_text(const char *name, const char *text, size_t length, Arena *arena,
                        Diagnostics *diagnostics, Error *error);

#endif
