// GltfJson: what glTF files say and the library that reads them does not tell. Knows JSON and no scene.
#ifndef CLRT_ASSETS_GLTF_JSON_H
#define CLRT_ASSETS_GLTF_JSON_H

#include "base/error.h"
#include "base/types.h"

// Stores the factors of emission (KHR_materials_emissive_strength, 0 or more) of the first count materials of
// the .gltf or .glb at path; 1 where it has none or cannot be read. Fails with ERROR_MEMORY.
bool gltf_emissive_strengths(const char *path, f64 *strengths, u32 count, Error *error);

#endif
