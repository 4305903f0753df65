// Planes, boxes and triangles of their own: rays along faces, through edges and corners; points exactly on
// planes; slivers and triangles that are none.
#include <math.h>

#include "layout/bake.h"
#include "selftest/random.h"
#include "selftest/run.h"

static const Vec3 ORIGIN = {0, 0, 0};

typedef struct Aim {
    Vec3 org, dir;
    f64 t;
} Aim;

static void add_aims(Sheet *sheet, const Aim *aims, u32 count)
{
    for (u32 i = 0; i < count; i++)
        sheet_ray(sheet, aims[i].org, aims[i].dir, aims[i].t);
}

// Returns the row of the first ray of C39.
static u32 boxes(Sheet *sheet)
{
    static const Aim ZEROS[] = {
        {{0, 0, 0}, {1, 0, 0}, 1},         {{0, 0, 0}, {1, -0.0, -0.0}, 1},
        {{-3, 2, 0}, {1, 0, 0}, INFINITY}, {{-3, 2, 0}, {1, -0.0, 0}, INFINITY},
        {{-3, 1, 0}, {1, 0, 0}, 2},        {{-3, -1, 0}, {1, -0.0, -0.0}, 2},
    };
    static const Aim EDGES[] = {
        {{-3, 1, 1}, {1, 0, 0}, 2},        {{-3, -3, -3}, {1, 1, 1}, 2}, {{-3, -3, 0}, {1, 1, 0}, 2},
        {{1, 0, 0}, {1, 0, 0}, INFINITY},  {{1, 0, 0}, {-1, 0, 0}, 2},   {{3, 0, 0}, {1, 0, 0}, INFINITY},
        {{0, 0, 0}, {0, -1, 0}, 1},        {{-3, 0.5, 1}, {1, 0, 0}, 2},
    };
    const Shape box = {.kind = SHAPE_BOX, .as.box = {{-1, -1, -1}, {1, 1, 1}}};
    sheet_shape(sheet, &box, affine_identity());
    sheet_case(sheet, "C22", "box, components +0 and -0: in, out, on a face", "closed form", UNIT_ULP, 0);
    add_aims(sheet, ZEROS, sizeof ZEROS / sizeof ZEROS[0]);
    sheet_case(sheet, "C39", "box: along faces and edges, corners, from inside", "closed form", UNIT_ULP, 1);
    const u32 first = sheet->table->count;
    add_aims(sheet, EDGES, sizeof EDGES / sizeof EDGES[0]);
    return first;
}

// The normal of a face is an axis, also where faces meet.
static void judge_face_normals(Run *run, const Sheet *sheet, u32 first, u32 last)
{
    Score score = {0};
    for (u32 row = first; row < last; row++) {
        const Vec3 n = hit_vector(sheet->table, row, PROBE_NG), d = ray_vector(sheet->table, row, PROBE_DIR);
        const bool axis = fabs(n.x) + fabs(n.y) + fabs(n.z) == 1 && vec_dot(n, n) == 1;
        if (!isinf(sheet->exact[row]))
            score_wrong(&score, !axis || vec_dot(n, d) == 0);
    }
    run_add(run, "C39", "their normals: an axis that the ray crosses", "definition", UNIT_WRONG, 0, &score);
}

// As it stands: also where no normal is known.
static Primitive triangle_of(Vec3 a, Vec3 b, Vec3 c)
{
    const Shape shape = {.kind = SHAPE_TRIANGLE, .as.triangle = {.vertices = {a, b, c}}};
    const Affine identity = affine_identity();
    Primitive p;
    BakedBounds bounds;
    Error error;
    if (!bake_shape(&shape, &identity, &p, &bounds, &error)) {
        p.row0.w = p.row1.w = p.p1 = 0;
        p.row2.w = 1;
    }
    return p;
}

static void triangles(Sheet *sheet)
{
    const Vec3 ahead = {0, 0, -1}, one = {1, 2, 3}, other = {4, 5, 6};
    const f64 s = 2e-4;
    sheet_case(sheet, "C16", "triangle with edges of 2e-4", "closed form", UNIT_ULP, 1);
    sheet_primitive(sheet, triangle_of((Vec3){0, 0, -1}, (Vec3){s, 0, -1}, (Vec3){0, s, -1}));
    sheet_ray(sheet, (Vec3){s / 3, s / 3, 0}, ahead, 1);
    sheet_case(sheet, "C18", "needles 1 : 1e-7 and 1e3 : 1e-4", "closed form", UNIT_ULP, 1);
    sheet_primitive(sheet, triangle_of((Vec3){-0.5, 0, -1}, (Vec3){0.5, 0, -1}, (Vec3){0.5, 1e-7, -1}));
    sheet_ray(sheet, (Vec3){0.25, 3e-8, 0}, ahead, 1);
    sheet_primitive(sheet, triangle_of((Vec3){-500, 0, -1}, (Vec3){500, 0, -1}, (Vec3){500, 1e-4, -1}));
    sheet_ray(sheet, (Vec3){250, 3e-5, 0}, ahead, 1);
    sheet_case(sheet, "C19", "three points on a line (pbrt Triangle.BadCases)", "no hit", UNIT_WRONG, 0);
    sheet_primitive(sheet, triangle_of((Vec3){-1113.45459, -79.049614, -56.2431908},
                                       (Vec3){-1113.45459, -87.0922699, -56.2431908},
                                       (Vec3){-1113.45459, -79.2090149, -56.2431908}));
    sheet_ray(sheet, (Vec3){-1081.47925, 99.9999542, 87.7701111},
              (Vec3){-32.1072998, -183.355865, -144.607635}, INFINITY);
    sheet_case(sheet, "C20", "two or three equal vertices", "no hit", UNIT_WRONG, 0);
    sheet_primitive(sheet, triangle_of(one, one, other));
    sheet_ray(sheet, ORIGIN, one, INFINITY);
    sheet_primitive(sheet, triangle_of(one, one, one));
    sheet_ray(sheet, ORIGIN, one, INFINITY);
}

static void parallel_planes(Sheet *sheet)
{
    const Shape floor = {.kind = SHAPE_PLANE, .as.plane = {{0, 0, 0}, {0, 1, 0}}};
    const f64 height = 1.7F;
    sheet_shape(sheet, &floor, affine_translate((Vec3){0, -1.7, 0}));
    sheet_case(sheet, "C38", "plane parallel to the ray, also that holds it", "no hit", UNIT_WRONG, 0);
    sheet_ray(sheet, ORIGIN, (Vec3){1, 0, 0}, INFINITY);
    sheet_ray(sheet, (Vec3){0, -height, 0}, (Vec3){1, 0, 0}, INFINITY);
    sheet_ray(sheet, ORIGIN, (Vec3){1, 1e-7, 0}, INFINITY);
    sheet_case(sheet, "C38", "d.n = 1e-7 and 1e-30", "h / d.n", UNIT_ULP, 2);
    sheet_ray(sheet, ORIGIN, (Vec3){1, -1e-7, 0}, height / (f64)1e-7F);
    sheet_ray(sheet, ORIGIN, (Vec3){1, -1e-30, 0}, height / (f64)1e-30F);
}

// Every point of a floor lies on it, to the last bit.
static bool points_on_planes(Run *run)
{
    enum { RAYS = 32768 };
    const Shape floor = {.kind = SHAPE_PLANE, .as.plane = {{0, 0, 0}, {0, 1, 0}}};
    const Affine map = affine_translate((Vec3){0, -1.7, 0});
    Primitive primitive;
    RayTable *table = run_rays(run, RAYS);
    if (!table || !run_bake(run, &floor, &map, &primitive))
        return false;
    u64 random = 37;
    for (u32 i = 0; i < RAYS; i++) {
        const Vec3 d = random_direction(&random);
        ray_table_add_vec(table, 0, ORIGIN, (Vec3){d.x, -fabs(d.y) - 1e-7, d.z});
    }
    if (!run_own(run, &primitive, 1, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < RAYS; i++)
        score_wrong(&score, isinf(hit_number(table, i, PROBE_T)) ||
                                hit_number(table, i, PROBE_P + 1) != -1.7F);
    run_add(run, "C37", "points of a floor 1.7 below: y = -1.7", "definition", UNIT_WRONG, 0, &score);
    return true;
}

// Both sides of a slab 1e-7 thick and 1e3 wide: the upper one is met first, or both at the same t.
static bool thin_slabs(Run *run)
{
    enum { RAYS = 4096 };
    const f64 high = -1, low = -1 - 0x1p-23;
    const Shape shapes[3][2] = {
        {{.kind = SHAPE_PLANE, .as.plane = {{0, high, 0}, {0, 1, 0}}},
         {.kind = SHAPE_PLANE, .as.plane = {{0, low, 0}, {0, 1, 0}}}},
        {{.kind = SHAPE_DISK, .as.disk = {{0, high, 0}, {0, 1, 0}, 500}},
         {.kind = SHAPE_DISK, .as.disk = {{0, low, 0}, {0, 1, 0}, 500}}},
        {{.kind = SHAPE_TRIANGLE,
          .as.triangle = {.vertices = {{-1000, high, -500}, {1000, high, -500}, {0, high, 1500}}}},
         {.kind = SHAPE_TRIANGLE,
          .as.triangle = {.vertices = {{-1000, low, -500}, {1000, low, -500}, {0, low, 1500}}}}},
    };
    RayTable *table = run_rays(run, 6 * RAYS);
    Primitive primitives[6];
    const Affine identity = affine_identity();
    if (!table)
        return false;
    u64 random = 25;
    for (u32 k = 0; k < 6; k++)
        if (!run_bake(run, &shapes[k / 2][k % 2], &identity, &primitives[k]))
            return false;
    for (u32 i = 0; i < 3 * RAYS; i++) {
        const Vec3 to = {random_in(&random, -300, 300), high, random_in(&random, -300, 300)};
        const Vec3 o = {random_in(&random, -1, 1), random_in(&random, -0.9, 0), random_in(&random, -1, 1)};
        const Vec3 d = vec_normalize(vec_sub(to, o));
        ray_table_add_vec(table, 2 * (i / RAYS), o, d);
        ray_table_add_vec(table, 2 * (i / RAYS) + 1, o, d);
    }
    if (!run_own(run, primitives, 6, table))
        return false;
    Score score = {0};
    for (u32 i = 0; i < 6 * RAYS; i += 2)
        score_wrong(&score, !(hit_number(table, i, PROBE_T) <= hit_number(table, i + 1, PROBE_T)) ||
                                isinf(hit_number(table, i + 1, PROBE_T)));
    run_add(run, "C25", "two sheets 1e-7 apart, 1e3 wide: the order", "definition", UNIT_WRONG, 0, &score);
    return true;
}

bool flat_cases(Run *run)
{
    Sheet *sheet = sheet_create(run);
    if (!sheet)
        return false;
    const u32 first = boxes(sheet), last = sheet->table->count;
    triangles(sheet);
    parallel_planes(sheet);
    if (!sheet_run(sheet))
        return false;
    judge_face_normals(run, sheet, first, last);
    return points_on_planes(run) && thin_slabs(run);
}
