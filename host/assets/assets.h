// Assets: what a scene names and does not hold itself: the meshes of its files, with their materials, and the
// images of its textures. Knows the Scene and nothing of how it is drawn.
#ifndef CLRT_ASSETS_ASSETS_H
#define CLRT_ASSETS_ASSETS_H

#include "base/arena.h"
#include "base/error.h"
#include "scene/diagnostics.h"
#include "scene/scene.h"

// Reads the file of every mesh of a scene without errors, each once; fills scene->meshes, the pointers of the
// shapes, and adds the files' materials to scene->materials (in arena, which is the scene's). Shapes share a
// mesh unless one is `smooth on`, the other is not, and the file lacks normals. Then reads the images, as in
// textures.h. What is wrong with a file is added to diagnostics, located in it or at the `file` of the first
// that names it, and also returns true: where an error was added, the scene may only be released. Returns
// false where memory is exhausted. assets_release frees what was read, in each case.
bool assets_load(Scene *scene, Arena *arena, Diagnostics *diagnostics, Error *error);

// Frees the meshes and bitmaps and forgets them; materials stay. Takes NULL, and a scene without any.
void assets_release(Scene *scene);

#endif
