#include "layout/place.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout/bake.h"
#include "layout/faces.h"
#include "layout/records.h"
#include "layout/textures.h"

// Where a group is placed: space of the group -> render space, the material that its shapes inherit (-1:
// none), its first place in the order of definition.
typedef struct Placement {
    Affine to_render;
    i32 material;
    u64 order;
} Placement;

static const Feature shape_features[PRIMITIVE_KIND_COUNT] = {
    [PRIMITIVE_SPHERE] = FEATURE_SPHERE,
    [PRIMITIVE_GIANT_SPHERE] = FEATURE_GIANT_SPHERE,
    [PRIMITIVE_ELLIPSOID] = FEATURE_ELLIPSOID,
    [PRIMITIVE_PLANE] = FEATURE_PLANE,
    [PRIMITIVE_BOX] = FEATURE_BOX,
    [PRIMITIVE_TETRAHEDRON] = FEATURE_TETRAHEDRON,
    [PRIMITIVE_DISK] = FEATURE_DISK,
    [PRIMITIVE_CYLINDER] = FEATURE_CYLINDER,
    [PRIMITIVE_CONE] = FEATURE_CONE,
    [PRIMITIVE_TORUS] = FEATURE_TORUS,
    [PRIMITIVE_TRIANGLE] = FEATURE_TRIANGLE,
    [PRIMITIVE_RECTANGLE] = FEATURE_RECTANGLE,
};

static Vec3 carried_normal(const Affine *inverse, Vec3 n)
{
    const Vec3 unit = vec_normalize(n);
    return vec_add(vec_add(vec_scale(inverse->row[0], unit.x), vec_scale(inverse->row[1], unit.y)),
                   vec_scale(inverse->row[2], unit.z));
}

// Stores what a triangle's vertices bring along; *index is NO_INDEX where that is nothing.
static bool add_extra(Placer *placer, const Shape *shape, const Affine *to_space, u32 *index, Error *error)
{
    *index = NO_INDEX;
    if (shape->kind != SHAPE_TRIANGLE ||
        !(shape->as.triangle.has_normals || (shape->as.triangle.has_uvs && placer->uv)))
        return true;
    if (placer->extra_count == placer->extra_capacity) {
        const u32 capacity = placer->extra_capacity ? 2 * placer->extra_capacity : 16;
        TriangleExtra *extras = realloc(placer->extras, capacity * sizeof *extras);
        if (!extras)
            return error_set(error, ERROR_MEMORY, "no memory for %u triangles", capacity);
        placer->extras = extras;
        placer->extra_capacity = capacity;
    }
    TriangleExtra *extra = &placer->extras[placer->extra_count];
    memset(extra, 0, sizeof *extra);
    extra->has_normals = shape->as.triangle.has_normals;
    const Affine inverse = affine_inverse(*to_space);
    f64 longest = 0;
    Vec3 normals[3] = { { 0, 0, 0 } };
    for (int k = 0; k < 3 && extra->has_normals; k++) {
        normals[k] = carried_normal(&inverse, shape->as.triangle.normals[k]);
        const f64 length = vec_length(normals[k]);
        longest = length > longest ? length : longest;
    }
    for (int k = 0; k < 3; k++) {
        // One common factor keeps the interpolation that of object space.
        extra->normals[3 * k] = (f32)(longest > 0 ? normals[k].x / longest : 0);
        extra->normals[3 * k + 1] = (f32)(longest > 0 ? normals[k].y / longest : 0);
        extra->normals[3 * k + 2] = (f32)(longest > 0 ? normals[k].z / longest : 0);
        // Without uvs of its own a triangle has the weights of its second and third vertex.
        const bool own = shape->as.triangle.has_uvs;
        extra->uvs[2 * k] = (f32)(own ? shape->as.triangle.uvs[k][0] : k == 1);
        extra->uvs[2 * k + 1] = (f32)(own ? shape->as.triangle.uvs[k][1] : k == 2);
    }
    *index = placer->extra_count++;
    placer->features |= feature_bit(FEATURE_TRIANGLE_EXTRA);
    return true;
}

// The material of this index can be seen.
static void use_material(Placer *placer, i32 material)
{
    placer->material_used[material < 0 ? 0 : material] = true;
}

// Places that a shape takes in the order of definition.
static u64 order_size(const Shape *shape)
{
    return shape->kind == SHAPE_MESH ? shape->as.mesh.mesh->face_count : 1;
}

// Bakes shape into list (or the planes). material -1: inherited from the instance.
static bool add_shape(Placer *placer, PrimitiveList *list, const Shape *shape, Affine to_space, i32 material,
                      u64 order, Error *error)
{
    Primitive primitive;
    BakedBounds bounds;
    ObjectFrame frame;
    PrimitiveInfo info = { material < 0 ? MATERIAL_INHERITED : (u32)material, NO_INDEX, (u32)order,
                           (u32)(order >> 32) };
    const Affine total = affine_compose(to_space, shape->transform);
    memset(&primitive, 0, sizeof primitive);
    if (!bake_shape(shape, &total, &primitive, &bounds, error) ||
        (placer->solid && !bake_object_frame(&total, &frame, error)) ||
        !add_extra(placer, shape, &total, &info.extra, error))
        return error_locate(placer->scene, shape->at, error);
    placer->features |= feature_bit(shape_features[primitive.kind]);
    if (material >= 0) {
        use_material(placer, material);
        if (!material_transmits(&placer->scene->materials[material]))
            primitive.kind |= PRIMITIVE_OPAQUE;
    }
    return primitive_list_add(list, &primitive, info, placer->solid ? &frame : NULL,
                              box_from_bounds(bounds.min, bounds.max), error);
}

static void use_file_materials(Placer *placer, const Mesh *mesh)
{
    for (u32 i = 0; i < mesh->part_count; i++)
        use_material(placer, mesh->parts[i].material);
}

// material: goes before the file's; -1: none. inherits: that of the instance does, too.
static bool add_mesh(Placer *placer, Level *level, const Shape *shape, Affine to_space, i32 material,
                     bool inherits, u64 order, Error *error)
{
    const Mesh *data = shape->as.mesh.mesh;
    PlacedMesh mesh = { .shape = shape, .to_space = affine_compose(to_space, shape->transform),
                        .material = material, .inherits = inherits, .order = order };
    if ((placer->solid && !bake_object_frame(&mesh.to_space, &mesh.frame, error)) ||
        !mesh_list_add(&level->meshes, &mesh, error))
        return error_locate(placer->scene, shape->at, error);
    if (material >= 0)
        use_material(placer, material);
    else if (!inherits)
        use_file_materials(placer, data);
    placer->features |= feature_bit(FEATURE_MESH);
    if (mesh_has_normals(&mesh))
        placer->features |= feature_bit(FEATURE_MESH_NORMALS);
    if (mesh_has_normals(&mesh) && shape->as.mesh.terminator)
        placer->features |= feature_bit(FEATURE_TERMINATOR);
    if (mesh_has_uvs(&mesh))
        placer->features |= feature_bit(FEATURE_MESH_UVS);
    return true;
}

// The shapes of an object, in its own space, once. There is at least one.
static bool list_object(Placer *placer, u32 index, Error *error)
{
    const Scene *scene = placer->scene;
    ObjectLayout *object = &placer->objects[index];
    const Group *group = &scene->objects[index].group;
    u64 order = 0;
    object->level.list.with_frames = placer->solid;
    for (u32 i = 0; i < group->count; i++) {
        if (group->items[i].kind == ITEM_INSTANCE) {
            order += placer->objects[scene->instances[group->items[i].index].object].order_size;
            continue;
        }
        const Shape *shape = &scene->shapes[group->items[i].index];
        const bool mesh = shape->kind == SHAPE_MESH, plane = shape->kind == SHAPE_PLANE;
        if (mesh && !add_mesh(placer, &object->level, shape, affine_identity(), shape->material,
                              shape->material < 0, order, error))
            return false;
        if (!mesh && !plane && !add_shape(placer, &object->level.list, shape, affine_identity(),
                                          shape->material, order, error))
            return false;
        object->inherits = object->inherits || (!plane && shape->material < 0);
        order += order_size(shape);
    }
    object->listed = true;
    return level_complete(&object->level, scene, error);
}

// What is to be known of the materials when an object with a level is placed with this one (-1: none).
static void note_material(Placer *placer, ObjectLayout *object, i32 material)
{
    Level *level = &object->level;
    if (!object->inherits)
        return;
    if (material >= 0) {
        use_material(placer, material);
        level->transmits_named =
            level->transmits_named || material_transmits(&placer->scene->materials[material]);
    } else if (!level->unnamed) {
        level->unnamed = true;
        for (u32 i = 0; i < level->list.count; i++)
            if (level->list.infos[i].material & MATERIAL_INHERITED)
                use_material(placer, 0);
        for (u32 i = 0; i < level->meshes.count; i++)
            if (level->meshes.meshes[i].inherits)
                use_file_materials(placer, level->meshes.meshes[i].shape->as.mesh.mesh);
    }
}

// The box of a placed box; what the map to the object's space, rounded to float, may be off by is added.
static Box placed_box(const Box *local, const Affine *map)
{
    const f64 reach = 16 * FLT_EPSILON;
    Vec3 low = { INFINITY, INFINITY, INFINITY }, high = { -INFINITY, -INFINITY, -INFINITY };
    for (int corner = 0; corner < 8; corner++) {
        const Vec3 p = affine_point(*map, (Vec3){ corner & 1 ? local->max[0] : local->min[0],
                                                  corner & 2 ? local->max[1] : local->min[1],
                                                  corner & 4 ? local->max[2] : local->min[2] });
        low = (Vec3){ fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z) };
        high = (Vec3){ fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z) };
    }
    const Vec3 t = map->translation;
    const f64 size = vec_length(vec_sub(high, low)) + vec_length(vec_sub(low, t));
    const f64 pad = reach * (size + fmax(vec_length(low), vec_length(high)));
    const Vec3 margin = { pad, pad, pad };
    return box_from_bounds(vec_sub(low, margin), vec_add(high, margin));
}

// A placed object as one primitive of the top-level hierarchy.
static bool add_instance(Placer *placer, u32 index, const Placement *placement, Error *error)
{
    if (!placer->objects[index].listed && !list_object(placer, index, error))
        return false;
    const Affine map = affine_inverse(placement->to_render);
    const Vec3 c = placement->to_render.translation;
    Primitive primitive;
    memset(&primitive, 0, sizeof primitive);
    primitive.row0 = (f32x4){ (f32)map.row[0].x, (f32)map.row[0].y, (f32)map.row[0].z, (f32)c.x };
    primitive.row1 = (f32x4){ (f32)map.row[1].x, (f32)map.row[1].y, (f32)map.row[1].z, (f32)c.y };
    primitive.row2 = (f32x4){ (f32)map.row[2].x, (f32)map.row[2].y, (f32)map.row[2].z, (f32)c.z };
    memcpy(&primitive.p0, &index, sizeof index);
    primitive.kind = PRIMITIVE_INSTANCE;
    const PrimitiveInfo info = { placement->material < 0 ? NO_INDEX : (u32)placement->material, NO_INDEX,
                                 (u32)placement->order, (u32)(placement->order >> 32) };
    placer->features |= feature_bit(FEATURE_INSTANCES);
    note_material(placer, &placer->objects[index], placement->material);
    return primitive_list_add(&placer->top.list, &primitive, info, NULL,
                              placed_box(&placer->objects[index].level.bounds, &placement->to_render), error);
}

// A group that is being placed. Objects may nest as deep as a file likes, so the stack of them is our own.
typedef struct Frame {
    const Group *group;
    u32 next;      // item
    Placement at;
    bool own_level; // bounded shapes belong to the object's own level
} Frame;

typedef struct FrameStack {
    Frame *frames;
    u32 count, capacity;
} FrameStack;

static bool push_frame(FrameStack *stack, const Group *group, Placement at, bool own_level, Error *error)
{
    if (stack->count == stack->capacity) {
        const u32 capacity = stack->capacity ? 2 * stack->capacity : 16;
        Frame *frames = realloc(stack->frames, capacity * sizeof *frames);
        if (!frames)
            return error_set(error, ERROR_MEMORY, "no memory for objects nested %u deep", stack->count);
        stack->frames = frames;
        stack->capacity = capacity;
    }
    stack->frames[stack->count++] = (Frame){ group, 0, at, own_level };
    return true;
}

static bool place_shape(Placer *placer, const Shape *shape, Frame *frame, Error *error)
{
    const bool plane = shape->kind == SHAPE_PLANE;
    const i32 material = shape->material < 0 ? frame->at.material : shape->material;
    const u64 order = frame->at.order;
    frame->at.order += order_size(shape);
    if (frame->own_level && !plane)
        return true;
    if (shape->kind == SHAPE_MESH)
        return add_mesh(placer, &placer->top, shape, frame->at.to_render, material, false, order, error);
    return add_shape(placer, plane ? &placer->planes : &placer->top.list, shape, frame->at.to_render,
                     material < 0 ? 0 : material, order, error);
}

// Places the surface of an area light.
static bool place_light(Placer *placer, const Light *light, Frame *frame, Error *error)
{
    Primitive primitive;
    BakedBounds bounds;
    const u64 order = frame->at.order++;
    const PrimitiveInfo info = { placer->scene->material_count + placer->area_lights++, NO_INDEX, (u32)order,
                                 (u32)(order >> 32) };
    if (!bake_light(light, &frame->at.to_render, &primitive, &bounds, error))
        return error_locate(placer->scene, light->at, error);
    placer->features |= feature_bit(shape_features[primitive.kind]);
    primitive.kind |= PRIMITIVE_OPAQUE;
    return primitive_list_add(&placer->top.list, &primitive, info, NULL,
                              box_from_bounds(bounds.min, bounds.max), error);
}

// Places an instance and puts the group of its object on the stack.
static bool place_instance(Placer *placer, const Instance *instance, FrameStack *stack, Error *error)
{
    Frame *frame = &stack->frames[stack->count - 1];
    const ObjectLayout *object = &placer->objects[instance->object];
    const Placement inner = { affine_compose(frame->at.to_render, instance->transform),
                              instance->material < 0 ? frame->at.material : instance->material,
                              frame->at.order };
    frame->at.order += object->order_size;
    if (object->second_level && !add_instance(placer, instance->object, &inner, error))
        return false;
    return (object->second_level && !object->deeper) ||
           push_frame(stack, &placer->scene->objects[instance->object].group, inner, object->second_level,
                      error);
}

static bool place_world(Placer *placer, Placement world, Error *error)
{
    const Scene *scene = placer->scene;
    FrameStack stack = { NULL, 0, 0 };
    bool ok = push_frame(&stack, &scene->world, world, false, error);
    while (ok && stack.count > 0) {
        Frame *frame = &stack.frames[stack.count - 1];
        if (frame->next == frame->group->count) {
            stack.count--;
            continue;
        }
        const Item item = frame->group->items[frame->next++];
        if (item.kind == ITEM_SHAPE)
            ok = place_shape(placer, &scene->shapes[item.index], frame, error);
        else if (item.kind == ITEM_INSTANCE)
            ok = place_instance(placer, &scene->instances[item.index], &stack, error);
        else
            ok = place_light(placer, &scene->lights[item.index], frame, error);
    }
    free(stack.frames);
    return ok;
}

// Sizes of the objects; each holds only objects defined before it.
static void measure_objects(Placer *placer)
{
    const Scene *scene = placer->scene;
    for (u32 i = 0; i < scene->object_count; i++) {
        const Group *group = &scene->objects[i].group;
        ObjectLayout *object = &placer->objects[i];
        for (u32 k = 0; k < group->count; k++) {
            if (group->items[k].kind == ITEM_INSTANCE) {
                const Instance *instance = &scene->instances[group->items[k].index];
                object->order_size += placer->objects[instance->object].order_size;
                object->deeper = true;
            } else {
                const Shape *shape = &scene->shapes[group->items[k].index];
                object->order_size += order_size(shape);
                object->bounded += shape->kind != SHAPE_PLANE;
                object->meshes = object->meshes || shape->kind == SHAPE_MESH;
                object->deeper = object->deeper || shape->kind == SHAPE_PLANE;
            }
        }
    }
}

static void count_placements(Placer *placer, const Group *group, u64 placements)
{
    for (u32 k = 0; k < group->count; k++)
        if (group->items[k].kind == ITEM_INSTANCE)
            placer->objects[placer->scene->instances[group->items[k].index].object].placements += placements;
}

// Which objects get a level of their own: a mesh is worth it alone, where it is placed more than once.
static void choose_levels(Placer *placer)
{
    count_placements(placer, &placer->scene->world, 1);
    for (u32 i = placer->scene->object_count; i-- > 0;) {
        ObjectLayout *object = &placer->objects[i];
        count_placements(placer, &placer->scene->objects[i].group, object->placements);
        object->second_level = object->meshes ? object->placements > 1 : object->bounded > 1;
    }
}

static void find_texture_needs(Placer *placer)
{
    const Scene *scene = placer->scene;
    for (u32 i = 0; i < scene->material_count; i++) {
        const Material *material = &scene->materials[i];
        i32 textures[MATERIAL_TEXTURES_MAX];
        for (u32 k = material_textures(material, true, true, textures); k-- > 0;) {
            const bool solid = scene->textures[textures[k]].kind == TEXTURE_CHECKER3D;
            placer->solid |= solid;
            placer->uv |= !solid;
        }
        placer->uv |= material->normal_map >= 0;
    }
}

bool placer_run(Placer *placer, const Scene *scene, Error *error)
{
    memset(placer, 0, sizeof *placer);
    placer->scene = scene;
    placer->objects = calloc(scene->object_count + 1, sizeof *placer->objects);
    placer->material_used = calloc(scene->material_count + 1, sizeof *placer->material_used);
    if (!placer->objects || !placer->material_used)
        return error_set(error, ERROR_MEMORY, "no memory for %u objects", scene->object_count);
    measure_objects(placer);
    choose_levels(placer);
    find_texture_needs(placer);
    placer->planes.with_frames = placer->top.list.with_frames = placer->solid;
    const Placement world = { affine_translate(vec_scale(scene->camera.position, -1)), -1, 0 };
    return place_world(placer, world, error) && level_complete(&placer->top, scene, error);
}

void placer_destroy(Placer *placer)
{
    for (u32 i = 0; placer->objects && i < placer->scene->object_count; i++)
        level_destroy(&placer->objects[i].level);
    primitive_list_destroy(&placer->planes);
    level_destroy(&placer->top);
    free(placer->objects);
    free(placer->extras);
    free(placer->material_used);
    memset(placer, 0, sizeof *placer);
}
