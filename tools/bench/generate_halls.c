// Scenes with architecture: large triangles next to dense objects.
#include "geometry.h"

#include <math.h>

static const f64 TAU = 6.283185307179586;

// A rectangle from a corner along two edges.
typedef struct Wall {
    Vec3 corner, across, up;
} Wall;

static Vec3 wall_point(f64 u, f64 v, const void *context)
{
    const Wall *wall = context;
    return vec_add(wall->corner, vec_add(vec_scale(wall->across, u), vec_scale(wall->up, v)));
}

// The inside of a box, each wall two quads.
static void add_room(Grower *mesh, Vec3 min, Vec3 max)
{
    const Vec3 x = {max.x - min.x, 0, 0}, y = {0, max.y - min.y, 0}, z = {0, 0, max.z - min.z};
    const Wall walls[6] = {{min, z, x}, {min, x, y}, {min, y, z},
                           {{min.x, max.y, min.z}, x, z},
                           {{min.x, min.y, max.z}, y, x},
                           {{max.x, min.y, min.z}, z, y}};
    for (int i = 0; i < 6; i++)
        grower_surface(mesh, 2, 1, false, wall_point, &walls[i]);
}

// A curve that is turned about the vertical through `center`: radius and height for v from 0 to 1.
typedef struct Lathe {
    Vec3 center;
    f64 size;
    void (*profile)(f64 v, f64 *radius, f64 *height);
} Lathe;

static Vec3 lathe_point(f64 u, f64 v, const void *context)
{
    const Lathe *lathe = context;
    f64 radius, height;
    lathe->profile(v, &radius, &height);
    const Vec3 at = {radius * cos(TAU * u), height, -radius * sin(TAU * u)};
    return vec_add(lathe->center, vec_scale(at, lathe->size));
}

// v in steps of 1/4: foot, shaft, capital.
static void column_profile(f64 v, f64 *radius, f64 *height)
{
    static const f64 RADII[] = {0.5, 0.5, 0.32, 0.28, 0.5}, HEIGHTS[] = {0, 0.25, 0.4, 4.6, 5};
    const int step = (int)(4 * v + 0.5);
    *radius = RADII[step];
    *height = HEIGHTS[step];
}

void generate_hall(Geometry *geometry, u32 triangles)
{
    Grower *mesh = &geometry->mesh;
    add_room(mesh, (Vec3){-8, 0, -20}, (Vec3){8, 5, 20});
    for (int i = 0; i < 20; i++) {
        const Lathe column = {{i & 1 ? 4.2 : -4.2, 0, -17.1 + 3.8 * (i / 2)}, 1, column_profile};
        grower_surface(mesh, 16, 4, true, lathe_point, &column);
    }
    for (u32 i = 0; i < 15; i++) {
        const f64 radius = 0.55 + 0.35 * random_at(i, 31);
        const Vec3 at = {-2.4 + 2.4 * (i % 3) + 0.5 * random_at(i, 32), 0.75 + 0.5 * random_at(i, 33),
                         -15 + 6 * (f64)(i / 3)};
        grower_blob(mesh, at, radius, 0.4, triangles / 15, 40 + 7 * i);
    }
    geometry->view = (View){{0.7, 2.3, 18.5}, {0, 1.3, 0}, 60, {0.3, 0.9, 0.2}};
}

// Body and lid in one curve from the middle of the bottom to the top of the knob.
static void teapot_profile(f64 v, f64 *radius, f64 *height)
{
    if (v < 0.7) {
        const f64 angle = 0.5 * TAU * (v / 0.7) * 0.86;
        *radius = 0.75 * sin(angle);
        *height = 0.5 - 0.5 * cos(angle) * 1.02;
        return;
    }
    const f64 w = (v - 0.7) / 0.3;
    f64 start_radius, start_height;
    teapot_profile(0.69999999, &start_radius, &start_height);
    *radius = start_radius * (1 - w) * (1 - w) + 0.24 * sin(0.5 * TAU * w) * w;
    *height = start_height + 0.28 * w;
}

// A bent tube: handle (u around, v along) on one side, spout on the other.
typedef struct Tube {
    Vec3 center;
    f64 size;
    bool spout;
} Tube;

static Vec3 tube_point(f64 u, f64 v, const void *context)
{
    const Tube *tube = context;
    const f64 turn = tube->spout ? 0.11 * TAU + 0.17 * TAU * v : -0.28 * TAU + 0.56 * TAU * v;
    const f64 bend = tube->spout ? 0.55 : 0.34, thick = tube->spout ? 0.16 - 0.1 * v : 0.07;
    const f64 reach = bend + thick * cos(TAU * u);
    const f64 x = tube->spout ? 0.3 + reach * sin(turn * 1.1) : -0.62 - reach * cos(turn);
    const f64 y = tube->spout ? 0.95 - reach * cos(turn * 1.1) : 0.55 + reach * sin(turn);
    return vec_add(tube->center, vec_scale((Vec3){x, y, thick * sin(TAU * u)}, tube->size));
}

static void add_teapot(Grower *mesh, Vec3 center, f64 size, u32 triangles)
{
    // Two thirds for the body, a sixth for each tube; quads about as high as wide.
    const u32 around = (u32)fmax(8, sqrt(triangles / 3.0)), along = (u32)fmax(10, around);
    const u32 ring = (u32)fmax(6, sqrt(triangles / 24.0)), length = (u32)fmax(8, 2.0 * ring);
    const Lathe body = {center, size, teapot_profile};
    const Tube handle = {center, size, false}, spout = {center, size, true};
    grower_surface(mesh, around, along, true, lathe_point, &body);
    grower_surface(mesh, ring, length, true, tube_point, &handle);
    grower_surface(mesh, ring, length, true, tube_point, &spout);
}

// An oval of terraces that rise towards the outside.
static Vec3 stadium_point(f64 u, f64 v, const void *context)
{
    const u32 rows = *(const u32 *)context, corner = (u32)(v * rows + 0.5);
    const f64 out = (corner + 1) / 2, up = corner / 2; // whole steps: tread, riser, tread, ...
    const f64 radius = 55 + 2.2 * out;
    return (Vec3){1.4 * radius * cos(TAU * u), 1.5 + 1.4 * up, -radius * sin(TAU * u)};
}

void generate_teapots(Geometry *geometry, u32 triangles)
{
    static const u32 ROWS = 44;
    static const Wall FIELD = {{-150, 0, 110}, {300, 0, 0}, {0, 0, -220}};
    static const Wall TABLE = {{-0.5, 0.7, 0.5}, {1, 0, 0}, {0, 0, -1}};
    Grower *mesh = &geometry->mesh;
    grower_surface(mesh, 72, ROWS, true, stadium_point, &ROWS);
    grower_surface(mesh, 2, 2, false, wall_point, &FIELD);
    grower_surface(mesh, 1, 1, false, wall_point, &TABLE);
    for (u32 i = 0; i < 9; i++) {
        const Vec3 at = {-0.3 + 0.3 * (i % 3) + 0.05 * random_at(i, 21), 0.7, -0.3 + 0.3 * (f64)(i / 3)};
        add_teapot(mesh, at, 0.12, triangles / 9);
    }
    geometry->view = (View){{0.35, 1.15, 1.25}, {0, 0.78, 0}, 45, {0.5, 0.7, 0.35}};
}
