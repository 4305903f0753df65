// Triangles of meshes: needles by exact arithmetic, equal ones, ones that are none; hits that no box hides.
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "selftest/random.h"
#include "selftest/run.h"

static const char MESH_SCENE[] = "mesh { file \"self-test.obj\" }";

// Traces the rays of the table through the mesh alone.
static bool walk_mesh(Run *run, const TriangleList *mesh, u32 steps, RayTable *table)
{
    Layout *layout = run_layout(run, MESH_SCENE, mesh);
    const ProbeHow how = {.mode = PROBE_HIERARCHY, .steps = steps};
    const bool ok = layout && probe_rays(run->probe, layout, how, table, run->error);
    layout_destroy(layout);
    return ok;
}

// ---- needles ----------------------------------------------------------------------------------

// Needles lie in planes of their own across an axis; ray i runs along it through the origin of plane i and
// ends before the next. So neither differences of coordinates nor the shear are rounded.
static TriangleList needles_make(u32 count, u32 axis, u64 *random)
{
    static const f64 SIZES[][2] = {{1, 1e-7}, {1e3, 1e-4}, {1e3, 1e-3}, {1, 1e-3}, {1, 1e-12}};
    TriangleList list = {.vertices = NULL};
    for (u32 i = 0; i < count; i++) {
        const f64 *size = SIZES[i % (sizeof SIZES / sizeof SIZES[0])];
        const f64 angle = random_in(random, 0, 2 * acos(-1)), c = cos(angle), s = sin(angle);
        const f64 along = random_in(random, 0.02, 0.98) * size[0];
        const f64 off = (i % 4 ? random_in(random, -0.7, 0.7) : 0) * size[1];
        const f64 ends[3][2] = {{-along, off}, {size[0] - along, off - size[1] / 2},
                                {size[0] - along, off + size[1] / 2}};
        Vec3 v[3];
        for (u32 k = 0; k < 3; k++) {
            f64 at[3];
            at[axis] = i;
            at[(axis + 1) % 3] = (f64)(f32)(c * ends[k][0] - s * ends[k][1]);
            at[(axis + 2) % 3] = (f64)(f32)(s * ends[k][0] + c * ends[k][1]);
            v[k] = (Vec3){at[0], at[1], at[2]};
        }
        triangles_add(&list, v[0], v[1 + i % 2], v[2 - i % 2]);
    }
    return list;
}

// Products of two floats are exact in double. 1: the axis runs within the triangle, 0: it does not, -1: it
// meets an edge exactly.
static i32 needle_verdict(const Vec3 *v, u32 axis)
{
    u32 positive = 0, negative = 0;
    for (u32 k = 0; k < 3; k++) {
        const Vec3 p = v[k], q = v[(k + 1) % 3];
        const f64 a[3] = {p.x, p.y, p.z}, b[3] = {q.x, q.y, q.z};
        const u32 x = (axis + 1) % 3, y = (axis + 2) % 3;
        positive += a[x] * b[y] > a[y] * b[x];
        negative += a[x] * b[y] < a[y] * b[x];
    }
    if (positive && negative)
        return 0;
    return positive + negative == 3 ? 1 : -1;
}

static bool needles(Run *run)
{
    enum { COUNT = 2048 };
    Score score = {0};
    for (u32 axis = 0; axis < 3; axis++) {
        u64 random = axis;
        TriangleList list = needles_make(COUNT, axis, &random);
        RayTable *table = run_rays(run, COUNT);
        for (u32 i = 0; table && i < COUNT; i++) {
            f32 o[3] = {0, 0, 0}, d[3] = {0, 0, 0};
            o[axis] = (f32)i + (i % 3 ? -0.5F : 0.5F);
            d[axis] = i % 3 ? 1 : -1;
            ray_table_add(table, 0, o, d);
            table->rays[PROBE_TFAR * (size_t)table->stride + i] = 1;
        }
        const bool ok = table && !list.failed && walk_mesh(run, &list, 2, table);
        for (u32 i = 0; ok && i < COUNT; i++) {
            const i32 verdict = needle_verdict(list.vertices + 3 * (size_t)i, axis);
            const i32 met = found_number(table, i, PROBE_CROSSINGS);
            score_wrong(&score, (verdict >= 0 && met != verdict) ||
                                    (met > 0 && hit_number(table, i, PROBE_T) != 0.5F));
        }
        triangles_destroy(&list);
        if (!ok)
            return false;
    }
    run_add(run, "C18", "needles 1 : 1e-3 to 1 : 1e-12, hit or not", "exact arithmetic", UNIT_WRONG, 0,
            &score);
    return true;
}

// ---- soups ------------------------------------------------------------------------------------

// From around the soup or far away at faces and edges, of any length, some along axes.
static void aim_at_soup(RayTable *table, u32 rays, const TriangleList *soup, u64 *random)
{
    for (u32 i = 0; i < rays; i++) {
        const Vec3 *v = soup->vertices + 3 * (size_t)(random_unit(random) * soup->count);
        const f64 b = random_unit(random), c = i % 3 ? random_unit(random) * (1 - b) : 0;
        const Vec3 rest = vec_add(vec_scale(v[1], b), vec_scale(v[2], c));
        const Vec3 target = vec_add(vec_scale(v[0], 1 - b - c), rest);
        const f64 far = i % 7 < 2 ? random_scale(random, 1, 6) : 1;
        const Vec3 o = vec_scale(random_point(random, i % 5 ? 2 : 0.5), far);
        Vec3 d = vec_scale(vec_sub(target, o), i % 2 ? 1 : random_scale(random, -3, 3));
        if (i % 11 == 0)
            d.y = i % 2 ? 0.0 : -0.0;
        if (i % 22 == 0)
            d.z = 0;
        ray_table_add_vec(table, 0, o, d);
    }
}

// Of triangles in one place the first of the file is hit; the others follow at the same t.
static bool equal_triangles(Run *run)
{
    enum { COPIES = 12, TRIANGLES = 100, RAYS = 4096 };
    u64 random = 21;
    TriangleList soup = triangles_soup(TRIANGLES, false, &random);
    for (u32 i = TRIANGLES; i < COPIES * TRIANGLES && !soup.failed; i++) {
        const Vec3 *v = soup.vertices + 3 * (size_t)((i * 37 + i / TRIANGLES) % TRIANGLES);
        const Vec3 a = v[0], b = v[1], c = v[2];
        triangles_add(&soup, a, b, c);
    }
    RayTable *table = run_rays(run, RAYS);
    if (table && !soup.failed)
        aim_at_soup(table, RAYS, &soup, &random);
    const bool ok = table && !soup.failed && walk_mesh(run, &soup, COPIES, table);
    triangles_destroy(&soup);
    Score score = {0};
    for (u32 i = 0; ok && i < RAYS; i++) {
        const i32 met = found_number(table, i, PROBE_CROSSINGS);
        if (met > 0)
            score_wrong(&score, met != COPIES || found_number(table, i, PROBE_FOUND) >= TRIANGLES);
    }
    if (ok)
        run_add(run, "C21", "12 copies of each of 100 triangles: the first is hit", "order of the file",
                UNIT_WRONG, 0, &score);
    return ok;
}

// Makes faces whose number is no multiple of 4 triangles that are none: two equal vertices, or three.
static void spoil(TriangleList *list)
{
    for (u32 i = 0; i < list->count; i++) {
        Vec3 *v = list->vertices + 3 * (size_t)i;
        if (i % 4 == 1 || i % 4 == 3)
            v[1] = v[0];
        if (i % 4 >= 2)
            v[2] = v[0];
    }
}

static bool spoilt_triangles(Run *run)
{
    enum { TRIANGLES = 1200, RAYS = 4096 };
    u64 random = 20;
    TriangleList soup = triangles_soup(TRIANGLES, false, &random);
    RayTable *table = run_rays(run, RAYS);
    if (table && !soup.failed)
        aim_at_soup(table, RAYS, &soup, &random);
    spoil(&soup);
    const bool ok = table && !soup.failed && walk_mesh(run, &soup, 1, table);
    triangles_destroy(&soup);
    Score score = {0};
    for (u32 i = 0; ok && i < RAYS; i++)
        if (found_number(table, i, PROBE_CROSSINGS) > 0)
            score_wrong(&score, found_number(table, i, PROBE_FOUND) % 4 != 0 ||
                                    !isfinite(hit_number(table, i, PROBE_T)));
    if (ok)
        run_add(run, "C20", "mesh with faces without area among others", "never hit", UNIT_WRONG, 0, &score);
    return ok;
}

// ---- boxes of the hierarchy -------------------------------------------------------------------

// Traces the rays with and without boxes; counts those for which it makes a difference.
static bool compare_with_boxes(Run *run, const Layout *layout, RayTable *table, Score *score)
{
    RayTable *other = run_rays(run, table->count);
    if (!other)
        return false;
    for (u32 i = 0; i < table->count; i++)
        ray_table_add_vec(other, 0, ray_vector(table, i, PROBE_ORG), ray_vector(table, i, PROBE_DIR));
    const ProbeHow by_boxes = {.mode = PROBE_HIERARCHY, .steps = 1}, each = {.mode = PROBE_EACH};
    if (!probe_rays(run->probe, layout, by_boxes, table, run->error) ||
        !probe_rays(run->probe, layout, each, other, run->error))
        return false;
    for (u32 i = 0; i < table->count; i++)
        if (isfinite(hit_number(other, i, PROBE_T)))
            score_wrong(score,
                        hit_number(table, i, PROBE_T) != hit_number(other, i, PROBE_T) ||
                            found_number(table, i, PROBE_FOUND) != found_number(other, i, PROBE_FOUND));
    return true;
}

static bool boxes_of_soups(Run *run)
{
    enum { TRIANGLES = 400, RAYS = 1 << 13 };
    Score score = {0};
    for (u32 thin = 0; thin < 2; thin++) {
        u64 random = 23 + thin;
        TriangleList soup = triangles_soup(TRIANGLES, thin, &random);
        RayTable *table = run_rays(run, RAYS);
        if (table && !soup.failed)
            aim_at_soup(table, RAYS, &soup, &random);
        Layout *layout = table && !soup.failed ? run_layout(run, MESH_SCENE, &soup) : NULL;
        const bool ok = layout && compare_with_boxes(run, layout, table, &score);
        layout_destroy(layout);
        triangles_destroy(&soup);
        if (!ok)
            return false;
    }
    run_add(run, "C23", "rays at edges of triangles: hits that boxes hide", "every triangle", UNIT_WRONG, 0,
            &score);
    return true;
}

// Squares across the axes, whose boxes have no extent along one: rays at them and at their edges.
static bool flat_boxes(Run *run)
{
    enum { SQUARES = 256, RAYS = 1 << 13 };
    u64 random = 24;
    TriangleList list = {.vertices = NULL};
    for (u32 i = 0; i < SQUARES; i++) {
        const u32 axis = i % 3, u = (axis + 1) % 3, v = (axis + 2) % 3;
        const Vec3 c = random_point(&random, 1);
        const f64 half = random_in(&random, 0.01, 0.3);
        f64 middle[3] = {c.x, c.y, c.z};
        middle[axis] = floor(8 * middle[axis]) / 8; // some overlap in one plane: the first of the file is hit
        Vec3 p[4];
        for (u32 k = 0; k < 4; k++) {
            f64 at[3] = {middle[0], middle[1], middle[2]};
            at[u] += k == 1 || k == 2 ? half : -half;
            at[v] += k >= 2 ? half : -half;
            p[k] = (Vec3){at[0], at[1], at[2]};
        }
        triangles_add(&list, p[0], p[1], p[2]);
        triangles_add(&list, p[0], p[2], p[3]);
    }
    RayTable *table = run_rays(run, RAYS);
    if (table && !list.failed)
        aim_at_soup(table, RAYS, &list, &random);
    Layout *layout = table && !list.failed ? run_layout(run, MESH_SCENE, &list) : NULL;
    Score score = {0};
    const bool ok = layout && compare_with_boxes(run, layout, table, &score);
    layout_destroy(layout);
    triangles_destroy(&list);
    if (ok)
        run_add(run, "C24", "squares across the axes: hits that flat boxes hide", "every triangle",
                UNIT_WRONG, 0, &score);
    return ok;
}

// Boxes of the scene, whose boxes in the hierarchy are just as large, at edges and corners.
static bool boxes_of_boxes(Run *run)
{
    enum { BOXES = 100, RAYS = 1 << 13, BYTES = 1 << 15 };
    char *text = run_alloc(run, BYTES, 1);
    RayTable *table = run_rays(run, RAYS);
    Vec3 low[BOXES], high[BOXES];
    u64 random = 22;
    size_t used = 0;
    for (u32 i = 0; text && i < BOXES; i++) {
        low[i] = random_point(&random, 1);
        high[i] = vec_add(low[i], vec_add(random_point(&random, 0.05), (Vec3){0.06, 0.06, 0.06}));
        used += (size_t)snprintf(text + used, BYTES - used, "box { min %.9g %.9g %.9g max %.9g %.9g %.9g }\n",
                                 low[i].x, low[i].y, low[i].z, high[i].x, high[i].y, high[i].z);
    }
    for (u32 i = 0; text && table && i < RAYS; i++) {
        const Vec3 a = low[i % BOXES], b = high[i % BOXES];
        const u32 free_axis = i % 4;
        const Vec3 share = {free_axis == 0 ? random_unit(&random) : random_unit(&random) < 0.5,
                            free_axis == 1 ? random_unit(&random) : random_unit(&random) < 0.5,
                            free_axis == 2 ? random_unit(&random) : random_unit(&random) < 0.5};
        const Vec3 edge = {a.x + share.x * (b.x - a.x), a.y + share.y * (b.y - a.y),
                           a.z + share.z * (b.z - a.z)};
        const Vec3 o = vec_scale(random_point(&random, 2), i % 7 < 2 ? random_scale(&random, 1, 6) : 1);
        ray_table_add_vec(table, 0, o, vec_sub(edge, o));
    }
    Layout *layout = text && table ? run_layout(run, text, NULL) : NULL;
    Score score = {0};
    const bool ok = layout && compare_with_boxes(run, layout, table, &score);
    layout_destroy(layout);
    if (ok)
        run_add(run, "C23", "rays at edges of boxes: hits that boxes hide", "every shape", UNIT_WRONG, 0,
                &score);
    return ok;
}

bool triangle_cases(Run *run)
{
    return needles(run) && spoilt_triangles(run) && equal_triangles(run) && boxes_of_soups(run) &&
           flat_boxes(run) && boxes_of_boxes(run);
}
