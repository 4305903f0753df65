// What the hierarchy adds to Primitive.kind: instances among the primitives, and a bit for shadow rays.
#ifndef CLRT_SHARED_INSTANCE_H
#define CLRT_SHARED_INSTANCE_H

#include "shared/primitive.h"

#define PRIMITIVE_KIND_MASK 15u
// Surely stops light: its own material transmits nothing.
#define PRIMITIVE_OPAQUE 16u
// A placed object: q = A (p - c) leads from the parent's space to the object's; bits of p0: root node (i32).
#define PRIMITIVE_INSTANCE 15u

#endif
