// MeshList: the meshes of one hierarchy, carried to its space, with the boxes of their triangles. Knows no
// materials and no device.
#ifndef CLRT_LAYOUT_MESH_H
#define CLRT_LAYOUT_MESH_H

#include "accel/bvh.h"
#include "base/error.h"
#include "scene/scene.h"
#include "shared/object_frame.h"

// Loops over fewer vertices or faces are not worth waking threads.
#define MESH_PARALLEL 4096

typedef struct PlacedMesh {
    const Shape *shape;
    Affine to_space;        // the mesh's own space -> that of the hierarchy
    ObjectFrame frame;      // where some texture needs object space
    i32 material;           // goes before the file's; -1: none
    bool inherits;          // the material that an instance names goes before the file's
    u64 order;              // place of its first face in the order of definition
    u32 first_face;         // in the list; the faces keep the order of the file
    u64 first_vertex;
    const f32 (*vertices)[3]; // its positions in the space of the hierarchy, once they are carried
} PlacedMesh;

typedef struct MeshList {
    PlacedMesh *meshes;
    u32 count, capacity;
    u32 face_count;
    u64 vertex_count;
    f32 (*vertices)[3]; // of all meshes, and one behind them, so that each may be read as four numbers
} MeshList;

// Adds a copy of *mesh, whose first_ members are set here. Fails with ERROR_MEMORY, also where the faces of
// the list are more than a hierarchy holds (2^30).
bool mesh_list_add(MeshList *list, const PlacedMesh *mesh, Error *error);

// Memory for the vertices. Fails with ERROR_MEMORY.
bool mesh_list_reserve_vertices(MeshList *list, Error *error);

// Carries the vertices to the space of the hierarchy, each from double and rounded once, so that faces that
// share a vertex go on sharing it; sets the box of face f at boxes[f] and widens *bounds by all. A box is
// that of the three rounded vertices, widened on each side by at least 8 * 2^-24 of the largest coordinate
// that any of them has along any axis, and rounded outward. The proof that traversal passes by no box that
// holds a hit counts on this margin. Fails with ERROR_SCENE where a face leaves the range of float.
bool mesh_carry(PlacedMesh *mesh, MeshList *list, Box *boxes, Box *bounds, Error *error);

// Frees the vertices alone: nothing needs them once the blocks are there.
void mesh_list_drop_vertices(MeshList *list);
void mesh_list_destroy(MeshList *list);

#endif
