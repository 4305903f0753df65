// Strong, tiny, mirroring and shearing maps, powers of two, scenes far from the origin.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "layout/bake.h"
#include "selftest/random.h"
#include "selftest/run.h"

enum { RAYS = 512, SHAPES = 10 };

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

// The primitive of an instance: the way from the space outside to its object's.
static Primitive instance_of(Affine map)
{
    const Affine inverse = affine_inverse(map);
    const Vec3 *a = inverse.row, c = map.translation;
    return (Primitive){.row0 = {(f32)a[0].x, (f32)a[0].y, (f32)a[0].z, (f32)c.x},
                       .row1 = {(f32)a[1].x, (f32)a[1].y, (f32)a[1].z, (f32)c.y},
                       .row2 = {(f32)a[2].x, (f32)a[2].y, (f32)a[2].z, (f32)c.z},
                       .kind = PRIMITIVE_INSTANCE};
}

// RAYS rays for each of `shapes` shapes, from around the unit cube under the map, all lengths times scale. At
// the shape's own primitive; where `instanced`, in the space of primitive number `shapes`, the instance.
static RayTable *rays_around(Run *run, Affine map, f64 scale, u32 shapes, bool instanced)
{
    RayTable *table = run_rays(run, shapes * RAYS);
    u64 random = 3;
    for (u32 i = 0; table && i < shapes * RAYS; i++) {
        const Vec3 o = affine_point(map, vec_scale(random_direction(&random), 4));
        const Vec3 to = affine_point(map, vec_scale(random_direction(&random), 0.8));
        ray_table_add_vec(table, i / RAYS, vec_scale(o, scale), vec_normalize(vec_sub(to, o)));
        if (instanced)
            table->targets[PROBE_INSTANCE * (size_t)table->stride + i] = (i32)shapes;
    }
    return table;
}

// Traces such rays at the shapes baked under `in_object`; with `placed`, in an instance under that.
static RayTable *shoot(Run *run, const Shape *shapes, u32 count, Affine in_object, const Affine *placed,
                       Affine around, f64 scale)
{
    Primitive primitives[SHAPES + 1];
    for (u32 k = 0; k < count; k++)
        if (!run_bake(run, &shapes[k], &in_object, &primitives[k]))
            return NULL;
    primitives[count] = instance_of(placed ? *placed : affine_identity());
    RayTable *table = rays_around(run, around, scale, count, placed != NULL);
    return table && run_own(run, primitives, count + 1, table) ? table : NULL;
}

// Lengths times a power of two: the same bits but for the exponent.
static bool powers_of_two(Run *run)
{
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const Affine one = affine_identity();
    const RayTable *table = shoot(run, shapes, SHAPES, one, NULL, one, 1);
    Score score = {0};
    for (int sign = -1; table && sign <= 1; sign += 2) {
        const f64 s = ldexp(1, 20 * sign);
        const RayTable *other = shoot(run, shapes, SHAPES, affine_scale((Vec3){s, s, s}), NULL, one, s);
        if (!other)
            return false;
        for (u32 i = 0; i < table->count; i++) {
            bool same = hit_number(other, i, PROBE_T) == (f32)(s * hit_number(table, i, PROBE_T));
            for (u32 k = 0; k < 3 && isfinite(hit_number(table, i, PROBE_T)); k++) {
                const f32 point = (f32)(s * hit_number(table, i, PROBE_P + k));
                same = same && hit_number(other, i, PROBE_P + k) == point &&
                       hit_number(other, i, PROBE_NG + k) == hit_number(table, i, PROBE_NG + k);
            }
            score_wrong(&score, !same);
        }
    }
    run_add(run, "C7", "every shape times 2^-20 and 2^20: t, point, normal", "its bits", UNIT_WRONG, 0,
            &score);
    return table != NULL;
}

// Compares what a shape of size 1 at `place` gives, all lengths times scale, with what it should give: t
// along the normal in ulps of the numbers that went in. Rays at edges may meet another part or nothing.
static void compare(const RayTable *expected, const RayTable *measured, f64 scale, Vec3 place, Score *t,
                    Score *edges)
{
    for (u32 i = 0; i < expected->count; i++) {
        const f64 e = hit_number(expected, i, PROBE_T), m = (f64)hit_number(measured, i, PROBE_T) / scale;
        if (isinf(e) && isinf(m))
            continue;
        const Vec3 n = hit_vector(measured, i, PROBE_NG), ne = hit_vector(expected, i, PROBE_NG);
        const Vec3 d = ray_vector(measured, i, PROBE_DIR);
        const Vec3 p = vec_scale(hit_vector(measured, i, PROBE_P), 1 / scale);
        const bool edge = isinf(e) || isinf(m) || fabs(m - e) > 1e-4 * e || vec_length(vec_sub(n, ne)) > 1e-3;
        score_wrong(edges, edge);
        const f64 size = vec_length(p) + vec_length(place) + e + 1;
        if (!edge)
            score_value(t, fabs(m - e) * fabs(vec_dot(d, n)) / (0x1p-23 * size));
    }
}

static bool tiny_scales(Run *run)
{
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const f64 s = 1e-13;
    const Affine one = affine_identity(), tiny = affine_scale((Vec3){s, s, s});
    const RayTable *expected = shoot(run, shapes, SHAPES, one, NULL, one, 1);
    const RayTable *baked = expected ? shoot(run, shapes, SHAPES, tiny, NULL, one, s) : NULL;
    const RayTable *placed = baked ? shoot(run, shapes, SHAPES, one, &tiny, one, s) : NULL;
    if (!placed)
        return false;
    Score t = {0}, edges = {0};
    compare(expected, baked, s, (Vec3){0, 0, 0}, &t, &edges);
    compare(expected, placed, s, (Vec3){0, 0, 0}, &t, &edges);
    run_add(run, "C41", "every shape at scale 1e-13, whose determinant is 0", "scale 1", UNIT_ULP, 8, &t);
    run_add(run, "C41", "rays that meet another part there, 1 % at edges", "scale 1", UNIT_WRONG,
            0.01 * edges.answers, &edges);
    return true;
}

static bool mirrors_and_shears(Run *run)
{
    Shape shapes[SHAPES];
    shapes_make(shapes);
    const Vec3 place = {2, -1, -6};
    const Affine mirror = affine_scale((Vec3){-1, 1, 1});
    const Affine shear = {.row = {{1, 0.5, 0}, {0, 0.9, 0.3}, {0, 0, 1}}};
    const Affine turned = affine_compose(affine_rotate((Vec3){1, 2, 3}, 40), affine_compose(mirror, shear));
    const Affine maps[] = {mirror, shear, turned};
    const Affine one = affine_identity();
    Score t = {0}, edges = {0}, inside_out = {0};
    for (u32 m = 0; m < 3; m++) {
        const Affine map = affine_compose(affine_translate(place), maps[m]);
        const RayTable *expected = shoot(run, shapes, SHAPES, map, NULL, map, 1);
        const RayTable *placed = expected ? shoot(run, shapes, SHAPES, one, &map, map, 1) : NULL;
        if (!placed)
            return false;
        compare(expected, placed, 1, place, &t, &edges);
        // From outside a solid its first hit faces the ray.
        for (u32 i = 0; i < placed->count; i++) {
            const ShapeKind kind = shapes[i / RAYS].kind;
            const bool solid = kind != SHAPE_PLANE && kind != SHAPE_DISK && kind != SHAPE_TRIANGLE;
            if (solid && i / RAYS < SHAPES - 1 && isfinite(hit_number(placed, i, PROBE_T)))
                score_wrong(&inside_out, vec_dot(hit_vector(placed, i, PROBE_NG),
                                                 ray_vector(placed, i, PROBE_DIR)) > 1e-5);
        }
    }
    run_add(run, "C42", "mirrored and sheared instances: t", "the baked shape", UNIT_ULP, 4, &t);
    run_add(run, "C42", "rays that meet another part, 1 % at edges", "the baked shape", UNIT_WRONG,
            0.01 * edges.answers, &edges);
    run_add(run, "C42", "normals that point inward", "definition", UNIT_WRONG, 0, &inside_out);
    return true;
}

// What faces (1, 1, 1) faces (1, 1e-6, 1e-12) under scale (1e-6, 1, 1e6).
static bool strong_scale(Run *run)
{
    const Affine scale = affine_scale((Vec3){1e-6, 1, 1e6}), one = affine_identity();
    const Vec3 middle = {1.0 / 3, 1.0 / 3, 1.0 / 3}, n = {1, 1, 1};
    const Shape shapes[4] = {
        {.kind = SHAPE_PLANE, .as.plane = {middle, n}},
        {.kind = SHAPE_DISK, .as.disk = {middle, n, 1}},
        {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
        {.kind = SHAPE_TETRAHEDRON, .as.tetrahedron = {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    };
    static const f64 NORMAL[3] = {1, 1e-6, 1e-12};
    Primitive primitives[9];
    RayTable *table = run_rays(run, 8 * RAYS);
    u64 random = 40;
    for (u32 k = 0; k < 8; k++)
        if (!run_bake(run, &shapes[k % 4], k < 4 ? &scale : &one, &primitives[k]))
            return false;
    primitives[8] = instance_of(scale);
    for (u32 i = 0; table && i < 8 * RAYS; i++) {
        const f64 y = random_in(&random, 0.2, 0.4), z = random_in(&random, 0.2, 0.4);
        ray_table_add_vec(table, i % 8, (Vec3){2e-6, y, 1e6 * z}, (Vec3){-1, 0, 0});
        table->targets[PROBE_INSTANCE * (size_t)table->stride + i] = i % 8 < 4 ? -1 : 8;
    }
    if (!table || !run_own(run, primitives, 9, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < table->count; i++) {
        const bool hit = isfinite(hit_number(table, i, PROBE_T));
        for (u32 k = 0; k < 3; k++)
            score_ulps(&score, NORMAL[k], hit ? hit_number(table, i, PROBE_NG + k) : NAN);
    }
    run_add(run, "C40", "normals under scale (1e-6, 1, 1e6)", "inverse transpose", UNIT_ULP, 4, &score);
    return true;
}

// The same world and the same eye, both `far` from the origin in x and z.
static RayTable *far_scene(Run *run, u32 far)
{
    char text[1024];
    const f64 x = far, z = far;
    snprintf(text, sizeof text,
             "camera { position %.17g 0 %.17g look_at %.17g 0 %.17g }\n"
             "sphere { center %.17g -1.25 %.17g radius 1 }\n"
             "box { min %.17g -1 %.17g max %.17g 0.5 %.17g }\n"
             "torus { center %.17g 1 %.17g axis 1 2 3 major 1.5 minor 0.25 }\n"
             "plane { point %.17g -2 %.17g normal 0 1 0 }\n",
             x, z, x, z - 1, x + 0.5, z - 6, x - 4, z - 7, x - 2.5, z - 5, x + 1, z - 8, x, z);
    RayTable *table = run_rays(run, 8 * RAYS);
    u64 random = 12;
    for (u32 i = 0; table && i < 8 * RAYS; i++)
        ray_table_add_vec(table, 0, random_point(&random, 0.5),
                          (Vec3){random_in(&random, -0.7, 0.7), random_in(&random, -0.4, 0.3), -1});
    return table && run_scene(run, text, table) ? table : NULL;
}

static bool far_scenes(Run *run)
{
    const RayTable *near = far_scene(run, 0);
    Score score = {0};
    for (u32 far = 1000000; near && far <= 10000000; far *= 10) {
        const RayTable *table = far_scene(run, far);
        if (!table)
            return false;
        for (u32 i = 0; i < near->count; i++)
            for (u32 k = PROBE_T; k < PROBE_T + 10; k++)
                score_wrong(&score, hit_number(near, i, k) != hit_number(table, i, k) &&
                                        isfinite(hit_number(near, i, PROBE_T)));
    }
    run_add(run, "C12", "eye and shapes 1e6 and 1e7 from the origin", "its bits at 0", UNIT_WRONG, 0, &score);
    return near != NULL;
}

bool transform_cases(Run *run)
{
    return powers_of_two(run) && far_scenes(run) && strong_scale(run) && tiny_scales(run) &&
           mirrors_and_shears(run);
}
