// Random shapes anywhere in space, and rays at them that look for trouble. The same ones on every machine.
#ifndef CLRT_ULP_REFERENCE_PLACED_H
#define CLRT_ULP_REFERENCE_PLACED_H

#include "base/error.h"
#include "reference/shapes.h"
#include "shared/primitive.h"

typedef struct Placed {
    Shape shape;
    Affine map;      // the shape's coordinates -> space
    RealMap inverse; // of map
    double size;     // object units, the largest extent
    double feature;  // the smallest radius or edge
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

typedef enum Placing {
    PLACING_ANY,     // any map, from millionths to millions in size, up to 3000 sizes from the origin
    PLACING_PLAIN,   // no map but a shift of up to five sizes
    PLACING_FAR,     // any map, three thousand to three hundred thousand sizes from the origin
    PLACING_EXTREME, // from 1e-9 to 1e9 in size, squeezed along an axis by up to 1e3
    PLACING_COUNT
} Placing;

// A shape of the family under a random map, and what it is baked to. Giant spheres are always near the origin
// of space. False with the error of bake_shape.
bool random_placed(const Family *family, Placing placing, Placed *placed, Primitive *primitive,
                   uint64_t *state, Error *error);

typedef enum RayKind {
    RAY_ANY,     // from the origin of space, around the shape or within it; some of any length
    RAY_FAR,     // from ten to a million sizes away
    RAY_GRAZING, // along the surface, a hundred-millionth to a tenth of the size off it
    RAY_AXIS,    // along an axis of space
    RAY_INSIDE,  // from within, or from close to a flat shape
    RAY_EDGE,    // at edges, rims and the apex
    RAY_KINDS
} RayKind;

// A ray at the neighbourhood of the shape, as floats.
void random_ray(const Placed *p, RayKind kind, uint64_t *state, float origin[3], float direction[3]);

#endif
