// Mesh files that tests make by rules, in the folder that they run in.
#ifndef CLRT_TESTS_RENDER_MESHES_H
#define CLRT_TESTS_RENDER_MESHES_H

#include "base/types.h"

// Both return the path, from the root, of the OBJ file `name`, which is written anew; the caller's to give to
// mesh_remove. Errors fail the running test.

// A closed ball of radius 0.75 to 1.25 with bumps and dents: 2 n (n / 2 - 1) triangles, uvs, no normals.
char *mesh_write_bumpy(const char *name, u32 n);

// Triangles within two units of the origin: apart from each other, needles, sheets and fans that share edges,
// and some twice; half of the coordinates are halves. Faces in turn have no material, or "glassy" (lets light
// through) or "solid" of the file NAME.mtl beside it; some have normals.
char *mesh_write_soup(const char *name, u32 triangles, u64 seed);

// Removes the files and frees the path.
void mesh_remove(char *path);

#endif
