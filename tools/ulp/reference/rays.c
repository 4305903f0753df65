#include "reference/placed.h"

#include <math.h>

#include "reference/parts.h"
#include "selftest/random.h"

// A point of the shape's neighbourhood in its coordinates, often near its surface or edges.
static Vec3 random_target(const Placed *p, uint64_t *state)
{
    Vec3 q = random_point(state, 1.2);
    const Shape *s = &p->shape;
    const double pick = random_unit(state);
    if (s->kind == SHAPE_TRIANGLE && pick < 0.5) {
        const Vec3 *v = s->as.triangle.vertices;
        const double a = random_unit(state), b = random_unit(state) * (1 - a);
        q = vec_add(v[0], vec_add(vec_scale(vec_sub(v[1], v[0]), a), vec_scale(vec_sub(v[2], v[0]), b)));
    } else if (s->kind == SHAPE_BOX && pick < 0.7) {
        const Vec3 size = vec_sub(s->as.box.max, s->as.box.min);
        q = vec_add(s->as.box.min, (Vec3){size.x * random_unit(state), size.y * random_unit(state),
                                          pick < 0.2 ? 0 : size.z * random_unit(state)});
    } else if (s->kind == SHAPE_TETRAHEDRON && pick < 0.7) {
        const Vec3 *v = s->as.tetrahedron.vertices;
        q = vec_scale(vec_add(vec_add(v[0], v[1]), vec_add(v[2], v[3])), 0.25);
        q = vec_add(q, random_point(state, 0.3));
    } else if (s->kind == SHAPE_SPHERE && pick < 0.7) {
        q = vec_add(s->as.sphere.center,
                    vec_scale(random_direction(state), s->as.sphere.radius * random_unit(state)));
    } else if (s->kind == SHAPE_TORUS && pick < 0.7) {
        q = vec_add(s->as.torus.center, vec_scale(random_direction(state), s->as.torus.major));
    } else if (s->kind == SHAPE_CYLINDER && pick < 0.7) {
        const Vec3 axis = vec_sub(s->as.cylinder.top, s->as.cylinder.base);
        q = vec_add(s->as.cylinder.base, vec_scale(axis, pick < 0.2 ? 0 : random_unit(state)));
        q = vec_add(q, vec_scale(random_direction(state), s->as.cylinder.radius));
    } else if (s->kind == SHAPE_CONE && pick < 0.7) {
        const Vec3 axis = vec_sub(s->as.cone.top, s->as.cone.base);
        q = vec_add(s->as.cone.base, vec_scale(axis, pick < 0.2 ? 1 : random_unit(state)));
        q = vec_add(q, vec_scale(random_direction(state), s->as.cone.radius * random_unit(state)));
    } else if (s->kind == SHAPE_DISK && pick < 0.7) {
        q = vec_add(s->as.disk.center, vec_scale(random_direction(state), s->as.disk.radius * 0.9));
    }
    return q;
}


static Vec3 vec_of(Real3 a)
{
    return (Vec3){(double)a.x, (double)a.y, (double)a.z};
}

// A point of the surface near the target, with its normal.
static Vec3 random_surface_point(const Placed *p, uint64_t *state, Vec3 *normal)
{
    const Vec3 target = random_target(p, state);
    const Real3 q = real3_from(target);
    const int pieces = reference_pieces(&p->shape);
    real distance, uv[2];
    Real3 n;
    if (!reference_piece(&p->shape, (int)(random_unit(state) * pieces), q, &distance, &n, uv))
        reference_piece(&p->shape, 0, q, &distance, &n, uv);
    *normal = vec_of(n);
    return vec_of(real3_sub(q, real3_scale(n, distance)));
}

// A point of the circle about the axis.
static Vec3 random_rim(Vec3 center, Vec3 axis, double radius, uint64_t *state)
{
    const Vec3 side = vec_normalize(vec_cross(axis, random_direction(state)));
    return vec_add(center, vec_scale(side, radius));
}

// A point of an edge or a corner, where the shape has such; else of its surface.
static Vec3 random_edge_point(const Placed *p, uint64_t *state)
{
    const Shape *s = &p->shape;
    const double share = random_unit(state) < 0.2 ? 0 : random_unit(state);
    const bool top = random_unit(state) < 0.5;
    const int i = (int)(random_unit(state) * 12), count = s->kind == SHAPE_TETRAHEDRON ? 4 : 3;
    const Vec3 *v = count == 4 ? s->as.tetrahedron.vertices : s->as.triangle.vertices;
    const Vec3 low = s->as.box.min, high = s->as.box.max;
    Vec3 normal;
    switch (s->kind) {
    case SHAPE_BOX: {
        // Along axis i / 4, at one of four places of the other two.
        const double x = low.x + share * (high.x - low.x), y = low.y + share * (high.y - low.y);
        const double z = low.z + share * (high.z - low.z);
        const bool one = i & 1, other = i & 2;
        return i / 4 == 0 ? (Vec3){x, one ? high.y : low.y, other ? high.z : low.z}
               : i / 4 == 1 ? (Vec3){one ? high.x : low.x, y, other ? high.z : low.z}
                            : (Vec3){one ? high.x : low.x, other ? high.y : low.y, z};
    }
    case SHAPE_TETRAHEDRON:
    case SHAPE_TRIANGLE: {
        const Vec3 a = v[i % count], b = v[(i % count + 1 + i / 4 % (count - 1)) % count];
        return vec_add(a, vec_scale(vec_sub(b, a), share));
    }
    case SHAPE_DISK:
        return random_rim(s->as.disk.center, s->as.disk.normal, s->as.disk.radius, state);
    case SHAPE_CYLINDER:
        return random_rim(top ? s->as.cylinder.top : s->as.cylinder.base,
                          vec_sub(s->as.cylinder.top, s->as.cylinder.base), s->as.cylinder.radius, state);
    case SHAPE_CONE:
        return random_rim(top ? s->as.cone.top : s->as.cone.base, vec_sub(s->as.cone.top, s->as.cone.base),
                          top ? s->as.cone.top_radius : s->as.cone.radius, state);
    default:
        return random_surface_point(p, state, &normal);
    }
}

// Origin and target in the shape's coordinates.
typedef struct Aim {
    Vec3 from, at;
} Aim;

static Aim aim_grazing(const Placed *p, uint64_t *state)
{
    Vec3 n;
    const Vec3 q = random_surface_point(p, state, &n);
    const Vec3 along = vec_normalize(vec_cross(n, random_direction(state)));
    const double off = random_scale(state, -8, -1) * (random_unit(state) < 0.5 ? -1 : 1);
    const Vec3 at = vec_add(q, vec_scale(n, random_unit(state) < 0.1 ? 0 : off));
    return (Aim){vec_sub(at, vec_scale(along, random_scale(state, -1, 3))), at};
}

static Aim aim_inside(const Placed *p, uint64_t *state)
{
    Vec3 n;
    const Vec3 q = random_surface_point(p, state, &n);
    const double depth = p->feature * (random_unit(state) < 0.5 ? random_unit(state)
                                                                : random_scale(state, -6, 0));
    const Vec3 from = vec_sub(q, vec_scale(n, depth));
    return (Aim){from, vec_add(from, random_direction(state))};
}

static Aim aim_any(const Placed *p, double pick, uint64_t *state)
{
    const Vec3 at = random_target(p, state);
    if (pick > 0.3) // around it, or within it
        return (Aim){random_point(state, pick > 0.7 ? 1 : random_scale(state, 0, 4)), at};
    // From the origin of space.
    return (Aim){vec_of(real_map_point(&p->inverse, real3(0, 0, 0))), at};
}

static Aim random_aim(const Placed *p, RayKind kind, double pick, uint64_t *state)
{
    Aim aim;
    switch (kind) {
    case RAY_FAR:
        aim.at = random_target(p, state);
        aim.from = vec_add(aim.at, vec_scale(random_direction(state), p->size * random_scale(state, 1, 6)));
        return aim;
    case RAY_GRAZING:
        return aim_grazing(p, state);
    case RAY_INSIDE:
        return aim_inside(p, state);
    case RAY_EDGE:
        aim.at = random_edge_point(p, state);
        aim.from = vec_add(aim.at, vec_scale(random_direction(state), random_scale(state, -1, 3)));
        return aim;
    default:
        return aim_any(p, pick, state);
    }
}

void random_ray(const Placed *p, RayKind kind, uint64_t *state, float origin[3], float direction[3])
{
    const double pick = random_unit(state);
    const Aim aim = random_aim(p, kind, pick, state);
    const Vec3 at = affine_point(p->map, aim.at), from = affine_point(p->map, aim.from);
    const bool camera = (kind == RAY_ANY || kind == RAY_AXIS) && pick <= 0.3;
    origin[0] = camera ? 0 : (float)from.x;
    origin[1] = camera ? 0 : (float)from.y;
    origin[2] = camera ? 0 : (float)from.z;
    Vec3 d = vec_sub(at, (Vec3){origin[0], origin[1], origin[2]});
    if (kind == RAY_AXIS || (kind == RAY_ANY && pick > 0.95)) {
        const int axis = (int)(random_unit(state) * 3);
        const Vec3 o = {origin[0], origin[1], origin[2]};
        d = (Vec3){axis == 0 ? d.x : 0, axis == 1 ? d.y : 0, axis == 2 ? d.z : 0};
        if (kind == RAY_AXIS) { // through the target
            origin[0] = (float)(axis == 0 ? o.x : at.x);
            origin[1] = (float)(axis == 1 ? o.y : at.y);
            origin[2] = (float)(axis == 2 ? o.z : at.z);
        }
    }
    if (d.x == 0 && d.y == 0 && d.z == 0)
        d.x = 1;
    d = vec_normalize(d);
    if (kind == RAY_ANY && pick < 0.02) // as within an instance
        d = vec_scale(d, random_scale(state, -6, 6));
    direction[0] = (float)d.x;
    direction[1] = (float)d.y;
    direction[2] = (float)d.z;
}
