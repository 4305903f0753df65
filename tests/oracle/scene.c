#include "scene.h"

#include <string.h>

#include "shape.h"

Material material_default(const char *name)
{
    return (Material){
        .name = name,
        .ambient = {grey(0), -1},
        .diffuse = {grey(0.8), -1},
        .emission = {grey(0), -1},
        .shininess = 32,
        .ior = 1.5,
        .normal_map = -1,
        .base_color = {grey(0.8), -1},
        .metallic = {grey(0), -1},
        .roughness = {grey(0.5), -1},
        .occlusion = {grey(1), -1},
    };
}

void scene_init(Scene *scene)
{
    *scene = (Scene){
        .width = 800,
        .height = 600,
        .samples = 1,
        .camera_look_at = vec(0, 0, -1),
        .camera_up = vec(0, 1, 0),
        .fov = 60,
        .max_depth = 5,
        .min_weight = 0.001,
        .shadows = true,
        .points = 256,
        .srgb = true,
        .ambient = grey(0.1),
    };
    scene->objects = store_grow(&scene->store, NULL, 0, sizeof *scene->objects);
    scene->objects[0] = (Object){"", NULL, 0};
    scene->object_count = 1;
}

void scene_free(Scene *scene)
{
    store_free(&scene->store);
}

int scene_find_texture(const Scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->texture_count; i++)
        if (strcmp(scene->textures[i].name, name) == 0)
            return (int)i;
    return -1;
}

int scene_find_material(const Scene *scene, const char *name)
{
    for (size_t i = 0; i < scene->material_count; i++)
        if (strcmp(scene->materials[i].name, name) == 0)
            return (int)i;
    return -1;
}

int scene_find_object(const Scene *scene, const char *name)
{
    for (size_t i = 1; i < scene->object_count; i++)
        if (strcmp(scene->objects[i].name, name) == 0)
            return (int)i;
    return -1;
}

static void place_shape(Scene *scene, const Shape *shape, const Transform *to_world, int material, int light)
{
    Primitive primitive = {
        .shape = shape,
        .material = &scene->materials[material],
        .light = light,
        .to_world = *to_world,
        .to_local = transform_inverse(to_world),
    };
    Vec center;
    real radius;
    real grow = transform_norm(to_world);
    primitive.bounded = shape_bound(shape, &center, &radius);
    primitive.bound_center = transform_point(to_world, center);
    /* A little larger, so that rounding in the bound itself never rejects a hit. */
    primitive.bound_radius = radius * grow * 1.000001L;
    Vec moved = vec(to_world->m[0][3], to_world->m[1][3], to_world->m[2][3]);
    primitive.magnitude = length(primitive.bound_center) + primitive.bound_radius;
    primitive.magnitude += length(moved) + grow * length(center);
    primitive.unit = 1e-16L * grow * transform_norm(&primitive.to_local);
    size_t count = scene->primitive_count;
    scene->primitives = store_grow(&scene->store, scene->primitives, count, sizeof *scene->primitives);
    scene->primitives[count] = primitive;
    scene->primitive_count = count + 1;
}

/* Adds the primitives from `first` on as a run. */
static void place_run(Scene *scene, size_t first)
{
    const Primitive *primitives = scene->primitives;
    Run run = {.first = first, .end = scene->primitive_count, .bounded = true};
    for (size_t i = first; i < run.end; i++)
        run.center = add(run.center, scaled(primitives[i].bound_center, 1 / (real)(run.end - first)));
    for (size_t i = first; i < run.end; i++) {
        real away = length(sub(primitives[i].bound_center, run.center));
        run.bounded &= primitives[i].bounded;
        run.radius = fmaxl(run.radius, away + primitives[i].bound_radius);
        run.magnitude = fmaxl(run.magnitude, primitives[i].magnitude);
    }
    size_t count = scene->run_count;
    scene->runs = store_grow(&scene->store, scene->runs, count, sizeof run);
    scene->runs[count] = run;
    scene->run_count = count + 1;
}

/* The faces of a mesh: neighbours in the file are mostly neighbours in space, so that short runs of them are
 * small. */
static void place_mesh(Scene *scene, const Mesh *mesh, const Transform *to_world, int material, int fallback)
{
    enum { RUN = 16 };
    size_t first = scene->primitive_count;
    for (size_t i = 0; i < mesh->count; i++) {
        int own = mesh->materials[i] == MATERIAL_NONE ? fallback : mesh->materials[i];
        place_shape(scene, &mesh->faces[i], to_world, material == MATERIAL_NONE ? own : material, -1);
        if (scene->primitive_count - first == RUN || i + 1 == mesh->count) {
            place_run(scene, first);
            first = scene->primitive_count;
        }
    }
}

/* inherited: the material of the nearest enclosing instance that names one, or MATERIAL_NONE. */
static void place_object(Scene *scene, const Object *object, const Transform *outer, int inherited,
                         int fallback)
{
    for (size_t i = 0; i < object->count; i++) {
        const Item *item = &object->items[i];
        Transform to_world = transform_then(&item->placed, outer);
        int material = item->material;
        if (material == MATERIAL_NONE)
            material = inherited;
        else if (material == MATERIAL_DEFAULT)
            material = fallback;
        if (item->is_instance) {
            place_object(scene, &scene->objects[item->object], &to_world, material, fallback);
        } else if (item->shape.kind == SHAPE_MESH) {
            place_mesh(scene, item->shape.mesh, &to_world, material, fallback);
        } else {
            place_shape(scene, &item->shape, &to_world, material == MATERIAL_NONE ? fallback : material,
                        item->light);
            place_run(scene, scene->primitive_count - 1);
        }
    }
}

void scene_place(Scene *scene)
{
    int material = scene_find_material(scene, "default");
    if (material < 0) {
        size_t count = scene->material_count;
        scene->materials = store_grow(&scene->store, scene->materials, count, sizeof *scene->materials);
        scene->materials[count] = material_default("default");
        scene->materials[count].ambient = scene->materials[count].diffuse;
        material = (int)count;
        scene->material_count = count + 1;
    }
    Transform identity = transform_identity();
    place_object(scene, &scene->objects[0], &identity, MATERIAL_NONE, material);
}
