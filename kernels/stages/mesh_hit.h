// The faces of meshes that lanes hit: surface, normals and texture coordinates from their corners.
#ifndef CLRT_KERNELS_STAGES_MESH_HIT_H
#define CLRT_KERNELS_STAGES_MESH_HIT_H

#include "stages/shading.h"

#if HAS_MESH
// The faces that lanes of `on` hit, at their slots.
typedef struct {
    vm on;
    FaceLanes face;
    Row run;
} MeshHit;

OUTLINE MeshHit mesh_hit_make(const Hierarchy *scene, vi primitive)
{
    MeshHit m;
    LanesI face, run;
    m.on = (primitive & HIT_MESH) != (vi)(0);
    m.face = face_gather(scene->blocks, m.on ? primitive & (HIT_MESH - 1) : (vi)(0));
    face.v = m.face.face;
    for (int k = 0; k < LANES; k++)
        run.s[k] = (int)run_of_face(scene->mesh_runs, scene->mesh_run_count, (uint)face.s[k]);
    m.run = row_make(scene->mesh_runs, run.v, RUN_NUMBERS);
    return m;
}

static inline vm mesh_flag(const MeshHit *m, uint flag)
{
    return m->on & ((row_int(&m->run, 4) & (int)flag) != (vi)(0));
}

OUTLINE void mesh_surface(const MeshHit *m, const RayLanes *ray, SurfaceLanes *surface)
{
    SurfaceLanes own = *surface;
    surface_mesh_face(&m->face, ray->org, ray->dir, &own);
    own.ng = v3_select(mesh_flag(m, MESH_MIRRORED), v3_neg(own.ng), own.ng);
    surface_select(m->on, &own, surface);
}

#if HAS_MESH_NORMALS || HAS_MESH_UVS
// Place in mesh_indices of the face's first corner, where the run has such corners (number `field` of its
// record); has: those lanes.
static inline vi mesh_corner(const MeshHit *m, int field, vm has)
{
    const vi corner = row_int(&m->run, field) + 3 * (m->face.face - row_int(&m->run, 0));
    return has ? corner : (vi)(0);
}
#endif

#if HAS_MESH_NORMALS
// The normal at corner k of a face whose corners begin there, in the lanes that have one; others give any.
static inline v3 mesh_corner_normal(const Shading *shading, vi corner, int k, vm has)
{
    const vi index = vi_gather(shading->mesh_indices, corner + k);
    const vi at = has ? 3 * index : (vi)(0);
    return v3_make(vf_gather(shading->mesh_normals, at), vf_gather(shading->mesh_normals, at + 1),
                   vf_gather(shading->mesh_normals, at + 2));
}

// The mean of the normals at the face's vertices, not of unit length, in the lanes that have them.
OUTLINE void mesh_normal(const Shading *shading, const MeshHit *m, const SurfaceLanes *surface, v3 *normal)
{
    vm has = mesh_flag(m, MESH_NORMALS);
    if (!vm_any(has))
        return;
    const vi corner = mesh_corner(m, 5, has);
    const vi first = vi_gather(shading->mesh_indices, corner);
    has = has & (first != (vi)(-1));
    v3 n[3];
    for (int k = 0; k < 3; k++)
        n[k] = mesh_corner_normal(shading, corner, k, has);
    const vf b0 = (1.0f - surface->b1) - surface->b2;
    *normal = v3_select(has, v3_fma(n[2], surface->b2, v3_fma(n[1], surface->b1, v3_scale(n[0], b0))), *normal);
}
#endif

#if HAS_TERMINATOR
// surface: in the space of the hierarchy, where the ray has the direction dir.
OUTLINE Raise mesh_raise(const Shading *shading, const MeshHit *m, const SurfaceLanes *surface, v3 dir)
{
    Raise raise;
    vm has = mesh_flag(m, MESH_TERMINATOR);
    raise.bulges = (vm)(0);
    if (!vm_any(has))
        return raise;
    const vi corner = mesh_corner(m, 5, has);
    has = has & (vi_gather(shading->mesh_indices, corner) != (vi)(-1));
    for (int k = 0; k < 3; k++)
        raise.normal[k] = mesh_corner_normal(shading, corner, k, has);
    const vf side = v3_dot(dir, surface->ng) > (vf)(0.0f) ? (vf)(-1.0f) : (vf)(1.0f);
    const vf b1 = surface->b1, b2 = surface->b2;
    raise_vertex(&raise, 0, m->face.a, (1.0f - b1) - b2, surface, side);
    raise_vertex(&raise, 1, m->face.b, b1, surface, side);
    raise_vertex(&raise, 2, m->face.c, b2, surface, side);
    raise.bulges = raise.bulges & has;
    return raise;
}

// Light counts above the horizon of the interpolated normal `smooth` in the lanes that bulge, and shadow rays
// start where `raise` leads to, unless that is below the face.
static inline void hit_raise(Hit *hit, const Raise *raise, v3 smooth)
{
    hit->horizon = hit->ng;
    hit->raised = (vm)(0);
    hit->raised_point = hit->point;
    if (!vm_any(raise->bulges))
        return;
    const v3 turned = v3_select(v3_dot(smooth, hit->ng) < (vf)(0.0f), v3_neg(smooth), smooth);
    const v3 way = raise_way(raise), point = v3_add(hit->point, way);
    const v3 rounding = v3_fma(v3_abs(way), (vf)(4.0f), v3_abs(point));
    const vf up = v3_dot(way, hit->ng);
    hit->horizon = v3_select(raise->bulges, turned, hit->ng);
    hit->raised = raise->bulges & (up > (vf)(0.0f)) & (up < (vf)(INFINITY));
    hit->raised_point =
        offset_origin(point, v3_fma(rounding, (vf)(ROUNDING), hit->error), hit->ng, hit->ng);
}
#endif

#if HAS_MESH_UVS
// Texture coordinates of the lanes whose faces bring them along.
OUTLINE void mesh_uv(const Shading *shading, const MeshHit *m, SurfaceLanes *surface, Hit *hit)
{
    vm has = mesh_flag(m, MESH_UVS);
    if (!vm_any(has))
        return;
    const vi corner = mesh_corner(m, 6, has);
    const vi first = vi_gather(shading->mesh_indices, corner);
    has = has & (first != (vi)(-1));
    const vf weights[3] = { (1.0f - surface->b1) - surface->b2, surface->b1, surface->b2 };
    vf u = (vf)(0.0f), v = (vf)(0.0f), us[3], vs[3];
    for (int k = 0; k < 3; k++) {
        const vi index = vi_gather(shading->mesh_indices, corner + k);
        const vi at = has ? 2 * index : (vi)(0);
        us[k] = vf_gather(shading->mesh_uvs, at);
        vs[k] = vf_gather(shading->mesh_uvs, at + 1);
        u = fma(us[k], weights[k], u);
        v = fma(vs[k], weights[k], v);
    }
    hit->at.u = has ? u : hit->at.u;
    hit->at.v = has ? v : hit->at.v;
#if HAS_NORMAL_MAP
    surface_uv_tangents(surface, us, vs, has);
#endif
}
#endif
#endif

#endif
