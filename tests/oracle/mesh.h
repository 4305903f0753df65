/* Meshes: OBJ files, with their MTL files, as lists of triangles in their own space. Knows nothing of where
 * they are placed. */
#ifndef ORACLE_MESH_H
#define ORACLE_MESH_H

#include "scene.h"

typedef enum Smooth { SMOOTH_OFF, SMOOTH_ON, SMOOTH_FILE } Smooth;

/* Triangles of an OBJ file in its order, and for each the index of its material among the scene's, to which
 * those of its MTL files are added; MATERIAL_NONE where the file names none. */
const Mesh *mesh_read(Scene *scene, const char *path, Smooth smooth);

/* A name of the file, and its material in the scene. */
typedef struct MtlEntry {
    const char *name;
    int material;
} MtlEntry;

typedef struct MtlList {
    MtlEntry *entries;
    size_t count;
} MtlList;

/* Adds the materials of an MTL file to the list and to the scene; a missing one is a warning. */
void mtl_read(Scene *scene, const char *path, MtlList *list);

#endif
