// SurfaceLanes: what a shape tells of the point where a ray meets it.
#ifndef CLRT_KERNELS_SHAPES_SURFACE_H
#define CLRT_KERNELS_SHAPES_SURFACE_H

#include "base/offset.h"
#include "base/ray.h"
#if HAS_UV
#include "base/trig.h"
#endif

// All in the space of the primitive.
typedef struct {
    v3 p;     // the hit point, moved onto the surface along ng
    v3 error; // of p's place off the surface: sum |ng_i| error_i is a bound of the distance
    v3 ng;    // unit geometric normal, outward as the scene language defines
#if HAS_UV
    vf u, v;             // texture coordinates; of a triangle b1, b2
    vf u_whole, v_whole; // whole numbers to be added to u and v: 0 but for planes
#endif
#if HAS_TRIANGLE || HAS_MESH
    vf b1, b2; // barycentric weights of the second and third vertex of a triangle
#endif
#if HAS_NORMAL_MAP
    v3 tangent_u, tangent_v; // directions of dP/du and dP/dv, of any length
#endif
} SurfaceLanes;

// Ends surface_X: s->p is off the surface by `distance` along s->ng, which is known up to `bound`.
static inline void surface_settle(SurfaceLanes *s, vf distance, vf bound)
{
    s->p = v3_fma(s->ng, -distance, s->p);
    s->error = v3_fma(v3_abs(s->ng), bound, v3_scale(v3_abs(s->p), (vf)(ROUNDING)));
}

#if HAS_UV
static inline void surface_uv(SurfaceLanes *s, vf u, vf v)
{
    s->u = u;
    s->v = v;
    s->u_whole = (vf)(0.0f);
    s->v_whole = (vf)(0.0f);
}

// For coordinates that are in [0, 1] but for rounding: the last cell of a texture ends before 1.
static inline vf uv_clamp(vf x) { return vf_clamp(x, 0.0f, 1.0f - ROUNDING); }

#define TURNS_A_RADIAN REAL(0.15915494f, 0.15915494309189535)

// The angle of (x, y) in turns, in [0, 1).
static inline vf uv_turn(vf y, vf x)
{
    const vf turn = vf_atan2(y, x) * TURNS_A_RADIAN;
    const vf positive = turn < (vf)(0.0f) ? turn + 1.0f : turn;
    return positive >= (vf)(1.0f) ? (vf)(0.0f) : positive;
}
#endif

// Carries a surface out of the space of an instanced object, q = A (p - c) given as `map`, to the space of
// the ray (org, dir): the hit point is that of the ray itself, moved onto the surface.
static inline void surface_place(const PrimitiveLanes *map, v3 org, v3 dir, vf t, SurfaceLanes *s)
{
    const v3 n = s->ng;
    const v3 gradient = v3_fma(map->row2, n.z, v3_fma(map->row1, n.y, v3_scale(map->row0, n.x)));
    const vf length = sqrt(v3_dot(gradient, gradient));
    const vf inverse = (vf)(1.0f) / length;
    const v3 placed_error = s->error, placed = s->p;
    s->ng = v3_scale(gradient, inverse);
    s->p = v3_fma(dir, t, org);
    // The distance of the ray's point from the surface, measured in the object's space.
    const v3 f = v3_sub(s->p, map->c);
    const v3 q = v3_make(v3_dot(map->row0, f), v3_dot(map->row1, f), v3_dot(map->row2, f));
    const vf distance = v3_dot(n, v3_sub(q, placed));
    const v3 a = v3_abs(f), m = v3_abs(n);
    const vf spread = v3_dot(v3_make(v3_dot(v3_abs(map->row0), a), v3_dot(v3_abs(map->row1), a),
                                     v3_dot(v3_abs(map->row2), a)), m);
    const vf bound = v3_dot(m, placed_error) + 6.0f * ROUNDING * spread;
    surface_settle(s, distance * inverse, bound * inverse);
}

#endif
