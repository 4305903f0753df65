#include "layout/place.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "layout/bake.h"

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
};

static bool transmits(const Material *material)
{
    return material->transmit.x > 0 || material->transmit.y > 0 || material->transmit.z > 0;
}

// Adds the place of what went wrong, unless memory did.
static bool located(const Scene *scene, SourcePos at, Error *error)
{
    const Error reason = *error;
    if (reason.code == ERROR_MEMORY)
        return false;
    return error_set(error, reason.code, "%s:%u:%u: error: %s", scene->files[at.file], at.line, at.column,
                     reason.text);
}

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

// Bakes shape into list (or the planes). material -1: inherited from the instance.
static bool add_shape(Placer *placer, PrimitiveList *list, const Shape *shape, Affine to_space, i32 material,
                      u64 order, Error *error)
{
    Primitive primitive;
    BakedBounds bounds;
    ObjectFrame frame;
    PrimitiveInfo info = { material < 0 ? NO_INDEX : (u32)material, NO_INDEX, (u32)order,
                           (u32)(order >> 32) };
    const Affine total = affine_compose(to_space, shape->transform);
    memset(&primitive, 0, sizeof primitive);
    if (!bake_shape(shape, &total, &primitive, &bounds, error) ||
        (placer->solid && !bake_object_frame(&total, &frame, error)) ||
        !add_extra(placer, shape, &total, &info.extra, error))
        return located(placer->scene, shape->at, error);
    placer->features |= feature_bit(shape_features[primitive.kind]);
    if (material >= 0) {
        placer->material_used[material] = true;
        if (!transmits(&placer->scene->materials[material]))
            primitive.kind |= PRIMITIVE_OPAQUE;
    }
    return primitive_list_add(list, &primitive, info, placer->solid ? &frame : NULL,
                              box_from_bounds(bounds.min, bounds.max), error);
}

// The shapes of an object, in its own space, once. There is at least one.
static bool list_object(Placer *placer, u32 index, Error *error)
{
    const Scene *scene = placer->scene;
    ObjectLayout *object = &placer->objects[index];
    const Group *group = &scene->objects[index].group;
    u64 order = 0;
    object->list.with_frames = placer->solid;
    for (u32 i = 0; i < group->count; i++) {
        if (group->items[i].kind == ITEM_INSTANCE) {
            order += placer->objects[scene->instances[group->items[i].index].object].order_size;
            continue;
        }
        const Shape *shape = &scene->shapes[group->items[i].index];
        if (shape->kind != SHAPE_PLANE &&
            !add_shape(placer, &object->list, shape, affine_identity(), shape->material, order, error))
            return false;
        object->inherits = object->inherits || (shape->kind != SHAPE_PLANE && shape->material < 0);
        order++;
    }
    object->bounds = primitive_list_bounds(&object->list);
    object->listed = true;
    return true;
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
    const i32 material = placement->material < 0 ? 0 : placement->material;
    const PrimitiveInfo info = { (u32)material, NO_INDEX, (u32)placement->order,
                                 (u32)(placement->order >> 32) };
    placer->features |= feature_bit(FEATURE_INSTANCES);
    if (placer->objects[index].inherits)
        placer->material_used[material] = true;
    return primitive_list_add(&placer->top, &primitive, info, NULL,
                              placed_box(&placer->objects[index].bounds, &placement->to_render), error);
}

// A group that is being placed. Objects may nest as deep as a file likes, so the stack of them is our own.
typedef struct Frame {
    const Group *group;
    u32 next;      // item
    Placement at;
    bool own_list; // bounded shapes belong to the object's own list
} Frame;

typedef struct FrameStack {
    Frame *frames;
    u32 count, capacity;
} FrameStack;

static bool push_frame(FrameStack *stack, const Group *group, Placement at, bool own_list, Error *error)
{
    if (stack->count == stack->capacity) {
        const u32 capacity = stack->capacity ? 2 * stack->capacity : 16;
        Frame *frames = realloc(stack->frames, capacity * sizeof *frames);
        if (!frames)
            return error_set(error, ERROR_MEMORY, "no memory for objects nested %u deep", stack->count);
        stack->frames = frames;
        stack->capacity = capacity;
    }
    stack->frames[stack->count++] = (Frame){ group, 0, at, own_list };
    return true;
}

static bool place_shape(Placer *placer, const Shape *shape, Frame *frame, Error *error)
{
    const bool plane = shape->kind == SHAPE_PLANE;
    const i32 inherited = frame->at.material < 0 ? 0 : frame->at.material;
    const u64 order = frame->at.order++;
    return (frame->own_list && !plane) ||
           add_shape(placer, plane ? &placer->planes : &placer->top, shape, frame->at.to_render,
                     shape->material < 0 ? inherited : shape->material, order, error);
}

// Places an instance and puts the group of its object on the stack.
static bool place_instance(Placer *placer, const Instance *instance, FrameStack *stack, Error *error)
{
    Frame *frame = &stack->frames[stack->count - 1];
    const ObjectLayout *object = &placer->objects[instance->object];
    const Placement inner = { affine_compose(frame->at.to_render, instance->transform),
                              instance->material < 0 ? frame->at.material : instance->material,
                              frame->at.order };
    const bool listed = object->bounded > 1;
    frame->at.order += object->order_size;
    if (listed && !add_instance(placer, instance->object, &inner, error))
        return false;
    return (listed && !object->deeper) ||
           push_frame(stack, &placer->scene->objects[instance->object].group, inner, listed, error);
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
    }
    free(stack.frames);
    return ok;
}

// Sizes of the objects (each holds only objects defined before it), and what their textures need.
static void measure(Placer *placer)
{
    const Scene *scene = placer->scene;
    for (u32 i = 0; i < scene->object_count; i++) {
        const Group *group = &scene->objects[i].group;
        for (u32 k = 0; k < group->count; k++) {
            if (group->items[k].kind == ITEM_INSTANCE) {
                const Instance *instance = &scene->instances[group->items[k].index];
                placer->objects[i].order_size += placer->objects[instance->object].order_size;
                placer->objects[i].deeper = true;
            } else {
                const bool plane = scene->shapes[group->items[k].index].kind == SHAPE_PLANE;
                placer->objects[i].order_size++;
                placer->objects[i].bounded += !plane;
                placer->objects[i].deeper = placer->objects[i].deeper || plane;
            }
        }
    }
    for (u32 i = 0; i < scene->material_count; i++) {
        const i32 textures[2] = { scene->materials[i].diffuse.texture, scene->materials[i].ambient.texture };
        for (int k = 0; k < 2; k++) {
            if (textures[k] >= 0 && scene->textures[textures[k]].kind == TEXTURE_CHECKER3D)
                placer->solid = true;
            else if (textures[k] >= 0)
                placer->uv = true;
        }
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
    measure(placer);
    placer->planes.with_frames = placer->top.with_frames = placer->solid;
    const Placement world = { affine_translate(vec_scale(scene->camera.position, -1)), -1, 0 };
    return place_world(placer, world, error);
}

void placer_destroy(Placer *placer)
{
    for (u32 i = 0; placer->objects && i < placer->scene->object_count; i++)
        primitive_list_destroy(&placer->objects[i].list);
    primitive_list_destroy(&placer->planes);
    primitive_list_destroy(&placer->top);
    free(placer->objects);
    free(placer->extras);
    free(placer->material_used);
    memset(placer, 0, sizeof *placer);
}
