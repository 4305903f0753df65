/* Shapes, their transforms, and instances. */
#include <string.h>

#include "mesh.h"
#include "parse.h"
#include "shape.h"

/* What a shape block says before it is put into a Shape. */
typedef struct ShapeText {
    Vec center, size, min, max, base, top, axis;
    bool has_center, has_vertices;
    bool round; /* cylinder: top_radius follows radius */
    const char *file; /* path; of a mesh */
    Smooth smooth;
} ShapeText;

static bool parse_transform(Parser *parser, Transform *placed)
{
    Transform step;
    if (parse_accept(parser, "translate")) {
        step = transform_translate(parse_vec(parser));
    } else if (parse_accept(parser, "scale")) {
        step = transform_scale(parse_one_or_three(parser));
    } else if (parse_accept(parser, "rotate")) {
        Vec axis;
        if (parse_accept(parser, "x"))
            axis = vec(1, 0, 0);
        else if (parse_accept(parser, "y"))
            axis = vec(0, 1, 0);
        else if (parse_accept(parser, "z"))
            axis = vec(0, 0, 1);
        else
            axis = parse_vec(parser);
        step = transform_rotate(axis, parse_number(parser));
    } else if (parse_accept(parser, "matrix")) {
        for (int i = 0; i < 12; i++)
            step.m[i / 4][i % 4] = parse_number(parser);
    } else {
        return false;
    }
    *placed = transform_then(placed, &step);
    return true;
}

static bool parse_vertex_data(Parser *parser, Shape *shape, ShapeText *text)
{
    if (parse_accept(parser, "vertices")) {
        text->has_vertices = true;
        int count = shape->kind == SHAPE_TRIANGLE ? 3 : 4;
        for (int i = 0; i < count; i++)
            shape->vertices[i] = parse_vec(parser);
    } else if (parse_accept(parser, "normals")) {
        shape->has_normals = true;
        for (int i = 0; i < 3; i++)
            shape->normals[i] = parse_vec(parser);
    } else if (parse_accept(parser, "uvs")) {
        shape->has_uvs = true;
        for (int i = 0; i < 6; i++)
            shape->uvs[i / 2][i % 2] = parse_number(parser);
    } else if (parse_accept(parser, "file")) {
        text->file = store_beside(&parser->scene->store, parser->path, parse_string(parser));
    } else if (parse_accept(parser, "smooth")) {
        text->smooth = parse_on_off(parser) ? SMOOTH_ON : SMOOTH_OFF;
    } else {
        return false;
    }
    return true;
}

static bool parse_dimension(Parser *parser, Shape *shape, ShapeText *text)
{
    if (parse_accept(parser, "center")) {
        text->center = parse_vec(parser);
        text->has_center = true;
    } else if (parse_accept(parser, "point")) {
        text->center = parse_vec(parser);
    } else if (parse_accept(parser, "normal") || parse_accept(parser, "axis")) {
        text->axis = parse_vec(parser);
    } else if (parse_accept(parser, "radius") || parse_accept(parser, "major")) {
        shape->radius = parse_number(parser);
    } else if (parse_accept(parser, "top_radius") || parse_accept(parser, "minor")) {
        shape->top_radius = parse_number(parser);
    } else if (parse_accept(parser, "caps")) {
        shape->caps = parse_on_off(parser);
    } else if (parse_accept(parser, "min")) {
        text->min = parse_vec(parser);
    } else if (parse_accept(parser, "max")) {
        text->max = parse_vec(parser);
    } else if (parse_accept(parser, "size")) {
        text->size = parse_one_or_three(parser);
    } else if (parse_accept(parser, "base")) {
        text->base = parse_vec(parser);
    } else if (parse_accept(parser, "top")) {
        text->top = parse_vec(parser);
    } else {
        return false;
    }
    return true;
}

/* The regular tetrahedron of edge s about a centre, apex towards +y. */
static void regular_vertices(Shape *shape, Vec center, real s)
{
    real h = s * sqrtl(2.0L / 3);
    real r = s / sqrtl(3);
    shape->vertices[0] = add(center, vec(-s / 2, -h / 4, r / 2));
    shape->vertices[1] = add(center, vec(s / 2, -h / 4, r / 2));
    shape->vertices[2] = add(center, vec(0, -h / 4, -r));
    shape->vertices[3] = add(center, vec(0, 3 * h / 4, 0));
}

static void finish(Scene *scene, Shape *shape, const ShapeText *text)
{
    shape->center = text->center;
    shape->normal = text->axis;
    if (shape->kind == SHAPE_CONE) {
        shape->center = text->base;
        shape->normal = sub(text->top, text->base);
        if (text->round)
            shape->top_radius = shape->radius;
    } else if (shape->kind == SHAPE_BOX) {
        shape->half = scaled(text->has_center ? text->size : sub(text->max, text->min), 0.5L);
        if (!text->has_center)
            shape->center = scaled(add(text->min, text->max), 0.5L);
    } else if (shape->kind == SHAPE_TETRAHEDRON && !text->has_vertices) {
        regular_vertices(shape, text->center, text->size.x);
    } else if (shape->kind == SHAPE_MESH) {
        shape->mesh = mesh_read(scene, text->file, text->smooth);
    }
    shape_finish(shape);
}

static const struct {
    const char *name;
    ShapeKind kind;
} SHAPES[] = {
    {"sphere", SHAPE_SPHERE},           {"plane", SHAPE_PLANE},       {"box", SHAPE_BOX},
    {"tetrahedron", SHAPE_TETRAHEDRON}, {"triangle", SHAPE_TRIANGLE}, {"disk", SHAPE_DISK},
    {"cone", SHAPE_CONE},               {"cylinder", SHAPE_CONE},     {"torus", SHAPE_TORUS},
    {"mesh", SHAPE_MESH},
};

static bool parse_start(Parser *parser, Item *item, ShapeText *text)
{
    if (parse_accept(parser, "instance")) {
        int object = scene_find_object(parser->scene, parser->at->text);
        if (object < 0)
            parse_unknown(parser, "object");
        parser->at++;
        item->is_instance = true;
        item->object = (size_t)object;
        return true;
    }
    for (size_t i = 0; i < sizeof SHAPES / sizeof SHAPES[0]; i++) {
        if (!parse_accept(parser, SHAPES[i].name))
            continue;
        item->shape.kind = SHAPES[i].kind;
        text->round = strcmp(SHAPES[i].name, "cylinder") == 0;
        return true;
    }
    return false;
}

bool parse_item(Parser *parser, Item *item)
{
    ShapeText text = {.smooth = SMOOTH_FILE};
    *item = (Item){.material = MATERIAL_NONE, .light = -1, .placed = transform_identity(),
                   .shape = {.caps = true}};
    if (!parse_start(parser, item, &text))
        return false;
    parse_open(parser);
    while (!parse_closed(parser)) {
        if (parse_transform(parser, &item->placed))
            continue;
        if (parse_accept(parser, "material")) {
            item->material = scene_find_material(parser->scene, parser->at->text);
            /* `default` serves the whole file, also where it is defined later or not at all. */
            if (item->material < 0 && strcmp(parser->at->text, "default") != 0)
                parse_unknown(parser, "material");
            if (item->material < 0)
                item->material = MATERIAL_DEFAULT;
            parser->at++;
        } else if (item->is_instance ||
                   !(parse_dimension(parser, &item->shape, &text) ||
                     parse_vertex_data(parser, &item->shape, &text))) {
            parse_unknown(parser, "property");
        }
    }
    if (!item->is_instance)
        finish(parser->scene, &item->shape, &text);
    return true;
}
