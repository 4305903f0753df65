// A mesh of a file, by the reader that renders use.
#ifndef CLRT_BENCH_MESH_FILE_H
#define CLRT_BENCH_MESH_FILE_H

#include "base/error.h"
#include "scene/mesh.h"

// Positions and faces alone. Fails with ERROR_SCENE, with what is wrong with the file printed to stderr, and
// ERROR_MEMORY. *mesh is the caller's to destroy.
bool mesh_file_read(const char *path, Mesh *mesh, Error *error);

#endif
