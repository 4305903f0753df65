// Import of materials: what a glTF 2 file that assimp has read says of them. Knows no scene.
#ifndef CLRT_ASSETS_IMPORT_MATERIALS_H
#define CLRT_ASSETS_IMPORT_MATERIALS_H

#include "assets/assimp.h"
#include "assets/import.h"

#ifdef CLRT_ASSIMP

// Fills the materials and images of *file from the scene that the library has made of the file at path. Fails
// with ERROR_MEMORY; import_materials_destroy frees what is there.
bool import_materials(const Assimp *assimp, const struct aiScene *scene, const char *path, ImportFile *file,
                      Error *error);

void import_materials_destroy(ImportFile *file);

#endif
#endif
