// Geometry: what a scene of the bench consists of before it is a Scene: one mesh, many placements of one
// mesh, or spheres; and from where it is seen. The generators fill a zeroed one with about as many triangles
// (or spheres, or triangles of all placements) as asked for. Where memory runs out they set `failed`.
#ifndef CLRT_BENCH_GEOMETRY_H
#define CLRT_BENCH_GEOMETRY_H

#include "grow.h"

typedef struct View {
    Vec3 eye, look_at; // y is up
    f64 fov;           // degrees, vertical
    Vec3 sun;          // towards the light
} View;

typedef struct Sphere {
    Vec3 center;
    f64 radius;
} Sphere;

typedef struct Geometry {
    Grower mesh;
    Sphere *spheres; // in place of the mesh
    u32 sphere_count;
    Affine *placements; // of the mesh; none: it stands where it is
    u32 placement_count;
    View view;
    bool failed;
} Geometry;

// A subdivided sphere with layered smooth displacement.
void generate_blob(Geometry *geometry, u32 triangles);
// A closed room: walls of a few triangles, 20 columns of long ones, 15 dense displaced objects.
void generate_hall(Geometry *geometry, u32 triangles);
// Spheres on spheres, nine on each, halves as large as in Haines' procedural databases (1987).
void generate_sphereflake(Geometry *geometry, u32 spheres);
// Hair: a field of thin leaning triangles that overlap each other's boxes.
void generate_needles(Geometry *geometry, u32 triangles);
// A grid of turned and scaled placements of one displaced sphere of 8000 triangles.
void generate_instances(Geometry *geometry, u32 triangles);
// Nine small dense teapots in a stadium of large triangles, a thousand times as large.
void generate_teapots(Geometry *geometry, u32 triangles);

#endif
