// Faces: what shading needs of the triangles of meshes, and the blocks of them that the leaves hold.
#ifndef CLRT_LAYOUT_FACES_H
#define CLRT_LAYOUT_FACES_H

#include "layout/layout.h"
#include "layout/level.h"

bool mesh_has_normals(const PlacedMesh *mesh);
bool mesh_has_uvs(const PlacedMesh *mesh);

// Makes the runs of all levels with the normals and texture coordinates of their corners; numbers the faces,
// and sets what the levels know of it. Primitives must be counted and frames have memory: the frames of the
// meshes follow those of the primitives. Fails with ERROR_MEMORY, also where there are more faces than
// FACE_TRANSMITS leaves numbers.
bool faces_add(Layout *layout, const Scene *scene, Level *const *levels, u32 level_count, Error *error);

// Fills the `count` blocks of a level; order: as Bvh.blocks.
void faces_fill_blocks(const Layout *layout, const Level *level, const u32 *order, u32 count,
                       TriangleBlock *blocks);

#endif
