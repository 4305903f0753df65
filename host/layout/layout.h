// Layout: a Scene as the arrays that a device reads, and the features that they make use of. Coordinates are
// those of render space, whose origin is the camera; all of it is computed in double and rounded once.
// Knows nothing of devices.
#ifndef CLRT_LAYOUT_LAYOUT_H
#define CLRT_LAYOUT_LAYOUT_H

#include "base/error.h"
#include "layout/features.h"
#include "scene/scene.h"
#include "shared/bvh.h"
#include "shared/environment.h"
#include "shared/instance.h"
#include "shared/light.h"
#include "shared/light_table.h"
#include "shared/material.h"
#include "shared/mesh.h"
#include "shared/object_frame.h"
#include "shared/params.h"
#include "shared/texture.h"

// What the kernels ask about paths (kernels/stages/path_scatter.h).
typedef struct PathLayout {
    bool on;            // the path integrator, in a scene that has surfaces
    u32 techniques;     // LIGHTS_BY_X
    u32 light_choices;  // lights that are looked at for each shadow ray
    u32 area_materials; // index of the material of the first area light
    f32 sky_floor;      // strength of the environment (shared/environment.h) that lights do not look for
} PathLayout;

// All arrays are in whole pages (base/memory.h), so that devices can use them in place; those of no members
// are NULL.
typedef struct Layout {
    FeatureSet features;
    Primitive *primitives; // planes, then the top-level leaves, then those of each object
    PrimitiveInfo *infos;  // beside the primitives
    ObjectFrame *frames;   // where textures need object space: beside the primitives, then one a mesh
    u32 primitive_count;
    u32 frame_count;
    u32 plane_count;
    BvhNode *nodes;
    u32 node_count;
    u32 root; // of the top-level hierarchy; NO_INDEX: none
    TriangleBlock *blocks; // the leaves' triangles
    u32 block_count;
    MeshRun *mesh_runs; // by first face
    u32 mesh_run_count;
    u32 *mesh_indices; // of normals and of uvs, three a face
    u32 mesh_index_count;
    f32 (*mesh_normals)[3]; // carried to the space of the hierarchy, one factor a mesh
    u32 mesh_normal_count;
    f32 (*mesh_uvs)[2];
    u32 mesh_uv_count;
    TriangleExtra *extras;
    u32 extra_count;
    MaterialRecord *materials; // at the scene's indices
    u32 material_count;
    TextureRecord *textures; // at the scene's indices
    u32 texture_count;
    u8 *texels; // of the images that can be seen, behind the tables of levels (shared/texture.h)
    u64 texel_bytes;
    LightRecord *lights; // under the path integrator area lights first, the environment last
    u32 light_count;
    LightTableEntry *light_table; // one a light, where paths do not look at all of them
    PathLayout path;
    EnvironmentRecord *environment; // NULL: none that shines
    f32 *environment_texels;        // shared/environment.h
    u64 environment_texel_count;    // in numbers
    u32 *environment_cdf;           // where directions are drawn from it
    u64 environment_cdf_count;
    f32 *environment_edges;
    u32 environment_edge_count;
    i32 *environment_guides;        // for paths
    u32 environment_guide_count;
    f32 *environment_levels;        // where it is prefiltered
    u64 environment_level_count;
    f32 *quantiles; // of the pixel filter, where it needs a table
    u32 quantile_count;
    RenderParams params; // all but crop, samples in hand and what the device decides
    f64 build_seconds;   // of the hierarchies
} Layout;

// An array by the name that kernels have for it.
typedef struct LayoutArray {
    const char *name;
    void *data; // page_alloc
    u64 bytes;
} LayoutArray;

#define LAYOUT_ARRAYS 22
void layout_arrays(const Layout *layout, LayoutArray arrays[LAYOUT_ARRAYS]);

// Shapes that are meshes must have theirs, one of scene->meshes. Fails with ERROR_MEMORY, and with the place
// of a shape that leaves the range of float (ERROR_SCENE). The layout is the caller's to destroy and does not
// refer to the scene.
Layout *layout_create(const Scene *scene, Error *error);
void layout_destroy(Layout *layout);

#endif
