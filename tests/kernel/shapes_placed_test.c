// Surfaces of instanced objects in the space outside, and hit points in the space of their shape.
#include "shapes_support.h"

#include <math.h>

enum { RAYS = 20000, LANES = 8 };

static const double U = 0x1p-24;

static const char source[] =
    "#include \"shapes/shapes.h\"\n"
    "#include \"shapes/object_frame.h\"\n"
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
    // records: the shape, then the map of its instance. out: t, p, error, ng, object point and normal.
    "kernel void place(global const float *records, global const ObjectFrame *frame, global const float "
    "*rays,\n"
    "                  global float *out, uint n)\n"
    "{\n"
    "    const size_t i = get_global_id(0) * LANES;\n"
    "    const PrimitiveLanes shape = splat(records), map = splat(records + 16);\n"
    "    const v3 org = v3_make(VF_LOAD(rays + i), VF_LOAD(rays + n + i), VF_LOAD(rays + 2 * n + i));\n"
    "    const v3 dir = v3_make(VF_LOAD(rays + 3 * n + i), VF_LOAD(rays + 4 * n + i), VF_LOAD(rays + 5 * n + "
    "i));\n"
    "    RayLanes ray;\n"
    "    ray.org = canonical_point(&map, org);\n"
    "    ray.dir = canonical_direction(&map, dir);\n"
    "    ray.tmin = (vf)(0.0f);\n"
    "    ray.self = ray.inward = (vm)(0);\n"
    "    const vf t = intersect_primitive(0, &shape, &ray);\n"
    "    SurfaceLanes s;\n"
    "    surface_primitive((vi)(0), &shape, &ray, t, &s);\n"
    "    const ObjectPoint o = object_point(frame, (vi)(0), s.p, s.ng);\n"
    "    surface_place(&map, org, dir, t, &s);\n"
    "    const v3 at = v3_add(o.whole, o.fine);\n"
    "    const v3 columns[5] = { s.p, s.error, s.ng, at, o.normal };\n"
    "    VF_STORE(t, out + i);\n"
    "    for (int k = 0; k < 5; k++) {\n"
    "        VF_STORE(columns[k].x, out + (3 * k + 1) * n + i);\n"
    "        VF_STORE(columns[k].y, out + (3 * k + 2) * n + i);\n"
    "        VF_STORE(columns[k].z, out + (3 * k + 3) * n + i);\n"
    "    }\n"
    "}\n";

enum { OUT_P = 1, OUT_ERROR = 4, OUT_NG = 7, OUT_OBJECT = 10, OUT_NORMAL = 13, OUT_COLUMNS = 16 };

static float out[OUT_COLUMNS * RAYS];

static Vec3 out_vector(size_t i, size_t column)
{
    return (Vec3){out[column * RAYS + i], out[(column + 1) * RAYS + i], out[(column + 2) * RAYS + i]};
}

static Primitive map_record(const Affine *map)
{
    const Affine inverse = affine_inverse(*map);
    const Vec3 *a = inverse.row, c = map->translation;
    return (Primitive){.row0 = {(f32)a[0].x, (f32)a[0].y, (f32)a[0].z, (f32)c.x},
                       .row1 = {(f32)a[1].x, (f32)a[1].y, (f32)a[1].z, (f32)c.y},
                       .row2 = {(f32)a[2].x, (f32)a[2].y, (f32)a[2].z, (f32)c.z}};
}

// A unit sphere, moved within its object and placed by a map that stretches, mirrors and turns.
static void instances_keep_points_and_normals(void **state)
{
    const Shape sphere = {.kind = SHAPE_SPHERE, .as.sphere = {{0, 0, 0}, 1}};
    const Affine in_object =
        affine_compose(affine_translate((Vec3){5, 0, -2}), affine_rotate((Vec3){0, 1, 0}, 30));
    const Affine placed =
        affine_compose(affine_translate((Vec3){30, -20, 10}),
                       affine_compose(affine_rotate((Vec3){1, 1, 0}, 50), affine_scale((Vec3){2, -0.5, 3})));
    const Affine whole = affine_compose(placed, in_object), back = affine_inverse(whole);
    Primitive records[2] = {{.kind = 0}};
    BakedBounds bounds;
    ObjectFrame frame;
    Error error;
    assert_true(bake_shape(&sphere, &in_object, &records[0], &bounds, &error));
    assert_true(bake_object_frame(&in_object, &frame, &error));
    records[1] = map_record(&placed);
    RayTable table = ray_table_create(RAYS);
    uint64_t random = 4;
    for (size_t i = 0; i < RAYS; ++i) {
        const Vec3 o = {random_in(&random, -50, 50), random_in(&random, -50, 50),
                        random_in(&random, -50, 50)};
        double s[3];
        random_direction(&random, s);
        const Vec3 d =
            vec_normalize(vec_sub(affine_point(whole, (Vec3){0.9 * s[0], 0.9 * s[1], 0.9 * s[2]}), o));
        ray_table_add(&table, 0, (float[3]){(float)o.x, (float)o.y, (float)o.z},
                      (float[3]){(float)d.x, (float)d.y, (float)d.z});
    }
    KernelProgram *program = kernel_program_create_with(
        *state, source, LANES,
        "-Werror -DHAS_UV=0 -DHAS_SPHERE=1 -DHAS_GIANT_SPHERE=0 -DHAS_ELLIPSOID=0 -DHAS_PLANE=0 -DHAS_BOX=0 "
        "-DHAS_TETRAHEDRON=0 -DHAS_DISK=0 -DHAS_CYLINDER=0 -DHAS_CONE=0 -DHAS_TORUS=0 "
        "-DHAS_RECTANGLE=0 -DHAS_TRIANGLE=0");
    const uint32_t n = RAYS;
    kernel_run(program, "place", RAYS / LANES,
               (KernelArg[]){kernel_in(records, sizeof records), kernel_in(&frame, sizeof frame),
                             kernel_in(table.rays, RAY_COLUMNS * RAYS * sizeof(float)),
                             kernel_out(out, sizeof out), kernel_value(&n, sizeof n)},
               5);
    kernel_program_destroy(program);
    double worst_bound = 0, worst_normal = 0, widest = 0;
    for (size_t i = 0; i < RAYS; ++i) {
        assert_true(isfinite(out[i]));
        const Vec3 p = out_vector(i, OUT_P), ng = out_vector(i, OUT_NG), e = out_vector(i, OUT_ERROR);
        const Vec3 q = affine_point(back, p), exact = affine_normal(whole, q);
        worst_normal = fmax(worst_normal, vec_length(vec_sub(exact, ng)));
        // |q| - 1 over the length of its gradient is the distance outside.
        const Vec3 g = {back.row[0].x * q.x + back.row[1].x * q.y + back.row[2].x * q.z,
                        back.row[0].y * q.x + back.row[1].y * q.y + back.row[2].y * q.z,
                        back.row[0].z * q.x + back.row[1].z * q.y + back.row[2].z * q.z};
        const double distance = fabs(vec_length(q) - 1) / vec_length(g);
        const double bound = fabs(ng.x) * e.x + fabs(ng.y) * e.y + fabs(ng.z) * e.z;
        const double rounding = U * (vec_length(p) + vec_length(placed.translation));
        // Rounding the numbers of sphere and map makes them another sphere, by some roundings of its place.
        worst_bound = fmax(worst_bound, (distance - 3 * rounding) / bound);
        widest = fmax(widest, bound / rounding);
        assert_true(vec_length(vec_sub(out_vector(i, OUT_OBJECT), q)) < 1e-4);
        assert_true(vec_length(vec_sub(out_vector(i, OUT_NORMAL), vec_normalize(q))) < 1e-4);
    }
    print_message("distance over bound %.2f, bound %.1f roundings, normals within %.1g\n", worst_bound,
                  widest, worst_normal);
    assert_true(worst_bound <= 1);
    assert_true(worst_normal < 2e-4);
    assert_true(widest <= 64);
    ray_table_destroy(&table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(instances_keep_points_and_normals)};
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
