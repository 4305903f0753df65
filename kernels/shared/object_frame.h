// ObjectFrame: the way from the space of a primitive back to the space in which the scene file describes its
// shape, for textures that live there (checker3d).
#ifndef CLRT_SHARED_OBJECT_FRAME_H
#define CLRT_SHARED_OBJECT_FRAME_H

#include "shared/types.h"

// Object-space position = (row0.p, row1.p, row2.p) + translation, the translation as the sum of a whole
// number (row0..2.w) and a rest (normal0..2.w), so that whole cells are counted exactly far from the origin.
typedef struct ObjectFrame {
    f32x4 row0; // xyz: first row of the linear part; w: whole number
    f32x4 row1;
    f32x4 row2;
    f32x4 normal0; // xyz: first row of the matrix that carries normals, up to a positive factor; w: rest
    f32x4 normal1;
    f32x4 normal2;
} ObjectFrame;
LAYOUT_SIZE(ObjectFrame, 96);
LAYOUT_OFFSET(ObjectFrame, normal0, 48);

#endif
