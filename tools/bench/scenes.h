// BenchScene: a Scene of the bench, generated or read, with its camera at the origin, so that render space
// and the world are one and both tracers get the same floats. Knows neither rays nor who traces them.
#ifndef CLRT_BENCH_SCENES_H
#define CLRT_BENCH_SCENES_H

#include "base/arena.h"
#include "base/error.h"
#include "geometry.h"
#include "scene/scene.h"

// What is hit: faces of one mesh, which may be placed many times, or spheres.
typedef struct BenchScene {
    const char *name;
    Arena *arena;
    Scene *scene;
    const Mesh *mesh; // NULL: spheres, which are all of scene->shapes
    u32 primitive_count;
    u32 instance_count; // 0: the mesh as it stands; else all of scene->instances, in the order of definition
    Affine *to_object;  // of each instance: the world to the space of the mesh
    View view;          // with the eye at the origin
    f64 diagonal;       // of the bounding box of all
} BenchScene;

typedef struct SceneKind {
    const char *name, *meaning;
    u32 triangles; // without --triangles
} SceneKind;

enum { SCENE_KINDS = 6 };
extern const SceneKind scene_kinds[SCENE_KINDS];

// The scene called `name`, one of scene_kinds, or the mesh file at that path. triangles 0: as many as the
// kind has. Fails with ERROR_USAGE for a name that is neither, ERROR_MEMORY, and what reading a file fails
// with.
BenchScene *bench_scene_create(const char *name, u32 triangles, Error *error);
void bench_scene_destroy(BenchScene *scene);

// The triangle (corners in the world's space) or, where there is no mesh, false.
bool bench_scene_triangle(const BenchScene *scene, u32 primitive, u32 instance, Vec3 corners[3]);
// Unit normal of what was hit at the point p, either way round.
Vec3 bench_scene_normal(const BenchScene *scene, u32 primitive, u32 instance, Vec3 p);

#endif
