// Four scenes that together use every feature, written so that they can be moved, scaled and mirrored.
#ifndef CLRT_TESTS_RENDER_SCENES_H
#define CLRT_TESTS_RENDER_SCENES_H

#include "base/types.h"
#include "base/vec.h"

// What is done to space: x is turned to -x where mirrored, then everything is scaled, then moved.
typedef struct SceneMap {
    f64 scale; // 0 is taken as 1
    bool mirrored;
    Vec3 offset;
} SceneMap;

// The scene that a marked text means under the map (NULL: none); the caller's to free.
//   P(x y z)  a point                     ~n  a length
//   L(x y z)  a point or way within an object   ^n  one over a length
//   D(x y z)  a direction                 A(x y z)  the axis of a rotation
char *scene_under(const char *marked, const SceneMap *map);

// Perspective, four samples a pixel, glass and instances.
extern const char scene_glass[];
// Orthographic, one sample a pixel.
extern const char scene_toys[];
// A lens, pbr materials.
extern const char scene_studio[];
// Paths among many lights.
extern const char scene_hall[];

#endif
