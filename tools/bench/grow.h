// Grower: a triangle mesh that grows vertex by vertex, and the pieces that scenes of the bench are made of.
// Knows nothing of scenes. Running out of memory is remembered, not reported, until grower_finish.
#ifndef CLRT_BENCH_GROW_H
#define CLRT_BENCH_GROW_H

#include "base/types.h"
#include "base/vec.h"
#include "scene/mesh.h"

typedef struct Grower {
    Vec3 *positions;
    u32 (*faces)[3];
    size_t position_count, position_room, face_count, face_room;
    bool failed;
} Grower;

// A point of a surface for u, v in [0, 1]; context is what the caller gave.
typedef Vec3 (*SurfacePoint)(f64 u, f64 v, const void *context);

// Adds a vertex and returns its index; its position counts from then on.
u32 grower_vertex(Grower *grower, Vec3 position);
void grower_face(Grower *grower, u32 a, u32 b, u32 c);
// Corners in order around it.
void grower_quad(Grower *grower, Vec3 a, Vec3 b, Vec3 c, Vec3 d);
// columns x rows quads over the unit square. wrap: u = 1 is u = 0 again, and shares its vertices.
void grower_surface(Grower *grower, u32 columns, u32 rows, bool wrap, SurfacePoint at, const void *context);
// A geodesic sphere of about `triangles` triangles, closed, moved in and out along the radius by layered
// smooth noise of `depth` times the radius at most.
void grower_blob(Grower *grower, Vec3 center, f64 radius, f64 depth, u32 triangles, u32 seed);

// Moves all vertices by -origin, rounds them to float, drops faces that have no area then, and hands the
// arrays over to *mesh, one part without a material. False where memory ran out or no face is left; the
// grower is empty either way.
bool grower_finish(Grower *grower, Vec3 origin, Mesh *mesh);

// The nearest floats.
Vec3 rounded_to_float(Vec3 p);
// Smooth noise in [-1, 1] that differs for each seed.
f64 noise_at(Vec3 p, u32 seed);
// A number in [0, 1) for each pair.
f64 random_at(u64 index, u32 seed);

#endif
