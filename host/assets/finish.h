// Finish: what the triangles of any reader go through before others see them: faces without area are left
// out, normals made where a scene asks for smooth ones. Knows of no file and no format. The result is the
// same for any number of threads.
#ifndef CLRT_ASSETS_FINISH_H
#define CLRT_ASSETS_FINISH_H

#include "base/error.h"
#include "scene/mesh.h"

// Leaves out the faces that have no area (a corner twice, or a cross product of two edges that is exactly 0
// in double) and the parts that are empty then; the others keep their order. Frees normals and uvs that no
// face uses. Fails with ERROR_SCENE where no face is left; the text is the reason alone.
bool mesh_finish(Mesh *mesh, Error *error);

// Whether a face of the mesh has no normals.
bool mesh_lacks_normals(const Mesh *mesh);

// Gives each face without normals those of its positions: the mean of the faces around, all of them, weighted
// by area. A face stays flat where they cancel out at a corner. Fails with ERROR_MEMORY or, above 2^32 - 2
// normals, ERROR_SCENE.
bool mesh_make_normals(Mesh *mesh, Error *error);

// Makes *copy a mesh of its own with the same content. Fails with ERROR_MEMORY, *copy is empty then.
bool mesh_copy(const Mesh *mesh, Mesh *copy, Error *error);

#endif
