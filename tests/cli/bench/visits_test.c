// Rays along the axes over regular grids, where they may lie in faces of the boxes of whole rows, visit at
// most twice what they do when tilted a little; those along the edges between four rows, four times.
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "device/list.h"
#include "scene/parse.h"
#include "trace.h"

// Of cells of size 1 around the origin, where the camera is too, so that the layout moves nothing.
typedef struct Grid {
    u32 cells; // along each axis
    Arena *arena;
    Layout *layout;
    Tracer *tracer;
} Grid;

enum { SPHERES = 16, FLOOR = 64 }; // cells

static const char CAMERA[] = "camera { position 0 0 0  look_at 0 0 -1 }\n";

static Device *open_device(Error *error)
{
    const char *spec = getenv("CLRT_DEVICE");
    DeviceList *list = device_list_create(error);
    u32 index;
    Device *device = NULL;
    if (list && device_choose(list, spec && spec[0] ? spec : NULL, &index, error))
        device = device_open(&list->devices[index], &(DeviceOptions){.threads = 0}, error);
    device_list_destroy(list);
    return device;
}

// Boxes touch, spheres only in points: a ray along the edges of the cells goes all the way and meets none.
static void write_spheres(FILE *text)
{
    const int n = SPHERES;
    for (int i = 0; i < n * n * n; i++)
        fprintf(text, "sphere { center %g %g %g radius 0.5 }\n", i % n - n / 2 + 0.5, i / n % n - n / 2 + 0.5,
                i / n / n - n / 2 + 0.5);
}

// Two triangles a cell: boxes without height.
static void write_floor(FILE *text)
{
    const int n = FLOOR;
    for (int i = 0; i < n * n; i++) {
        const int x = i % n - n / 2, z = i / n - n / 2;
        fprintf(text, "triangle { vertices %d 0 %d  %d 0 %d  %d 0 %d }\n", x, z, x, z + 1, x + 1, z);
        fprintf(text, "triangle { vertices %d 0 %d  %d 0 %d  %d 0 %d }\n", x + 1, z, x, z + 1, x + 1, z + 1);
    }
}

static Grid grid_make(Device *device, void write(FILE *), u32 cells)
{
    Error error = {0};
    char *text = NULL;
    size_t length = 0;
    FILE *stream = open_memstream(&text, &length);
    assert_non_null(stream);
    fputs(CAMERA, stream);
    write(stream);
    assert_int_equal(fclose(stream), 0);
    Grid grid = {.cells = cells, .arena = arena_create()};
    Diagnostics *diagnostics = diagnostics_create();
    Scene *scene = scene_parse_text("grid", text, length, grid.arena, diagnostics, &error);
    assert_non_null(scene);
    assert_int_equal(diagnostics_error_count(diagnostics), 0);
    grid.layout = layout_create(scene, &error);
    assert_non_null(grid.layout);
    grid.tracer = tracer_create(device, grid.layout, true, &error);
    if (!grid.tracer)
        fail_msg("%s", error.text);
    diagnostics_destroy(diagnostics);
    free(text);
    return grid;
}

static void grid_end(Grid *grid)
{
    tracer_destroy(grid->tracer);
    layout_destroy(grid->layout);
    arena_destroy(grid->arena);
}

// Rays from outside of the grid along an axis, one a cell, at the place (at, beside) of its cell; `tilt`
// turns them a little, and differently along the two other axes.
static RaySet *rays_along(const Grid *grid, int axis, f64 at, f64 beside, f64 tilt)
{
    const u32 cells = grid->cells;
    RaySet *rays = calloc(1, sizeof *rays);
    assert_non_null(rays);
    rays->count = cells * cells;
    rays->stride = rays->count + RAYS_PADDING;
    rays->columns = calloc((size_t)RAY_COLUMNS * rays->stride, sizeof *rays->columns);
    assert_non_null(rays->columns);
    const f64 length = sqrt(1 + tilt * tilt * (1 + 0.7 * 0.7)), half = cells / 2.0;
    for (u32 i = 0; i < rays->stride; i++) {
        const u32 k = i < rays->count ? i : rays->count - 1;
        const int second = (axis + 1) % 3, third = (axis + 2) % 3;
        f64 org[3], dir[3];
        org[axis] = -half - 1;
        org[second] = k % cells - half + at;
        org[third] = k / cells - half + beside;
        dir[axis] = 1 / length;
        dir[second] = tilt / length;
        dir[third] = 0.7 * tilt / length;
        for (u32 c = 0; c < 3; c++) {
            rays->columns[(RAY_ORG + c) * rays->stride + i] = (f32)org[c];
            rays->columns[(RAY_DIR + c) * rays->stride + i] = (f32)dir[c];
        }
        rays->columns[RAY_FAR * rays->stride + i] = INFINITY;
    }
    return rays;
}

// Nodes and leaves a ray. Takes the rays.
static f64 visits_of(const Grid *grid, RaySet *rays)
{
    Error error = {0};
    Visits visits;
    if (!tracer_load(grid->tracer, rays, &error) || !tracer_run(grid->tracer, &error) ||
        !tracer_visits(grid->tracer, &visits, &error))
        fail_msg("%s", error.text);
    const f64 mean = (f64)(visits.nodes + visits.leaves) / rays->count;
    rays_destroy(rays);
    return mean;
}

static void check(const Grid *grid, int axis, f64 at, f64 beside, f64 most)
{
    const f64 tilted = visits_of(grid, rays_along(grid, axis, at, beside, 1e-3));
    const f64 along = visits_of(grid, rays_along(grid, axis, at, beside, 0));
    printf("axis %d at %g %g: %.1f visits, tilted %.1f\n", axis, at, beside, along, tilted);
    assert_true(tilted >= 1);
    if (!(along <= most * tilted))
        fail_msg("%.3g times the visits of tilted rays", along / tilted);
}

static void check_places(const Grid *grid, int axis)
{
    check(grid, axis, 0.2, 0.3, 2);
    check(grid, axis, 0, 0.3, 2);
    check(grid, axis, 0.3, 0, 2);
    check(grid, axis, 0, 0, 4);
}

static void test_spheres(void **state)
{
    Grid grid = grid_make(*state, write_spheres, SPHERES);
    for (int axis = 0; axis < 3; axis++)
        check_places(&grid, axis);
    grid_end(&grid);
}

static void test_floor(void **state)
{
    Grid grid = grid_make(*state, write_floor, FLOOR);
    check_places(&grid, 1);
    grid_end(&grid);
}

int main(void)
{
    Error error = {0};
    Device *device = open_device(&error);
    if (!device) {
        printf("skipped: %s\n", error.text);
        return 77;
    }
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_prestate(test_spheres, device),
        cmocka_unit_test_prestate(test_floor, device),
    };
    const int failed = cmocka_run_group_tests_name("bench.visits", tests, NULL, NULL);
    device_close(device);
    return failed;
}
