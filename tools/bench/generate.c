// Scenes without architecture: blob, sphereflake, needles, instances.
#include "geometry.h"

#include <math.h>
#include <stdlib.h>

static const f64 TAU = 6.283185307179586;

void generate_blob(Geometry *geometry, u32 triangles)
{
    grower_blob(&geometry->mesh, (Vec3){0, 0, 0}, 1, 0.35, triangles, 1);
    geometry->view = (View){{1.1, 0.9, 2.6}, {0, 0, 0}, 42, {0.4, 0.8, 0.45}};
}

typedef struct Flake {
    Geometry *geometry;
    u32 room;
} Flake;

// The sphere with its axis away from what it sits on, and `levels` levels of smaller ones around it.
static void add_flake(const Flake *flake, Sphere sphere, Vec3 axis, u32 levels)
{
    Geometry *geometry = flake->geometry;
    if (geometry->sphere_count == flake->room)
        return;
    geometry->spheres[geometry->sphere_count++] = sphere;
    if (levels == 0)
        return;
    const Vec3 other = fabs(axis.y) < 0.9 ? (Vec3){0, 1, 0} : (Vec3){1, 0, 0};
    const Vec3 right = vec_normalize(vec_cross(other, axis)), front = vec_cross(axis, right);
    const f64 radius = sphere.radius / 3, distance = sphere.radius + radius;
    for (int k = 0; k < 9; k++) {
        // Six around the waist, three around the top.
        const f64 turn = k < 6 ? TAU * k / 6 : TAU * (k - 6) / 3 + TAU / 12;
        const f64 height = k < 6 ? 0 : 0.8164965809277260;
        const f64 out = sqrt(1 - height * height);
        const Vec3 around = vec_add(vec_scale(right, cos(turn) * out), vec_scale(front, sin(turn) * out));
        const Vec3 away = vec_add(around, vec_scale(axis, height));
        const Sphere child = {vec_add(sphere.center, vec_scale(away, distance)), radius};
        add_flake(flake, child, away, levels - 1);
    }
}

void generate_sphereflake(Geometry *geometry, u32 spheres)
{
    u32 levels = 0;
    u64 count = 1, layer = 1;
    while (count + layer * 9 <= spheres) {
        layer *= 9;
        count += layer;
        levels++;
    }
    const Flake flake = {geometry, (u32)count};
    geometry->spheres = malloc(count * sizeof *geometry->spheres);
    geometry->failed = !geometry->spheres;
    if (!geometry->failed)
        add_flake(&flake, (Sphere){{0, 0, 0}, 1}, (Vec3){0, 1, 0}, levels);
    geometry->view = (View){{2.1, 1.9, 3.2}, {0, 0.2, 0}, 40, {0.5, 0.7, 0.5}};
}

void generate_needles(Geometry *geometry, u32 triangles)
{
    Grower *mesh = &geometry->mesh;
    const u32 count = triangles > 3 ? triangles - 2 : 1;
    const f64 side = sqrt((f64)count) * 0.01; // 10 000 a square unit
    for (u32 i = 0; i < count; i++) {
        const Vec3 root = {(random_at(i, 1) - 0.5) * side, 0, (random_at(i, 2) - 0.5) * side};
        const f64 turn = TAU * random_at(i, 3), lean = 0.9 * random_at(i, 4);
        const f64 length = 0.08 + 0.17 * random_at(i, 5), width = 0.0008 + 0.0012 * random_at(i, 6);
        const Vec3 along = {sin(lean) * cos(turn), cos(lean), sin(lean) * sin(turn)};
        const f64 face = TAU * random_at(i, 7);
        const Vec3 across = {width * cos(face), 0, width * sin(face)};
        const u32 a = grower_vertex(mesh, vec_sub(root, across));
        const u32 b = grower_vertex(mesh, vec_add(root, across));
        grower_face(mesh, a, b, grower_vertex(mesh, vec_add(root, vec_scale(along, length))));
    }
    const f64 half = 0.5 * side + 0.3;
    grower_quad(mesh, (Vec3){-half, 0, -half}, (Vec3){-half, 0, half}, (Vec3){half, 0, half},
                (Vec3){half, 0, -half});
    const f64 reach = side < 4 ? side : 4;
    geometry->view = (View){{0.05, 0.55, 0.5 * reach}, {0, 0.05, 0}, 45, {0.5, 0.7, 0.2}};
}

enum { INSTANCED_TRIANGLES = 8000 };

void generate_instances(Geometry *geometry, u32 triangles)
{
    const u32 wanted = triangles / INSTANCED_TRIANGLES;
    const u32 columns = wanted < 1 ? 1 : (u32)ceil(sqrt(wanted));
    const u32 count = wanted < 1 ? 1 : wanted;
    grower_blob(&geometry->mesh, (Vec3){0, 0, 0}, 1, 0.3,
                triangles < INSTANCED_TRIANGLES ? triangles : INSTANCED_TRIANGLES, 5);
    geometry->placements = malloc(count * sizeof *geometry->placements);
    geometry->failed = !geometry->placements;
    for (u32 i = 0; i < count && !geometry->failed; i++) {
        const f64 scale = 0.5 + 0.4 * random_at(i, 11);
        const Vec3 axis = {random_at(i, 12) - 0.5, random_at(i, 13) - 0.5, 0.7};
        const Vec3 at = {2.2 * ((f64)(i % columns) - 0.5 * (columns - 1)), 0.4 * random_at(i, 14),
                         -2.2 * (f64)(i / columns)};
        const Affine turned = affine_compose(affine_rotate(axis, 360 * random_at(i, 15)),
                                             affine_scale((Vec3){scale, scale, scale}));
        geometry->placements[geometry->placement_count++] = affine_compose(affine_translate(at), turned);
    }
    geometry->view = (View){{1.1, 2.6, 4.5}, {0, 0, -6}, 50, {0.5, 0.7, 0.3}};
}
