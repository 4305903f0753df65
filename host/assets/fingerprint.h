// Fingerprint: a number that tells whether two scenes were read from the same bytes.
#ifndef CLRT_ASSETS_FINGERPRINT_H
#define CLRT_ASSETS_FINGERPRINT_H

#include "base/error.h"
#include "scene/scene.h"

// XXH64 (base/hash.h) of the text of the scene, of what it includes, in the order of reading, then of the
// files that its shapes, textures and environment name, each mesh and image once, and last of the numbers of
// the materials that files of meshes brought. Of a scene that names no files that is `xxhsum -H64` of its
// text. What a mesh's file names in turn (libraries of materials, buffers) counts by those numbers alone.
// After assets_load. Fails with ERROR_IO where a file is no longer there, or ERROR_MEMORY.
bool scene_fingerprint(const Scene *scene, u64 *fingerprint, Error *error);

#endif
