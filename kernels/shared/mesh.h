// Triangles of meshes: blocks of eight that leaves of the hierarchy hold, and what shading needs of a face.
// Faces are numbered through the whole layout, those of a mesh in the order of its file; the runs, by their
// first face, tell which face is whose.
#ifndef CLRT_SHARED_MESH_H
#define CLRT_SHARED_MESH_H

#include "shared/types.h"

#define BLOCK_WIDTH 8
// In TriangleBlock.face: the face may let light through.
#define FACE_TRANSMITS 0x80000000u

// Eight triangles side by side for one vector test. A lane without a triangle has NaN vertices and face
// NO_INDEX; such lanes come last.
typedef struct TriangleBlock {
    f32 vertex[3][3][BLOCK_WIDTH]; // [vertex a, b, c][axis], in the space of the hierarchy
    u32 face[BLOCK_WIDTH];         // number of the face | FACE_TRANSMITS
} TriangleBlock;
LAYOUT_SIZE(TriangleBlock, 320);
LAYOUT_OFFSET(TriangleBlock, face, 288);

#define MESH_MIRRORED 1u // baked under a mirroring transform: the geometric normal is -(b-a) x (c-a)
#define MESH_NORMALS 2u  // corner_normals counts
#define MESH_UVS 4u      // corner_uvs counts
#define MESH_TERMINATOR 8u // with MESH_NORMALS: shadow rays start above faces that bulge

// Faces from `first` up to that of the next run. Of face f of the run, corner k (0..2) has the normal of index
// mesh_indices[corner_normals + 3 (f - first) + k], and in the same way its uv; NO_INDEX there: none.
typedef struct MeshRun {
    u32 first;
    u32 material;  // as PrimitiveInfo.material
    u32 order_low; // place of face `first` in the order of definition; the others follow
    u32 order_high;
    u32 flags; // MESH_X
    u32 corner_normals;
    u32 corner_uvs;
    u32 frame; // index of its ObjectFrame, where HAS_CHECKER3D
} MeshRun;
LAYOUT_SIZE(MeshRun, 32);

#endif
