// What the tests of meshes share: meshes of simple rules, their layouts, and rays through them on the device.
#ifndef CLRT_TESTS_KERNEL_MESH_SUPPORT_H
#define CLRT_TESTS_KERNEL_MESH_SUPPORT_H

#include "harness.h"

#include "layout/layout.h"
#include "selftest/random.h"
#include "selftest/surfaces.h"

// Closed surfaces about the origin beside those of selftest/surfaces.h.
TriangleList triangles_bumpy(u32 levels);              // triangles_icosphere with bumps, radius 0.5 to 1.5
TriangleList triangles_cube(void);                     // 12, [-1, 1]^3
TriangleList triangles_spindle(u32 slices, u32 rings); // an ellipsoid of long thin triangles, radius 1

// The world is this mesh under the transform; render space is the world's. With `instanced` it stands in an
// object, itself as it is, placed by an instance with the transform.
Layout *mesh_layout(const TriangleList *triangles, const Affine *transform, bool instanced);

// The triangles as the device sees them, by number of face.
typedef struct FaceTable {
    f32 (*vertices)[3][3];
    u32 count;
} FaceTable;

FaceTable face_table_create(const Layout *layout);
void face_table_destroy(FaceTable *table);

// Rays as columns of `count` numbers, a multiple of 32; and what became of them.
enum { COLUMN_ORG, COLUMN_DIR = 3, COLUMN_END = 6, RAY_COLUMNS };
typedef struct Rays {
    u32 count;
    f32 *numbers;   // RAY_COLUMNS * count
    f32 *t;         // of the first hit; -1: none
    u32 *face;      // of the first hit; NO_INDEX: none
    u32 *crossings; // hits along the ray, at most as many as asked for
} Rays;

Rays rays_create(u32 count); // rounded up
void rays_destroy(Rays *rays);
// To infinity.
void rays_set(Rays *rays, u32 i, const f32 org[3], const f32 dir[3]);
// From around a soup of that size at faces, edges, and along the axes, of any length.
void rays_aim_at_soup(Rays *rays, const FaceTable *faces, f64 size, Vec3 center, u64 *random);

// One shape of kernels: lanes, rays a batch, work-items a group, as CLRT_SHAPE names them.
typedef struct Variant {
    int lanes, batch, group;
} Variant;

enum { VARIANTS = 5 };
extern const Variant mesh_variants[VARIANTS];

KernelProgram *walk_program(KernelDevice *device, Variant variant, bool instanced);
// Follows each ray from hit to hit until it has met `steps` or none is left; fills t, face and crossings.
// Returns the seconds that it took.
double walk(KernelProgram *program, Variant variant, const Layout *layout, u32 steps, Rays *rays);

// Rays of a long run, by CLRT_LEAK_RAYS; else `standard`.
u32 leak_rays(u32 standard);

#endif
