// No ray slips through a closed mesh, and none counts a shared edge twice, at any size and place and in every
// shape of kernels, which must also agree in every bit.
#include "mesh_support.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

// What happened to the rays of a case in one variant.
typedef struct Verdict {
    u32 leaks; // met nothing
    u32 wrong; // met the surface an even number of times, or more than once where once is right
    u32 other; // differs from the first variant
} Verdict;

static Verdict judge(const Rays *rays, const Rays *first, bool once)
{
    Verdict verdict = {0, 0, 0};
    for (u32 i = 0; i < rays->count; i++) {
        verdict.leaks += rays->crossings[i] == 0;
        verdict.wrong += rays->crossings[i] > 1 && (once || rays->crossings[i] % 2 == 0);
        verdict.other += memcmp(&rays->t[i], &first->t[i], sizeof(f32)) != 0 ||
                         rays->face[i] != first->face[i] || rays->crossings[i] != first->crossings[i];
    }
    return verdict;
}

// Whether the surface shows its inner side to every point within `spread` of the centre along each axis: then
// a ray from there meets it once. Faces that rounding has left without area do not count.
static bool is_seen_whole(const FaceTable *faces, Vec3 center, f64 spread)
{
    for (u32 i = 0; i < faces->count; i++) {
        Vec3 v[3];
        for (int k = 0; k < 3; k++)
            v[k] = vec_sub((Vec3){(f64)faces->vertices[i][k][0], (f64)faces->vertices[i][k][1],
                                  (f64)faces->vertices[i][k][2]}, center);
        const Vec3 n = vec_cross(vec_sub(v[1], v[0]), vec_sub(v[2], v[0]));
        const f64 length = vec_length(n);
        if (length > 0 && vec_dot(n, v[0]) < 1.8 * spread * length)
            return false;
    }
    return true;
}

// Rays from near the centre at points of edges and at vertices of the mesh as it was rounded.
static void aim_at_edges(Rays *rays, const FaceTable *faces, Vec3 center, f64 spread)
{
    u64 random = 1;
    const f64 middle[3] = {center.x, center.y, center.z};
    for (u32 i = 0; i < rays->count; i++) {
        f32 (*v)[3] = faces->vertices[(u32)(random_unit(&random) * faces->count)];
        const int from = (int)(random_unit(&random) * 3), to = (from + 1) % 3;
        const f32 share = i % 4 == 0 ? 0 : i % 4 == 1 ? 0.5F : (f32)random_unit(&random);
        f32 o[3], d[3], length = 0;
        for (int k = 0; k < 3; k++) {
            o[k] = (f32)(middle[k] + (i % 3 ? random_in(&random, -spread, spread) : 0));
            d[k] = v[from][k] + share * (v[to][k] - v[from][k]) - o[k];
            length += d[k] * d[k];
        }
        length = sqrtf(length);
        for (int k = 0; k < 3 && i % 2; k++)
            d[k] /= length;
        rays_set(rays, i, o, d);
    }
}

typedef struct Walkers {
    KernelProgram *programs[VARIANTS];
    u32 rays[VARIANTS], leaks[VARIANTS], wrong[VARIANTS], other[VARIANTS];
} Walkers;

static Walkers walkers_create(KernelDevice *device)
{
    Walkers walkers = {{NULL}, {0}, {0}, {0}, {0}};
    for (int k = 0; k < VARIANTS; k++)
        walkers.programs[k] = walk_program(device, mesh_variants[k], false);
    return walkers;
}

// Prints the counts, and fails the test where any is not 0.
static void walkers_finish(Walkers *walkers)
{
    u32 bad = 0;
    print_message("shape      rays        leaks  wrong counts  other than the first shape\n");
    for (int k = 0; k < VARIANTS; k++) {
        const Variant v = mesh_variants[k];
        print_message("%2d,%2d,%-2d   %-10u  %-5u  %-12u  %u\n", v.lanes, v.batch, v.group, walkers->rays[k],
                      walkers->leaks[k], walkers->wrong[k], walkers->other[k]);
        bad += walkers->leaks[k] + walkers->wrong[k] + walkers->other[k];
        kernel_program_destroy(walkers->programs[k]);
    }
    assert_int_equal(bad, 0);
}

static void run_all(Walkers *walkers, const Layout *layout, Rays *rays, bool once, const char *what)
{
    Rays first = rays_create(rays->count);
    for (int k = 0; k < VARIANTS; k++) {
        walk(walkers->programs[k], mesh_variants[k], layout, 32, rays);
        if (k == 0) {
            memcpy(first.t, rays->t, rays->count * sizeof(f32));
            memcpy(first.face, rays->face, rays->count * sizeof(u32));
            memcpy(first.crossings, rays->crossings, rays->count * sizeof(u32));
        }
        const Verdict verdict = judge(rays, &first, once);
        walkers->rays[k] += rays->count;
        walkers->leaks[k] += verdict.leaks;
        walkers->wrong[k] += verdict.wrong;
        walkers->other[k] += verdict.other;
        if (verdict.leaks + verdict.wrong + verdict.other)
            print_message("%s, shape %d,%d: of %u rays %u leaks, %u wrong counts, %u other than the first\n",
                          what, mesh_variants[k].lanes, mesh_variants[k].batch, rays->count, verdict.leaks,
                          verdict.wrong, verdict.other);
    }
    rays_destroy(&first);
}

static const struct {
    f64 scale;
    Vec3 center;
    u32 share; // of the rays: one in so many, where all boxes overlap for want of digits
} places[] = {
    {1, {0, 0, 0}, 1},        {1e-4, {0, 0, 0}, 1},              {1e6, {0, 0, 0}, 1},
    {1, {1e3, 0, -1e3}, 1},   {100, {148376, 1234, -223423}, 1}, {1, {1e6, 0, 1e6}, 32},
    {1, {0.3, -0.7, 0.1}, 1},
};
enum { PLACES = sizeof places / sizeof *places };

static void meshes_are_tight(void **state)
{
    static const char *const names[] = {"1280", "20480", "bumpy", "cube", "spindle"};
    TriangleList meshes[] = {triangles_icosphere(3), triangles_icosphere(5), triangles_bumpy(5),
                             triangles_cube(), triangles_spindle(2048, 4)};
    enum { MESHES = sizeof meshes / sizeof *meshes };
    Walkers walkers = walkers_create(*state);
    const u32 rays_each = leak_rays(140000) / (MESHES * PLACES) + 1;
    u32 met_once = 0;
    for (u32 i = 0; i < MESHES * PLACES; i++) {
        const u32 m = i / PLACES;
        const f64 s = places[i % PLACES].scale, spread = (m == 2 ? 0.02 : 0.3) * s;
        const Vec3 center = places[i % PLACES].center;
        const Affine map = affine_compose(affine_translate(center), affine_scale((Vec3){s, s, s}));
        Layout *layout = mesh_layout(&meshes[m], &map, false);
        FaceTable faces = face_table_create(layout);
        Rays rays = rays_create(rays_each / places[i % PLACES].share + 1);
        const bool once = is_seen_whole(&faces, center, spread);
        char what[80];
        snprintf(what, sizeof what, "%s times %g at %g %g %g", names[m], s, center.x, center.y, center.z);
        aim_at_edges(&rays, &faces, center, spread);
        run_all(&walkers, layout, &rays, once, what);
        met_once += once;
        rays_destroy(&rays);
        face_table_destroy(&faces);
        layout_destroy(layout);
    }
    for (u32 m = 0; m < MESHES; m++)
        triangles_destroy(&meshes[m]);
    print_message("in %u of %u cases each ray has to meet the surface exactly once\n", met_once,
                  (u32)MESHES * PLACES);
    assert_true(met_once >= MESHES * PLACES / 2);
    walkers_finish(&walkers);
}

// Rays in objects' space: the numbers of the ray are rounded anew, and nothing else changes.
static void instances_are_tight(void **state)
{
    const Affine turned = affine_compose(affine_translate((Vec3){3, -2, 5}),
                                         affine_compose(affine_rotate((Vec3){1, 2, 3}, 37),
                                                        affine_scale((Vec3){2, -1, 3})));
    TriangleList sphere = triangles_icosphere(4);
    Layout *layout = mesh_layout(&sphere, &turned, true);
    const Variant variant = mesh_variants[2];
    KernelProgram *program = walk_program(*state, variant, true);
    Rays rays = rays_create(leak_rays(140000) / 16);
    u64 random = 3;
    for (u32 i = 0; i < rays.count; i++) {
        const Vec3 *v = sphere.vertices + 3 * (u32)(random_unit(&random) * sphere.count);
        const f64 share = i % 3 ? random_unit(&random) : 0;
        const Vec3 target = vec_add(v[0], vec_scale(vec_sub(v[1], v[0]), share));
        const Vec3 from = {random_in(&random, -0.3, 0.3), random_in(&random, -0.3, 0.3), 0};
        const Vec3 o = affine_point(turned, from), d = vec_sub(affine_point(turned, target), o);
        rays_set(&rays, i, (f32[3]){(f32)o.x, (f32)o.y, (f32)o.z}, (f32[3]){(f32)d.x, (f32)d.y, (f32)d.z});
    }
    walk(program, variant, layout, 4, &rays);
    const Verdict verdict = judge(&rays, &rays, true);
    print_message("instance: %u rays, %u leaks, %u met twice\n", rays.count, verdict.leaks, verdict.wrong);
    assert_int_equal(verdict.leaks + verdict.wrong, 0);
    rays_destroy(&rays);
    kernel_program_destroy(program);
    layout_destroy(layout);
    triangles_destroy(&sphere);
}

// Rays along the axes from within a solid made of the cells of a grid, many of them in the planes, edges and
// corners of the grid.
static void grids_are_tight(void **state)
{
    enum { RADIUS = 8 };
    static const f64 cells[] = {1, 0.1, 0x1p-20, 1e5};
    Walkers walkers = walkers_create(*state);
    for (u32 c = 0; c < sizeof cells / sizeof *cells; c++) {
        const f64 shifts[3] = {c % 2 ? 0.7 : 0, c % 2 ? -33.3 : 16 * cells[c], 0};
        const Affine map = affine_translate((Vec3){shifts[0], shifts[1], shifts[2]});
        TriangleList voxels = triangles_voxels(RADIUS, cells[c]);
        Layout *layout = mesh_layout(&voxels, &map, false);
        Rays rays = rays_create(leak_rays(140000) / 20);
        u64 random = c;
        for (u32 i = 0; i < rays.count; i++) {
            f32 o[3], d[3] = {0, 0, 0};
            // Zeros of either sign beside the axis.
            const u32 axis = i % 3;
            d[(axis + 1) % 3] = i % 2 ? 0.0F : -0.0F;
            d[axis] = (f32)((i / 3 % 2 ? 1 : -1) * (i % 7 ? 1 : 0.3));
            for (int k = 0; k < 3; k++) {
                // On a plane of the grid as the vertices are rounded, or within a cell; inside by all means.
                const f64 at = floor(random_in(&random, -4, 5)) + (random_unit(&random) < 0.4 ? 0.37 : 0);
                o[k] = (f32)(at * cells[c] + shifts[k]);
            }
            rays_set(&rays, i, o, d);
        }
        char what[80];
        snprintf(what, sizeof what, "grid of %g", cells[c]);
        run_all(&walkers, layout, &rays, false, what);
        rays_destroy(&rays);
        layout_destroy(layout);
        triangles_destroy(&voxels);
    }
    walkers_finish(&walkers);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(meshes_are_tight),
        cmocka_unit_test(instances_are_tight),
        cmocka_unit_test(grids_are_tight),
    };
    return kernel_run_tests(tests, sizeof tests / sizeof *tests);
}
