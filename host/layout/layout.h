// Layout: a Scene as the arrays that a device reads, and the features that they make use of. Coordinates are
// those of render space, whose origin is the camera; all of it is computed in double and rounded once.
// Knows nothing of devices.
#ifndef CLRT_LAYOUT_LAYOUT_H
#define CLRT_LAYOUT_LAYOUT_H

#include "base/error.h"
#include "layout/features.h"
#include "scene/scene.h"
#include "shared/bvh.h"
#include "shared/instance.h"
#include "shared/light.h"
#include "shared/material.h"
#include "shared/object_frame.h"
#include "shared/params.h"

typedef struct Layout {
    FeatureSet features;
    Primitive *primitives; // planes, then the top-level leaves, then those of each object
    PrimitiveInfo *infos;  // beside the primitives
    ObjectFrame *frames;   // beside the primitives where HAS_CHECKER3D; else NULL
    u32 primitive_count;
    u32 plane_count;
    BvhNode *nodes;
    u32 node_count;
    u32 root; // of the top-level hierarchy; NO_INDEX: none
    TriangleExtra *extras;
    u32 extra_count;
    MaterialRecord *materials; // at the scene's indices
    u32 material_count;
    TextureRecord *textures; // at the scene's indices
    u32 texture_count;
    LightRecord *lights;
    u32 light_count;
    RenderParams params; // all but crop, samples in hand and what the device decides
    f64 build_seconds;   // of the hierarchies
} Layout;

// Fails with ERROR_MEMORY. The layout is the caller's to destroy and does not refer to the scene.
Layout *layout_create(const Scene *scene, Error *error);
void layout_destroy(Layout *layout);

#endif
