// Where shadow rays of smooth meshes start. A face lies below the surface that its normals tell of, so that
// faces next to the terminator shadow themselves one by one. Origins move out to that surface: to the mean,
// by the weights of the hit, of the hit's projections onto the tangent planes at the three vertices.
// Hanika, "Hacking the Shadow Terminator", Ray Tracing Gems II, 2021, chapter 4.
#ifndef CLRT_KERNELS_SHAPES_TERMINATOR_H
#define CLRT_KERNELS_SHAPES_TERMINATOR_H

#include "shapes/surface.h"

typedef struct {
    vm bulges;    // lanes whose hit is below the tangent plane at one of the vertices at least
    v3 normal[3]; // at the vertices, of any length
    vf lift[3];   // weight times how far the hit is below that plane; 0 where it is not; negative from within
} Raise;

// Vertex k has this place and weight and raise->normal[k], all in the space of the surface; side: 1, or -1
// where the ray comes from within. What the hit's place and the vertices' own rounding account for is no
// distance, so that flat faces stay where they are.
static inline void raise_vertex(Raise *raise, int k, v3 vertex, vf weight, const SurfaceLanes *s, vf side)
{
    const v3 from = v3_sub(s->p, vertex), n = raise->normal[k];
    const v3 spread = v3_add(v3_abs(from), v3_abs(vertex));
    const vf noise = v3_dot(v3_abs(n), v3_fma(spread, (vf)(4.0f * ROUNDING), s->error));
    const vf below = -v3_dot(from, n);
    const vm under = below * side > noise;
    raise->bulges = raise->bulges | under;
    raise->lift[k] = under ? below * vf_max(weight, (vf)(0.0f)) : (vf)(0.0f);
}

// The way from the hit to the mean of its projections, in the space of the normals; v3_dot(place, normal) is
// the same number in every space that both are carried to.
static inline v3 raise_way(const Raise *raise)
{
    v3 way = v3_splat(0.0f);
    for (int k = 0; k < 3; k++) {
        const v3 n = raise->normal[k];
        way = v3_fma(n, raise->lift[k] / v3_dot(n, n), way);
    }
    return way;
}

#endif
