// Transforms: the four properties that shapes and instances share.
#ifndef CLRT_SCENE_TRANSFORM_H
#define CLRT_SCENE_TRANSFORM_H

#include "scene/block.h"

// Compose one transform onto the Affine at value, to be applied after what is there.
PropertyReader transform_read_translate, transform_read_rotate, transform_read_scale, transform_read_matrix;

// The lines of a table, for an Affine at offset.
#define TRANSFORM_PROPERTIES(offset) \
    {"translate", VALUE_OTHER, offset, .read = transform_read_translate, .repeatable = true, \
     .takes = "3 numbers"}, \
    {"rotate", VALUE_OTHER, offset, .read = transform_read_rotate, .repeatable = true, \
     .takes = "x, y, z or an axis of 3 numbers, and an angle"}, \
    {"scale", VALUE_OTHER, offset, .read = transform_read_scale, .repeatable = true, \
     .takes = "1 or 3 numbers"}, \
    {"matrix", VALUE_OTHER, offset, .read = transform_read_matrix, .repeatable = true, \
     .takes = "12 numbers: 3 rows of 4"}

// Reports a chain of transforms whose product is out of the range of numbers.
void transform_check(Parser *parser, const Block *block, const Affine *transform);

#endif
