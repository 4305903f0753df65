// Random shapes anywhere in space, and rays at them that look for trouble.
#ifndef CLRT_TESTS_KERNEL_SHAPES_RANDOM_H
#define CLRT_TESTS_KERNEL_SHAPES_RANDOM_H

#include "shapes_reference.h"
#include "shapes_support.h"

typedef struct Placed {
    Shape shape;
    Affine map;
    RealMap inverse;
    double size;    // object units, the largest extent
    double feature; // the smallest radius or edge
} Placed;

typedef struct Family {
    const char *name;
    ShapeKind kind;
    int primitive; // PRIMITIVE_X that it becomes
    bool affine;   // under any transform; else under similarities
    bool open;     // cylinder and cone without caps
    bool giant;
} Family;

enum { FAMILY_COUNT = 13 };
extern const Family shape_families[FAMILY_COUNT];

// Fills `count` shapes of the family under random maps, from millionths to millions in size, and what they
// are baked to.
void random_placed(const Family *family, Placed *placed, Primitive *primitives, int count, uint64_t *state);

// Adds a ray from the origin of space, around the shape or within it, aimed at its neighbourhood: surface,
// edges, axes; some along an axis of space, some of any length.
void add_random_ray(RayTable *table, const Placed *p, int index, uint64_t *state);

#endif
