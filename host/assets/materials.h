// Materials: what the files of meshes call by name, as materials of the scene. Reads MTL; knows no triangles.
#ifndef CLRT_ASSETS_MATERIALS_H
#define CLRT_ASSETS_MATERIALS_H

#include "assets/import.h"
#include "assets/obj.h"
#include "scene/scene.h"

// What both functions need of the file and who names it.
typedef struct MaterialContext {
    Scene *scene;
    Arena *arena; // of the scene
    Diagnostics *diagnostics;
    const char *path; // of the mesh's file
    SourcePos at;     // of the first shape that names it
} MaterialContext;

// Adds the materials that the OBJ uses to the scene; indices[i] becomes that of its name i, -1 where no
// library has it, with a warning. Fails with ERROR_MEMORY.
bool materials_add_obj(const MaterialContext *context, const ObjFile *obj, i32 *indices, Error *error);

// The same for the materials of an imported file.
bool materials_add_import(const MaterialContext *context, const ImportFile *file, i32 *indices, Error *error);

#endif
