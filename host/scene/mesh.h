// Mesh: triangles of a file in its own space, as plain arrays. Who fills it is the module assets; whoever
// holds a Mesh may rely on what stands here.
#ifndef CLRT_SCENE_MESH_H
#define CLRT_SCENE_MESH_H

#include "base/types.h"
#include "base/vec.h"

#define MESH_NO_INDEX 0xffffffffu

// Faces from `first` up to the first one of the next part.
typedef struct MeshPart {
    u32 first;
    i32 material; // index into Scene.materials; -1: the file names none
} MeshPart;

typedef struct Mesh {
    Vec3 *positions;
    u32 position_count;
    f32 (*normals)[3]; // unit; NULL: none
    u32 normal_count;
    f32 (*uvs)[2]; // NULL: none
    u32 uv_count;
    u32 (*faces)[3];        // indices into positions; in the order of the file, without those that have no area
    u32 (*face_normals)[3]; // indices into normals, or all three MESH_NO_INDEX: the face is flat; NULL: all are
    u32 (*face_uvs)[3];     // indices into uvs, in the same way
    u32 face_count;         // 1 .. 2^30
    MeshPart *parts;        // by first; parts[0].first is 0
    u32 part_count;         // at least 1
} Mesh;

// Frees the arrays (malloc) and zeroes *mesh; a zeroed Mesh is fine.
void mesh_destroy(Mesh *mesh);

#endif
