// Every shape against the long double reference: distances, verdicts, normals, texture coordinates, error
// bounds; random and adversarial rays, any placement.
//
// The measure is backward: an answer is K input ulps off if it is right for the shape with its surface moved
// by K half-ulps of the coordinates that went in (ray, hit point, place and size of the shape). That is what
// no float32 code can know better than, and it says the right thing at silhouettes, edges and far away.
#include "reference/accept.h"
#include "reference/placed.h"
#include "shapes_support.h"

#include <math.h>

enum { SHAPES = 96, RAYS = 16384, LONG_RAYS = 102400, LANES = 8, ALLOWED_ULPS = 16 };

static const double U = 0x1p-24;

// ---- judging ----------------------------------------------------------------------------------

typedef struct Verdicts {
    double worst_ulps;   // of input
    double worst_t_ulps; // of t, rays from the origin of space that meet the surface at no small angle
    double worst_normal, worst_uv; // in units of what is allowed
    double worst_bound;            // distance from the surface over its stated bound
    double widest_bound;           // the bound in input ulps
    size_t hits, wrong;
} Verdicts;

typedef struct Case {
    const Placed *placed;
    ShapeRay ray; // object space
    real exact;
    double scale; // object units: size of the numbers that went in
} Case;

static Real3 ray_vector(const RayTable *table, size_t i, int column)
{
    return real3(ray_number(table, i, column), ray_number(table, i, column + 1),
                 ray_number(table, i, column + 2));
}

static Real3 hit_vector(const RayTable *table, size_t i, int column)
{
    return real3(hit_number(table, i, column), hit_number(table, i, column + 1),
                 hit_number(table, i, column + 2));
}

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

static void judge_t(const Case *c, const RayTable *table, size_t i, Verdicts *v)
{
    const double t = hit_number(table, i, HIT_T);
    double ulps = 0.5;
    const real off = fabsl(t - c->exact);
    const bool close = off * real3_length(c->ray.d) <= ulps * U * c->scale;
    while (!close && ulps <= 64 && !reference_accepts(&c->ray, t, ulps * U * c->scale, 4 * U * fabs(t)))
        ulps *= 2;
    if (ulps > ALLOWED_ULPS) {
        if (v->wrong++ < 8)
            print_message("ray %zu: t %.9g, exact %.9Lg, %g input ulps; scale %g\n", i, t, c->exact, ulps,
                          c->scale);
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

// |x|, or that of the nearest other number that is the same place on a closed circle.
static double wrapped(double x) { return fmin(fabs(x), fmin(fabs(x - 1), fabs(x + 1))); }

// Error of the texture coordinates over what is allowed. Angles count by the length of their arc.
static double uv_error(const Case *c, const RayTable *table, size_t i, Real3 normal, const real uv[2])
{
    const Placed *p = c->placed;
    const ShapeKind kind = p->shape.kind;
    const double u = (double)hit_number(table, i, HIT_U) + (double)hit_number(table, i, HIT_U_WHOLE);
    const double v = (double)hit_number(table, i, HIT_V) + (double)hit_number(table, i, HIT_V_WHOLE);
    const double off_u = u - (double)uv[0], off_v = v - (double)uv[1];
    double arc = 1;
    if (kind == SHAPE_SPHERE)
        arc = fmax(hypot((double)normal.x, (double)normal.z), 1e-6);
    if (kind == SHAPE_CONE)
        arc = fmin(1, bend_radius(p, uv[1]));
    if (kind == SHAPE_TORUS)
        arc = 0.02;
    const double eu = (kind == SHAPE_PLANE ? fabs(off_u) : wrapped(off_u)) * arc;
    const double ev = kind == SHAPE_TORUS ? wrapped(off_v) * arc : fabs(off_v);
    return fmax(eu, ev) / (16 * U * (1 + c->scale / p->feature));
}

// The gradient in space of a distance in the shape's coordinates.
static Real3 gradient_in_space(const RealMap *inverse, Real3 normal)
{
    return real3_add(
        real3_scale(inverse->row[0], normal.x),
        real3_add(real3_scale(inverse->row[1], normal.y), real3_scale(inverse->row[2], normal.z)));
}

static Real3 normal_in_object(const Affine *map, Real3 n)
{
    const Vec3 *m = map->row;
    return real3_normalize((Real3){m[0].x * n.x + m[1].x * n.y + m[2].x * n.z,
                                   m[0].y * n.x + m[1].y * n.y + m[2].y * n.z,
                                   m[0].z * n.x + m[1].z * n.y + m[2].z * n.z});
}

// Judges by the piece of the surface whose normal fits best among those that the point is on.
static void judge_surface(const Case *c, const RayTable *table, size_t i, Verdicts *v)
{
    const Placed *p = c->placed;
    const Real3 q = real_map_point(&p->inverse, hit_vector(table, i, HIT_P));
    const Real3 ng = hit_vector(table, i, HIT_NG), error = hit_vector(table, i, HIT_ERROR);
    const Real3 back = normal_in_object(&p->map, ng);
    double normal_error = INFINITY, texture = INFINITY, distance = INFINITY, widest = 0;
    for (int k = 0; k < reference_pieces(&p->shape); ++k) {
        real off, uv[2];
        Real3 normal;
        if (!reference_piece(&p->shape, k, q, &off, &normal, uv) || fabsl(off) > ALLOWED_ULPS * U * c->scale)
            continue;
        const double allowed = 64 * U + 16 * U * c->scale / bend_radius(p, uv[1]);
        const double e = (double)real3_length(real3_sub(normal, back)) / allowed;
        if (e >= normal_error)
            continue;
        normal_error = e;
        texture = uv_error(c, table, i, normal, uv);
        const double to_space = 1 / (double)real3_length(gradient_in_space(&p->inverse, normal));
        const double rounding = U * c->scale * to_space;
        const double bound = (double)(fabsl(ng.x) * error.x + fabsl(ng.y) * error.y + fabsl(ng.z) * error.z);
        // What rounding the shape's own numbers moves is not in the bound: the shape is then another one.
        distance = fmax(0, (double)fabsl(off) * to_space - rounding) / bound;
        widest = bound / rounding;
    }
    v->worst_normal = fmax(v->worst_normal, normal_error);
    v->worst_uv = fmax(v->worst_uv, texture);
    v->worst_bound = fmax(v->worst_bound, distance);
    v->widest_bound = fmax(v->widest_bound, widest);
}

static void judge(const Placed *placed, const RayTable *table, Verdicts *v)
{
    for (size_t i = 0; i < table->count; ++i) {
        const Placed *p = &placed[table->index[i]];
        const Real3 o = ray_vector(table, i, RAY_ORG), d = ray_vector(table, i, RAY_DIR);
        Case c = {.placed = p, .ray.shape = &p->shape};
        c.ray.o = real_map_point(&p->inverse, o);
        c.ray.d = real_map_direction(&p->inverse, d);
        c.exact = reference_hit(&p->shape, c.ray.o, c.ray.d, 0, 0, 0);
        const double t = hit_number(table, i, HIT_T), exact = (double)c.exact;
        c.scale = magnitude(p, table, i, isfinite(t) ? t : isfinite(exact) ? exact : 0);
        judge_t(&c, table, i, v);
        if (isinf(t))
            continue;
        ++v->hits;
        judge_surface(&c, table, i, v);
        const bool from_camera = o.x == 0 && o.y == 0 && o.z == 0;
        const bool steep = fabsl(real3_dot(hit_vector(table, i, HIT_NG), d)) > 0.3L * real3_length(d);
        if (from_camera && steep && !reference_at_open_rim(&c.ray, t, ALLOWED_ULPS * U * c.scale, false))
            v->worst_t_ulps = fmax(v->worst_t_ulps, ulps_between(exact, (float)t));
    }
}

static void shape_family(KernelDevice *device, const Family *family, uint64_t seed)
{
    uint64_t state = seed;
    static Placed placed[SHAPES];
    static Primitive primitives[SHAPES];
    Error error;
    for (int i = 0; i < SHAPES; ++i)
        assert_true(random_placed(family, PLACING_ANY, &placed[i], &primitives[i], &state, &error));
    const size_t rays = shapes_long_run() ? LONG_RAYS : RAYS;
    RayTable table = ray_table_create(rays);
    for (size_t i = 0; i < rays; ++i)
        ray_table_add_random(&table, (int)(i % SHAPES), &placed[i % SHAPES], &state);
    KernelProgram *program = shapes_program(device, family->primitive, LANES);
    shapes_run(program, LANES, &table, primitives, SHAPES);
    kernel_program_destroy(program);
    Verdicts v = {0};
    judge(placed, &table, &v);
    print_message("%-14s %7zu %6g %8.2f %8.2f %8.2f %8.2f %8.2f %5zu\n", family->name, v.hits, v.worst_ulps,
                  v.worst_t_ulps, v.worst_normal, v.worst_uv, v.worst_bound, v.widest_bound, v.wrong);
    ray_table_destroy(&table);
    assert_int_equal(v.wrong, 0);
    assert_true(v.hits > rays / 8);
    assert_true(v.worst_normal <= 1);
    assert_true(v.worst_uv <= 1);
    assert_true(v.worst_bound <= 1);
    assert_true(v.widest_bound <= ALLOWED_ULPS);
}

static void all_shapes(void **state)
{
    print_message("shape             hits  input t ulps   normal      uv  d/bound bound  wrong\n");
    for (size_t i = 0; i < FAMILY_COUNT; ++i)
        shape_family(*state, &shape_families[i], 17 + i);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(all_shapes)};
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
