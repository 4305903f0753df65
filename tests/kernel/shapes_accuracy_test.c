// Every shape against the long double reference: distances, verdicts, normals, texture coordinates, error
// bounds; random and adversarial rays, any placement; the same bits for every width of lanes.
//
// The measure is backward: an answer is K input ulps off if it is right for the shape with its surface moved
// by K half-ulps of the coordinates that went in (ray, hit point, place and size of the shape). That is what
// no float32 code can know better than, and it says the right thing at silhouettes, edges and far away.
#include "shapes_reference.h"
#include "shapes_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { SHAPES = 96, RAYS = 102400, ALLOWED_ULPS = 16 };

static const double U = 0x1p-24;

typedef struct Placed {
    Shape shape;
    Affine map;
    RealMap inverse;
    double size;    // object units, the largest extent
    double feature; // the smallest radius or edge
} Placed;

typedef struct Family {
    const char *name;
    ShapeKind kind;
    int primitive; // PRIMITIVE_X that it becomes
    bool affine;   // under any transform; else under similarities
    bool open;     // cylinder and cone without caps
    bool giant;
} Family;

static const Family families[] = {
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
    p.feature = fmin(p.feature, r) * (family->kind == SHAPE_TETRAHEDRON || family->kind == SHAPE_TRIANGLE ? 0.1 : 1);
    return p;
}

static Placed random_placed(const Family *family, uint64_t *state)
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
        q = vec_add(s->as.sphere.center, vec_scale(random_unit_vec(state), s->as.sphere.radius * random_unit(state)));
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

static void add_random_ray(RayTable *table, const Placed *p, int index, uint64_t *state)
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

// ---- judging ----------------------------------------------------------------------------------

typedef struct Verdicts {
    double worst_ulps;   // of input
    double worst_t_ulps; // of t, rays from the origin of space that meet the surface at no small angle
    double worst_normal, worst_uv; // in units of what is allowed
    double worst_bound;  // distance from the surface over its stated bound
    double widest_bound; // the bound in input ulps
    size_t hits, wrong;
} Verdicts;

typedef struct Case {
    const Placed *placed;
    Real3 o, d;   // object space
    real exact;
    double scale; // object units: size of the numbers that went in
} Case;

static double magnitude(const Placed *p, const RayTable *table, size_t i, double t)
{
    const Vec3 c = p->map.translation;
    double a[3] = {fabs(c.x), fabs(c.y), fabs(c.z)}, worst = 0;
    for (int k = 0; k < 3; ++k)
        a[k] += fabs(ray_number(table, i, RAY_ORG + k)) + fabs(t * ray_number(table, i, RAY_DIR + k));
    for (int k = 0; k < 3; ++k) {
        const Real3 row = p->inverse.row[k];
        worst = fmax(worst, (double)(fabsl(row.x) * a[0] + fabsl(row.y) * a[1] + fabsl(row.z) * a[2]));
    }
    return worst + p->size;
}

// Whether the ray starts so close to the surface that it may start on either side.
static bool starts_on_surface(const Case *c, real grow)
{
    bool on_surface = false;
    for (int k = 0; k < reference_pieces(&c->placed->shape); ++k) {
        real distance, uv[2];
        Real3 normal;
        on_surface |= reference_piece(&c->placed->shape, k, c->o, &distance, &normal, uv) && fabsl(distance) <= grow;
    }
    return on_surface;
}

// Whether t is a point of the wall of an open cylinder or cone close to its rim, or on a ray that may miss.
static bool at_open_rim(const Case *c, double t, real grow, bool may_miss)
{
    const Shape *s = &c->placed->shape;
    const bool cone = s->kind == SHAPE_CONE;
    if ((!cone && s->kind != SHAPE_CYLINDER) || (cone ? s->as.cone.caps : s->as.cylinder.caps))
        return false;
    const double height = vec_length(cone ? vec_sub(s->as.cone.top, s->as.cone.base)
                                          : vec_sub(s->as.cylinder.top, s->as.cylinder.base));
    real distance, uv[2];
    Real3 normal;
    reference_piece(s, 0, real3_add(c->o, real3_scale(c->d, t)), &distance, &normal, uv);
    return fabsl(distance) <= grow && (may_miss || fminl(uv[1], 1 - uv[1]) * height <= 4 * grow);
}

// Whether t is an answer for the shape with its surface `ulps` away.
static bool acceptable(const Case *c, double t, double ulps)
{
    const Shape *shape = &c->placed->shape;
    const real grow = ulps * U * c->scale;
    const bool flat = shape->kind == SHAPE_PLANE || shape->kind == SHAPE_DISK || shape->kind == SHAPE_TRIANGLE;
    real slack = 4 * U * fabs(t), sideways = grow;
    if (flat) {
        // What moves a ray sideways moves its hit, and the edges as it sees them, by more than that.
        real distance, uv[2];
        Real3 normal;
        reference_piece(shape, 0, c->o, &distance, &normal, uv);
        const real rate = fabsl(real3_dot(normal, c->d));
        slack += grow / rate;
        sideways += grow / rate * real3_length(c->d);
    }
    real low = INFINITY, high = 0;
    for (int k = 0; k < 9; ++k) {
        const real hit = reference_hit(shape, c->o, c->d, sideways * (k % 3 - 1), grow * (k / 3 - 1), 0);
        low = fminl(low, hit);
        high = fmaxl(high, hit);
    }
    const bool on_surface = starts_on_surface(c, grow);
    if (isinf(t))
        return isinf(high) || (on_surface && flat);
    if (flat && isinf(low))
        return on_surface && t <= 2 * slack;
    if (t >= (on_surface ? 0 : low - slack) && t <= high + slack)
        return true;
    return at_open_rim(c, t, grow, isinf(high));
}

static void judge_t(const Case *c, const RayTable *table, size_t i, Verdicts *v)
{
    const double t = hit_number(table, i, HIT_T);
    double ulps = 0.5;
    const real off = fabsl(t - c->exact);
    const bool close = off * real3_length(c->d) <= ulps * U * c->scale;
    while (!close && ulps <= 64 && !acceptable(c, t, ulps))
        ulps *= 2;
    if (ulps > ALLOWED_ULPS) {
        if (v->wrong++ < 8)
            print_message("ray %zu (%a %a %a) (%a %a %a): t %.9g, exact %.9Lg, %g input ulps; scale %g\n", i, (double)ray_number(table,i,0),(double)ray_number(table,i,1),(double)ray_number(table,i,2),(double)ray_number(table,i,3),(double)ray_number(table,i,4),(double)ray_number(table,i,5), t,
                          c->exact, ulps, c->scale);
    }
    v->worst_ulps = fmax(v->worst_ulps, ulps);
}

// Of the surface: on a cone that of a circle which shrinks towards the apex.
static double bend_radius(const Placed *p, real v)
{
    if (p->shape.kind != SHAPE_CONE)
        return p->feature;
    const double r = p->shape.as.cone.radius, top = p->shape.as.cone.top_radius;
    return fmax(r + (top - r) * (double)v, 1e-9);
}

static void judge_surface(const Case *c, const RayTable *table, size_t i, Verdicts *v)
{
    const Placed *p = c->placed;
    const float *h = table->hits + i;
    const size_t n = table->capacity;
    const Real3 at = real3(h[HIT_P * n], h[(HIT_P + 1) * n], h[(HIT_P + 2) * n]);
    const Vec3 ng = {h[HIT_NG * n], h[(HIT_NG + 1) * n], h[(HIT_NG + 2) * n]};
    const Real3 q = real_map_point(&p->inverse, at);
    const Vec3 *m = p->map.row;
    const Real3 back = real3_normalize((Real3){m[0].x * ng.x + m[1].x * ng.y + m[2].x * ng.z,
                                               m[0].y * ng.x + m[1].y * ng.y + m[2].y * ng.z,
                                               m[0].z * ng.x + m[1].z * ng.y + m[2].z * ng.z});
    const double slack = 16 * U * c->scale;
    double normal_error = INFINITY, uv_error = INFINITY, distance = INFINITY, widest = 0;
    for (int k = 0; k < reference_pieces(&p->shape); ++k) {
        real off, uv[2];
        Real3 normal;
        if (!reference_piece(&p->shape, k, q, &off, &normal, uv) || fabsl(off) > slack)
            continue;
        const double bend = bend_radius(p, uv[1]);
        const double e = (double)real3_length(real3_sub(normal, back)) / (64 * U + 16 * U * c->scale / bend);
        if (e >= normal_error)
            continue;
        normal_error = e;
        // Distances along the normal in space.
        const Real3 g = real3_add(real3_scale(p->inverse.row[0], normal.x),
                                  real3_add(real3_scale(p->inverse.row[1], normal.y),
                                            real3_scale(p->inverse.row[2], normal.z)));
        const double to_space = 1 / (double)real3_length(g), rounding = U * c->scale * to_space;
        const double bound = fabs(ng.x) * h[HIT_ERROR * n] + fabs(ng.y) * h[(HIT_ERROR + 1) * n] +
                             fabs(ng.z) * h[(HIT_ERROR + 2) * n];
        // What rounding the shape's own numbers moves is not in the bound: the shape is then another one.
        distance = fmax(0, (double)fabsl(off) * to_space - rounding) / bound;
        widest = bound / rounding;
        const double du = (double)h[HIT_U * n] + (double)h[HIT_U_WHOLE * n] - (double)uv[0];
        const double dv = (double)h[HIT_V * n] + (double)h[HIT_V_WHOLE * n] - (double)uv[1];
        const bool wraps = p->shape.kind != SHAPE_PLANE;
        const double eu = wraps ? fmin(fabs(du), fmin(fabs(du - 1), fabs(du + 1))) : fabs(du);
        const double ev = p->shape.kind == SHAPE_TORUS ? fmin(fabs(dv), fmin(fabs(dv - 1), fabs(dv + 1))) : fabs(dv);
        const double pole = p->shape.kind == SHAPE_SPHERE ? fmax(hypot((double)normal.x, (double)normal.z), 1e-6) :
                            p->shape.kind == SHAPE_CONE ? fmin(1, bend_radius(p, uv[1])) : p->shape.kind == SHAPE_TORUS ? 0.02 : 1;
        uv_error = fmax(eu * pole, ev * (p->shape.kind == SHAPE_TORUS ? 0.02 : 1)) / (16 * U + 16 * U * c->scale / p->feature);
    }
    v->worst_normal = fmax(v->worst_normal, normal_error);
    v->worst_uv = fmax(v->worst_uv, uv_error);
    v->worst_bound = fmax(v->worst_bound, distance);
    v->widest_bound = fmax(v->widest_bound, widest);
}

static void judge(const Placed *placed, const RayTable *table, Verdicts *v)
{
    for (size_t i = 0; i < table->count; ++i) {
        const Placed *p = &placed[table->index[i]];
        Case c = {.placed = p};
        const Real3 o = real3(ray_number(table, i, RAY_ORG), ray_number(table, i, RAY_ORG + 1),
                              ray_number(table, i, RAY_ORG + 2));
        const Real3 d = real3(ray_number(table, i, RAY_DIR), ray_number(table, i, RAY_DIR + 1),
                              ray_number(table, i, RAY_DIR + 2));
        c.o = real_map_point(&p->inverse, o);
        c.d = real_map_direction(&p->inverse, d);
        const real exact = c.exact = reference_hit(&p->shape, c.o, c.d, 0, 0, 0);
        const double t = hit_number(table, i, HIT_T);
        const double along = isinf(t) ? (isinf(exact) ? 0 : (double)exact) : t;
        c.scale = magnitude(p, table, i, along);
        judge_t(&c, table, i, v);
        if (isinf(t))
            continue;
        ++v->hits;
        judge_surface(&c, table, i, v);
        const double incidence = fabs((double)(hit_number(table, i, HIT_NG) * ray_number(table, i, RAY_DIR) +
                                               hit_number(table, i, HIT_NG + 1) * ray_number(table, i, RAY_DIR + 1) +
                                               hit_number(table, i, HIT_NG + 2) * ray_number(table, i, RAY_DIR + 2)));
        if (o.x == 0 && o.y == 0 && o.z == 0 && !at_open_rim(&c, t, ALLOWED_ULPS * U * c.scale, false) && incidence > 0.3 * (double)real3_length(d))
            v->worst_t_ulps = fmax(v->worst_t_ulps, ulps_between((double)exact, (float)t));
    }
}

static void shape_family(KernelDevice *device, const Family *family, uint64_t seed)
{
    uint64_t state = seed;
    static Placed placed[SHAPES];
    static Primitive primitives[SHAPES];
    for (int i = 0; i < SHAPES; ++i) {
        BakedBounds bounds;
        Error error;
        do {
            placed[i] = random_placed(family, &state);
            primitives[i] = (Primitive){.kind = 99};
            assert_true(bake_shape(&placed[i].shape, &placed[i].map, &primitives[i], &bounds, &error));
        } while ((int)primitives[i].kind != family->primitive);
    }
    RayTable table = ray_table_create(RAYS);
    for (size_t i = 0; i < RAYS; ++i)
        add_random_ray(&table, &placed[i % SHAPES], (int)(i % SHAPES), &state);
    float *first = malloc(sizeof(float) * HIT_COLUMNS * table.capacity);
    assert_non_null(first);
    for (int lanes = 1; lanes <= 8; lanes *= 8) {
        KernelProgram *program = shapes_program(device, family->primitive, lanes);
        shapes_run(program, lanes, &table, primitives, SHAPES);
        kernel_program_destroy(program);
        if (lanes == 1)
            memcpy(first, table.hits, sizeof(float) * HIT_COLUMNS * table.capacity);
    }
    const size_t defined = family->kind == SHAPE_TRIANGLE ? HIT_COLUMNS : HIT_B1;
    for (size_t i = 0; i < table.capacity; ++i)
        for (size_t k = 0; k < defined; ++k) {
            const size_t at = k * table.capacity + i;
            if (!isinf(table.hits[i]) || k == 0)
                assert_memory_equal(&first[at], &table.hits[at], sizeof(float));
        }
    free(first);
    Verdicts v = {0};
    judge(placed, &table, &v);
    print_message("%-14s %7zu %6g %8.2f %8.2f %8.2f %8.2f %8.2f %5zu\n", family->name, v.hits, v.worst_ulps,
                  v.worst_t_ulps, v.worst_normal, v.worst_uv, v.worst_bound, v.widest_bound, v.wrong);
    ray_table_destroy(&table);
    assert_int_equal(v.wrong, 0);
    assert_true(v.hits > RAYS / 8);
    assert_true(v.worst_normal <= 1);
    assert_true(v.worst_uv <= 1);
    assert_true(v.worst_bound <= 1);
}

static void all_shapes(void **state)
{
    print_message("shape             hits  input t ulps   normal      uv  d/bound bound  wrong\n");
    for (size_t i = 0; i < sizeof families / sizeof *families; ++i)
        shape_family(*state, &families[i], 17 + i);
}

int main(void)
{
    KernelDevice *device = kernel_device_create();
    if (!device)
        return KERNEL_TEST_SKIP;
    const struct CMUnitTest tests[] = {kernel_unit_test(all_shapes, device)};
    const int failed = cmocka_run_group_tests(tests, NULL, NULL);
    kernel_device_destroy(device);
    return failed;
}
