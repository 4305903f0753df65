// The shapes of a scene behind two functions. A scene with one kind of shape has no dispatch.
#ifndef CLRT_KERNELS_SHAPES_SHAPES_H
#define CLRT_KERNELS_SHAPES_SHAPES_H

#include "shapes/surface.h"
#include "shared/primitive.h"
#if HAS_SPHERE || HAS_ELLIPSOID || HAS_GIANT_SPHERE
#include "shapes/sphere.h"
#endif
#if HAS_ELLIPSOID
#include "shapes/ellipsoid.h"
#endif
#if HAS_PLANE
#include "shapes/plane.h"
#endif
#if HAS_BOX
#include "shapes/box.h"
#endif
#if HAS_TETRAHEDRON
#include "shapes/tetrahedron.h"
#endif
#if HAS_DISK
#include "shapes/disk.h"
#endif
#if HAS_CYLINDER
#include "shapes/cylinder.h"
#endif
#if HAS_CONE
#include "shapes/cone.h"
#endif
#if HAS_TORUS
#include "shapes/torus.h"
#endif
#if HAS_TRIANGLE
#include "shapes/triangle.h"
#endif
#if HAS_RECTANGLE
#include "shapes/rectangle.h"
#endif

#define SHAPE_KINDS                                                                                          \
    (HAS_SPHERE + HAS_GIANT_SPHERE + HAS_ELLIPSOID + HAS_PLANE + HAS_BOX + HAS_TETRAHEDRON + HAS_DISK +      \
     HAS_CYLINDER + HAS_CONE + HAS_TORUS + HAS_TRIANGLE + HAS_RECTANGLE)

// The smallest root t > max(0, tmin) of one primitive for each ray, INFINITY where there is none. Rays that
// start on the primitive (self) do not meet it at their origin. Invalid rays (NaN, infinite) hit nothing.
static inline vf intersect_primitive(uint kind, const PrimitiveLanes *p, const RayLanes *ray)
{
#if HAS_SPHERE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_SPHERE)
        return intersect_sphere(p, ray);
#endif
#if HAS_TRIANGLE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TRIANGLE)
        return intersect_triangle(p, ray);
#endif
#if HAS_BOX
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_BOX)
        return intersect_box(p, ray);
#endif
#if HAS_PLANE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_PLANE)
        return intersect_plane(p, ray);
#endif
#if HAS_GIANT_SPHERE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_GIANT_SPHERE)
        return intersect_giant_sphere(p, ray);
#endif
#if HAS_ELLIPSOID
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_ELLIPSOID)
        return intersect_ellipsoid(p, ray);
#endif
#if HAS_TETRAHEDRON
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TETRAHEDRON)
        return intersect_tetrahedron(p, ray);
#endif
#if HAS_DISK
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_DISK)
        return intersect_disk(p, ray);
#endif
#if HAS_CYLINDER
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_CYLINDER)
        return intersect_cylinder(p, ray);
#endif
#if HAS_CONE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_CONE)
        return intersect_cone(p, ray);
#endif
#if HAS_TORUS
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TORUS)
        return intersect_torus(p, ray);
#endif
#if HAS_RECTANGLE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_RECTANGLE)
        return intersect_rectangle(p, ray);
#endif
    return (vf)(INFINITY);
}

static inline void surface_select(vm m, const SurfaceLanes *from, SurfaceLanes *to)
{
    to->p = v3_select(m, from->p, to->p);
    to->error = v3_select(m, from->error, to->error);
    to->ng = v3_select(m, from->ng, to->ng);
#if HAS_UV
    to->u = m ? from->u : to->u;
    to->v = m ? from->v : to->v;
    to->u_whole = m ? from->u_whole : to->u_whole;
    to->v_whole = m ? from->v_whole : to->v_whole;
#endif
#if HAS_TRIANGLE || HAS_MESH
    to->b1 = m ? from->b1 : to->b1;
    to->b2 = m ? from->b2 : to->b2;
#endif
#if HAS_NORMAL_MAP
    to->tangent_u = v3_select(m, from->tangent_u, to->tangent_u);
    to->tangent_v = v3_select(m, from->tangent_v, to->tangent_v);
#endif
}

static inline SurfaceLanes surface_zero(void)
{
    SurfaceLanes s;
    s.p = s.error = s.ng = v3_splat(0.0f);
#if HAS_UV
    s.u = s.v = s.u_whole = s.v_whole = (vf)(0.0f);
#endif
#if HAS_TRIANGLE || HAS_MESH
    s.b1 = s.b2 = (vf)(0.0f);
#endif
#if HAS_NORMAL_MAP
    s.tangent_u = s.tangent_v = v3_splat(0.0f);
#endif
    return s;
}

// surface_X of the kind for all lanes.
static inline void surface_of_kind(uint kind, const PrimitiveLanes *p, const RayLanes *ray, vf t,
                                   SurfaceLanes *s)
{
#if HAS_SPHERE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_SPHERE)
        surface_sphere(p, ray, t, s);
#endif
#if HAS_TRIANGLE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TRIANGLE)
        surface_triangle(p, ray, t, s);
#endif
#if HAS_BOX
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_BOX)
        surface_box(p, ray, t, s);
#endif
#if HAS_PLANE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_PLANE)
        surface_plane(p, ray, t, s);
#endif
#if HAS_GIANT_SPHERE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_GIANT_SPHERE)
        surface_giant_sphere(p, ray, t, s);
#endif
#if HAS_ELLIPSOID
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_ELLIPSOID)
        surface_ellipsoid(p, ray, t, s);
#endif
#if HAS_TETRAHEDRON
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TETRAHEDRON)
        surface_tetrahedron(p, ray, t, s);
#endif
#if HAS_DISK
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_DISK)
        surface_disk(p, ray, t, s);
#endif
#if HAS_CYLINDER
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_CYLINDER)
        surface_cylinder(p, ray, t, s);
#endif
#if HAS_CONE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_CONE)
        surface_cone(p, ray, t, s);
#endif
#if HAS_TORUS
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_TORUS)
        surface_torus(p, ray, t, s);
#endif
#if HAS_RECTANGLE
    if (SHAPE_KINDS == 1 || kind == PRIMITIVE_RECTANGLE)
        surface_rectangle(p, ray, t, s);
#endif
}

// The surface at the t that intersect_primitive gave for the same numbers. Kinds differ by lane: each kind
// that any lane has is computed for all and kept where it belongs. Lanes without a hit give numbers without
// meaning.
static inline void surface_primitive(vi kind, const PrimitiveLanes *p, const RayLanes *ray, vf t,
                                     SurfaceLanes *s)
{
    *s = surface_zero();
#if SHAPE_KINDS == 1
    surface_of_kind(0, p, ray, t, s);
#elif LANES == 1
    surface_of_kind((uint)kind, p, ray, t, s);
#else
    for (uint k = 0; k < PRIMITIVE_KIND_COUNT; k++) {
        const vm mine = kind == (vi)((int)k);
        if (!vm_any(mine))
            continue;
        SurfaceLanes one = surface_zero();
        surface_of_kind(k, p, ray, t, &one);
        surface_select(mine, &one, s);
    }
#endif
}

#endif
