// Surfaces: lists of triangles by simple rules.
#ifndef CLRT_SELFTEST_SURFACES_H
#define CLRT_SELFTEST_SURFACES_H

#include "base/vec.h"

// Triangles, each with three positions of its own. The functions below give a list without triangles where
// memory is exhausted; triangles_destroy frees what there is.
typedef struct TriangleList {
    Vec3 *vertices;
    u32 count, capacity; // of triangles
    bool failed;         // memory was exhausted: some or all are missing
} TriangleList;

void triangles_add(TriangleList *list, Vec3 a, Vec3 b, Vec3 c);
void triangles_destroy(TriangleList *list);

// Closed surfaces about the origin.
TriangleList triangles_icosphere(u32 levels);         // 20 * 4^levels, on the unit sphere
TriangleList triangles_voxels(i32 radius, f64 cell);  // faces of the cells within a sphere, on a grid

// Of any kind within two units of the origin; thin: needles of all widths.
TriangleList triangles_soup(u32 count, bool thin, u64 *random);

#endif
