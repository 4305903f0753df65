// Placer: flattens objects and instances to two levels. Top-level shapes, and objects of a single shape,
// become primitives of the top-level hierarchy; every other placed object becomes one INSTANCE primitive
// there and keeps its shapes once, in a list of its own. Infinite planes, wherever they are placed, form one
// list.
#ifndef CLRT_LAYOUT_PLACE_H
#define CLRT_LAYOUT_PLACE_H

#include "layout/features.h"
#include "layout/primitives.h"
#include "scene/scene.h"

// The shapes of an object in its own space.
typedef struct ObjectLayout {
    PrimitiveList list;
    u64 order_size; // primitives in all, those of placed objects counted for each placement
    u32 bounded;    // shapes of its own that are not planes
    bool deeper;    // holds planes or instances, which are placed one by one
    bool listed;    // list is filled, and what follows
    Box bounds;     // of the list
    bool inherits;  // some shape of the list takes the material of the instance
    u32 root;       // node of its hierarchy, once that is built
} ObjectLayout;

typedef struct Placer {
    const Scene *scene;
    PrimitiveList planes, top;
    ObjectLayout *objects; // at the scene's indices
    TriangleExtra *extras;
    u32 extra_count, extra_capacity;
    bool uv, solid; // some texture needs texture coordinates, or object space
    FeatureSet features; // of shapes and placements
    bool *material_used; // at the scene's indices
} Placer;

// Places the scene's world. Index of the object stands in p0 (bits, i32) of INSTANCE primitives until the
// roots are known. Fails with ERROR_MEMORY, and with ERROR_SCENE where a number leaves the range of float;
// the placer is to be destroyed either way.
bool placer_run(Placer *placer, const Scene *scene, Error *error);
void placer_destroy(Placer *placer);

#endif
