#include "scene/transform.h"

#include <math.h>
#include <string.h>

static bool then(Affine *transform, Affine next)
{
    *transform = affine_compose(next, *transform);
    return true;
}

bool transform_read_translate(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property numbers = {"translate", VALUE_NUMBERS, 0, .count = 3};
    (void)property;
    Vec3 t;
    return value_read(parser, &numbers, name, &t) && then(value, affine_translate(t));
}

bool transform_read_rotate(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const char *const axes[] = {"x", "y", "z", NULL};
    static const Property axis_numbers = {"rotate", VALUE_OTHER, 0, RANGE_DIRECTION, .count = 3,
                                          .takes = "x, y, z or an axis of 3 numbers, and an angle"};
    static const Property degrees = {"rotate", VALUE_OTHER, 0, .count = 1,
                                     .takes = "x, y, z or an axis of 3 numbers, and an angle"};
    const i32 named = parser_find_word(&parser->token, axes);
    if (named < 0 && parser->token.kind != TOKEN_NUMBER)
        return value_refuse(parser, property, name, 0);
    Vec3 axis = {named == 0, named == 1, named == 2};
    f64 angle;
    if (named >= 0)
        parser_advance(parser);
    else if (!value_read_numbers(parser, &axis_numbers, name, &axis.x))
        return false;
    return value_read_numbers(parser, &degrees, name, &angle) && then(value, affine_rotate(axis, angle));
}

bool transform_read_scale(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property numbers = {"scale", VALUE_NUMBERS, 0, RANGE_NOT_ZERO, .count = 3,
                                     .one_for_all = true};
    (void)property;
    Vec3 s;
    return value_read(parser, &numbers, name, &s) && then(value, affine_scale(s));
}

bool transform_read_matrix(Parser *parser, const Property *property, const Token *name, void *value)
{
    static const Property numbers = {"matrix", VALUE_NUMBERS, 0, .count = 12};
    const f64 singular_ratio = 1e-6;
    (void)property;
    f64 m[12];
    if (!value_read(parser, &numbers, name, m))
        return false;
    const Affine matrix = {.row = {{m[0], m[1], m[2]}, {m[4], m[5], m[6]}, {m[8], m[9], m[10]}},
                           .translation = {m[3], m[7], m[11]}};
    f64 values[3];
    affine_singular_values(matrix, values);
    if (values[0] == 0 || values[2] < singular_ratio * values[0]) {
        parser_error(parser, name, "the matrix is singular");
        return false;
    }
    return then(value, matrix);
}

void transform_check(Parser *parser, const Block *block, const Affine *transform)
{
    const Affine identity = affine_identity();
    if (memcmp(transform, &identity, sizeof identity) == 0)
        return; // as most shapes have it
    // Factors that are each fine may multiply to more than a number holds, or to nothing.
    const f64 largest = 1e150, smallest = 1e-150;
    const Vec3 *row = transform->row;
    const f64 norm = fmax(vec_length(row[0]), fmax(vec_length(row[1]), vec_length(row[2])));
    const f64 moved = vec_length(transform->translation);
    bool good = norm <= largest && moved <= largest;
    // The smallest singular value is at least the determinant over the square of the largest.
    const f64 ordinary = 1e30;
    if (good && !(norm <= ordinary && fabs(affine_determinant(*transform)) >= 1 / ordinary)) {
        f64 values[3];
        affine_singular_values(*transform, values);
        good = values[2] >= smallest;
    }
    if (!good)
        parser_error(parser, block->word, "the transforms of this %s multiply out of range",
                     block->type->title);
}
