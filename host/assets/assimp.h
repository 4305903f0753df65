// Assimp: the library's functions, loaded when a file needs them, because its start alone takes longer than
// the rest of the program's.
#ifndef CLRT_ASSETS_ASSIMP_H
#define CLRT_ASSETS_ASSIMP_H

#include "base/error.h"

#ifdef CLRT_ASSIMP

#include <assimp/GltfMaterial.h>
#include <assimp/cimport.h>
#include <assimp/commonMetaData.h>
#include <assimp/material.h>
#include <assimp/mesh.h>
#include <assimp/scene.h>

typedef struct Assimp {
    void *library;
    const struct aiScene *(*import_file)(const char *path, unsigned flags);
    void (*release_import)(const struct aiScene *scene);
    const char *(*error_string)(void);
    enum aiReturn (*material_color)(const struct aiMaterial *material, const char *key, unsigned type,
                                    unsigned index, struct aiColor4D *color);
    enum aiReturn (*material_string)(const struct aiMaterial *material, const char *key, unsigned type,
                                     unsigned index, struct aiString *text);
    enum aiReturn (*material_numbers)(const struct aiMaterial *material, const char *key, unsigned type,
                                      unsigned index, ai_real *numbers, unsigned *count);
    enum aiReturn (*material_whole)(const struct aiMaterial *material, const char *key, unsigned type,
                                    unsigned index, int *numbers, unsigned *count);
    enum aiReturn (*texture)(const struct aiMaterial *material, enum aiTextureType type, unsigned index,
                             struct aiString *path, enum aiTextureMapping *mapping, unsigned *uvs,
                             ai_real *blend, enum aiTextureOp *op, enum aiTextureMapMode *modes,
                             unsigned *flags);
} Assimp;

// Fails with ERROR_SCENE where the library that the build found is not there.
bool assimp_open(Assimp *assimp, Error *error);

void assimp_close(Assimp *assimp);

#endif
#endif
