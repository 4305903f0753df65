// Shapes: ten kinds, each a table and what must hold of its properties together.
#include <float.h>
#include <math.h>
#include <string.h>

#include "scene/statement.h"
#include "scene/transform.h"

#define NUMBERS(name, member, numbers, range) \
    {name, VALUE_NUMBERS, AT(Shape, as.member), range, .count = numbers, .required = true}
#define CAPS(member) {"caps", VALUE_SWITCH, AT(Shape, as.member)}
#define COMMON \
    {"material", VALUE_MATERIAL, AT(Shape, material)}, \
    TRANSFORM_PROPERTIES(offsetof(Shape, transform))

static const char *const SMOOTH_WORDS[] = {"off", "on", NULL};

static const Property SPHERE_PROPERTIES[] = {
    NUMBERS("center", sphere.center, 3, RANGE_ANY),
    NUMBERS("radius", sphere.radius, 1, RANGE_POSITIVE),
    COMMON,
};

static const Property PLANE_PROPERTIES[] = {
    NUMBERS("point", plane.point, 3, RANGE_ANY),
    NUMBERS("normal", plane.normal, 3, RANGE_DIRECTION),
    COMMON,
};

// center and size are read into min and max, and turned into them when both are known.
static const Property BOX_PROPERTIES[] = {
    {"min", VALUE_NUMBERS, AT(Shape, as.box.min), .count = 3},
    {"max", VALUE_NUMBERS, AT(Shape, as.box.max), .count = 3},
    {"center", VALUE_NUMBERS, AT(Shape, as.box.min), .count = 3},
    {"size", VALUE_NUMBERS, AT(Shape, as.box.max), RANGE_POSITIVE, .count = 3, .one_for_all = true},
    COMMON,
};

// center and size are read into the first two vertices, and turned into all four when both are known.
static const Property TETRAHEDRON_PROPERTIES[] = {
    {"vertices", VALUE_NUMBERS, AT(Shape, as.tetrahedron.vertices), .count = 12},
    {"center", VALUE_NUMBERS, AT(Shape, as.tetrahedron.vertices[0]), .count = 3},
    {"size", VALUE_NUMBERS, AT(Shape, as.tetrahedron.vertices[1]), RANGE_POSITIVE, .count = 1},
    COMMON,
};

static const Property TRIANGLE_PROPERTIES[] = {
    NUMBERS("vertices", triangle.vertices, 9, RANGE_ANY),
    {"normals", VALUE_NUMBERS, AT(Shape, as.triangle.normals), RANGE_DIRECTION, .count = 9},
    {"uvs", VALUE_NUMBERS, AT(Shape, as.triangle.uvs), .count = 6},
    COMMON,
};

static const Property DISK_PROPERTIES[] = {
    NUMBERS("center", disk.center, 3, RANGE_ANY),
    NUMBERS("normal", disk.normal, 3, RANGE_DIRECTION),
    NUMBERS("radius", disk.radius, 1, RANGE_POSITIVE),
    COMMON,
};

static const Property CYLINDER_PROPERTIES[] = {
    NUMBERS("base", cylinder.base, 3, RANGE_ANY),
    NUMBERS("top", cylinder.top, 3, RANGE_ANY),
    NUMBERS("radius", cylinder.radius, 1, RANGE_POSITIVE),
    CAPS(cylinder.caps),
    COMMON,
};

static const Property CONE_PROPERTIES[] = {
    NUMBERS("base", cone.base, 3, RANGE_ANY),
    NUMBERS("top", cone.top, 3, RANGE_ANY),
    NUMBERS("radius", cone.radius, 1, RANGE_NOT_NEGATIVE),
    {"top_radius", VALUE_NUMBERS, AT(Shape, as.cone.top_radius), RANGE_NOT_NEGATIVE, .count = 1},
    CAPS(cone.caps),
    COMMON,
};

static const Property TORUS_PROPERTIES[] = {
    NUMBERS("center", torus.center, 3, RANGE_ANY),
    NUMBERS("axis", torus.axis, 3, RANGE_DIRECTION),
    NUMBERS("major", torus.major, 1, RANGE_POSITIVE),
    NUMBERS("minor", torus.minor, 1, RANGE_POSITIVE),
    COMMON,
};

static const Property MESH_PROPERTIES[] = {
    {"file", VALUE_FILE, AT(Shape, as.mesh.file), .required = true,
     .position = offsetof(Shape, as.mesh.file_at)},
    {"smooth", VALUE_WORD, AT(Shape, as.mesh.smooth), .words = SMOOTH_WORDS},
    {"terminator", VALUE_SWITCH, AT(Shape, as.mesh.terminator)},
    COMMON,
};

// ---- checks ---------------------------------------------------------------------------------

// Given, without an error.
static bool known(const Block *block, const char *property)
{
    return block_given(block, property) && block_good(block, property);
}

static void check_transform(Parser *parser, Block *block)
{
    const Shape *shape = block->target;
    transform_check(parser, block, &shape->transform);
}

// Whether one of the two forms of a shape is complete and the other absent. form_a, form_b: names of
// properties, the last may be NULL.
static bool check_forms(Parser *parser, const Block *block, const char *const form_a[2],
                        const char *const form_b[2], const char *needs)
{
    bool complete[2] = {true, true};
    const char *given[2] = {NULL, NULL};
    for (u32 i = 0; i < 2; ++i) {
        const char *const names[2] = {form_a[i], form_b[i]};
        for (u32 form = 0; form < 2; ++form) {
            if (!names[form])
                continue;
            if (block_given(block, names[form]))
                given[form] = names[form];
            else
                complete[form] = false;
        }
    }
    if (given[0] && given[1]) {
        block_refuse_both(parser, block, given[0], given[1]);
        return false;
    }
    if (!complete[0] && !complete[1] && !block->unknown_property)
        parser_error(parser, block->word, "%s lacks %s", block->type->title, needs);
    return complete[0] || complete[1];
}

// The axis in which min is not below max; NULL where there is none.
static const char *flat_axis(Vec3 min, Vec3 max)
{
    return !(min.x < max.x) ? "x" : !(min.y < max.y) ? "y" : !(min.z < max.z) ? "z" : NULL;
}

static void check_box(Parser *parser, Block *block)
{
    check_transform(parser, block);
    static const char *const corners[2] = {"min", "max"}, *const middle[2] = {"center", "size"};
    Shape *shape = block->target;
    Vec3 *min = &shape->as.box.min, *max = &shape->as.box.max;
    if (!check_forms(parser, block, corners, middle, "'min' and 'max', or 'center' and 'size'"))
        return;
    if (known(block, "center") && known(block, "size")) {
        const Vec3 center = *min, half = vec_scale(*max, 0.5);
        *min = vec_sub(center, half);
        *max = vec_add(center, half);
        if (flat_axis(*min, *max))
            parser_error(parser, block_place(block, "size"), "'size' is lost beside 'center' in %s",
                         flat_axis(*min, *max));
    } else if (known(block, "min") && known(block, "max") && flat_axis(*min, *max)) {
        parser_error(parser, block_later(block, "min", "max"), "'min' must be below 'max' in %s",
                     flat_axis(*min, *max));
    }
}

// Largest absolute coordinate, as the measure of what the vertices are rounded to.
static f64 magnitude(const Vec3 *vertices, u32 count)
{
    f64 largest = 0;
    for (u32 i = 0; i < count; ++i)
        largest = fmax(largest, fmax(fabs(vertices[i].x), fmax(fabs(vertices[i].y), fabs(vertices[i].z))));
    return largest;
}

// A regular one of edge length size about center, apex up, as the manual gives it.
static void make_regular(Vec3 center, f64 size, Vec3 vertices[4])
{
    const f64 height = size * sqrt(2.0 / 3.0), low = -height / 4, back = size / (2 * sqrt(3.0));
    vertices[0] = vec_add(center, (Vec3){-size / 2, low, back});
    vertices[1] = vec_add(center, (Vec3){size / 2, low, back});
    vertices[2] = vec_add(center, (Vec3){0, low, -size / sqrt(3.0)});
    vertices[3] = vec_add(center, (Vec3){0, 3 * height / 4, 0});
}

static void check_tetrahedron(Parser *parser, Block *block)
{
    check_transform(parser, block);
    static const char *const listed[2] = {"vertices", NULL}, *const middle[2] = {"center", "size"};
    Shape *shape = block->target;
    Vec3 *v = shape->as.tetrahedron.vertices;
    if (!check_forms(parser, block, listed, middle, "'vertices', or 'center' and 'size'"))
        return;
    if (known(block, "center") && known(block, "size")) {
        make_regular(v[0], v[1].x, v);
    } else if (known(block, "vertices")) {
        // Vertices that lie in a plane do so only up to the rounding of their coordinates.
        const Vec3 e1 = vec_sub(v[1], v[0]), e2 = vec_sub(v[2], v[0]), e3 = vec_sub(v[3], v[0]);
        const f64 edge = fmax(vec_length(e1), fmax(vec_length(e2), vec_length(e3)));
        const f64 rounding = 16 * DBL_EPSILON * magnitude(v, 4);
        if (fabs(vec_dot(e1, vec_cross(e2, e3))) <= rounding * edge * edge)
            parser_error(parser, block_place(block, "vertices"), "the tetrahedron has no volume");
    }
}

static void check_triangle(Parser *parser, Block *block)
{
    check_transform(parser, block);
    Shape *shape = block->target;
    const Vec3 *v = shape->as.triangle.vertices;
    shape->as.triangle.has_normals = block_given(block, "normals");
    shape->as.triangle.has_uvs = block_given(block, "uvs");
    if (!known(block, "vertices"))
        return;
    const Vec3 e1 = vec_sub(v[1], v[0]), e2 = vec_sub(v[2], v[0]);
    const f64 edge = fmax(vec_length(e1), vec_length(e2));
    if (vec_length(vec_cross(e1, e2)) <= 8 * DBL_EPSILON * magnitude(v, 3) * edge)
        parser_error(parser, block_place(block, "vertices"), "the triangle has no area");
}

static void check_axis(Parser *parser, const Block *block, Vec3 base, Vec3 top)
{
    if (known(block, "base") && known(block, "top") && vec_length(vec_sub(top, base)) == 0)
        parser_error(parser, block_later(block, "base", "top"), "'base' and 'top' are the same point");
}

static void check_cylinder(Parser *parser, Block *block)
{
    check_transform(parser, block);
    const Shape *shape = block->target;
    check_axis(parser, block, shape->as.cylinder.base, shape->as.cylinder.top);
}

static void check_cone(Parser *parser, Block *block)
{
    check_transform(parser, block);
    const Shape *shape = block->target;
    check_axis(parser, block, shape->as.cone.base, shape->as.cone.top);
    if (known(block, "radius") && block_good(block, "top_radius") && shape->as.cone.radius == 0 &&
        shape->as.cone.top_radius == 0)
        parser_error(parser, block_later(block, "radius", "top_radius"),
                     "'radius' and 'top_radius' are both 0");
}

static void check_torus(Parser *parser, Block *block)
{
    check_transform(parser, block);
    const Shape *shape = block->target;
    if (known(block, "major") && known(block, "minor") && shape->as.torus.minor > shape->as.torus.major)
        parser_error(parser, block_later(block, "major", "minor"), "'minor' (%g) is above 'major' (%g)",
                     shape->as.torus.minor, shape->as.torus.major);
}

// ---- the statement --------------------------------------------------------------------------

static const BlockType SHAPE_BLOCKS[] = {
    [SHAPE_SPHERE] = BLOCK_TYPE("sphere", SPHERE_PROPERTIES, check_transform),
    [SHAPE_PLANE] = BLOCK_TYPE("plane", PLANE_PROPERTIES, check_transform),
    [SHAPE_BOX] = BLOCK_TYPE("box", BOX_PROPERTIES, check_box),
    [SHAPE_TETRAHEDRON] = BLOCK_TYPE("tetrahedron", TETRAHEDRON_PROPERTIES, check_tetrahedron),
    [SHAPE_TRIANGLE] = BLOCK_TYPE("triangle", TRIANGLE_PROPERTIES, check_triangle),
    [SHAPE_DISK] = BLOCK_TYPE("disk", DISK_PROPERTIES, check_transform),
    [SHAPE_CYLINDER] = BLOCK_TYPE("cylinder", CYLINDER_PROPERTIES, check_cylinder),
    [SHAPE_CONE] = BLOCK_TYPE("cone", CONE_PROPERTIES, check_cone),
    [SHAPE_TORUS] = BLOCK_TYPE("torus", TORUS_PROPERTIES, check_torus),
    [SHAPE_MESH] = BLOCK_TYPE("mesh", MESH_PROPERTIES, check_transform),
};

void shape_parse(Parser *parser, const Statement *statement, const Token *word, Group *inside)
{
    Shape shape;
    memset(&shape, 0, sizeof shape);
    shape.kind = (ShapeKind)statement->kind;
    shape.at = parser_position(parser, word);
    shape.material = -1;
    shape.transform = affine_identity();
    if (shape.kind == SHAPE_CYLINDER)
        shape.as.cylinder.caps = true;
    else if (shape.kind == SHAPE_CONE)
        shape.as.cone.caps = true;
    else if (shape.kind == SHAPE_MESH)
        shape.as.mesh.smooth = -1;
    if (!block_parse(parser, &SHAPE_BLOCKS[shape.kind], word, &shape))
        return;
    Scene *scene = parser->scene;
    Shape *shapes = parser_grow(parser, scene->shapes, scene->shape_count, sizeof *shapes);
    if (!shapes)
        return;
    scene->shapes = shapes;
    shapes[scene->shape_count++] = shape;
    group_add(parser, inside, ITEM_SHAPE, scene->shape_count - 1);
}
