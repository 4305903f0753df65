// hit_make: the point where a ray meets a surface, as shading wants it.
#ifndef CLRT_KERNELS_STAGES_HIT_H
#define CLRT_KERNELS_STAGES_HIT_H

#include "stages/mesh_hit.h"

static inline PrimitiveLanes primitive_gather(const Row *row)
{
    PrimitiveLanes p;
#if HAS_PATH
    const Gather4 row0 = row_real4(row, 0), row1 = row_real4(row, 4), row2 = row_real4(row, 8),
                  rest = row_real4(row, 12);
    p.row0 = v3_make(row0.x, row0.y, row0.z);
    p.row1 = v3_make(row1.x, row1.y, row1.z);
    p.row2 = v3_make(row2.x, row2.y, row2.z);
    p.c = v3_make(row0.w, row1.w, row2.w);
    p.p0 = rest.x;
    p.p1 = rest.y;
    p.p2 = rest.w;
#else
    p.row0 = row_real3(row, 0);
    p.row1 = row_real3(row, 4);
    p.row2 = row_real3(row, 8);
    p.c = v3_make(row_real(row, 3), row_real(row, 7), row_real(row, 11));
    p.p0 = row_real(row, 12);
    p.p1 = row_real(row, 13);
    p.p2 = row_real(row, 15);
#endif
    return p;
}

#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS
// Carries a normal out of a space q = A (p - c): the gradient of a function of q.
static inline v3 carry_normal(const PrimitiveLanes *map, v3 n)
{
    return v3_fma(map->row2, n.z, v3_fma(map->row1, n.y, v3_scale(map->row0, n.x)));
}

#endif

#if HAS_TRIANGLE_EXTRA
// Normals and texture coordinates that vertices bring along, in the lanes that have them.
OUTLINE void hit_interpolate(const Shading *shading, vi extra, vm has, SurfaceLanes *surface, v3 *normal,
                             Hit *hit)
{
    const Row row = row_make(shading->extras, has ? extra : (vi)(0), EXTRA_NUMBERS);
    const vf b1 = surface->b1, b2 = surface->b2, b0 = (1.0f - b1) - b2;
    const v3 n01 = v3_fma(row_real3(&row, 3), b1, v3_scale(row_real3(&row, 0), b0));
    const v3 n = v3_fma(row_real3(&row, 6), b2, n01);
    *normal = v3_select(has & (row_int(&row, 15) != (vi)(0)), n, *normal);
#if HAS_UV
    const vf us[3] = { row_real(&row, 9), row_real(&row, 11), row_real(&row, 13) };
    const vf vs[3] = { row_real(&row, 10), row_real(&row, 12), row_real(&row, 14) };
    const vf u = fma(us[2], b2, fma(us[1], b1, us[0] * b0));
    const vf v = fma(vs[2], b2, fma(vs[1], b1, vs[0] * b0));
    hit->at.u = has ? u : hit->at.u;
    hit->at.v = has ? v : hit->at.v;
#if HAS_NORMAL_MAP
    surface_uv_tangents(surface, us, vs, has);
#endif
#endif
}
#endif
#if HAS_INSTANCES
// The instances of the lanes; those without one stand in for the first of the list.
typedef struct {
    vm placed;
    PrimitiveLanes map;
    vi material; // that the instance names, or NO_INDEX
} Placement;

static inline Placement placement_make(const Hierarchy *scene, vi instance)
{
    Placement p;
    p.placed = instance >= (vi)(0);
    const vi index = p.placed ? instance : (vi)(0);
    const Row map = row_make(scene->primitives, index, PRIMITIVE_NUMBERS);
    const Row info = row_make(scene->infos, index, INFO_NUMBERS);
    p.map = primitive_gather(&map);
    p.material = row_int(&info, 0);
    return p;
}

// The ray in the space of the object, in the lanes that have one.
static inline void placement_enter(const Placement *p, RayLanes *ray)
{
    const v3 from = v3_sub(ray->org, p->map.c), dir = ray->dir;
    const v3 org = v3_make(v3_dot(p->map.row0, from), v3_dot(p->map.row1, from), v3_dot(p->map.row2, from));
    const v3 turned = v3_make(v3_dot(p->map.row0, dir), v3_dot(p->map.row1, dir), v3_dot(p->map.row2, dir));
    ray->org = v3_select(p->placed, org, ray->org);
    ray->dir = v3_select(p->placed, turned, ray->dir);
}

// Carries the surface back out.
static inline void placement_leave(const Placement *p, v3 org, v3 dir, vf t, SurfaceLanes *surface)
{
    SurfaceLanes outside = *surface;
    surface_place(&p->map, org, dir, t, &outside);
    surface->p = v3_select(p->placed, outside.p, surface->p);
    surface->error = v3_select(p->placed, outside.error, surface->error);
    surface->ng = v3_select(p->placed, outside.ng, surface->ng);
#if HAS_NORMAL_MAP
    surface_tangents(&p->map, surface->tangent_u, surface->tangent_v, &outside);
    surface->tangent_u = v3_select(p->placed, outside.tangent_u, surface->tangent_u);
    surface->tangent_v = v3_select(p->placed, outside.tangent_v, surface->tangent_v);
#endif
}
#endif

// What the lanes hit: a primitive or a face.
typedef struct {
    vm mesh;      // lanes that hit a face
    vi primitive; // a valid index in every lane
#if SHAPE_KINDS > 0
    Row record, info;
    PrimitiveLanes shape;
#endif
    vi material; // as PrimitiveInfo.material
#if HAS_CHECKER3D
    vi frame;
#endif
#if HAS_MESH
    MeshHit face;
#endif
} Target;

OUTLINE Target target_make(const Hierarchy *scene, vi primitive)
{
    Target t;
    const vi valid = primitive < (vi)(0) ? (vi)(0) : primitive;
    t.mesh = (vm)(0);
    t.primitive = valid;
#if HAS_MESH
    t.face = mesh_hit_make(scene, valid);
    t.mesh = t.face.on;
    t.primitive = t.mesh ? (vi)(0) : valid;
#endif
    t.material = (vi)(0);
#if SHAPE_KINDS > 0
    t.record = row_make(scene->primitives, t.primitive, PRIMITIVE_NUMBERS);
    t.info = row_make(scene->infos, t.primitive, INFO_NUMBERS);
    t.shape = primitive_gather(&t.record);
    t.material = row_int(&t.info, 0);
#endif
#if HAS_CHECKER3D
    t.frame = t.primitive;
#endif
#if HAS_MESH
    t.material = t.mesh ? row_int(&t.face.run, 1) : t.material;
#if HAS_CHECKER3D
    t.frame = t.mesh ? row_int(&t.face.run, 7) : t.frame;
#endif
#endif
    return t;
}

// surface: in the space of the shape.
static inline void target_surface(const Target *target, const RayLanes *ray, vf t, SurfaceLanes *surface)
{
#if SHAPE_KINDS > 0
    surface_primitive(row_int(&target->record, 14) & (int)PRIMITIVE_KIND_MASK, &target->shape, ray, t, surface);
#else
    *surface = surface_zero();
#endif
#if HAS_MESH
    if (vm_any(target->mesh))
        mesh_surface(&target->face, ray, surface);
#endif
}

#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS
// The shading normal in the space of the shape, of any length, and the texture coordinates of the vertices.
static inline v3 target_normal(const Target *target, const Shading *shading, SurfaceLanes *surface, Hit *hit)
{
    v3 normal = surface->ng;
#if HAS_TRIANGLE_EXTRA
    const vi extra = row_int(&target->info, 1);
    const vm has = (extra >= (vi)(0)) & !target->mesh;
    if (vm_any(has))
        hit_interpolate(shading, extra, has, surface, &normal, hit);
#endif
#if HAS_MESH_NORMALS
    mesh_normal(shading, &target->face, surface, &normal);
#endif
    return normal;
}
#endif

#if HAS_NORMAL_MAP
// The unit normal n as the normal maps of the lanes tilt it.
OUTLINE v3 mapped_normal(const Hit *hit, const Shading *shading, const SurfaceLanes *surface, v3 n)
{
    const vi texture = row_int(&hit->material, MATERIAL_NORMAL_TEXTURE);
    const vm mapped = texture >= (vi)(0);
    vi channel;
    if (!vm_any(mapped))
        return n;
    const v3 color = texture_color(&shading->textures, &hit->at, texture, mapped, true, &channel);
    return v3_select(mapped, tilted_normal(n, surface->tangent_u, surface->tangent_v, color), n);
}
#endif

// The surface at distance t along the rays of the lanes. Lanes without a hit give numbers without meaning.
OUTLINE Hit hit_make(const Hierarchy *scene, const Shading *shading, v3 org, v3 dir, vf t, vi primitive,
                     vi instance)
{
    Hit hit;
    SurfaceLanes surface;
    RayLanes ray;
    ray.org = org;
    ray.dir = dir;
    ray.tmin = (vf)(0.0f);
    ray.self = (vm)(0);
    ray.inward = (vm)(0);
    hit.dir = dir;
    hit.primitive = primitive < (vi)(0) ? (vi)(0) : primitive;
    const Target target = target_make(scene, primitive);
    const vi own = target.material & (int)~MATERIAL_INHERITED;
    vi material = own;
#if HAS_INSTANCES
    const Placement placement = placement_make(scene, instance);
    placement_enter(&placement, &ray);
    const vm named = placement.placed & (target.material < (vi)(0)) & (placement.material >= (vi)(0));
    material = named ? placement.material : own;
#endif
    target_surface(&target, &ray, t, &surface);
#if HAS_UV
    hit.at.u = surface.u;
    hit.at.v = surface.v;
    hit.at.u_whole = surface.u_whole;
    hit.at.v_whole = surface.v_whole;
#endif
#if HAS_MESH_UVS && HAS_UV
    mesh_uv(shading, &target.face, &surface, &hit);
#endif
#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS
    v3 normal = target_normal(&target, shading, &surface, &hit);
#endif
#if HAS_CHECKER3D
    hit.at.object = object_point(shading->frames, target.frame, surface.p, surface.ng);
#endif
#if HAS_TERMINATOR
    Raise raise = mesh_raise(shading, &target.face, &surface, ray.dir);
#endif
#if HAS_INSTANCES
    placement_leave(&placement, org, dir, t, &surface);
#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS
    normal = v3_select(placement.placed, carry_normal(&placement.map, normal), normal);
#endif
#if HAS_TERMINATOR
    for (int k = 0; k < 3 && vm_any(raise.bulges); k++) {
        const v3 n = raise.normal[k];
        raise.normal[k] = v3_select(placement.placed, carry_normal(&placement.map, n), n);
    }
#endif
#endif
    hit.point = surface.p;
    hit.error = surface.error;
    hit.inside = v3_dot(dir, surface.ng) > (vf)(0.0f);
    hit.ng = v3_select(hit.inside, v3_neg(surface.ng), surface.ng);
    hit.material = row_make(shading->materials, material, MATERIAL_NUMBERS);
#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS || HAS_NORMAL_MAP
    v3 ns = surface.ng;
#if HAS_TRIANGLE_EXTRA || HAS_MESH_NORMALS
    ns = v3_normalize(normal);
#endif
#if HAS_TERMINATOR
    hit_raise(&hit, &raise, ns);
#endif
#if HAS_NORMAL_MAP
    ns = mapped_normal(&hit, shading, &surface, ns);
#endif
    hit.ns = v3_select(v3_dot(ns, hit.ng) < (vf)(0.0f), v3_neg(ns), ns);
#else
    hit.ns = hit.ng;
#endif
    return hit;
}

// A color of the material, number k of its record, times the texture of index `texture` where there is one.
OUTLINE v3 hit_color(const Hit *hit, const Shading *shading, int k, vi texture)
{
    v3 color = row_real3(&hit->material, k);
#if HAS_TEXTURES
    const vm textured = texture >= (vi)(0);
    if (vm_any(textured)) {
        vi channel;
        const v3 found = texture_color(&shading->textures, &hit->at, texture, textured, false, &channel);
        color = v3_select(textured, v3_mul(color, found), color);
    }
#endif
    return color;
}

#if HAS_PBR
static inline vm hit_is_pbr(const Hit *hit)
{
    return (row_int(&hit->material, MATERIAL_FLAGS) & (int)MATERIAL_IS_PBR) != (vi)(0);
}

// A number of the material, number k of its record, times the texture whose index is number `texture` of it.
OUTLINE vf hit_number(const Hit *hit, const Shading *shading, int k, int texture)
{
    vf number = row_real(&hit->material, k);
#if HAS_TEXTURES
    const vi index = row_int(&hit->material, texture);
    const vm textured = index >= (vi)(0);
    if (vm_any(textured)) {
        vi channel;
        const v3 found = texture_color(&shading->textures, &hit->at, index, textured, true, &channel);
        const vf part = channel == (vi)(0) ? found.x : channel == (vi)(1) ? found.y : found.z;
        number = textured ? number * part : number;
    }
#endif
    return number;
}
#endif

#endif
