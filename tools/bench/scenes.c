#include "scenes.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "mesh_file.h"
#include "scene/parse.h"

const SceneKind scene_kinds[SCENE_KINDS] = {
    {"blob", "a subdivided sphere with layered smooth displacement", 1500000},
    {"hall", "a closed room, 20 columns of long triangles, 15 dense displaced objects", 1500000},
    {"sphereflake", "spheres on spheres", 66430},
    {"needles", "a hair-like field of long thin triangles", 1000000},
    {"instances", "a grid of placements of one mesh of 8000 triangles", 80000000},
    {"teapots", "small dense teapots in a huge stadium of large triangles", 1000000},
};

static void (*const GENERATORS[SCENE_KINDS])(Geometry *, u32) = {
    generate_blob,    generate_hall,      generate_sphereflake,
    generate_needles, generate_instances, generate_teapots,
};

typedef struct Bounds {
    Vec3 min, max;
} Bounds;

static void bounds_add(Bounds *b, Vec3 p)
{
    b->min = (Vec3){fmin(b->min.x, p.x), fmin(b->min.y, p.y), fmin(b->min.z, p.z)};
    b->max = (Vec3){fmax(b->max.x, p.x), fmax(b->max.y, p.y), fmax(b->max.z, p.z)};
}

static Bounds bounds_none(void)
{
    return (Bounds){{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
}

static Bounds mesh_bounds(const Mesh *mesh)
{
    Bounds bounds = bounds_none();
    for (u32 f = 0; f < mesh->face_count; f++)
        for (int k = 0; k < 3; k++)
            bounds_add(&bounds, mesh->positions[mesh->faces[f][k]]);
    return bounds;
}

static Vec3 bounds_corner(const Bounds *b, int corner)
{
    return (Vec3){corner & 1 ? b->max.x : b->min.x, corner & 2 ? b->max.y : b->min.y,
                  corner & 4 ? b->max.z : b->min.z};
}

static f64 scene_diagonal(const BenchScene *bench)
{
    const Scene *scene = bench->scene;
    Bounds all = bounds_none();
    const Bounds mesh = bench->mesh ? mesh_bounds(bench->mesh) : bounds_none();
    for (u32 i = 0; !bench->mesh && i < scene->shape_count; i++) {
        const Vec3 c = scene->shapes[i].as.sphere.center;
        const f64 r = scene->shapes[i].as.sphere.radius;
        bounds_add(&all, vec_sub(c, (Vec3){r, r, r}));
        bounds_add(&all, vec_add(c, (Vec3){r, r, r}));
    }
    for (u32 i = 0; i < bench->instance_count; i++)
        for (int corner = 0; corner < 8; corner++)
            bounds_add(&all, affine_point(scene->instances[i].transform, bounds_corner(&mesh, corner)));
    if (bench->mesh && bench->instance_count == 0)
        all = mesh;
    return vec_length(vec_sub(all.max, all.min));
}

static bool out_of_memory(const char *name, Error *error)
{
    return error_set(error, ERROR_MEMORY, "%s: no memory for the scene", name);
}

// An object with the shape of the mesh, and an instance of it for each placement.
static bool place_mesh(BenchScene *bench, const Geometry *geometry, Error *error)
{
    Scene *scene = bench->scene;
    const u32 count = geometry->placement_count;
    Item *inner = arena_alloc(bench->arena, 1, sizeof *inner);
    scene->objects = arena_alloc(bench->arena, 1, sizeof *scene->objects);
    scene->instances = arena_alloc(bench->arena, count, sizeof *scene->instances);
    bench->to_object = arena_alloc(bench->arena, count, sizeof *bench->to_object);
    Item *items = arena_alloc(bench->arena, count, sizeof *items);
    if (!inner || !scene->objects || !scene->instances || !bench->to_object || !items)
        return out_of_memory(bench->name, error);
    *inner = (Item){ITEM_SHAPE, 0};
    scene->objects[0] = (Object){.name = "mesh", .group = {inner, 1}};
    scene->object_count = 1;
    for (u32 i = 0; i < count; i++) {
        const Affine moved = affine_compose(affine_translate(vec_scale(geometry->view.eye, -1)),
                                            geometry->placements[i]);
        scene->instances[i] = (Instance){.object = 0, .material = -1, .transform = moved};
        bench->to_object[i] = affine_inverse(moved);
        items[i] = (Item){ITEM_INSTANCE, i};
    }
    scene->instance_count = bench->instance_count = count;
    scene->world = (Group){items, count};
    return true;
}

static bool add_shapes(BenchScene *bench, const Geometry *geometry, Error *error)
{
    Scene *scene = bench->scene;
    const u32 count = bench->mesh ? 1 : geometry->sphere_count;
    scene->shapes = arena_alloc(bench->arena, count, sizeof *scene->shapes);
    Item *items = arena_alloc(bench->arena, count, sizeof *items);
    if (!scene->shapes || !items)
        return out_of_memory(bench->name, error);
    for (u32 i = 0; i < count; i++) {
        Shape *shape = &scene->shapes[i];
        *shape = (Shape){.material = -1, .transform = affine_identity()};
        items[i] = (Item){ITEM_SHAPE, i};
        if (bench->mesh) {
            shape->kind = SHAPE_MESH;
            shape->as.mesh.smooth = 0;
            shape->as.mesh.mesh = bench->mesh;
            continue;
        }
        const Sphere *sphere = &geometry->spheres[i];
        shape->kind = SHAPE_SPHERE;
        shape->as.sphere.center = rounded_to_float(vec_sub(sphere->center, geometry->view.eye));
        shape->as.sphere.radius = (f32)sphere->radius;
    }
    scene->shape_count = count;
    scene->world = (Group){items, count};
    return true;
}

// Takes the mesh out of the geometry.
static bool add_mesh(BenchScene *bench, Geometry *geometry, Error *error)
{
    Scene *scene = bench->scene;
    const Vec3 origin = geometry->placement_count > 0 ? (Vec3){0, 0, 0} : geometry->view.eye;
    scene->meshes = arena_alloc(bench->arena, 1, sizeof *scene->meshes);
    if (!scene->meshes || !grower_finish(&geometry->mesh, origin, &scene->meshes[0]))
        return out_of_memory(bench->name, error);
    scene->mesh_count = 1;
    bench->mesh = &scene->meshes[0];
    return true;
}

static void aim_camera(BenchScene *bench, const View *view)
{
    Camera *camera = &bench->scene->camera;
    bench->view = *view;
    bench->view.look_at = vec_sub(view->look_at, view->eye);
    bench->view.eye = (Vec3){0, 0, 0};
    camera->position = bench->view.eye;
    camera->look_at = bench->view.look_at;
    camera->fov = view->fov;
}

static bool fill(BenchScene *bench, Geometry *geometry, Error *error)
{
    aim_camera(bench, &geometry->view);
    bench->scene->ambient = bench->scene->background = (Vec3){0, 0, 0};
    if (geometry->failed)
        return out_of_memory(bench->name, error);
    if (!geometry->spheres && !add_mesh(bench, geometry, error))
        return false;
    if (!add_shapes(bench, geometry, error) ||
        (geometry->placement_count > 0 && !place_mesh(bench, geometry, error)))
        return false;
    bench->primitive_count = bench->mesh ? bench->mesh->face_count : bench->scene->shape_count;
    bench->diagonal = scene_diagonal(bench);
    return true;
}

// A view of the whole from the front, a little above.
static View view_of_all(const Mesh *mesh)
{
    const Bounds b = mesh_bounds(mesh);
    const Vec3 center = vec_scale(vec_add(b.min, b.max), 0.5);
    const f64 radius = 0.5 * vec_length(vec_sub(b.max, b.min));
    const Vec3 away = vec_normalize((Vec3){0.35, 0.3, 1});
    return (View){vec_add(center, vec_scale(away, 2.3 * radius)), center, 45, {0.4, 0.8, 0.45}};
}

static bool read_geometry(const char *path, Geometry *geometry, Error *error)
{
    Mesh mesh;
    if (!mesh_file_read(path, &mesh, error))
        return false;
    geometry->view = view_of_all(&mesh);
    geometry->mesh = (Grower){.positions = mesh.positions, .faces = mesh.faces,
                              .position_count = mesh.position_count, .face_count = mesh.face_count};
    mesh.positions = NULL;
    mesh.faces = NULL;
    mesh_destroy(&mesh);
    return true;
}

static bool make_geometry(const char *name, u32 triangles, Geometry *geometry, Error *error)
{
    for (int i = 0; i < SCENE_KINDS; i++) {
        if (strcmp(name, scene_kinds[i].name) == 0) {
            GENERATORS[i](geometry, triangles ? triangles : scene_kinds[i].triangles);
            return true;
        }
    }
    if (!strchr(name, '.') && !strchr(name, '/'))
        return error_set(error, ERROR_USAGE, "'%s' is neither a scene nor the path of a mesh", name);
    return read_geometry(name, geometry, error);
}

BenchScene *bench_scene_create(const char *name, u32 triangles, Error *error)
{
    Geometry geometry = {.spheres = NULL};
    BenchScene *bench = calloc(1, sizeof *bench);
    Diagnostics *diagnostics = diagnostics_create();
    bool ok = bench && diagnostics && (bench->arena = arena_create()) != NULL;
    if (ok) {
        bench->name = name;
        // Whatever the language has for defaults.
        bench->scene = scene_parse_text(name, "", 0, bench->arena, diagnostics, error);
        ok = bench->scene && make_geometry(name, triangles, &geometry, error) &&
             fill(bench, &geometry, error);
    } else {
        out_of_memory(name, error);
    }
    free(geometry.mesh.positions);
    free(geometry.mesh.faces);
    free(geometry.spheres);
    free(geometry.placements);
    diagnostics_destroy(diagnostics);
    if (ok)
        return bench;
    bench_scene_destroy(bench);
    return NULL;
}

void bench_scene_destroy(BenchScene *bench)
{
    if (!bench)
        return;
    for (u32 i = 0; bench->scene && i < bench->scene->mesh_count; i++)
        mesh_destroy(&bench->scene->meshes[i]);
    arena_destroy(bench->arena);
    free(bench);
}

bool bench_scene_triangle(const BenchScene *bench, u32 primitive, u32 instance, Vec3 corners[3])
{
    if (!bench->mesh)
        return false;
    for (int k = 0; k < 3; k++) {
        corners[k] = bench->mesh->positions[bench->mesh->faces[primitive][k]];
        if (bench->instance_count > 0)
            corners[k] = affine_point(bench->scene->instances[instance].transform, corners[k]);
    }
    return true;
}

Vec3 bench_scene_normal(const BenchScene *bench, u32 primitive, u32 instance, Vec3 p)
{
    Vec3 corners[3];
    if (!bench_scene_triangle(bench, primitive, instance, corners))
        return vec_normalize(vec_sub(p, bench->scene->shapes[primitive].as.sphere.center));
    return vec_normalize(
        vec_cross(vec_sub(corners[1], corners[0]), vec_sub(corners[2], corners[0])));
}
