// Textures: the image files that a scene names, as bitmaps. Knows the Scene and nothing of how texels are
// used.
#ifndef CLRT_ASSETS_TEXTURES_H
#define CLRT_ASSETS_TEXTURES_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

// Reads the file of every image texture and of the environment, each once; fills scene->bitmaps (in arena,
// which is the scene's) and the pointers of those that name them. Values that are no radiance (below 0,
// infinite, NaN) are repaired as in bitmap_repair, with a warning. What is wrong with a file is added to
// diagnostics at the `file` of the first that names it, and also returns true: where an error was added, the
// scene may only be released. Materials of files go without images that cannot be read, with a warning.
// Returns false where memory is exhausted. textures_release frees what was read, in each case.
bool textures_load(Scene *scene, Arena *arena, Diagnostics *diagnostics, Error *error);

// Frees the bitmaps and forgets them; a scene without any is fine.
void textures_release(Scene *scene);

#endif
