// PrimitiveList: primitives of one hierarchy, or the planes, with what stands beside them.
#ifndef CLRT_LAYOUT_PRIMITIVES_H
#define CLRT_LAYOUT_PRIMITIVES_H

#include "accel/bvh.h"
#include "base/error.h"
#include "base/vec.h"
#include "shared/instance.h"
#include "shared/material.h"
#include "shared/object_frame.h"

typedef struct PrimitiveList {
    Primitive *primitives;
    PrimitiveInfo *infos;
    ObjectFrame *frames; // NULL where no texture needs object space
    Box *boxes;
    u32 count, capacity;
    bool with_frames;
} PrimitiveList;

// Adds a copy of everything; frame may be NULL. Fails with ERROR_MEMORY.
bool primitive_list_add(PrimitiveList *list, const Primitive *primitive, PrimitiveInfo info,
                        const ObjectFrame *frame, Box box, Error *error);

// Writes `count` primitives to arrays: place i takes what is at order[i] of the list (NULL: at i). frames may
// be NULL.
void primitive_list_store(const PrimitiveList *list, const u32 *order, u32 count, Primitive *primitives,
                          PrimitiveInfo *infos, ObjectFrame *frames);

void primitive_list_destroy(PrimitiveList *list);

// The union of all boxes; count must not be 0.
Box primitive_list_bounds(const PrimitiveList *list);

// The box with corners min and max, rounded outward to float.
Box box_from_bounds(Vec3 min, Vec3 max);

#endif
