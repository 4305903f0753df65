#include "shapes_random.h"

#include <math.h>

const Family shape_families[FAMILY_COUNT] = {
    {"sphere", SHAPE_SPHERE, PRIMITIVE_SPHERE, false, false, false},
    {"giant sphere", SHAPE_SPHERE, PRIMITIVE_GIANT_SPHERE, false, false, true},
    {"ellipsoid", SHAPE_SPHERE, PRIMITIVE_ELLIPSOID, true, false, false},
    {"plane", SHAPE_PLANE, PRIMITIVE_PLANE, true, false, false},
    {"box", SHAPE_BOX, PRIMITIVE_BOX, true, false, false},
    {"tetrahedron", SHAPE_TETRAHEDRON, PRIMITIVE_TETRAHEDRON, true, false, false},
    {"disk", SHAPE_DISK, PRIMITIVE_DISK, true, false, false},
    {"cylinder", SHAPE_CYLINDER, PRIMITIVE_CYLINDER, true, false, false},
    {"open cylinder", SHAPE_CYLINDER, PRIMITIVE_CYLINDER, true, true, false},
    {"cone", SHAPE_CONE, PRIMITIVE_CONE, true, false, false},
    {"open cone", SHAPE_CONE, PRIMITIVE_CONE, true, true, false},
    {"torus", SHAPE_TORUS, PRIMITIVE_TORUS, true, false, false},
    {"triangle", SHAPE_TRIANGLE, PRIMITIVE_TRIANGLE, true, false, false},
};

static Vec3 random_vec(uint64_t *state, double extent)
{
    const double x = random_in(state, -extent, extent), y = random_in(state, -extent, extent);
    return (Vec3){x, y, random_in(state, -extent, extent)};
}

static Vec3 random_unit_vec(uint64_t *state)
{
    double d[3];
    random_direction(state, d);
    return (Vec3){d[0], d[1], d[2]};
}

// A shape of size about 1 near the origin of its own coordinates.
static Placed random_shape(const Family *family, uint64_t *state)
{
    Placed p = {.shape = {.kind = family->kind}, .size = 2, .feature = 1};
    Shape *s = &p.shape;
    const Vec3 c = random_vec(state, 1);
    const double r = random_in(state, 0.2, 1);
    switch (family->kind) {
    case SHAPE_SPHERE:
        s->as.sphere.center = c;
        s->as.sphere.radius = r;
        break;
    case SHAPE_PLANE:
        s->as.plane.point = c;
        s->as.plane.normal = random_vec(state, 2);
        break;
    case SHAPE_BOX:
        s->as.box.min = c;
        s->as.box.max = vec_add(c, (Vec3){r, random_in(state, 0.1, 1), random_in(state, 0.1, 1)});
        break;
    case SHAPE_TETRAHEDRON:
        s->as.tetrahedron.vertices[0] = c;
        s->as.tetrahedron.vertices[1] = vec_add(c, (Vec3){r, random_in(state, -0.2, 0.2), 0.1});
        s->as.tetrahedron.vertices[2] = vec_add(c, (Vec3){0.1, random_in(state, 0.3, 1), -0.1});
        s->as.tetrahedron.vertices[3] = vec_add(c, (Vec3){0, random_in(state, -0.2, 0.2), r < 0.6 ? r : -r});
        break;
    case SHAPE_TRIANGLE:
        s->as.triangle.vertices[0] = c;
        s->as.triangle.vertices[1] = vec_add(c, vec_scale(random_unit_vec(state), r));
        s->as.triangle.vertices[2] = vec_add(c, random_vec(state, 1));
        break;
    case SHAPE_DISK:
        s->as.disk.center = c;
        s->as.disk.normal = random_vec(state, 2);
        s->as.disk.radius = r;
        break;
    case SHAPE_CYLINDER:
        s->as.cylinder.base = c;
        s->as.cylinder.top = vec_add(c, vec_scale(random_unit_vec(state), random_in(state, 0.2, 2)));
        s->as.cylinder.radius = r;
        s->as.cylinder.caps = !family->open;
        break;
    case SHAPE_CONE:
        s->as.cone.base = c;
        s->as.cone.top = vec_add(c, vec_scale(random_unit_vec(state), random_in(state, 0.2, 2)));
        s->as.cone.radius = r;
        s->as.cone.top_radius = random_unit(state) < 0.4 ? 0 : random_in(state, 0, 1.2);
        s->as.cone.caps = !family->open;
        break;
    case SHAPE_TORUS:
        s->as.torus.center = c;
        s->as.torus.axis = random_vec(state, 2);
        s->as.torus.major = r;
        s->as.torus.minor = r * (random_unit(state) < 0.1 ? 1 : random_in(state, 0.05, 1));
        p.feature = s->as.torus.minor;
        break;
    case SHAPE_MESH:
        break;
    }
    p.feature =
        fmin(p.feature, r) * (family->kind == SHAPE_TETRAHEDRON || family->kind == SHAPE_TRIANGLE ? 0.1 : 1);
    return p;
}

static Placed random_place(const Family *family, uint64_t *state)
{
    Placed p = random_shape(family, state);
    const double scale = random_scale(state, -6, 6);
    Vec3 factors = {scale, scale, random_unit(state) < 0.3 ? -scale : scale};
    if (family->affine && random_unit(state) < 0.7)
        factors = (Vec3){scale, scale * random_in(state, 0.3, 1), -scale * random_in(state, 0.3, 2)};
    p.map = affine_compose(affine_translate((Vec3){0.1, 0.2, 0.3}), affine_scale(factors));
    if (random_unit(state) < 0.7)
        p.map = affine_compose(affine_rotate(random_unit_vec(state), random_in(state, 0, 360)), p.map);
    const double away = scale * random_scale(state, 0, 3);
    if (family->giant) {
        // The surface passes the origin at a small share of the radius.
        const Vec3 c = affine_point(p.map, p.shape.as.sphere.center);
        const double r = p.shape.as.sphere.radius * scale, gap = r * random_scale(state, -7, -2.5);
        const Vec3 target = vec_scale(random_unit_vec(state), r + (random_unit(state) < 0.5 ? gap : -gap));
        p.map.translation = vec_add(p.map.translation, vec_sub(target, c));
    } else {
        p.map.translation = vec_add(p.map.translation, vec_scale(random_unit_vec(state), 3 * away));
    }
    p.inverse = real_map_inverse(&p.map);
    return p;
}

void random_placed(const Family *family, Placed *placed, Primitive *primitives, int count, uint64_t *state)
{
    for (int i = 0; i < count; ++i) {
        BakedBounds bounds;
        Error error;
        do {
            placed[i] = random_place(family, state);
            assert_true(bake_shape(&placed[i].shape, &placed[i].map, &primitives[i], &bounds, &error));
        } while ((int)primitives[i].kind != family->primitive);
    }
}

// A point of the shape's neighbourhood in space, often near its surface or edges.
static Vec3 random_target(const Placed *p, uint64_t *state)
{
    Vec3 q = random_vec(state, 1.2);
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
        q = vec_add(q, random_vec(state, 0.3));
    } else if (s->kind == SHAPE_SPHERE && pick < 0.7) {
        q = vec_add(s->as.sphere.center,
                    vec_scale(random_unit_vec(state), s->as.sphere.radius * random_unit(state)));
    } else if (s->kind == SHAPE_TORUS && pick < 0.7) {
        q = vec_add(s->as.torus.center, vec_scale(random_unit_vec(state), s->as.torus.major));
    } else if (s->kind == SHAPE_CYLINDER && pick < 0.7) {
        const Vec3 axis = vec_sub(s->as.cylinder.top, s->as.cylinder.base);
        q = vec_add(s->as.cylinder.base, vec_scale(axis, pick < 0.2 ? 0 : random_unit(state)));
        q = vec_add(q, vec_scale(random_unit_vec(state), s->as.cylinder.radius));
    } else if (s->kind == SHAPE_CONE && pick < 0.7) {
        const Vec3 axis = vec_sub(s->as.cone.top, s->as.cone.base);
        q = vec_add(s->as.cone.base, vec_scale(axis, pick < 0.2 ? 1 : random_unit(state)));
        q = vec_add(q, vec_scale(random_unit_vec(state), s->as.cone.radius * random_unit(state)));
    } else if (s->kind == SHAPE_DISK && pick < 0.7) {
        q = vec_add(s->as.disk.center, vec_scale(random_unit_vec(state), s->as.disk.radius * 0.9));
    }
    return affine_point(p->map, q);
}

void add_random_ray(RayTable *table, const Placed *p, int index, uint64_t *state)
{
    const Vec3 target = random_target(p, state);
    Vec3 origin = {0, 0, 0};
    const double pick = random_unit(state);
    if (pick > 0.3) // around it, or within it
        origin = affine_point(p->map, random_vec(state, pick > 0.7 ? 1 : random_scale(state, 0, 4)));
    const float o[3] = {(float)origin.x, (float)origin.y, (float)origin.z};
    Vec3 d = vec_sub(target, (Vec3){o[0], o[1], o[2]});
    if (pick > 0.95) { // along an axis of space
        const int axis = (int)(random_unit(state) * 3);
        d = (Vec3){axis == 0 ? d.x : 0, axis == 1 ? d.y : 0, axis == 2 ? d.z : 0};
    }
    if (d.x == 0 && d.y == 0 && d.z == 0)
        d.x = 1;
    d = vec_normalize(d);
    if (pick < 0.02) // as within an instance
        d = vec_scale(d, random_scale(state, -6, 6));
    ray_table_add(table, index, o, (float[3]){(float)d.x, (float)d.y, (float)d.z});
}
