// What shading reads of the scene, and Hit: everything that it asks of the point where a ray meets a surface.
#ifndef CLRT_KERNELS_STAGES_SHADING_H
#define CLRT_KERNELS_STAGES_SHADING_H

#include "accel/batch.h"
#include "base/offset.h"
#include "base/table.h"
#include "stages/random.h"
#include "stages/state.h"
#if HAS_MESH
#include "shapes/mesh.h"
#endif
#if HAS_NORMAL_MAP
#include "shapes/tangents.h"
#endif
#if HAS_TERMINATOR
#include "shapes/terminator.h"
#endif
#include "texture/texture.h"
#if HAS_PBR
#include "material/pbr.h"
#endif
#if HAS_ENVIRONMENT
#include "light/environment.h"
#endif

// Records in numbers, for Row.
#define PRIMITIVE_NUMBERS 16
#define INFO_NUMBERS 4
#define MATERIAL_NUMBERS 36
#define EXTRA_NUMBERS 16
#define RUN_NUMBERS 8

// Numbers of a MaterialRecord.
enum {
    MATERIAL_DIFFUSE = 0, MATERIAL_SHININESS = 3, MATERIAL_SPECULAR = 4, MATERIAL_IOR = 7,
    MATERIAL_AMBIENT = 8, MATERIAL_ETA_IN_REST = 11, MATERIAL_REFLECT = 12, MATERIAL_ETA_OUT_REST = 15,
    MATERIAL_TRANSMIT = 16, MATERIAL_INVERSE_IOR = 19, MATERIAL_EMISSION = 20, MATERIAL_FLAGS = 23,
    MATERIAL_DIFFUSE_TEXTURE = 24, MATERIAL_AMBIENT_TEXTURE, MATERIAL_EMISSION_TEXTURE, MATERIAL_NORMAL_TEXTURE,
    MATERIAL_METALLIC = 28, MATERIAL_ROUGHNESS, MATERIAL_OCCLUSION, MATERIAL_BASE_REFLECTANCE,
    MATERIAL_METALLIC_TEXTURE = 32, MATERIAL_ROUGHNESS_TEXTURE, MATERIAL_OCCLUSION_TEXTURE, MATERIAL_PBR_TRANSMIT
};

// What shading reads of the scene, beside the hierarchy.
typedef struct {
    global const MaterialRecord *materials;
#if HAS_ENVIRONMENT
    Environment environment;
#endif
#if HAS_TEXTURES
    Textures textures;
#endif
#if HAS_TRIANGLE_EXTRA
    global const TriangleExtra *extras;
#endif
#if HAS_MESH_NORMALS || HAS_MESH_UVS
    global const int *mesh_indices;
#endif
#if HAS_MESH_NORMALS
    global const f32 *mesh_normals; // 3 a normal
#endif
#if HAS_MESH_UVS
    global const f32 *mesh_uvs; // 2 a vertex
#endif
#if HAS_CHECKER3D
    global const ObjectFrame *frames; // one a primitive, then one a mesh
#endif
} Shading;

typedef struct {
    v3 dir;       // of the ray
    v3 point;     // in render space
    v3 error;     // bound of the error of each coordinate of point
    v3 ng, ns;    // unit, turned to the ray's origin
#if HAS_TERMINATOR
    v3 horizon;   // unit: light from below the plane with this normal does not count
    vm raised;    // shadow rays start at raised_point, off the surface; else next to point
    v3 raised_point;
#endif
    vm inside;    // the ray met the surface from its inner side
    vi primitive; // a valid index or slot in every lane, as in BatchHits
    Row material;
#if HAS_HIT_RANDOM
    HitRandom random;
#endif
#if HAS_PBR
    PbrLanes pbr; // of the material, by hit_pbr
#endif
#if HAS_UV || HAS_CHECKER3D
    TexturePoint at;
#endif
} Hit;

#endif
