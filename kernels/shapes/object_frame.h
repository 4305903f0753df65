// The hit point in the space of its shape, for textures that live there.
#ifndef CLRT_KERNELS_SHAPES_OBJECT_FRAME_H
#define CLRT_KERNELS_SHAPES_OBJECT_FRAME_H

#include "base/table.h"
#include "shared/object_frame.h"

#define OBJECT_FRAME_NUMBERS 24

// The position is whole + fine.
typedef struct {
    v3 whole;  // whole numbers
    v3 fine;
    v3 normal; // unit, outward, in the shape's space
} ObjectPoint;

// p and ng: a point and its unit normal in the space of the primitive; index: of the primitive's frame.
static inline ObjectPoint object_point(global const ObjectFrame *frames, vi index, v3 p, v3 ng)
{
    const Row row = row_make(frames, index, OBJECT_FRAME_NUMBERS);
    ObjectPoint o;
    o.whole = v3_make(row_real(&row, 3), row_real(&row, 7), row_real(&row, 11));
    const v3 rest = v3_make(row_real(&row, 15), row_real(&row, 19), row_real(&row, 23));
    o.fine = v3_add(v3_make(v3_dot(row_real3(&row, 0), p), v3_dot(row_real3(&row, 4), p),
                            v3_dot(row_real3(&row, 8), p)), rest);
    o.normal = v3_normalize(v3_make(v3_dot(row_real3(&row, 12), ng), v3_dot(row_real3(&row, 16), ng),
                                    v3_dot(row_real3(&row, 20), ng)));
    return o;
}

#endif
