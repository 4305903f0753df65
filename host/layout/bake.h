// Bake: brings one shape of a scene, under its transforms, to the canonical form that kernels intersect
// (shared/primitive.h). Everything is computed in double and rounded once. Knows single shapes only: no
// hierarchy, no material, no device.
#ifndef CLRT_LAYOUT_BAKE_H
#define CLRT_LAYOUT_BAKE_H

#include "base/error.h"
#include "scene/scene.h"
#include "shared/object_frame.h"
#include "shared/primitive.h"

#define BAKE_OUT_OF_RANGE "too large or too small, once transformed, for the float format"

// Covers the primitive as it was rounded to float and the error of the hits on it. Planes are infinite.
typedef struct BakedBounds {
    Vec3 min, max;
} BakedBounds;

// The shape under `to_space`, the whole map from the coordinates that the shape is described in (so including
// shape->transform) to the space of the hierarchy: render space, where the camera is the origin, or the space
// of an object. Fills all of *out. shape->kind must not be SHAPE_MESH. ERROR_SCENE where a number
// of the result leaves the range of float; the message names neither the shape nor its place.
bool bake_shape(const Shape *shape, const Affine *to_space, Primitive *out, BakedBounds *bounds,
                Error *error);

// The surface of an area light, in the same way. Its outer side is the one that shines.
bool bake_light(const Light *light, const Affine *to_space, Primitive *out, BakedBounds *bounds, Error *error);

// The way back from that space. Numbers out of the range of float: ERROR_SCENE, as above.
bool bake_object_frame(const Affine *to_space, ObjectFrame *out, Error *error);

// x as the sum of the nearest whole number and a rest, so that small numbers stay as precise as they are. The
// rest is at most 1/2 up to 2^24, half an ulp of the whole number beyond.
void bake_split_whole(f64 x, f32 *whole, f32 *rest);

#endif
