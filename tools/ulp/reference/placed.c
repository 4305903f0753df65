#include "reference/placed.h"

#include <math.h>

#include "layout/bake.h"
#include "selftest/random.h"

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

// A shape of size about 1 near the origin of its own coordinates.
static Placed random_shape(const Family *family, uint64_t *state)
{
    Placed p = {.shape = {.kind = family->kind}, .size = 2, .feature = 1};
    Shape *s = &p.shape;
    const Vec3 c = random_point(state, 1);
    const double r = random_in(state, 0.2, 1);
    switch (family->kind) {
    case SHAPE_SPHERE:
        s->as.sphere.center = c;
        s->as.sphere.radius = r;
        break;
    case SHAPE_PLANE:
        s->as.plane.point = c;
        s->as.plane.normal = random_point(state, 2);
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
        s->as.triangle.vertices[1] = vec_add(c, vec_scale(random_direction(state), r));
        s->as.triangle.vertices[2] = vec_add(c, random_point(state, 1));
        break;
    case SHAPE_DISK:
        s->as.disk.center = c;
        s->as.disk.normal = random_point(state, 2);
        s->as.disk.radius = r;
        break;
    case SHAPE_CYLINDER:
        s->as.cylinder.base = c;
        s->as.cylinder.top = vec_add(c, vec_scale(random_direction(state), random_in(state, 0.2, 2)));
        s->as.cylinder.radius = r;
        s->as.cylinder.caps = !family->open;
        break;
    case SHAPE_CONE:
        s->as.cone.base = c;
        s->as.cone.top = vec_add(c, vec_scale(random_direction(state), random_in(state, 0.2, 2)));
        s->as.cone.radius = r;
        s->as.cone.top_radius = random_unit(state) < 0.4 ? 0 : random_in(state, 0, 1.2);
        s->as.cone.caps = !family->open;
        break;
    case SHAPE_TORUS:
        s->as.torus.center = c;
        s->as.torus.axis = random_point(state, 2);
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

static Placed random_place(const Family *family, Placing placing, uint64_t *state)
{
    Placed p = random_shape(family, state);
    const double scale = placing == PLACING_PLAIN     ? 1
                         : placing == PLACING_EXTREME ? random_scale(state, -9, 9)
                                                      : random_scale(state, -6, 6);
    Vec3 factors = {scale, scale, random_unit(state) < 0.3 ? -scale : scale};
    if (family->affine && random_unit(state) < 0.7)
        factors = (Vec3){scale, scale * random_in(state, 0.3, 1), -scale * random_in(state, 0.3, 2)};
    if (family->affine && placing == PLACING_EXTREME)
        factors.y *= random_scale(state, -3, 0);
    p.map = affine_compose(affine_translate((Vec3){0.1, 0.2, 0.3}), affine_scale(factors));
    if (random_unit(state) < 0.7)
        p.map = affine_compose(affine_rotate(random_direction(state), random_in(state, 0, 360)), p.map);
    if (placing == PLACING_PLAIN) // an ellipsoid is a sphere under some map
        p.map = family->primitive == PRIMITIVE_ELLIPSOID ? affine_scale(factors) : affine_identity();
    const double away = scale * (placing == PLACING_PLAIN ? random_in(state, 0, 1.7)
                                 : placing == PLACING_FAR ? random_scale(state, 3, 5)
                                                          : random_scale(state, 0, 3));
    if (family->giant) {
        // The surface passes the origin at a small share of the radius.
        const Vec3 c = affine_point(p.map, p.shape.as.sphere.center);
        const double r = p.shape.as.sphere.radius * scale, gap = r * random_scale(state, -7, -2.5);
        const Vec3 target = vec_scale(random_direction(state), r + (random_unit(state) < 0.5 ? gap : -gap));
        p.map.translation = vec_add(p.map.translation, vec_sub(target, c));
    } else {
        p.map.translation = vec_add(p.map.translation, vec_scale(random_direction(state), 3 * away));
    }
    p.inverse = real_map_inverse(&p.map);
    return p;
}

bool random_placed(const Family *family, Placing placing, Placed *placed, Primitive *primitive,
                   uint64_t *state, Error *error)
{
    BakedBounds bounds;
    do {
        *placed = random_place(family, placing, state);
        if (!bake_shape(&placed->shape, &placed->map, primitive, &bounds, error))
            return false;
    } while ((int)primitive->kind != family->primitive);
    return true;
}
