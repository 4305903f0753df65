// Feature scenes: texts of small scenes that differ in one feature of the scene language.
#ifndef CLRT_REPORT_FEATURE_SCENES_H
#define CLRT_REPORT_FEATURE_SCENES_H

#include "base/arena.h"
#include "base/types.h"

typedef enum FeatureText {
    FEATURE_BASE,       // without the feature
    FEATURE_USED,       // with it
    FEATURE_UNUSED,     // with it declared where nothing comes of it
    FEATURE_UNUSED_BASE // what FEATURE_UNUSED is compared with, where that is not FEATURE_BASE
} FeatureText;

extern const size_t FEATURE_SCENE_COUNT;

const char *feature_scene_name(size_t feature);

// What is added, for people.
const char *feature_scene_what(size_t feature);

// In the arena; NULL where the feature has no such text, or memory is exhausted.
const char *feature_scene_text(size_t feature, FeatureText text, Arena *arena);

// The name that scenes know the mesh by, and its text: an OBJ of a ball of some hundred triangles.
#define FEATURE_MESH_NAME "ball.obj"
const char *feature_scene_mesh(Arena *arena);

#endif
