// Rays and triangles where the answer is known: by exact arithmetic for needles, and by double outside the
// band of single precision for any triangles.
#include "mesh_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const f64 rounding = 0x1p-24;

// ---- needles ----------------------------------------------------------------------------------

// Needles lie in planes of their own across an axis; ray i runs along it through the origin of plane i and
// ends before the next. So neither differences of coordinates nor the shear are rounded, and products of two
// floats are exact in double: the verdict is that of exact arithmetic.
static TriangleList needles_make(u32 count, int axis, u64 *random)
{
    static const f64 shapes[][2] = {{1, 1e-7}, {1e3, 1e-4}, {1e3, 1e-3}, {1, 1e-3}, {1, 1e-12}};
    TriangleList list = {.vertices = NULL};
    for (u32 i = 0; i < count; i++) {
        const f64 *shape = shapes[i % (sizeof shapes / sizeof *shapes)];
        const f64 angle = random_in(random, 0, 2 * acos(-1)), c = cos(angle), s = sin(angle);
        const f64 along = random_in(random, 0.02, 0.98) * shape[0];
        const f64 off = (i % 4 ? random_in(random, -0.7, 0.7) : 0) * shape[1];
        const f64 ends[3][2] = {{-along, off}, {shape[0] - along, off - shape[1] / 2},
                                {shape[0] - along, off + shape[1] / 2}};
        Vec3 v[3];
        for (int k = 0; k < 3; k++) {
            f64 at[3];
            at[axis] = (f64)i;
            at[(axis + 1) % 3] = (f64)(f32)(c * ends[k][0] - s * ends[k][1]);
            at[(axis + 2) % 3] = (f64)(f32)(s * ends[k][0] + c * ends[k][1]);
            v[k] = (Vec3){at[0], at[1], at[2]};
        }
        triangles_add(&list, v[0], v[1 + i % 2], v[2 - i % 2]);
    }
    return list;
}

// 1: the axis runs within the triangle, 0: it does not, -1: it meets an edge exactly.
static int needle_verdict(f32 v[3][3], int axis)
{
    int positive = 0, negative = 0;
    for (int k = 0; k < 3; k++) {
        const f32 *a = v[k], *b = v[(k + 1) % 3];
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        const f64 left = (f64)a[x] * (f64)b[y], right = (f64)a[y] * (f64)b[x];
        positive += left > right;
        negative += left < right;
    }
    if (positive && negative)
        return 0;
    return positive + negative == 3 ? 1 : -1;
}

static void check_needles(KernelProgram *program, Variant variant, u32 count, int axis, u32 hits[2])
{
    u64 random = (u64)axis;
    TriangleList needles = needles_make(count, axis, &random);
    const Affine identity = affine_identity();
    Layout *layout = mesh_layout(&needles, &identity, false);
    FaceTable faces = face_table_create(layout);
    assert_int_equal(faces.count, count);
    Rays rays = rays_create(count);
    for (u32 i = 0; i < rays.count; i++) {
        const u32 needle = i < count ? i : 0;
        const bool up = needle % 3 != 0;
        f32 o[3] = {0, 0, 0}, d[3] = {0, 0, 0};
        o[axis] = (f32)needle + (up ? -0.5F : 0.5F);
        d[axis] = up ? 1 : -1;
        rays_set(&rays, i, o, d);
        rays.numbers[COLUMN_END * rays.count + i] = 1;
    }
    walk(program, variant, layout, 2, &rays);
    u32 wrong = 0;
    for (u32 i = 0; i < count; i++) {
        const int verdict = needle_verdict(faces.vertices[i], axis);
        if (verdict >= 0)
            hits[verdict]++;
        wrong += verdict >= 0 && rays.crossings[i] != (u32)verdict;
        wrong += rays.crossings[i] && (rays.face[i] != i || rays.t[i] != 0.5F);
    }
    if (wrong)
        fail_msg("axis %d, shape %d,%d: %u of %u needles wrong", axis, variant.lanes, variant.batch, wrong,
                 count);
    rays_destroy(&rays);
    face_table_destroy(&faces);
    layout_destroy(layout);
    triangles_destroy(&needles);
}

static void needles_have_the_exact_verdict(void **state)
{
    u32 hits[2] = {0, 0};
    for (int k = 0; k < VARIANTS; k++) {
        KernelProgram *program = walk_program(*state, mesh_variants[k], false);
        for (int axis = 0; axis < 3; axis++)
            check_needles(program, mesh_variants[k], leak_rays(60000) / 15, axis, hits);
        kernel_program_destroy(program);
    }
    print_message("needles: %u hits and %u misses, all as in exact arithmetic\n", hits[1], hits[0]);
    assert_true(hits[0] > 1000 && hits[1] > 1000);
}

// ---- any triangles ----------------------------------------------------------------------------

// What double says of a ray and a triangle whose vertices single precision may have moved within a band.
typedef struct Reference {
    bool surely_hit, surely_missed;
    f64 t, error;     // where surely hit
    f64 least, most;  // of t, where it is neither
} Reference;

static f64 segment_distance(const f64 a[2], const f64 b[2])
{
    const f64 ex = b[0] - a[0], ey = b[1] - a[1], square = ex * ex + ey * ey;
    f64 share = square > 0 ? -(a[0] * ex + a[1] * ey) / square : 0;
    share = fmin(1, fmax(0, share));
    return hypot(a[0] + share * ex, a[1] + share * ey);
}

// The band: a coordinate relative to the origin, the slope of the ray, their product and its sum are rounded
// once each.
static Reference reference_of(f32 v[3][3], const f32 org[3], const f32 dir[3])
{
    Reference r = {false, false, 0, 0, INFINITY, -INFINITY};
    int z = fabsf(dir[0]) >= fabsf(dir[1]) ? 0 : 1;
    z = fabsf(dir[2]) > fabsf(dir[z]) ? 2 : z;
    const int axes[3] = {(z + 1) % 3, (z + 2) % 3, z};
    f64 p[3][2], t[3], largest = 0, farthest = 0, boundary = INFINITY, edges[3];
    for (int k = 0; k < 3; k++) {
        const f64 ahead = (f64)v[k][z] - (f64)org[z];
        for (int c = 0; c < 2; c++) {
            const f64 away = (f64)v[k][axes[c]] - (f64)org[axes[c]];
            p[k][c] = away - (f64)dir[axes[c]] / (f64)dir[z] * ahead;
            largest = fmax(largest, fmax(fabs(away), fabs(ahead)));
        }
        t[k] = ahead / (f64)dir[z];
        farthest = fmax(farthest, fabs(t[k]));
        r.least = fmin(r.least, t[k]);
        r.most = fmax(r.most, t[k]);
    }
    const f64 band = 8 * rounding * largest;
    for (int k = 0; k < 3; k++) {
        const f64 *a = p[(k + 1) % 3], *b = p[(k + 2) % 3];
        boundary = fmin(boundary, segment_distance(a, b));
        edges[k] = a[0] * b[1] - a[1] * b[0];
    }
    const f64 det = edges[0] + edges[1] + edges[2];
    const bool inside = (edges[0] > 0 && edges[1] > 0 && edges[2] > 0) ||
                        (edges[0] < 0 && edges[1] < 0 && edges[2] < 0);
    // How t grows across the ray.
    const f64 e1[2] = {p[1][0] - p[0][0], p[1][1] - p[0][1]}, e2[2] = {p[2][0] - p[0][0], p[2][1] - p[0][1]};
    const f64 gx = ((t[1] - t[0]) * e2[1] - (t[2] - t[0]) * e1[1]) / det;
    const f64 gy = ((t[2] - t[0]) * e1[0] - (t[1] - t[0]) * e2[0]) / det;
    r.t = (edges[0] * t[0] + edges[1] * t[1] + edges[2] * t[2]) / det;
    r.error = hypot(gx, gy) * band + 8 * rounding * farthest;
    r.least -= 8 * rounding * farthest;
    r.most += 8 * rounding * farthest;
    r.surely_hit = inside && boundary > band && r.t > r.error;
    r.surely_missed = (!inside && boundary > band) || r.most < 0;
    return r;
}

// Whether what the device found for a ray can be.
static bool is_possible(const FaceTable *faces, const f32 org[3], const f32 dir[3], f32 t, u32 face)
{
    for (u32 i = 0; i < faces->count; i++) {
        const Reference r = reference_of(faces->vertices[i], org, dir);
        if (r.surely_hit && (face == NO_INDEX || (f64)t > r.t + r.error))
            return false;
    }
    if (face == NO_INDEX)
        return true;
    const Reference r = reference_of(faces->vertices[face], org, dir);
    if (r.surely_missed || !(t > 0))
        return false;
    return r.surely_hit ? fabs((f64)t - r.t) <= r.error : (f64)t >= r.least && (f64)t <= r.most;
}

static void check_soup(KernelProgram **programs, const TriangleList *soup, Affine map, f64 size, u32 count)
{
    Layout *layout = mesh_layout(soup, &map, false);
    FaceTable faces = face_table_create(layout);
    Rays rays = rays_create(count), first = rays_create(count);
    u64 random = 5;
    u32 wrong = 0, hits = 0, other = 0;
    rays_aim_at_soup(&rays, &faces, size, map.translation, &random);
    for (int k = 0; k < VARIANTS; k++) {
        walk(programs[k], mesh_variants[k], layout, 1, &rays);
        if (k == 0) {
            memcpy(first.t, rays.t, count * sizeof(f32));
            memcpy(first.face, rays.face, count * sizeof(u32));
        }
        other += memcmp(first.t, rays.t, count * sizeof(f32)) != 0 ||
                 memcmp(first.face, rays.face, count * sizeof(u32)) != 0;
    }
    for (u32 i = 0; i < rays.count; i++) {
        f32 o[3], d[3];
        for (u32 k = 0; k < 3; k++) {
            o[k] = rays.numbers[(COLUMN_ORG + k) * rays.count + i];
            d[k] = rays.numbers[(COLUMN_DIR + k) * rays.count + i];
        }
        hits += rays.crossings[i] > 0;
        wrong += !is_possible(&faces, o, d, rays.t[i], rays.face[i]);
    }
    print_message("soup of size %g at %g: %u rays, %u hits, %u beyond the error of floats\n", size,
                  map.translation.x, rays.count, hits, wrong);
    assert_int_equal(wrong, 0);
    assert_int_equal(other, 0);
    assert_true(hits > rays.count / 4);
    rays_destroy(&rays);
    rays_destroy(&first);
    face_table_destroy(&faces);
    layout_destroy(layout);
}

static void soups_agree_with_double(void **state)
{
    static const struct {
        f64 scale;
        Vec3 center;
        bool thin;
    } cases[] = {{1, {0, 0, 0}, false},    {1, {0, 0, 0}, true},     {1e-4, {0, 0, 0}, false},
                 {1e6, {0, 0, 0}, true},   {1, {1e3, 0, -1e3}, false}, {100, {148376, 1234, -223423}, true}};
    enum { TRIANGLES = 600, CASES = sizeof cases / sizeof *cases };
    KernelProgram *programs[VARIANTS];
    for (int k = 0; k < VARIANTS; k++)
        programs[k] = walk_program(*state, mesh_variants[k], false);
    for (u32 i = 0; i < CASES; i++) {
        u64 random = i;
        const f64 s = cases[i].scale;
        TriangleList soup = triangles_soup(TRIANGLES, cases[i].thin, &random);
        check_soup(programs, &soup,
                   affine_compose(affine_translate(cases[i].center), affine_scale((Vec3){s, s, s})), s,
                   leak_rays(12288) / CASES / 32 * 32 + 32);
        triangles_destroy(&soup);
    }
    for (int k = 0; k < VARIANTS; k++)
        kernel_program_destroy(programs[k]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(needles_have_the_exact_verdict),
        cmocka_unit_test(soups_agree_with_double),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
