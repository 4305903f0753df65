// Strong, tiny, mirroring and shearing transforms: a shape in an instance is the shape baked under the same
// map.
#include "shapes_support.h"

#include <math.h>
#include <string.h>

enum { RAYS = 512, LANES = 8, SHAPES = 10 };

static const double U = 0x1p-24;

// records: the shape, then the map of its instance. out: t, p, error, ng.
static const char source[] =
    "#include \"shapes/shapes.h\"\n"
    "static PrimitiveLanes splat(global const float *r)\n"
    "{\n"
    "    PrimitiveLanes p;\n"
    "    p.row0 = v3_make((vf)(r[0]), (vf)(r[1]), (vf)(r[2]));\n"
    "    p.row1 = v3_make((vf)(r[4]), (vf)(r[5]), (vf)(r[6]));\n"
    "    p.row2 = v3_make((vf)(r[8]), (vf)(r[9]), (vf)(r[10]));\n"
    "    p.c = v3_make((vf)(r[3]), (vf)(r[7]), (vf)(r[11]));\n"
    "    p.p0 = (vf)(r[12]);\n"
    "    p.p1 = (vf)(r[13]);\n"
    "    p.p2 = (vf)(r[15]);\n"
    "    return p;\n"
    "}\n"
    "kernel void place(global const float *records, global const float *rays, global float *out, uint n)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const PrimitiveLanes shape = splat(records), map = splat(records + 16);\n"
    "    const uint kind = as_uint(records[14]);\n"
    "    const v3 org = v3_make(VF_LOAD(rays + i), VF_LOAD(rays + n + i), VF_LOAD(rays + 2 * n + i));\n"
    "    const v3 dir = v3_make(VF_LOAD(rays + 3 * n + i), VF_LOAD(rays + 4 * n + i),\n"
    "                           VF_LOAD(rays + 5 * n + i));\n"
    "    RayLanes ray;\n"
    "    ray.org = canonical_point(&map, org);\n"
    "    ray.dir = canonical_direction(&map, dir);\n"
    "    ray.tmin = (vf)(0.0f);\n"
    "    ray.self = ray.inward = (vm)(0);\n"
    "    const vf t = intersect_primitive(kind, &shape, &ray);\n"
    "    SurfaceLanes s;\n"
    "    surface_primitive((vi)((int)kind), &shape, &ray, t, &s);\n"
    "    surface_place(&map, org, dir, t, &s);\n"
    "    const v3 columns[3] = { s.p, s.error, s.ng };\n"
    "    VF_STORE(t, out + i);\n"
    "    for (int k = 0; k < 3; k++) {\n"
    "        VF_STORE(columns[k].x, out + (3 * k + 1) * n + i);\n"
    "        VF_STORE(columns[k].y, out + (3 * k + 2) * n + i);\n"
    "        VF_STORE(columns[k].z, out + (3 * k + 3) * n + i);\n"
    "    }\n"
    "}\n";

enum { OUT_T, OUT_P, OUT_NG = 7, OUT_COLUMNS = 10 };

typedef struct Hits {
    float column[OUT_COLUMNS][RAYS];
} Hits;

static Vec3 hit_vector(const Hits *hits, size_t i, int column)
{
    return (Vec3){hits->column[column][i], hits->column[column + 1][i], hits->column[column + 2][i]};
}

static Primitive map_record(Affine map)
{
    const Affine inverse = affine_inverse(map);
    const Vec3 *a = inverse.row, c = map.translation;
    return (Primitive){.row0 = {(f32)a[0].x, (f32)a[0].y, (f32)a[0].z, (f32)c.x},
                       .row1 = {(f32)a[1].x, (f32)a[1].y, (f32)a[1].z, (f32)c.y},
                       .row2 = {(f32)a[2].x, (f32)a[2].y, (f32)a[2].z, (f32)c.z}};
}

// Shoots the rays at the shape baked under `in_object`, in an instance placed by `placed`.
static void shoot(KernelProgram *program, const Shape *shape, Affine in_object, Affine placed,
                  const RayTable *table, Hits *hits)
{
    Primitive records[2] = {{.kind = 0}};
    BakedBounds bounds;
    Error error;
    assert_true(bake_shape(shape, &in_object, &records[0], &bounds, &error));
    records[1] = map_record(placed);
    const uint32_t n = RAYS;
    kernel_run(program, "place", RAYS / LANES,
               (KernelArg[]){kernel_in(records, sizeof records),
                             kernel_in(table->rays, RAY_COLUMNS * RAYS * sizeof(float)),
                             kernel_out(hits, sizeof *hits), kernel_value(&n, sizeof n)},
               4);
}

static void shapes_make(Shape shapes[SHAPES])
{
    const Vec3 z = {0, 0, 0}, low = {0, -1, 0}, y = {0, 1, 0};
    const Shape all[SHAPES] = {
        {.kind = SHAPE_SPHERE, .as.sphere = {z, 1}},
        {.kind = SHAPE_PLANE, .as.plane = {{0, -0.5, 0}, {0.2, 1, 0.1}}},
        {.kind = SHAPE_BOX, .as.box = {{-1, -0.7, -0.5}, {1, 0.6, 0.8}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 1, 0}, {1, -1, 1}, {-1, -1, 1}, {0, -1, -1}}}},
        {.kind = SHAPE_DISK, .as.disk = {z, {0.3, 1, 0.5}, 1.2}},
        {.kind = SHAPE_CYLINDER, .as.cylinder = {low, y, 0.8, true}},
        {.kind = SHAPE_CONE, .as.cone = {low, y, 1, 0.3, true}},
        {.kind = SHAPE_TORUS, .as.torus = {z, {1, 1, 0}, 0.8, 0.4}},
        {.kind = SHAPE_TRIANGLE,
         .as.triangle = {.vertices = {{-1.5, -1, 0}, {1.5, -0.8, 0.3}, {0, 1.5, -0.2}}}},
        {.kind = SHAPE_SPHERE, .as.sphere = {{0, -3, 0}, 3}},
    };
    memcpy(shapes, all, sizeof all);
}

// Rays at the unit cube under the map, from around it; all lengths times `scale`.
static RayTable rays_at(Affine map, double scale, uint64_t random)
{
    RayTable table = ray_table_create(RAYS);
    for (size_t i = 0; i < RAYS; ++i) {
        double a[3], b[3];
        random_direction(&random, a);
        random_direction(&random, b);
        const Vec3 o = affine_point(map, (Vec3){4 * a[0], 4 * a[1], 4 * a[2]});
        const Vec3 to = affine_point(map, (Vec3){0.8 * b[0], 0.8 * b[1], 0.8 * b[2]});
        const Vec3 d = vec_normalize(vec_sub(to, o)), from = vec_scale(o, scale);
        ray_table_add(&table, 0, (float[3]){(float)from.x, (float)from.y, (float)from.z},
                      (float[3]){(float)d.x, (float)d.y, (float)d.z});
    }
    return table;
}

typedef struct Agreement {
    size_t hits, edges; // rays that both meet; that only one meets, or that meet another part of the shape
    double worst;       // difference of t along the normal, in half ulps of the numbers that went in
    double normals;     // |difference|, times how steep the ray is: grazing ones find the point less well
} Agreement;

// Compares hits on a shape of size 1 at `place`, all lengths times `scale`, with what is expected of the
// shape at scale 1.
static Agreement compare(const RayTable *table, const Hits *expected, const Hits *hits, double scale,
                         Vec3 place)
{
    Agreement r = {0};
    for (size_t i = 0; i < RAYS; ++i) {
        const double t = (double)hits->column[OUT_T][i] / scale, e = expected->column[OUT_T][i];
        assert_true(t > 0);
        if (isinf(t) && isinf(e))
            continue;
        const Vec3 n = hit_vector(hits, i, OUT_NG), ne = hit_vector(expected, i, OUT_NG);
        const Vec3 d = {ray_number(table, i, RAY_DIR), ray_number(table, i, RAY_DIR + 1),
                        ray_number(table, i, RAY_DIR + 2)};
        const Vec3 p = vec_scale(hit_vector(hits, i, OUT_P), 1 / scale);
        assert_true(isinf(t) || (isfinite(n.x + n.y + n.z) && isfinite(p.x + p.y + p.z)));
        if (isinf(t) || isinf(e) || fabs(t - e) > 1e-4 * e || vec_length(vec_sub(n, ne)) > 1e-3) {
            ++r.edges;
            continue;
        }
        ++r.hits;
        const double size = vec_length(p) + vec_length(place) + e + 1;
        r.worst = fmax(r.worst, fabs(t - e) * fabs(vec_dot(d, n)) / (U * size));
        r.normals = fmax(r.normals, vec_length(vec_sub(n, ne)) * fabs(vec_dot(d, n)));
    }
    return r;
}

static void expect_agreement(const char *what, const Shape *shape, Agreement r, double half_ulps)
{
    print_message("  %-24s shape %d: %3zu hits, %zu at edges, t within %.2f half ulps, normals %.1g\n", what,
                  (int)shape->kind, r.hits, r.edges, r.worst, r.normals);
    assert_true(r.hits > RAYS / 4);
    assert_true(r.edges <= RAYS / 100);
    assert_true(r.worst <= half_ulps);
    assert_true(r.normals < 1e-5);
}

// Case C40: what faces (1, 1, 1) faces (1, 1e-6, 1e-12) under scale (1e-6, 1, 1e6), by the inverse transpose.
static void normals_under_a_strong_scale(void **state)
{
    const Affine scale = affine_scale((Vec3){1e-6, 1, 1e6}), one = affine_identity();
    const Vec3 middle = {1.0 / 3, 1.0 / 3, 1.0 / 3}, n = {1, 1, 1};
    const Shape shapes[] = {
        {.kind = SHAPE_PLANE, .as.plane = {middle, n}},
        {.kind = SHAPE_DISK, .as.disk = {middle, n, 1}},
        {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    };
    const double expected[3] = {1, 1e-6, 1e-12}; // its length is 1 to 1e-12
    RayTable table = ray_table_create(RAYS);
    uint64_t random = 6;
    for (size_t i = 0; i < RAYS; ++i) {
        const double y = random_in(&random, 0.2, 0.4), z = random_in(&random, 0.2, 0.4);
        ray_table_add(&table, 0, (float[3]){2e-6f, (float)y, (float)(1e6 * z)}, (float[3]){-1, 0, 0});
    }
    KernelProgram *program = shapes_program_of(*state, source, -1, LANES);
    double worst = 0;
    for (size_t k = 0; k < 2 * sizeof shapes / sizeof *shapes; ++k) {
        static Hits hits;
        const bool instanced = k % 2;
        shoot(program, &shapes[k / 2], instanced ? one : scale, instanced ? scale : one, &table, &hits);
        for (size_t i = 0; i < RAYS; ++i) {
            assert_true(isfinite(hits.column[OUT_T][i]));
            for (int c = 0; c < 3; ++c)
                worst = fmax(worst, ulps_between(expected[c], hits.column[OUT_NG + c][i]));
        }
    }
    kernel_program_destroy(program);
    ray_table_destroy(&table);
    print_message("  each coordinate of the normal within %.2f ulp\n", worst);
    assert_true(worst <= 4);
}

// Case C41: a scale of 1e-13, whose determinant is 0 in float, baked and as an instance; the shape at scale 1
// says what is right, but for the rounding of the rays.
static void tiny_scales(void **state)
{
    static Hits expected, hits;
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const double scale = 1e-13;
    const Affine one = affine_identity(), tiny = affine_scale((Vec3){scale, scale, scale});
    RayTable table = rays_at(one, 1, 3), small = rays_at(one, scale, 3);
    KernelProgram *program = shapes_program_of(*state, source, -1, LANES);
    for (int k = 0; k < SHAPES; ++k) {
        shoot(program, &shapes[k], one, one, &table, &expected);
        shoot(program, &shapes[k], tiny, one, &small, &hits);
        expect_agreement("scale 1e-13, baked", &shapes[k],
                         compare(&small, &expected, &hits, scale, (Vec3){0, 0, 0}), 16);
        shoot(program, &shapes[k], one, tiny, &small, &hits);
        expect_agreement("scale 1e-13, instance", &shapes[k],
                         compare(&small, &expected, &hits, scale, (Vec3){0, 0, 0}), 16);
    }
    kernel_program_destroy(program);
    ray_table_destroy(&table);
    ray_table_destroy(&small);
}

// Case C42: mirrored and sheared instances keep outward outward and are what the baked shape is.
static void mirrored_and_sheared_instances(void **state)
{
    static Hits expected, hits;
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const Affine mirror = affine_scale((Vec3){-1, 1, 1});
    const Affine shear = {.row = {{1, 0.5, 0}, {0, 0.9, 0.3}, {0, 0, 1}}};
    const Vec3 place = {2, -1, -6};
    const Affine maps[] = {mirror, shear, affine_compose(affine_rotate((Vec3){1, 2, 3}, 40),
                                                         affine_compose(mirror, shear))};
    static const char *const names[] = {"mirror", "shear", "mirror, shear and turn"};
    KernelProgram *program = shapes_program_of(*state, source, -1, LANES);
    for (size_t m = 0; m < sizeof maps / sizeof *maps; ++m) {
        const Affine map = affine_compose(affine_translate(place), maps[m]), one = affine_identity();
        RayTable table = rays_at(map, 1, m);
        for (int k = 0; k < SHAPES; ++k) {
            shoot(program, &shapes[k], map, one, &table, &expected);
            shoot(program, &shapes[k], one, map, &table, &hits);
            expect_agreement(names[m], &shapes[k], compare(&table, &expected, &hits, 1, place), 8);
        }
        ray_table_destroy(&table);
    }
    kernel_program_destroy(program);
}

// Which way is outward does not depend on the code that is tested: the first hit from outside faces the ray.
static void outward_stays_outward(void **state)
{
    static Hits hits;
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const Affine map = affine_compose(affine_translate((Vec3){2, -1, -6}), affine_scale((Vec3){1, -1, 1}));
    RayTable table = rays_at(map, 1, 7);
    KernelProgram *program = shapes_program_of(*state, source, -1, LANES);
    for (int k = 0; k < SHAPES; ++k)
        for (int instanced = 0; instanced < 2; ++instanced) {
            const Affine one = affine_identity();
            shoot(program, &shapes[k], instanced ? one : map, instanced ? map : one, &table, &hits);
            const ShapeKind kind = shapes[k].kind;
            for (size_t i = 0; i < RAYS; ++i) {
                const Vec3 n = hit_vector(&hits, i, OUT_NG);
                const Vec3 d = {ray_number(&table, i, RAY_DIR), ray_number(&table, i, RAY_DIR + 1),
                                ray_number(&table, i, RAY_DIR + 2)};
                if (isinf(hits.column[OUT_T][i]) || k == SHAPES - 1) // the last one holds some of the origins
                    continue;
                if (kind == SHAPE_PLANE || kind == SHAPE_DISK) // up in the object, mirrored down
                    assert_true(n.y < 0);
                else if (kind == SHAPE_TRIANGLE)
                    assert_true(n.z > 0);
                else
                    assert_true(vec_dot(n, d) < 1e-5);
            }
        }
    kernel_program_destroy(program);
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(normals_under_a_strong_scale),
        cmocka_unit_test(tiny_scales),
        cmocka_unit_test(mirrored_and_sheared_instances),
        cmocka_unit_test(outward_stays_outward),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
