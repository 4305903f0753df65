// Placer: flattens objects and instances to two levels. Top-level shapes, objects of a single shape, and
// objects with meshes that are placed only once, become part of the top-level hierarchy; every other placed
// object becomes one INSTANCE primitive there and keeps its shapes once, in a level of its own. Infinite
// planes, wherever they are placed, form one list.
#ifndef CLRT_LAYOUT_PLACE_H
#define CLRT_LAYOUT_PLACE_H

#include "layout/features.h"
#include "layout/level.h"
#include "scene/scene.h"

// An object, and its shapes in its own space where it has a level of its own.
typedef struct ObjectLayout {
    Level level;
    u64 order_size;   // places in the order of definition, those of placed objects counted for each placement
    u64 placements;   // of the object in the whole world
    u32 bounded;      // shapes of its own that are not planes
    bool meshes;      // among them
    bool deeper;      // holds planes or instances, which are placed one by one
    bool second_level; // placed as an INSTANCE
    bool listed;      // level is complete
    bool inherits;    // some shape of the level takes the material of the instance
} ObjectLayout;

typedef struct Placer {
    const Scene *scene;
    PrimitiveList planes;
    Level top;
    ObjectLayout *objects; // at the scene's indices
    TriangleExtra *extras;
    u32 extra_count, extra_capacity;
    u32 area_lights; // placed; their materials stand behind the scene's, in the order of the lights
    bool uv, solid; // some texture needs texture coordinates, or object space
    FeatureSet features; // of shapes and placements
    bool *material_used; // at the scene's indices
} Placer;

// Places the scene's world; levels are complete then. The index of the object stands in p0 (bits, i32) of
// INSTANCE primitives until the roots are known. Fails with ERROR_MEMORY, and with ERROR_SCENE where a number leaves
// the range of float; the placer is to be destroyed either way.
bool placer_run(Placer *placer, const Scene *scene, Error *error);
void placer_destroy(Placer *placer);

#endif
