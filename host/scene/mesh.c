#include "scene/mesh.h"

#include <stdlib.h>
#include <string.h>

void mesh_destroy(Mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->uvs);
    free(mesh->faces);
    free(mesh->face_normals);
    free(mesh->face_uvs);
    free(mesh->parts);
    memset(mesh, 0, sizeof *mesh);
}
